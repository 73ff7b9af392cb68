"""The family of distances with weights 1 / lambda^alpha (paper, section 6), alpha from 1.25 to 4.

The paper: "any normalization 1/lambda^alpha, alpha > 1, of the eigenvalues will produce a new and maybe useful
distance measure"; biharmonic distance (alpha = 2) balances between too local and too global.
"""

import numpy as np

from ..laplacian import Laplacian
from ..progress import Progress, part
from .measures import FIELD_COLUMNS, field_row, marks, percent
from .result import Chart, Claim, Panel, Result, Series, Table
from .shapes import Shapes, distance, vertex_at

TITLE = "The family of weights 1/λ^α"
ALPHAS = (1.25, 1.5, 2.0, 3.0, 4.0)
COUNT = 3_000


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """One source, all eigenpairs of a mesh of 3,000 vertices (quick: 1,000), so that nothing is cut off."""
    (name,) = shapes.names("figure")
    surface = shapes.sized(name, min(1_000 if quick else COUNT, len(shapes[name].vertices)), part(progress, 0, 0.1))
    laplacian = Laplacian(surface)
    everything = len(surface.vertices) - 1
    laplacian.components[0].spectrum(everything, part(progress, 0.1, 0.9))
    source = vertex_at(surface, 0.5, 0.72, "back")
    geodesic = distance(laplacian, "geodesic").from_source(source)
    rows, panels = [], []
    for alpha in ALPHAS:
        label = f"α = {alpha:g}"
        field = distance(laplacian, f"power alpha = {alpha}, k = {everything}").from_source(source)
        rows.append(field_row(surface, name, "upper back", source, label, field, geodesic))
        panels.append(Panel(label, name, field, "family", marks(surface, field, source), ("front", "back")))
        if alpha == 2:
            exact = distance(laplacian, "biharmonic").from_source(source)
            difference = float(np.abs(field - exact).max() / exact.max())
    table = Table("fields", FIELD_COLUMNS, tuple(rows))
    ratio = np.array([float(v or 0) for v in table.values("isotropy ratio")])
    others = [int(v or 0) for v in table.values("minima besides the source")]
    return Result(
        "alpha",
        TITLE,
        f"Source: the upper back. All {everything:,} eigenpairs of a mesh of {len(surface.vertices):,} vertices.",
        {name: surface},
        tuple(panels),
        charts=(Chart("isotropy", "α", "isotropy ratio", (Series("upper back", np.array(ALPHAS), ratio, "points"),)),),
        tables=(table,),
        claims=(
            Claim(
                "With alpha = 2 the family is biharmonic distance.",
                f"Largest difference of the sum over all eigenpairs from the exact distance: {percent(difference)}.",
                difference < 1e-6,
            ),
            Claim(
                "A slower decay is more local, a faster one more global.",
                "Isotropy ratio: " + ", ".join(f"α = {a:g}: {r:.3g}" for a, r in zip(ALPHAS, ratio, strict=True)) + ".",
                bool((np.diff(ratio) > 0).all()),
            ),
            Claim(
                "Every member is a usable distance field: no minima but the source.",
                "Minima besides the source: "
                + ", ".join(f"α = {a:g}: {c}" for a, c in zip(ALPHAS, others, strict=True)),
                not any(others),
            ),
        ),
    )
