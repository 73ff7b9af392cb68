"""The kinds of work that can be done with each mesh of a set: one record each."""

from dataclasses import dataclass
from functools import cached_property

MAXIMA = "maxima"
"""A work that is done before figures that share their range: the largest value of each panel."""
FILES = frozenset({"cut", "labels", "mask", "sources"})
"""Fields that name what is read beside a mesh."""


@dataclass(frozen=True)
class WorkKind:
    """word: of `--do`.  meaning: in the command's help.  fields: of a `WorkOrder`, on which its results depend, and
    with `by_distance` on the distance; they are told apart by these.  options: of the command, which have an effect
    besides.  function: of the module `works`, from a mesh and a distance to what is made, "" where another module has
    it.
    """

    word: str
    meaning: str
    fields: frozenset[str]
    by_distance: bool = False
    options: frozenset[str] = frozenset()
    function: str = ""

    @cached_property
    def reads(self) -> frozenset[str]:
        """What it reads beside the mesh: a change of it is one of its results."""
        return FILES & self.fields


def _kind(
    word: str, meaning: str, fields: str, by_distance: bool = False, options: str = "", function: str = ""
) -> WorkKind:
    return WorkKind(word, meaning, frozenset(fields.split()), by_distance, frozenset(options.split()), function)


OF_IDS = "areas cut merge sources arrays one_based mask normalise"
OF_SOURCES = f"{OF_IDS} dtype"

KINDS = {
    kind.word: kind
    for kind in (
        _kind("fields", "distances of all vertices from the sources", OF_SOURCES, by_distance=True, function="fields"),
        _kind("pairs", "among the sources", f"{OF_SOURCES} labels layout", by_distance=True, function="pairs"),
        _kind("nearest", "their nearest vertices", f"{OF_SOURCES} nearest", by_distance=True, function="neighbours"),
        _kind("eigen", "eigenpairs", "areas cut merge eigenpairs dtype arrays normalise", function="eigen"),
        _kind("fps", "farthest points", OF_IDS, by_distance=True, function="fps"),
        _kind("figure", "a picture", "recipe range maxima cut merge", options="sources distance areas"),
        _kind("evaluate", "errors of maps", "areas samples arrays", options="maps truth symmetry"),
        _kind(MAXIMA, "", "recipe cut merge"),
    )
}

WORKS = tuple(word for word in KINDS if word != MAXIMA)
"""Those that can be asked for."""

OPTIONS = {"format": "arrays"}
"""Options of the command that say a field of a `WorkOrder` by another name."""
COUNTS = {"nearest": "nearest", "eigen": "eigenpairs"}
"""Works that `--k` counts for, and the field that it says."""


def works_of(option: str) -> tuple[str, ...]:
    """The works that an option of the command has an effect on."""
    if option == "k":
        return tuple(work for work in WORKS if work in COUNTS or KINDS[work].by_distance or work == "figure")
    field = OPTIONS.get(option, option)
    return tuple(
        word
        for word in WORKS
        if field in KINDS[word].fields
        or option in KINDS[word].options
        or (option == "distance" and KINDS[word].by_distance)
    )
