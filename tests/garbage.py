"""What only Python's garbage collector could free, for tests that nothing which holds large arrays waits for it."""

import gc
from collections import Counter
from collections.abc import Callable
from types import FrameType
from typing import Any

PACKAGES = ("bihdist", "app")
"""What the modules of the project begin with."""


def garbage_of(work: Callable[[], Any]) -> Counter[str]:
    """Return the project's objects, by kind, that refer to each other in circles once the work is done.

    They are found where they are, unlike by weak references to objects that somebody thought of, and whatever other
    threads still hold for a moment is not among them. Objects from before are left out: to look at them takes a second.
    """
    was_on = gc.isenabled()
    gc.disable()
    gc.freeze()
    gc.set_debug(gc.DEBUG_SAVEALL)
    try:
        work()
        gc.collect()
        found = Counter(name for name in map(_name, gc.garbage) if name.startswith(PACKAGES))
    finally:
        gc.set_debug(0)
        gc.garbage.clear()
        gc.unfreeze()
        if was_on:
            gc.enable()
    return found


def _name(thing: Any) -> str:
    """Of an object that is the project's: its module and type, or a function's or a frame's own names."""
    if isinstance(thing, FrameType):
        return f"{thing.f_globals.get('__name__')}:{thing.f_code.co_qualname} (frame)"
    named = thing if hasattr(thing, "__qualname__") else type(thing)
    return f"{getattr(named, '__module__', '')}:{named.__qualname__}"
