"""Results that are kept by what they belong to, and stay behind when their owner is pickled."""

import threading
from collections.abc import Callable
from typing import TypeVar

Key = TypeVar("Key")
Value = TypeVar("Value")


class Memo(dict[Key, Value]):
    """A dict of results that can be computed again, with a lock for whoever does so: empty where it is unpickled."""

    def __init__(self) -> None:
        super().__init__()
        self.lock = threading.RLock()

    def __reduce__(self) -> tuple[Callable[[], "Memo[Key, Value]"], tuple[()]]:
        return Memo, ()
