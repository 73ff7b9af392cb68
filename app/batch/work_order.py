"""The kinds of work, and what is to be computed for each mesh, in plain values: the same in any process."""

import hashlib
import json
import re
from dataclasses import asdict, dataclass
from functools import cached_property

from bihdist_core.errors import ParameterError

from ..document.repairs import Repairs
from ..document.sources import FARTHEST, HIGHEST, Sources

MAXIMA, STATEMENTS = "maxima", "statements"
"""Works that `--do` does not name: the largest value of each panel, before figures that share their range; and the
paper's statements, for `bihdist paper --aggregate`."""
FILES = frozenset({"cut", "labels", "mask", "sources"})
"""Fields that name what is read beside a mesh."""


@dataclass(frozen=True)
class WorkKind:
    """A kind of work of `--do`, with its meaning for the command's help.

    Results depend on these `fields` of a `WorkOrder` and, with `by_distance`, on the distance. The `options` of the
    command have an effect, too. `function` is the one of `jobs`, "" if another module has it.
    """

    word: str
    meaning: str
    fields: frozenset[str]
    by_distance: bool = False
    options: frozenset[str] = frozenset()
    function: str = ""

    @cached_property
    def reads(self) -> frozenset[str]:
        """The files that it reads beside the mesh."""
        return FILES & self.fields


def _kind(
    word: str, meaning: str, fields: str, by_distance: bool = False, options: str = "", function: str = ""
) -> WorkKind:
    return WorkKind(word, meaning, frozenset(fields.split()), by_distance, frozenset(options.split()), function)


REPAIRS = "cut merge largest_component operator"
OF_IDS = f"areas {REPAIRS} sources arrays one_based mask normalise"
OF_SOURCES = f"{OF_IDS} dtype"

KINDS = {
    kind.word: kind
    for kind in (
        _kind("fields", "distances of all vertices from the sources", OF_SOURCES, by_distance=True, function="fields"),
        _kind("pairs", "among the sources", f"{OF_SOURCES} labels layout", by_distance=True, function="pairs"),
        _kind("nearest", "their nearest vertices", f"{OF_SOURCES} nearest", by_distance=True, function="neighbours"),
        _kind("eigen", "eigenpairs", f"areas eigenpairs dtype arrays normalise {REPAIRS}", function="eigen"),
        _kind("fps", "farthest points", OF_IDS, by_distance=True, function="fps"),
        _kind("figure", "a picture", f"recipe range maxima {REPAIRS}", options="sources distance areas clim"),
        _kind("evaluate", "errors of maps", "areas operator samples arrays", options="maps truth symmetry"),
        _kind(MAXIMA, "", f"recipe {REPAIRS}"),
        _kind(STATEMENTS, "", "experiments quick up"),
    )
}

WORKS = tuple(word for word in KINDS if word not in (MAXIMA, STATEMENTS))
"""The kinds of work that can be asked for."""

OPTIONS = {"format": "arrays"}
"""Options of the command that say a field of a `WorkOrder` by another name."""
COUNTS = {"nearest": "nearest", "eigen": "eigenpairs"}
"""Works that `--k` counts for, and the field that it says."""


def works_of(option: str) -> tuple[str, ...]:
    """Return the kinds of work on which an option of the command has an effect."""
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


SIZE, SHARED, OWN = RANGES = ("size", "shared", "own")
"""Where colours of figures end: at one value over the root of each mesh's area, to the power that a distance has; at
one value in mesh units; at the maximum of each mesh."""
GIFTI = "func.gii"
"""The format of values at vertices, in single precision."""
ARRAYS = ("npy", "npz", "mat", "zarr", GIFTI)
"""Formats of arrays."""
LAYOUTS = ("dist", "geodist")
"""Folders of .mat files as benchmarks of shape matching read them (see `layouts`)."""
ALL = "(all maps)"
"""The name in the tables of what is of all maps together."""


