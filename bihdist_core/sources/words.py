"""Sources as words: `12`, `f311:0.2,0.5`, `loop:0`, `curve.json`, and several of them, `12+40+7`.

`f311:0.2,0.5` is in face 311, with the weights of its first two corners; the third's is the rest.  A curve is a file,
`{"points": [[face, b0, b1], ...]}`, with `"closed": true` for one that comes back to its first point.
"""

import json
import math
import os
import re
from collections.abc import Mapping
from difflib import get_close_matches
from types import MappingProxyType
from typing import Any

from ..errors import ParameterError
from ..file_content import file_json
from ..sentences import shortened
from .source import BoundaryLoop, Curve, Member, Source, SourceSet, SurfacePoint

SYNTAX = (
    "write a vertex (12), several (12+40+7), a place in a face (f311:0.2,0.5), a boundary loop (loop:0) or a curve's "
    "file (curve.json)"
)
NAMED_MEMBERS, MOST_CHARACTERS = 3, 60
"""Members that are named of a set, and letters that are repeated."""

_VERTEX = re.compile(r"[0-9]{1,18}")
_FACE = re.compile(r"f([0-9]{1,18}):([^,]*),([^,]*)")
_LOOP = re.compile(r"loop:([0-9]{1,18})")


EMPTY: Mapping[Any, Any] = MappingProxyType({})


def source_from_words(text: str, known: Mapping[str, Member] = EMPTY, files: dict[Curve, str] | None = None) -> Source:
    """Read a source: ``12``, ``f311:0.2,0.5``, ``loop:0``, ``curve.json``, or several of them, ``12+40+7``.

    Parameters
    ----------
    text : str
        The words; a curve's file is read.
    known : mapping of str, optional
        Members of sources by other words that may be used.
    files : dict, optional
        Gets the absolute path of each curve that was read.

    Returns
    -------
    int, SurfacePoint, BoundaryLoop, Curve or SourceSet
        The source.

    Raises
    ------
    ParameterError
        For words that mean none; the message says what could have been written.

    Examples
    --------
    >>> import bihdist
    >>> bihdist.source_from_words("12+40"), bihdist.source_from_words("loop:0")
    (SourceSet(members=(12, 40)), BoundaryLoop(number=0))
    >>> bihdist.source_from_words("f311:0.2,0.5")
    SurfacePoint(face=311, weights=(0.2, 0.5, 0.3))
    """
    words = text.strip()
    members = []
    for part in _parts(words):
        members.append(known[part] if part in known else _member(part, words))
        if files is not None and isinstance(members[-1], Curve) and part not in known:
            files[members[-1]] = os.path.abspath(part)
    return members[0] if len(members) == 1 else SourceSet(tuple(members))


def _parts(words: str) -> list[str]:
    """Split words at the pluses that are not part of an existing file's name."""
    pieces, parts = words.split("+"), []
    while pieces:
        for count in range(len(pieces), 0, -1):
            part = "+".join(pieces[:count]).strip()
            if count == 1 or (_is_file(part) and os.path.exists(part)):
                parts.append(part)
                del pieces[:count]
                break
    return parts


def _member(word: str, whole: str) -> Member:
    if _VERTEX.fullmatch(word):
        return int(word)
    if found := _LOOP.fullmatch(word):
        return BoundaryLoop(int(found[1]))
    if found := _FACE.fullmatch(word):
        try:
            first, second = float(found[2]), float(found[3])
        except ValueError:
            first = second = math.nan
        if not (math.isfinite(first) and math.isfinite(second)):
            raise ParameterError(f"{_shown(word)} has weights that are not numbers; write f311:0.2,0.5.")
        return SurfacePoint.of(int(found[1]), first, second)
    if _is_file(word):
        return read_curve(word)
    among = "" if word == whole else f" in {_shown(whole)}"
    if not word and among:
        raise ParameterError(f"A plus{among} has nothing beside it; write several as 12+40+7.")
    meant = _meant(word)
    raise ParameterError(f"{_shown(word)}{among} is not a source{meant or f'; {SYNTAX}.'}")


