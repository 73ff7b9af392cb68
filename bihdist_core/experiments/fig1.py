"""Figure 1: the biharmonic distance from one source, as equally spaced white lines.

The paper shows the picture and lists, in section 1, what it stands for: gradual, isotropic near the source, aware of
the shape away from it.
"""

from ..analysis.persistence import extrema
from ..progress import Progress, part
from .measures import FIELD_COLUMNS, ISOTROPIC, field_row, other_minima, span
from .result import Claim, Mark, Panel, Result, Table
from .shapes import Shapes, distance, vertex_at

TITLE = "Biharmonic distance from a source"
PLACE = {"figure": (0.5, 0.75), "animal": (0.5, 0.62), "hand": (0.5, 0.4), "genus3": (0.5, 0.4)}
"""Where the source is: shares of width and height."""


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """The field on each shape, from a source on its front; quick: two shapes."""
    names = shapes.names(*("figure", "animal", "hand", "genus3")[: 2 if quick else 4])
    panels, rows = [], []
    others = 0
    for k, name in enumerate(names):
        surface = shapes[name]
        part(progress, k / len(names), 1)(0.0, name)
        laplacian = shapes.laplacian(name)
        source = vertex_at(surface, *PLACE.get(name, (0.5, 0.5)))
        field = distance(laplacian, "biharmonic").from_source(source)
        geodesic = distance(laplacian, "geodesic").from_source(source)
        others += len(other_minima(extrema(surface, field), source))
        rows.append(field_row(surface, name, "front", source, "biharmonic", field, geodesic))
        panels.append(Panel(name, name, field, "biharmonic", (Mark(source, "source"),), ("front", "back")))
    ratios = [float(row[FIELD_COLUMNS.index("isotropy ratio")] or 0) for row in rows]
    return Result(
        "fig1",
        TITLE,
        "Source: on the front, at a fixed share of width and height. Twenty isolines at equal steps of the distance.",
        {name: shapes[name] for name in names},
        tuple(panels),
        tables=(Table("fields", FIELD_COLUMNS, tuple(rows)),),
        claims=(
            Claim(
                "Biharmonic distance has no local minima, except at the source point.",
                f"Local minima besides the source: {others} on {len(names)} surfaces.",
                others == 0,
            ),
            Claim(
                "Near the source the distance is locally isotropic.",
                f"Farthest over nearest direction on a small geodesic circle: {span(ratios)}.",
                max(ratios) <= ISOTROPIC,
            ),
        ),
    )