@dataclass(frozen=True)
class WorkOrder:
    """The kinds of work and their options.

    `works` are of WORKS, in their order; `distances` specs in words; `nearest` the number of neighbours; `samples`
    those of a map, 0 for all vertices. `cut`, `merge`, `largest_component` and `operator` are those of `Repairs`. In
    the paths `labels`, `mask`, `cut` and of the sources' file, {name} stands for the mesh's.

    With `one_based`, vertex ids in .mat files count from 1. `layout` is one of LAYOUTS for pairs; `normalise` is
    "area" for distances and eigenpairs of the mesh scaled to area 1. `recipe` is the text of the one that figures
    are drawn from, `range` one of RANGES, and `maxima` the ends of panels that share them. `experiments` are those
    whose statements are measured, `quick` or not, with the axis `up`, guessed if "". With `verify`, results that are
    there must have their checksums.
    """

    works: tuple[str, ...]
    distances: tuple[str, ...] = ("biharmonic",)
    areas: str = "voronoi"
    sources: Sources = HIGHEST
    eigenpairs: int = 100
    nearest: int = 10
    dtype: str = "float64"
    arrays: str = "npy"
    one_based: bool = False
    samples: int = 0
    cut: str = ""
    merge: float | None = None
    largest_component: bool = False
    operator: str = "cotan"
    labels: str = ""
    mask: str = ""
    layout: str = ""
    normalise: str = ""
    recipe: str = ""
    range: str = OWN
    maxima: tuple[float, ...] = ()
    experiments: tuple[str, ...] = ()
    quick: bool = False
    up: str = ""
    verify: bool = False

    def __post_init__(self) -> None:
        if not self.works:
            raise ParameterError(f"There is nothing to do; name some of {', '.join(WORKS)}.")
        for work in self.works:
            if work not in KINDS:
                raise ParameterError(f"There is no task {work!r}; it is one of {', '.join(WORKS)}.")
        if "pairs" in self.works and not (self.labels or self.sources.several):
            raise ParameterError(
                "Pairs are among several sources: name them, such as --sources farthest:400 or --sources all; or "
                "--labels for the mean distances between parcels."
            )
        if self.layout and (self.layout not in LAYOUTS or "pairs" not in self.works or len(self.distances) > 1):
            raise ParameterError(
                f"A layout ({', '.join(LAYOUTS)}) is of the pairs of one distance: --do pairs --sources all."
            )
        if "fps" in self.works and self.sources.rule != FARTHEST:
            raise ParameterError("Farthest points need a number of them: --sources farthest:400.")

    def results(self) -> list[tuple[str, str]]:
        """Return each kind of work with the distance it is done with, "" for none."""
        chosen = [kind for kind in KINDS.values() if kind.word in self.works]
        return [(kind.word, each) for kind in chosen for each in (self.distances if kind.by_distance else ("",))]

    def key(self, work: str, distance: str, checksums: str, version: str) -> str:
        """Return the key of a result: of a mesh and other files (by their checksums), options and version."""
        says = asdict(self)
        # What stands in files is in their checksums, wherever they are.
        says["sources"]["file"] = ""
        says |= {name: bool(getattr(self, name)) for name in ("cut", "mask", "labels")}
        says = {name: value for name, value in says.items() if name in KINDS[work].fields}
        text = json.dumps([work, distance, checksums, version, says], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()

    @property
    def repairs(self) -> Repairs:
        """The repairs of each mesh."""
        return Repairs(self.cut, "", self.merge, self.largest_component, self.operator)

    @property
    def files(self) -> dict[str, str]:
        """The files that are read beside the mesh, by what they are."""
        sources = "" if self.sources.text else self.sources.file
        named = {"sources": sources, "cut": self.cut, "labels": self.labels, "mask": self.mask}
        return {what: path for what, path in named.items() if path}

    def file_for(self, pattern: str, name: str) -> str:
        """Return the file that a pattern means for a mesh."""
        return pattern.replace("{name}", name)


def slug(distance: str) -> str:
    """Return a spec in characters for file names: diffusion(t=1/4) becomes diffusion_t_1_4."""
    return re.sub(r"[^0-9A-Za-z.-]+", "_", distance).strip("_")


def thumbnail_name(mesh: str) -> str:
    """Return the file name of the thumbnail of a mesh's figure."""
    return f"thumbnails/{mesh}.jpg"


def result_name(mesh: str, work: str, distance: str, layout: str = "") -> str:
    """Return the beginning of the file names of a result; of its JSON alone if the pairs have a layout."""
    name = ".".join(part for part in (mesh, work, layout if work == "pairs" and layout else slug(distance)) if part)
    return f".{MAXIMA}/{name}" if work == MAXIMA else name
