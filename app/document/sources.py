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
    "random:K or random:K:SEED, all, @FILE, or - for standard input"
)
"""What can be written, in one phrase."""

_RULE = re.compile(r"(farthest|random):([^:]*)(?::(.*))?", re.DOTALL)


@dataclass(frozen=True)
class Sources:
    """rule: of RULES.  members: those that are listed; none is the highest vertex.  count: of farthest or random ones;
    start: of farthest ones, the highest vertex if None; seed: of random ones.  file: a path in which {name} stands for
    the mesh's, or "-" for standard input, whose text is here."""

    rule: str = LISTED
    members: tuple[Source, ...] = ()
    count: int = 0
    start: Source | None = None
    seed: int = 0
    file: str = ""
    text: str = ""

    @property
    def several(self) -> bool:
        """Whether they are more than one, so that there are pairs among them."""
        return self.rule != LISTED or len(self.members) > 1


HIGHEST = Sources()
"""Where distances start where nothing is said: at the highest vertex."""


def sources_from_words(text: str) -> Sources:
    """What `--sources` says; ParameterError, with what could have been written, for what says nothing."""
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
    if words in ("@", FARTHEST, RANDOM):
        raise ParameterError(f"{words!r} is no sources; write {HOW}.")
    return Sources(members=tuple(map(source_from_words, split_list(words))))


def _count(text: str, words: str) -> int:
    if not re.fullmatch("[0-9]{1,15}", text) or int(text) < 1:
        raise ParameterError(f"{words!r} has no number of sources from 1 after the first colon; write farthest:400.")
    return int(text)


def _seed(text: str | None, words: str) -> int:
    if text is not None and not re.fullmatch("[0-9]{1,15}", text):
        raise ParameterError(f"{words!r} has no seed from 0 after the second colon; write random:100:7.")
    return int(text or 0)
