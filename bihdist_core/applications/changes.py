"""Changes to a surface as a value, and in words: "noise=0.4,along=normals,seed=1"; `perturbation` makes them."""

import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from typing import Any

from ..counts import counted
from ..errors import ParameterError

WAYS = ("xyz", "normals")
"""Along what there is noise."""


Runs = tuple[tuple[int, int], ...]
"""Ids as runs: from the first to the last, both included, in order, apart."""


@dataclass(frozen=True)
class Perturbation:
    """Changes to a surface, made in this order; those that are None, 0 or empty are not made.

    Attributes
    ----------
    pose : str
        A file with another pose, whose vertices and faces are numbered alike.
    pose_sha256 : str
        The checksum of its bytes; empty as long as any content will do.
    cut : runs of int
        Faces that are taken out.
    simplify : int or None
        To so many vertices.
    noise : float
        Standard deviation in mean edge lengths, see `noisy`.
    along : {"xyz", "normals"}
        Direction of the noise.
    holes : int
        How many holes, see `with_holes`.
    radius : float
        Of the holes, in roots of the surface's area.
    weld, handle : tuple of int and int, or None
        Two vertices whose largest faces are joined, see `welded` and `with_handle`.
    seed : int
        Of noise and holes.

    Notes
    -----
    Vertices and faces are numbered as in the surface that is changed. A vertex that is taken out is replaced by the
    nearest that stays.
    """

    pose: str = ""
    pose_sha256: str = ""
    cut: Runs = ()
    simplify: int | None = None
    noise: float = 0.0
    along: str = "xyz"
    holes: int = 0
    radius: float = 0.05
    weld: tuple[int, int] | None = None
    handle: tuple[int, int] | None = None
    seed: int = 0

    def __str__(self) -> str:
        words = []
        if self.pose:
            words.append(f"pose of {os.path.basename(self.pose)}")
        if self.cut:
            words.append(f"without {counted(count_of(self.cut), 'face')}")
        if self.simplify is not None:
            words.append(f"simplified to {self.simplify}")
        if self.noise:
            way = "in x, y and z" if self.along == "xyz" else "along normals"
            words.append(f"noise of {self.noise:g} edges {way}, seed {self.seed}")
        if self.holes:
            words.append(f"{counted(self.holes, 'hole')} of radius {self.radius:g}, seed {self.seed}")
        if self.weld is not None:
            words.append(f"welded at {self.weld[0]} and {self.weld[1]}")
        if self.handle is not None:
            words.append(f"a handle from {self.handle[0]} to {self.handle[1]}")
        return ", ".join(words) or "unchanged"

    @property
    def changes_nothing(self) -> bool:
        """True if the surface stays as it is."""
        parts = (self.pose, self.cut, self.simplify is not None, self.noise, self.holes, self.weld, self.handle)
        return not any(parts)


def count_of(runs: Runs) -> int:
    """Count the ids in runs."""
    return sum(last - first + 1 for first, last in runs)


def words_of_runs(runs: Runs) -> str:
    """Write runs as `runs_from_words` reads them: "3+10-20"."""
    return "+".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def runs_from_words(text: str) -> Runs:
    """Read ids and runs of ids such as "3+10-20", in any order; ValueError for anything else."""
    ends = []
    for word in text.split("+"):
        start, _, stop = word.partition("-")
        ends.append((int(start), int(stop or start)))
    if any(not 0 <= first <= last for first, last in ends):
        raise ValueError(f"Runs of ids ascend from 0, unlike {text!r}.")
    return joined_runs(ends)


def joined_runs(ends: Iterable[tuple[int, int]]) -> Runs:
    """Put runs in order and join those that overlap or touch."""
    runs: list[tuple[int, int]] = []
    for first, last in sorted(ends):
        if runs and first <= runs[-1][1] + 1:
            runs[-1] = (runs[-1][0], max(runs[-1][1], last))
        else:
            runs.append((first, last))
    return tuple(runs)


def words_of_change(change: Perturbation) -> str:
    """Write what differs from the defaults, but for checksums, as `change_from_words` reads it."""
    words = []
    for each in fields(change):
        value = getattr(change, each.name)
        if value == each.default or each.name == "pose_sha256":
            continue
        text = words_of_runs(value) if each.name == "cut" else value
        words.append(f"{each.name}={value[0]}:{value[1]}" if each.name in ("weld", "handle") else f"{each.name}={text}")
    return ",".join(words)


def change_from_words(text: str) -> Perturbation:
    """Read changes such as "noise=0.4,along=normals,seed=1", "simplify=2000,weld=12:40" or "pose=lion-2.obj,cut=3+10".

    Raises ParameterError for another word, for a bad value, and where nothing would change.
    """
    values: dict[str, Any] = {}
    # A path may hold commas, but none before one of the words.
    for word in re.split(rf",(?=\s*(?:{'|'.join(READERS)})\s*=)", text):
        name, _, value = (part.strip() for part in word.partition("="))
        if name not in READERS or name in values:
            raise ParameterError(
                f"{word.strip()!r} is not a change to a mesh; give one or more of {', '.join(READERS)}, each once, "
                "as in noise=0.4,along=normals,seed=1."
            )
        read, what = READERS[name]
        try:
            values[name] = read(value)
        except ValueError:
            raise ParameterError(f"{name} is {what}, not {value!r}.") from None
    change = Perturbation(**values)
    if change.changes_nothing:
        raise ParameterError(f"{text!r} changes nothing; give pose, cut, simplify, noise, holes, weld or handle.")
    return change


def _count(text: str) -> int:
    if (count := int(text)) < 1:
        raise ValueError
    return count


def _seed(text: str) -> int:
    if (seed := int(text)) < 0:
        raise ValueError
    return seed


def _size(text: str) -> float:
    size = float(text)
    if not 0 < size < float("inf"):
        raise ValueError
    return size


def _way(text: str) -> str:
    if text not in WAYS:
        raise ValueError
    return text


def _pair(text: str) -> tuple[int, int]:
    first, second = (_seed(part) for part in text.split(":"))
    return first, second


def _path(text: str) -> str:
    if not text:
        raise ValueError
    return text


READERS: dict[str, tuple[Callable[[str], Any], str]] = {
    "pose": (_path, "a mesh file"),
    "cut": (runs_from_words, "faces such as 3+10-20"),
    "simplify": (_count, "a number of vertices from 1"),
    "noise": (_size, "a number of mean edge lengths above 0"),
    "along": (_way, f"one of {', '.join(WAYS)}"),
    "holes": (_count, "a whole number from 1"),
    "radius": (_size, "a number of roots of the area above 0"),
    "weld": (_pair, "two vertices such as 12:40"),
    "handle": (_pair, "two vertices such as 12:40"),
    "seed": (_seed, "a whole number from 0"),
}
