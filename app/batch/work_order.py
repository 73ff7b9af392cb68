"""What is to be done with each mesh, in plain values: the same text is the same work, in any process."""

import hashlib
import json
import re
from dataclasses import asdict, dataclass

from bihdist_core.errors import ParameterError

from ..document.sources import FARTHEST, HIGHEST, Sources
from .work_kinds import KINDS, MAXIMA, WORKS

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
    """works: of WORKS, in their order; distances: specs in words; nearest: as many neighbours; samples: of a map, that
    many vertices or all; cut, merge: see `Repairs`; labels, mask, cut and the sources' file: a path in which {name}
    stands for the mesh's.  one_based: whether vertex ids in .mat files count from 1.  layout: of LAYOUTS, for pairs.
    normalise: "area" for distances and eigenpairs of the mesh scaled to area 1.  recipe: the text of that which figures
    are drawn from; range: of RANGES; maxima: where those of panels end, if they are not their own.  verify: whether
    what is there counts as there only if its bytes are those that were written."""

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
    labels: str = ""
    mask: str = ""
    layout: str = ""
    normalise: str = ""
    recipe: str = ""
    range: str = OWN
    maxima: tuple[float, ...] = ()
    verify: bool = False

    def __post_init__(self) -> None:
        if not self.works:
            raise ParameterError(f"Nothing is to be done; name some of {', '.join(WORKS)}.")
        for work in self.works:
            if work not in KINDS:
                raise ParameterError(f"There is no work {work!r}; it is one of {', '.join(WORKS)}.")
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
        """Each work with the distance it is done with, "" for none."""
        chosen = [kind for kind in KINDS.values() if kind.word in self.works]
        return [(kind.word, each) for kind in chosen for each in (self.distances if kind.by_distance else ("",))]

    def key(self, work: str, distance: str, checksums: str, version: str) -> str:
        """What tells this result from others: of a mesh and other files (by their checksums), options and version."""
        says = asdict(self)
        # What stands in files is in their checksums, wherever they are.
        says["sources"]["file"] = ""
        says |= {name: bool(getattr(self, name)) for name in ("cut", "mask", "labels")}
        says = {name: value for name, value in says.items() if name in KINDS[work].fields}
        text = json.dumps([work, distance, checksums, version, says], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()

    @property
    def files(self) -> dict[str, str]:
        """What is read beside the mesh, by what it is."""
        sources = "" if self.sources.text else self.sources.file
        named = {"sources": sources, "cut": self.cut, "labels": self.labels, "mask": self.mask}
        return {what: path for what, path in named.items() if path}

    def file_for(self, pattern: str, name: str) -> str:
        """The file that a pattern means for a mesh."""
        return pattern.replace("{name}", name)


def slug(distance: str) -> str:
    """A spec's words in letters that files may have: diffusion(t=1/4) is diffusion_t_1_4."""
    return re.sub(r"[^0-9A-Za-z.-]+", "_", distance).strip("_")


def thumbnail_name(mesh: str) -> str:
    """The file with a thumbnail of a mesh's figure."""
    return f"thumbnails/{mesh}.jpg"


def result_name(mesh: str, work: str, distance: str, layout: str = "") -> str:
    """The beginning of the names of a result's files; of its JSON alone where the pairs have a layout, whose files
    have the same name for all distances."""
    name = ".".join(part for part in (mesh, work, layout if work == "pairs" and layout else slug(distance)) if part)
    return f".{MAXIMA}/{name}" if work == MAXIMA else name
