"""Changes to a surface as a value, and in words: "noise=0.4,along=normals,seed=1"; `perturbation` makes them."""

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

from ..errors import ParameterError

WAYS = ("xyz", "normals")
"""Along what there is noise."""


@dataclass(frozen=True)
class Perturbation:
    """Changes to a surface, made in this order; those that are None or 0 are not made.

    simplify: to so many vertices.  noise: see `noisy`.  holes, radius: see `with_holes`.  weld, handle: two vertices,
    whose largest faces are joined (`welded`, `with_handle`).  seed: of noise and holes.  Vertices are those of the
    surface as it was; one that simplification takes out is replaced by the nearest that stays.
    """

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
        if self.simplify is not None:
            words.append(f"simplified to {self.simplify}")
        if self.noise:
            way = "in x, y and z" if self.along == "xyz" else "along normals"
            words.append(f"noise of {self.noise:g} edges {way}, seed {self.seed}")
        if self.holes:
            words.append(f"{self.holes} holes of radius {self.radius:g}, seed {self.seed}")
        if self.weld is not None:
            words.append(f"grown together at {self.weld[0]} and {self.weld[1]}")
        if self.handle is not None:
            words.append(f"a handle from {self.handle[0]} to {self.handle[1]}")
        return ", ".join(words) or "unchanged"

    @property
    def changes_nothing(self) -> bool:
        return not (self.simplify is not None or self.noise or self.holes or self.weld or self.handle)


def words_of_change(change: Perturbation) -> str:
    """What is not as usual, as `change_from_words` reads it."""
    said = []
    for each in fields(change):
        value = getattr(change, each.name)
        if value != each.default:
            text = f"{value[0]}:{value[1]}" if isinstance(value, tuple) else value
            said.append(f"{each.name}={text}")
    return ",".join(said)


def change_from_words(text: str) -> Perturbation:
    """Such as "noise=0.4,along=normals,seed=1" or "simplify=2000,weld=12:40".

    ParameterError for another word, for a value that is none, and where nothing would change.
    """
    values: dict[str, Any] = {}
    for word in text.split(","):
        name, _, value = (part.strip() for part in word.partition("="))
        if name not in READERS or name in values:
            raise ParameterError(
                f"{word.strip()!r} is no change to a mesh; say one or more of {', '.join(READERS)}, each once, "
                "as in noise=0.4,along=normals,seed=1."
            )
        read, what = READERS[name]
        try:
            values[name] = read(value)
        except ValueError:
            raise ParameterError(f"{name} is {what}, not {value!r}.") from None
    change = Perturbation(**values)
    if change.changes_nothing:
        raise ParameterError(f"{text!r} changes nothing; say simplify, noise, holes, weld or handle.")
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


READERS: dict[str, tuple[Callable[[str], Any], str]] = {
    "simplify": (_count, "a number of vertices from 1"),
    "noise": (_size, "a number of mean edge lengths above 0"),
    "along": (_way, f"one of {', '.join(WAYS)}"),
    "holes": (_count, "a whole number from 1"),
    "radius": (_size, "a number of roots of the area above 0"),
    "weld": (_pair, "two vertices such as 12:40"),
    "handle": (_pair, "two vertices such as 12:40"),
    "seed": (_seed, "a whole number from 0"),
}