def _meant(word: str) -> str:
    """Suggest what may have been meant, as the end of a sentence; "" if that cannot be told."""
    head, colon, rest = word.lower().partition(":")
    if colon and rest.isdigit() and get_close_matches(head, ["loop"], 1, 0.5):
        return f"; did you mean loop:{rest}?"
    if re.fullmatch(r"f?[0-9]+[:,][^,]*,[^,]*,[^,]*", word):
        return "; a place has the weights of the face's first two corners, the third's is the rest: f311:0.2,0.5."
    if re.fullmatch(r"f[0-9]+(:[^,]*)?", word):
        return "; a place in a face has two weights: f311:0.2,0.5."
    if re.fullmatch(r"[0-9]+([,; ]+[0-9]+)+", word):
        return f"; did you mean {'+'.join(re.findall('[0-9]+', word))[:MOST_CHARACTERS]}?"
    if re.fullmatch(r"-[0-9]+", word):
        return "; vertex ids start at 0."
    return ""


def words_of(source: Source, files: Mapping[Curve, str] = EMPTY) -> str:
    """Return the words that mean a source, which give it back; of a curve its file, or what it is where none is
    known."""
    if isinstance(source, SourceSet):
        return "+".join(words_of(member, files) for member in source.members)
    if isinstance(source, SurfacePoint):
        return f"f{source.face}:{source.weights[0]!r},{source.weights[1]!r}"
    if isinstance(source, BoundaryLoop):
        return f"loop:{source.number}"
    if isinstance(source, Curve):
        return files.get(source) or f"a {'closed ' if source.closed else ''}curve of {len(source.places):,} points"
    return str(source)


def short_words_of(source: Source) -> str:
    """Words of a source for a heading: weights with three digits, and of a large set how many members it has."""
    if isinstance(source, SurfacePoint):
        return f"f{source.face}:{source.weights[0]:.3g},{source.weights[1]:.3g}"
    if isinstance(source, SourceSet):
        named = "+".join(short_words_of(member) for member in source.members[:NAMED_MEMBERS])
        more = len(source.members) - NAMED_MEMBERS
        return f"{named} and {more} more" if more > 0 else named
    return words_of(source)


# ---------------------------------------------------------------------- curves
def read_curve(path: str | os.PathLike[str]) -> Curve:
    """Return the curve in a file; ParameterError, with the file, the element and its value, for what is none."""
    data = file_json(path, "curve", "a curve")
    if not isinstance(data, dict) or "points" not in data:
        raise ParameterError(f'{path} is not a curve, which is {{"points": [[face, b0, b1], ...]}}.')
    for name in data.keys() - {"points", "closed"}:
        raise ParameterError(f"{path} has the unknown key {name!r}; the keys of a curve are points and closed.")
    closed = data.get("closed", False)
    if not isinstance(closed, bool):
        raise ParameterError(f"{path}: closed is true or false, not {_shown(closed)}.")
    try:
        return Curve(places_from(data["points"], "points"), closed)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None


def places_from(rows: Any, where: str) -> tuple[SurfacePoint, ...]:
    """Places from a list of [face, b0, b1]; ParameterError that begins with the row's place for what is none."""
    if not isinstance(rows, list):
        raise ParameterError(f"{where} must be a list of [face, b0, b1], not {_shown(rows)}.")
    return tuple(_row(row, f"{where}[{k}]") for k, row in enumerate(rows))


def _row(row: Any, where: str) -> SurfacePoint:
    if not isinstance(row, list) or len(row) != 3 or not _is_whole(row[0]) or not all(map(_is_number, row[1:])):
        raise ParameterError(f"{where} must be a face and two weights, [face, b0, b1], not {_shown(row)}.")
    try:
        return SurfacePoint.of(row[0], float(row[1]), float(row[2]))
    except ParameterError as error:
        raise ParameterError(f"{where}: {error}") from None


def curve_rows(curve: Curve) -> list[list[int | float]]:
    """Return the points of a curve as they are written."""
    return [[place.face, *place.weights[:2]] for place in curve.places]


def curve_text(curve: Curve) -> str:
    """Return a curve as the text of its file."""
    return json.dumps({"points": curve_rows(curve), **({"closed": True} if curve.closed else {})}) + "\n"


def _is_file(word: str) -> bool:
    return word.lower().endswith(".json")


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**63


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e300


def _shown(value: Any) -> str:
    return shortened(repr(value) if isinstance(value, str) else json.dumps(value, default=repr), MOST_CHARACTERS)
