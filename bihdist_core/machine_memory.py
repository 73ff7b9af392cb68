"""How much memory there is for this process, which the machine, its control group and its own limit bound."""

import ctypes
import os
import sys
from contextlib import suppress
from pathlib import Path

from .errors import NotEnoughMemory

SMALL_BYTES = 1 << 26
"""Less is not looked for."""

MEMORY_ADVICE = (
    "show fewer panels, simplify the mesh (bihdist perturb --simplify N), or use a larger machine or a cluster."
)
"""Advice where a mesh needs more memory than there is."""

PROC, CGROUPS = Path("/proc"), Path("/sys/fs/cgroup")

CGROUP_FILES = {
    "": ("memory.max", "memory.current", "inactive_file"),
    "memory": ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"),
}
"""By controller, none for version 2: the files with a group's limit and use, and what of its use are files that give
way."""


def check_memory(needed: float, what: str, advice: str) -> None:
    """Raise NotEnoughMemory, with the advice, where this many bytes are not free; `what` needs them.

    `what` is as "The factor of hand.off". To be called before long work: what is allocated is there on paper only, and
    touching it ends the process.
    """
    if needed < SMALL_BYTES:
        return
    there = available()
    if needed > there:
        raise NotEnoughMemory(
            f"{what} needs about {needed / 1e9:.2g} GB of memory, and {there / 1e9:.2g} GB are free here; {advice}"
        )


def release_freed() -> None:
    """Return freed memory to the system, of which glibc keeps up to hundreds of megabytes for later.

    To be called between meshes in a process that goes through many.  Nothing happens with other C libraries.
    """
    if sys.platform == "linux":
        with suppress(AttributeError, OSError):  # another C library
            ctypes.CDLL(None).malloc_trim(0)


def available(proc: Path = PROC, cgroups: Path = CGROUPS) -> int:
    """Return the bytes of memory that this process may still take."""
    return max(min(_of_machine(proc), _of_groups(proc, cgroups), _of_limit(proc)), 0)


def _of_machine(proc: Path) -> int:
    with suppress(OSError, ValueError, IndexError):
        for line in (proc / "meminfo").read_text("ascii").splitlines():
            if line.startswith("MemAvailable"):
                return int(line.split()[1]) * 1024
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2
    except (ValueError, OSError, AttributeError):
        return 4 * 10**9


def _of_groups(proc: Path, cgroups: Path) -> int:
    """Return the bytes left in the control group of this process and in those around it."""
    found = [sys.maxsize]
    with suppress(OSError):
        for line in (proc / "self" / "cgroup").read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            for name in {"", "memory"} & {*controllers.split(",")}:
                root = cgroups / name
                # In a container, the path is that outside, and the root is its own group.
                folder = root / path.strip("/")
                for each in [folder, *folder.parents] if folder.is_dir() else [root]:
                    found.append(_left_in(each, *CGROUP_FILES[name]))
                    if each == root:
                        break
    return min(found)


def _left_in(folder: Path, limit: str, use: str, files: str) -> int:
    try:
        most = int((folder / limit).read_text())
        used = int((folder / use).read_text())
    except (OSError, ValueError):  # no such file, or "max"
        return sys.maxsize
    with suppress(OSError, ValueError):
        for line in (folder / "memory.stat").read_text().splitlines():
            name, count = line.split()
            used -= int(count) if name == files else 0
    return most - used


def _of_limit(proc: Path) -> int:
    """Return the bytes left under `ulimit -v`."""
    with suppress(ImportError, OSError, ValueError):
        import resource

        most = resource.getrlimit(resource.RLIMIT_AS)[0]
        if most != resource.RLIM_INFINITY:
            pages = int((proc / "self" / "statm").read_text().split()[0])
            return most - pages * resource.getpagesize()
    return sys.maxsize
