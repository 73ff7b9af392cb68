"""How much memory there is for this process, which the machine, its control group and its own limit bound."""

import os
import sys
from contextlib import suppress
from pathlib import Path

from .errors import NotEnoughMemory

SMALL = 1 << 26
"""Less is not looked for."""

REMEDY = "show fewer panels, simplify the mesh (bihdist perturb --simplify N), or take a larger machine or a cluster."
"""Where a mesh has no room."""

PROC, CGROUPS = Path("/proc"), Path("/sys/fs/cgroup")

LIMITS = {
    "": ("memory.max", "memory.current", "inactive_file"),
    "memory": ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"),
}
"""By controller, none for version 2: the files with a group's limit and use, and what of its use are files that give
way."""


def check_memory(needed: float, what: str, remedy: str) -> None:
    """NotEnoughMemory, a sentence with the remedy, where so many bytes are not there; what: "The factor of hand.off".

    To be called before long work: what is allocated is there on paper only, and touching it ends the process.
    """
    if needed < SMALL:
        return
    there = available()
    if needed > there:
        raise NotEnoughMemory(
            f"{what} needs about {needed / 1e9:.2g} GB of memory, and {there / 1e9:.2g} GB are free here; {remedy}"
        )


def available(proc: Path = PROC, cgroups: Path = CGROUPS) -> int:
    """Bytes that this process may still take."""
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
    """What is left in the control group of this process and in those that it is within."""
    found = [sys.maxsize]
    with suppress(OSError):
        for line in (proc / "self" / "cgroup").read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            for name in {"", "memory"} & {*controllers.split(",")}:
                root = cgroups / name
                # In a container, the path is that outside, and the root is its own group.
                folder = root / path.strip("/")
                for each in [folder, *folder.parents] if folder.is_dir() else [root]:
                    found.append(_left_in(each, *LIMITS[name]))
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
    """What `ulimit -v` leaves."""
    with suppress(ImportError, OSError, ValueError):
        import resource

        most = resource.getrlimit(resource.RLIMIT_AS)[0]
        if most != resource.RLIM_INFINITY:
            pages = int((proc / "self" / "statm").read_text().split()[0])
            return most - pages * resource.getpagesize()
    return sys.maxsize
