"""Figure 6: insensitivity to noise, tessellation and nearly isometric deformation.

The paper: isolines of biharmonic distance are "largely unchanged" by Gaussian noise of 400 % of the mean edge length,
"stable" as a mesh is simplified from 14K to 4K vertices, and insensitive to a change of pose.
"""

from dataclasses import dataclass, field

import numpy as np

from ..analysis.diagnostics import FieldChange
from ..applications.perturbation import noisy
from ..applications.resizing import simplified
from ..arrays import FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import SolverError
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from ._stated_figures import insensitive
from .measures import CHANGE_COLUMNS, by_source, change_cells, changes, over, percent
from .parts import Parts
from .result import STATEMENTS, Cell, Claim, Mark, Panel, Result, Table
from .shapes import DISTANCES, UPPER_BACK, Shapes, distances_there, start_vertex, starts
from .verdicts import Numbers

TITLE = "Noise, tessellation, deformation"
NOISE = (0.1, 0.4, 1.0, 4.0)
"""Standard deviation, in mean edge lengths."""
WAYS = {"xyz": "", "normals": " along the normals"}
DRAWN = 1.0
"""Noise along the normals is drawn from this size on."""
FINE, COARSE = 14_000, 4_000
SIMPLIFIED, BESIDE = "fig6-5", "fig6-7"
"""The statements on simplification, and on geodesic distance beside biharmonic."""
COMPARED = NOISE.index(1.0)
"""The noise by which they are compared."""
DRAWS, QUICK_DRAWS = 5, 2
"""Draws of the noise."""
EACH = 2
"""Random sources for each of them; a change without chance has all of them."""


@dataclass(frozen=True, eq=False)
class Change:
    """A surface, what became of it (several times, where that is random), and the points that both share.

    Vertices `ids` (k,) before and `images` (k,) after are equal points.
    """

    name: str
    before: Surface
    after: tuple[Surface, ...]
    ids: IntArray
    images: IntArray
    drawn: bool = True

    @property
    def where(self) -> str:
        """The name of the surface before."""
        return f"{len(self.before.vertices):,} vertices"


@dataclass
class Found:
    """Measurements of a change, by distance; the pictured source comes first."""

    rows: list[tuple[Cell, ...]] = field(default_factory=list)
    panels: list[Panel] = field(default_factory=list)
    every: dict[str, list[FieldChange]] = field(default_factory=lambda: {kind: [] for kind in DISTANCES})

    @property
    def kinds(self) -> list[str]:
        """The distances that were measured."""
        return [kind for kind, changes in self.every.items() if changes]


