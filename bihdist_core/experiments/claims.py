"""Statements of sections 1, 2, 4 and 5 without a figure: metric, growth, refinement, conformal maps, topology.

The paper: biharmonic distance is a metric, smooth because eigenvalues grow like k, computed in O(N) a column,
insensitive to small changes of topology; commute-time distance diverges, and depends on the conformal structure only.
"""

from collections.abc import Callable

from ..progress import Progress, part
from ._claims_growth import conformal, cost, eigenvalues, refinement
from ._claims_metric import metric
from ._claims_sampling import sampling
from ._claims_topology import topology
from .parts import Parts
from .result import Claim, Findings, Result, statements_of
from .shapes import Shapes

TITLE = "Statements of the text"
PARTS = {
    "metric axioms": ("claims-triangle", "claims-identity", "claims-truncated"),
    "cost with N": ("claims-cost",),
    "growth of eigenvalues": ("claims-weyl",),
    "refinement": ("claims-commute", "claims-converges"),
    "conformal maps": ("claims-conformal",),
    "changes of topology": ("claims-handle", "claims-weld"),
    "sub-sampling": ("claims-sampling",),
}
"""The statements that each part judges."""


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Check all claims; with smaller meshes, fewer triples and sources if `quick`."""
    (figure,), (hand,) = shapes.names("figure"), shapes.names("hand")
    parts = Parts()
    jobs: dict[str, tuple[float, Callable[[Progress], Findings]]] = {
        "metric axioms": (0.3, lambda step: metric(shapes, figure, quick, parts, step)),
        "cost with N": (0.5, lambda step: cost(shapes, figure, quick, parts, step)),
        "growth of eigenvalues": (0.6, lambda step: eigenvalues(shapes, figure, quick, step)),
        "refinement": (0.7, lambda step: refinement(quick, step)),
        "conformal maps": (0.75, lambda step: conformal(quick, step)),
        "changes of topology": (0.9, lambda step: topology(shapes, hand, quick, parts, step)),
        "sub-sampling": (1.0, lambda step: sampling(shapes, figure, quick, parts, step)),
    }
    start, every = 0.0, list[Findings]()
    for name, (stop, job) in jobs.items():
        found = parts.do(name, job, part(progress, start, stop))
        every += [] if found is None else [found]
        start = stop
    judged = {claim.id: claim for found in every for claim in found.claims}
    return Result(
        "claims",
        TITLE,
        "Triples and points are random, with seed 0. The weld joins two faces that are close in space and far apart "
        "along the surface. The thin handle is a three-sided tube between the two most pronounced ends, a quarter of "
        "an edge wide; further handles join random points, and further welds other places that nearly touch. The "
        "axioms of a metric are checked on a smaller mesh, the smallest distance over all its pairs. Fields are "
        "sampled at farthest points, which include all sources. Times are processor times.",
        {name: surface for found in every for name, surface in found.surfaces.items()},
        tuple(panel for found in every for panel in found.panels),
        tuple(chart for found in every for chart in found.charts),
        tuple(table for found in every for table in found.tables),
        tuple(judged.get(statement.id) or _not_judged(statement.id, parts) for statement in statements_of("claims")),
        not_done=tuple(parts.not_done),
    )


def _not_judged(id: str, parts: Parts) -> Claim:
    """Return the claim of a statement whose part could not be done."""
    return Claim(id, failure=parts.why(*(name for name, ids in PARTS.items() if id in ids)))
