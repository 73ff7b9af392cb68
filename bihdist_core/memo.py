"""Results that are computed once, also when several threads ask for them first."""

import threading
from collections.abc import Callable
from functools import cached_property
from typing import Any, Generic, TypeVar, overload

Key = TypeVar("Key")
Value = TypeVar("Value")


class Memo(dict[Key, Value]):
    """A dict of results that can be computed again, with a lock for whoever does so: empty where it is unpickled."""

    def __init__(self) -> None:
        super().__init__()
        self.lock = threading.RLock()

    def __reduce__(self) -> tuple[Callable[[], "Memo[Key, Value]"], tuple[()]]:
        return Memo, ()


class locked_cached_property(cached_property[Value], Generic[Value]):
    """`functools.cached_property`, of which Python 3.12 took the lock; here each object and property has its own."""

    def __init__(self, func: Callable[[Any], Value]) -> None:
        super().__init__(func)

    @overload
    def __get__(self, instance: None, owner: type | None = None) -> "locked_cached_property[Value]": ...

    @overload
    def __get__(self, instance: object, owner: type | None = None) -> Value: ...

    def __get__(self, instance: object, owner: type | None = None) -> "locked_cached_property[Value] | Value":
        if instance is None:
            return self
        values, name = instance.__dict__, str(self.attrname)
        if name not in values:
            with values.setdefault(f"_lock_of_{name.lstrip('_')}", threading.RLock()):
                if name not in values:
                    values[name] = self.func(instance)
        value: Value = values[name]
        return value
