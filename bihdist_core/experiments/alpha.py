"""The family of distances with weights 1 / lambda^alpha (paper, section 6), alpha from 1.25 to 4.

The paper: "any normalization 1/lambda^alpha, alpha > 1, of the eigenvalues will produce a new and maybe useful
distance measure"; biharmonic distance (alpha = 2) balances between too local and too global.
"""

import numpy as np

from ..analysis.circles import small_radius
from ..analysis.diagnostics import isotropy_ratio
from ..arrays import FloatArray
from ..laplacian import Laplacian
from ..progress import Progress, part
from .measures import FIELD_COLUMNS, by_source, deepest_minimum, field_row, marks, percent
from .result import Cell, Chart, Claim, Panel, Result, Series, Table
from .shapes import UPPER_BACK, Shapes, distance, random_sources

TITLE = "The family of weights 1/λ^α"
ALPHAS = (1.25, 1.5, 2.0, 3.0, 4.0)
COUNT = 3_000
SOURCES, QUICK_SOURCES = 10, 4
"""Random sources beside the pictured one."""


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Compare distances of eleven sources, with all eigenpairs of a mesh of 3,000 vertices (quick: five, 1,000)."""
    (name,) = shapes.names("figure")
    surface = shapes.at_most(name, 1_000 if quick else COUNT, part(progress, 0, 0.1))
    laplacian = Laplacian(surface)
    sources = {"upper back": shapes.vertex_at(surface, *UPPER_BACK, "back")}
    random = random_sources(surface, QUICK_SOURCES if quick else SOURCES)
    sources |= {f"random {k}": source for k, source in enumerate(random, 1)}
    family = {alpha: distance(laplacian, f"power alpha = {alpha}") for alpha in ALPHAS}
    geodesics, exact = distance(laplacian, "geodesic"), distance(laplacian, "biharmonic")
    radius = small_radius(surface)
    rows: list[tuple[Cell, ...]] = []
    panels = []
    ratios, depths = np.empty((2, len(sources), len(ALPHAS)))
    differences = []
    for k, (label, source) in enumerate(sources.items()):
        part(progress, 0.8, 1)(k / len(sources), label)
        geodesic, direct = geodesics.from_source(source), exact.from_source(source)
        for q, alpha in enumerate(ALPHAS):
            title = f"α = {alpha:g}"
            field = family[alpha].from_source(source)
            ratios[k, q] = isotropy_ratio(surface, field, geodesic, radius)
            depths[k, q] = deepest_minimum(surface, field, source)
            rows.append(field_row(surface, name, label, source, title, field, geodesic))
            if not k:
                panels.append(Panel(title, name, field, "family", marks(surface, field, source), ("front", "back")))
            if alpha == 2:
                differences.append(float(np.nanmax(np.abs(field - direct)) / np.nanmax(direct)))
    growth = (ratios[:, 1:] / ratios[:, :-1]).min(axis=1)
    x = np.array(ALPHAS)
    return Result(
        "alpha",
        TITLE,
        f"The sources are on the upper back and at {len(random)} random vertices of a mesh of "
        f"{len(surface.vertices):,} vertices. The isotropy ratio is measured on a geodesic circle with a radius of "
        f"{percent(radius / float(np.sqrt(surface.face_areas.sum())))} of the root of the area.",
        {name: surface},
        tuple(panels),
        charts=(
            Chart(
                "isotropy",
                "α",
                "isotropy ratio",
                (
                    Series("upper back", x, ratios[0], "points"),
                    Series("random, median", x, np.median(ratios[1:], axis=0), "points"),
                ),
            ),
        ),
        tables=(_summary(ratios, depths), Table("fields", FIELD_COLUMNS, tuple(rows))),
        claims=(
            Claim(
                "alpha-1",
                {"largest difference from the direct solution, of the maximum": by_source(differences)},
            ),
            Claim(
                "alpha-2",
                {"isotropy ratio, least growth from one α to the next": by_source(growth.tolist())},
                f"Isotropy ratio from the upper back: {_listed(ratios[0])}.",
            ),
            Claim(
                "alpha-3",
                {"deepest other minimum of any α, of the range": by_source(depths.max(axis=1).tolist())},
                "Deepest minimum besides the source, of the range, from the upper back: "
                f"{_listed(100 * depths[0], ' %')}; median over the random sources: "
                f"{_listed(100 * np.median(depths[1:], axis=0), ' %')}.",
            ),
        ),
    )


def _summary(ratios: FloatArray, depths: FloatArray) -> Table:
    """Return the family from the pictured source, and over the random ones."""
    rows: list[tuple[Cell, ...]] = []
    for q, alpha in enumerate(ALPHAS):
        for label, values in (("isotropy ratio", ratios[:, q]), ("deepest other minimum, of the range", depths[:, q])):
            pictured, random = float(values[0]), values[1:]
            spread = (float(x) for x in (np.median(random), random.min(), random.max()))
            rows.append((f"α = {alpha:g}", label, pictured, *spread))
    return Table("family", ("α", "measured", "upper back", "random, median", "least", "most"), tuple(rows))


def _listed(values: FloatArray, unit: str = "") -> str:
    return ", ".join(f"α = {alpha:g}: {value:.3g}{unit}" for alpha, value in zip(ALPHAS, values, strict=True))
