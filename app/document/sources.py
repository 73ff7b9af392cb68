"""Which sources a command starts from: `--sources` as one value, a list or a rule that chooses on each mesh."""

import re
from dataclasses import dataclass

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import source_from_words

from .lists import file_in, split_list, standard_input

LISTED, FARTHEST, RANDOM, ALL, FILE = RULES = ("listed", "farthest", "random", "all", "file")

HOW = (
    "12,40 and all that is a source (12+40+7, f311:0.2,0.5, loop:0, curve.json), farthest:K or farthest:K:START, "
    "random:K or random:K:SEED, all, xyz:X,Y,Z for the vertex nearest to a position, @FILE, or - for standard input"
)
"""What can be written, in one phrase."""

POSITION = "xyz:"
"""The prefix of a position, which stands for the vertex nearest to it."""
_NUMBER = r"[-+]?[0-9.]+(?:e[-+]?[0-9]+)?"
_RULE = re.compile(r"(farthest|random):([^:]*)(?::(.*))?", re.DOTALL)


@dataclass(frozen=True)
class Sources:
    """A choice of sources on a mesh that is read later.

    Attributes
    ----------
    rule
        How they are chosen, one of RULES.
    members
        The listed sources; none stands for the highest vertex.
    count
        The number of farthest or random vertices.
    start
        Where farthest vertices start; None for the highest vertex.
    seed
        The seed of random vertices.
    file
        A path in which {name} stands for the mesh's name, or "-" for standard input.
    text
        The text of standard input, or positions, a row for each.
    """

    rule: str = LISTED
    members: tuple[Source, ...] = ()
    count: int = 0
    start: Source | None = None
    seed: int = 0
    file: str = ""
    text: str = ""

    @property
    def several(self) -> bool:
        """Return whether they are more than one, so that there are pairs among them."""
        return self.rule != LISTED or len(self.members) > 1


HIGHEST = Sources()
"""Where distances start where nothing is said: at the highest vertex."""


def sources_from_words(text: str) -> Sources:
    """Read the value of `--sources`; ParameterError, with what could have been written, for any other text."""
    words = text.strip()
    path = file_in(words)
    if path:
        return Sources(FILE, file=path, text=standard_input("sources") if path == "-" else "")
    if words == "all":
        return Sources(ALL)
    if found := _RULE.fullmatch(words):
        rule, count = found[1], _count(found[2], words)
        if rule == RANDOM:
            return Sources(RANDOM, count=count, seed=_seed(found[3], words))
        return Sources(FARTHEST, count=count, start=None if found[3] is None else source_from_words(found[3]))
    if words.startswith(POSITION):
        positions = _positions(words)
        return Sources(FILE, file=words, text="\n".join(["x,y,z", *positions]))
    if re.fullmatch(rf"{_NUMBER},{_NUMBER},{_NUMBER}", words) and re.search("[.e-]", words):
        raise ParameterError(
            f"{words!r} is not a list of vertices; for the vertex nearest to a position write xyz:{words}."
        )
    if re.fullmatch(r"[0-9]+(\s*[\s;]\s*[0-9]+)+", words):
        raise ParameterError(f"{words!r} has no commas; write {','.join(re.findall('[0-9]+', words))}.")
    if words in ("@", FARTHEST, RANDOM):
        raise ParameterError(f"{words!r} is not a list of sources; write {HOW}.")
    return Sources(members=tuple(map(source_from_words, split_list(words))))


def _positions(words: str) -> list[str]:
    """Return the three numbers of each position in xyz:0.1,0.5,0.1,xyz:0.2,0.5,0.1; ParameterError for what is none."""
    found = [part.strip(", ") for part in words.split(POSITION)[1:]]
    for text in found:
        if not re.fullmatch(rf"{_NUMBER}\s*,\s*{_NUMBER}\s*,\s*{_NUMBER}", text):
            raise ParameterError(
                f"'{POSITION}{text}' is not a position; write {POSITION}0.1,0.5,0.1, and several with commas."
            )
    return found


def _count(text: str, words: str) -> int:
    if not re.fullmatch("[0-9]{1,15}", text) or int(text) < 1:
        raise ParameterError(
            f"{words!r} needs a number of sources, 1 or more, after the first colon; write farthest:400."
        )
    return int(text)


def _seed(text: str | None, words: str) -> int:
    if text is not None and not re.fullmatch("[0-9]{1,15}", text):
        raise ParameterError(f"{words!r} needs a seed, 0 or more, after the second colon; write random:100:7.")
    return int(text or 0)
