"""The claims of sections 1, 2 and 4 that belong to no figure: metric, growth, refinement, conformal maps, topology.

The paper: biharmonic distance is a metric, smooth because eigenvalues grow like k, computed in O(N) a column,
insensitive to small changes of topology; commute-time distance diverges and depends on the conformal structure only.
"""

from ..progress import Progress, part
from ._claims_growth import conformal, cost, eigenvalues, refinement
from ._claims_metric import metric
from ._claims_sampling import sampling
from ._claims_topology import topology
from .parts import Parts
from .result import Claim, Result
from .shapes import Shapes
from .statements import statements_of

TITLE = "Claims in words"
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
    """Everything; quick: smaller meshes, fewer triples and sources."""
    (figure,), (hand,) = shapes.names("figure"), shapes.names("hand")
    parts = Parts()
    metric_tables, metric_claims = parts.do(
        "metric axioms", metric, shapes, figure, quick, parts, part(progress, 0, 0.3)
    ) or (
        [],
        [],
    )
    cost_tables, cost_charts, cost_claims = parts.do(
        "cost with N", cost, shapes, figure, quick, parts, part(progress, 0.3, 0.5)
    ) or ([], [], [])
    value_charts, value_claims = parts.do(
        "growth of eigenvalues", eigenvalues, shapes, figure, quick, part(progress, 0.5, 0.6)
    ) or ([], [])
    fine_tables, fine_charts, fine_claims = parts.do("refinement", refinement, quick, part(progress, 0.6, 0.7)) or (
        [],
        [],
        [],
    )
    moebius_tables, moebius_claims = parts.do("conformal maps", conformal, quick, part(progress, 0.7, 0.75)) or ([], [])
    surfaces, panels, edit_tables, edit_claims = parts.do(
        "changes of topology", topology, shapes, hand, quick, parts, part(progress, 0.75, 0.9)
    ) or ({}, [], [], [])
    coarse_tables, coarse_charts, coarse_claims = parts.do(
        "sub-sampling", sampling, shapes, figure, quick, parts, part(progress, 0.9, 1)
    ) or ([], [], [])
    claims: list[Claim] = [*metric_claims, *cost_claims, *value_claims, *fine_claims, *moebius_claims]
    judged = {claim.id: claim for claim in [*claims, *edit_claims, *coarse_claims]}
    return Result(
        "claims",
        TITLE,
        "Triples and points at random with seed 0. The weld joins two faces that are close in space and far along the "
        "surface; the thin handle is a three-sided tube between the two most pronounced ends, a quarter of an edge "
        "wide; other handles join random points, other welds other places that nearly touch. Metric axioms are checked "
        "on a smaller mesh, the smallest distance over all its pairs. Fields are sampled at farthest points, among "
        "them all sources. Times are processor times.",
        surfaces,
        tuple(panels),
        (*cost_charts, *value_charts, *fine_charts, *coarse_charts),
        (*metric_tables, *cost_tables, *fine_tables, *moebius_tables, *edit_tables, *coarse_tables),
        tuple(judged.get(statement.id) or _not_judged(statement.id, parts) for statement in statements_of("claims")),
        not_done=tuple(parts.not_done),
    )


def _not_judged(id: str, parts: Parts) -> Claim:
    """The claim of a statement whose part could not be done."""
    return Claim(id, failure=parts.why(*(name for name, ids in PARTS.items() if id in ids)))
