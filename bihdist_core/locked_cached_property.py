"""A property that is computed once, also when several threads ask for it first."""

import threading
from collections.abc import Callable
from functools import cached_property
from typing import Any


class locked_cached_property(cached_property):
    """`functools.cached_property`, of which Python 3.12 took the lock; here each object and property has its own."""

    def __init__(self, func: Callable[[Any], Any]) -> None:
        super().__init__(func)

    def __get__(self, instance: Any, owner: type | None = None) -> Any:
        if instance is None:
            return self
        kept, name = instance.__dict__, self.attrname
        if name not in kept:
            with kept.setdefault(f"lock of {name}", threading.RLock()):
                if name not in kept:
                    kept[name] = self.func(instance)
        return kept[name]