class Before:
    """The distances, by their kinds, on a surface that is to change; each field serves all its changes."""

    def __init__(self, distances: dict[str, Distance]) -> None:
        self._distances = distances
        self._fields: dict[tuple[str, int], FloatArray] = {}

    @property
    def kinds(self) -> list[str]:
        """The kinds of distance that can be had."""
        return list(self._distances)

    def field(self, kind: str, source: int) -> FloatArray:
        """Return (n,) the distances from a vertex."""
        if (kind, source) not in self._fields:
            self._fields[kind, source] = self._distances[kind].from_source(source)
        return self._fields[kind, source]


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Measure changes of three distances from eleven sources (quick: five, on meshes of 4,000 and 1,150 vertices)."""
    (name,) = shapes.names("figure")
    part(progress, 0, 0.2)(0.0, "simplifying")
    parts = Parts()
    cases = _cases(shapes, name, quick, parts, part(progress, 0, 0.2))
    known: dict[int, Before | None] = {}
    found: dict[str, Found] = {}
    for q, case in enumerate(cases):
        step = part(progress, 0.2 + 0.8 * q / len(cases), 0.2 + 0.8 * (q + 1) / len(cases))
        if id(case.before) not in known:
            known[id(case.before)] = parts.do(case.where, _before, shapes, name, case, parts)
        before = known[id(case.before)]
        if before is None:
            parts.note(case.name, parts.why(case.where))
            continue
        draws = QUICK_DRAWS if quick else DRAWS
        measured = parts.do(case.name, _measured, shapes, case, before, draws, parts, step)
        if measured is not None:
            found[case.name] = measured
    surfaces = {case.where: case.before for case in cases}
    return Result(
        "fig6",
        TITLE,
        "The pictured source is on the upper back. Noise is Gaussian, independent for each vertex, on each coordinate "
        "or along the normal, with a share of the mean edge length as its standard deviation. It is drawn several "
        "times: the pictured source has the first draw, and each draw has two random sources, of which the second "
        "measures biharmonic distance only. The mesh is refined or simplified to the first number of vertices, and "
        "simplified to the second; fields are compared at the vertices that stay, whose positions are unchanged. The "
        "two poses have the same triangles.",
        surfaces | {case.name: case.after[0] for case in cases},
        tuple(panel for each in found.values() for panel in each.panels),
        tables=_tables(found),
        claims=(
            *_claims(found, parts, [*_noises(), [_simplification(quick)], ["another pose"]]),
            _beside_geodesic(found, parts, _noises()[COMPARED]),
        ),
        not_done=tuple(parts.not_done),
    )


def _cases(shapes: Shapes, name: str, quick: bool, parts: Parts, progress: Progress) -> list[Change]:
    fine_count, coarse_count = _counts(quick)
    title = _simplification(quick)
    fine = parts.do(title, shapes.sized, name, fine_count, part(progress, 0, 0.5))
    whole = fine if quick and fine is not None else shapes[name]
    same, draws = np.arange(len(whole.vertices)), QUICK_DRAWS if quick else DRAWS
    cases = [
        Change(
            f"noise of {percent(share)}{words}",
            whole,
            tuple(noisy(whole, share, seed, along) for seed in range(draws)),
            *(same, same),
            drawn=along == "xyz" or share >= DRAWN,
        )
        for share in NOISE
        for along, words in WAYS.items()
    ]
    made = fine and parts.do(title, simplified, fine, coarse_count, part(progress, 0.5, 1))
    if fine is not None and made:
        coarse, ids = made
        cases.append(Change(title, fine, (coarse,), ids, np.arange(coarse_count)))
    if shapes.own is None:
        same = np.arange(len(shapes[name].vertices))
        posed = parts.do("another pose", shapes.__getitem__, "figure_pose2")
        if posed is not None:
            cases.append(Change("another pose", shapes[name], (posed,), same, same))
    return cases


def _counts(quick: bool) -> tuple[int, int]:
    return (4_000, 1_150) if quick else (FINE, COARSE)


def _simplification(quick: bool) -> str:
    """Return the name of that change."""
    fine, coarse = _counts(quick)
    return f"{fine:,} to {coarse:,} vertices"


def _noises() -> list[list[str]]:
    """Return the names of noise of each size, both ways."""
    return [[f"noise of {percent(share)}{words}" for words in WAYS.values()] for share in NOISE]


def _before(shapes: Shapes, name: str, case: Change, parts: Parts) -> Before:
    laplacian = shapes.laplacian(name) if case.before is shapes[name] else Laplacian(case.before)
    return Before(distances_there(laplacian, parts, case.where))


def _measured(shapes: Shapes, case: Change, before: Before, draws: int, parts: Parts, step: Progress) -> Found:
    """Return the changes of biharmonic distance, and of the others that can be had before and after every draw.

    Raises SolverError if biharmonic distance is not among them.
    """
    surface, ids, found = case.before, case.ids, Found()
    image = dict(zip(ids.tolist(), case.images.tolist(), strict=True))
    # The sources of the case are points that both surfaces have.
    random = [(s, _shared(surface, ids, start_vertex(surface, s))) for s in starts(draws * EACH + 1)[1:]]
    share = len(random) // len(case.after)
    lost: set[str] = set()
    for q, after in enumerate(case.after):
        distances = distances_there(Laplacian(after), parts, case.name)
        both = [kind for kind in before.kinds if kind in distances]
        if "biharmonic" not in both:
            raise SolverError(parts.why(*(f"biharmonic on {where}" for where in (case.where, case.name))))
        for kind in set(DISTANCES) - set(both):
            found.every[kind].clear()
            found.rows = [row for row in found.rows if row[2] != kind]
            lost.add(kind)
        sources = random[q * share : (q + 1) * share]
        if not q:
            pictured = shapes.vertex_at(surface, *UPPER_BACK, "back")
            sources = [("pictured", _shared(surface, ids, pictured)), *sources]
        for k, (label, source) in enumerate(sources):
            step((q + k / len(sources)) / len(case.after), f"{case.name}, {label}")
            kinds = [kind for kind in both if kind not in lost]
            if label != "pictured" and k == len(sources) - 1:
                kinds = ["biharmonic"]
            one = {kind: before.field(kind, source) for kind in kinds}
            two = {kind: distances[kind].from_source(image[source]) for kind in kinds}
            change = changes({k: f[ids] for k, f in one.items()}, {k: f[case.images] for k, f in two.items()})
            for kind in kinds:
                found.rows.append((case.name, label, kind, *change_cells(change[kind])))
                found.every[kind].append(change[kind])
            if label == "pictured" and case.drawn:
                found.panels += _panels(case, source, image[source], one, two)
    return found


def _panels(
    case: Change, source: int, image: int, one: dict[str, FloatArray], two: dict[str, FloatArray]
) -> list[Panel]:
    panels, heading = [], case.where
    for kind in one:
        mark = (Mark(source, "source"),)
        panels.append(Panel(f"{kind}, before", heading, one[kind], case.name, mark, ("source",)))
        mark = (Mark(image, "source"),)
        panels.append(Panel(f"{kind}, after", case.name, two[kind], case.name, mark, ("source",)))
    return panels


def _shared(surface: Surface, ids: IntArray, vertex: int) -> int:
    """Return the vertex among ids (k,) that is nearest to a vertex."""
    return int(ids[np.linalg.norm(surface.vertices[ids] - surface.vertices[vertex], axis=1).argmin()])


def _tables(found: dict[str, Found]) -> tuple[Table, ...]:
    rows = [row for each in found.values() for row in each.rows]
    if not rows:
        return ()
    summary: list[tuple[Cell, ...]] = []
    for case, each in found.items():
        for kind in each.kinds:
            means = [change.normalised_mean for change in each.every[kind]]
            raw = float(np.median([change.mean for change in each.every[kind]]))
            summary.append((case, kind, means[0], float(np.median(means)), min(means), max(means), len(means), raw))
    columns = ("change", "distance", "pictured", "median", "least", "most", "sources", "raw, median")
    return (
        Table("mean changes", columns, tuple(summary)),
        Table("changes", ("change", "source", "distance", *CHANGE_COLUMNS), tuple(rows)),
    )


def _claims(found: dict[str, Found], parts: Parts, titles: list[list[str]]) -> list[Claim]:
    """Make the claims; `titles` are the changes of each statement."""
    claims = []
    for k, cases in enumerate(titles, 1):
        id = f"fig6-{k}"
        done = {name: found[case] for name, case in zip(STATEMENTS[id].names, cases, strict=True) if case in found}
        numbers = {
            name: by_source([c.normalised_mean for c in each.every["biharmonic"]]) for name, each in done.items()
        }
        means = "; ".join(f"{case}: {_means_in_words(found[case])}" for case in cases if case in found)
        note = f"Mean change from the pictured source, after division by the maximum (raw in parentheses), {means}."
        # What is neither done nor noted as failed is the pose, of a mesh of a reader.
        failure = parts.why(*cases) or ("" if numbers else "There is no other pose of this mesh to compare it with.")
        # The quick version simplifies other sizes than the statement names.
        words = insensitive(f"simplification from {cases[0]}") if id == SIMPLIFIED else ""
        claims.append(Claim(id, numbers, note if numbers else "", failure=failure, words=words))
    return claims


def _beside_geodesic(found: dict[str, Found], parts: Parts, cases: list[str]) -> Claim:
    """Make the claim that compares geodesic distance, from the sources that it was measured from."""
    numbers: dict[str, Numbers] = {}
    for name, case in zip(STATEMENTS[BESIDE].names, cases, strict=True):
        if case in found and "geodesic" in found[case].kinds:
            means = {(row[1], row[2]): float(row[5] or 0) for row in found[case].rows}
            ratios = [over(x, means[label, "biharmonic"]) for (label, kind), x in means.items() if kind == "geodesic"]
            numbers[name] = by_source(ratios)
    return Claim(BESIDE, numbers, failure=parts.why(*cases, *(f"geodesic on {case}" for case in cases)))


def _means_in_words(found: Found) -> str:
    pictured = {kind: found.every[kind][0] for kind in found.kinds}
    return ", ".join(f"{kind} {percent(c.normalised_mean)} ({percent(c.mean)})" for kind, c in pictured.items())
