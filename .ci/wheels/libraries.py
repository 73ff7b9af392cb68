"""What a compiled library says of itself, read from its bytes: ELF, Mach-O and PE."""

import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Library:
    """A compiled library: its format (ELF, Mach-O or PE) and its machine, as wheels call it.

    `needs` is the newest version of glibc or macOS that it asks for, (0, 0) where it asks for none; `names` are the
    functions of the kernel that are in it.
    """

    format: str
    machine: str
    needs: tuple[int, int]
    names: frozenset[str]


ELF_MACHINES = {62: "x86_64", 183: "aarch64"}
MACH_O_MACHINES = {0x01000007: "x86_64", 0x0100000C: "arm64"}
PE_MACHINES = {0x8664: "amd64"}
VERSION_MIN_MACOSX, BUILD_VERSION, CODE_SIGNATURE = 0x24, 0x32, 0x1D
"""Load commands of Mach-O files."""


def library(content: bytes) -> Library:
    """Return the library with these bytes.

    ValueError if they are none, or one for a machine that we have no wheels for.
    """
    try:
        return _library(content)
    except struct.error:
        raise ValueError("it ends in its headers") from None


def _library(content: bytes) -> Library:
    # Names end with a zero in the tables of all three.
    names = frozenset(name.decode() for name in re.findall(rb"\bbih_\w+|(?<=_)bih_\w+(?=\0)", content))
    if content[:4] == b"\x7fELF":
        (machine,) = struct.unpack_from("<H", content, 18)
        versions = re.findall(rb"\0GLIBC_(\d+)\.(\d+)", content)
        needs = max(((int(major), int(minor)) for major, minor in versions), default=(0, 0))
        return Library("ELF", _known(ELF_MACHINES, machine), needs, names)
    if content[:4] == b"\xcf\xfa\xed\xfe":
        (machine,) = struct.unpack_from("<I", content, 4)
        return Library("Mach-O", _known(MACH_O_MACHINES, machine), _macos(content, machine), names)
    if content[:2] == b"MZ":
        (start,) = struct.unpack_from("<I", content, 0x3C)
        if content[start : start + 4] == b"PE\0\0":
            (machine,) = struct.unpack_from("<H", content, start + 4)
            return Library("PE", _known(PE_MACHINES, machine), (0, 0), names)
    raise ValueError("it is no ELF, Mach-O or PE file")


def _known(machines: dict[int, str], number: int) -> str:
    if number not in machines:
        raise ValueError(f"it is for machine {number:#x}, not for {' or '.join(machines.values())}")
    return machines[number]


def _macos(content: bytes, machine: int) -> tuple[int, int]:
    """Return the oldest macOS a library runs on; ValueError for one that Apple's own processors would refuse."""
    commands = dict(_load_commands(content))
    if MACH_O_MACHINES[machine] == "arm64" and CODE_SIGNATURE not in commands:
        raise ValueError("it has no signature, without which macOS on arm64 loads nothing")
    if BUILD_VERSION in commands:
        (version,) = struct.unpack_from("<I", content, commands[BUILD_VERSION] + 12)
    elif VERSION_MIN_MACOSX in commands:
        (version,) = struct.unpack_from("<I", content, commands[VERSION_MIN_MACOSX] + 8)
    else:
        raise ValueError("it does not say which macOS it needs")
    return version >> 16, version >> 8 & 0xFF


def _load_commands(content: bytes) -> Iterator[tuple[int, int]]:
    """Yield each command with where it begins."""
    (count,) = struct.unpack_from("<I", content, 16)
    place = 32
    for _ in range(count):
        command, size = struct.unpack_from("<II", content, place)
        yield command, place
        place += size
