"""Figure 1: the biharmonic distance from one source, as equally spaced white lines.

The paper shows the picture and lists, in section 1, what it stands for: gradual, isotropic near the source, aware of
the shape away from it.
"""

from ..arrays import FloatArray
from ..progress import Progress, part, steps
from ._stated_figures import MINIMA
from .circles import FRONT, PROTOCOL, gather_shared_circles
from .measures import FIELD_COLUMNS, deepest_minimum, field_row, marks
from .parts import Parts
from .result import Cell, Gathered, Panel, Result, Table
from .shapes import Shapes, distance, random_sources, spec_of

TITLE = "Biharmonic distance from a source"
RANDOM = {"figure": 24}
"""Random sources on each shape: as many as figures 4 and 5 have; on others `FEW`."""
FEW, QUICK = 8, 4


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Compute the field on each shape from its front, and numbers from random sources; two shapes if `quick`."""
    names = shapes.names(*("figure", "animal", "hand", "genus3")[: 2 if quick else 4])
    panels, rows = [], []
    found, parts = Gathered(), Parts()
    for step, name in steps(progress, names):
        surface = shapes[name]
        step(0.0, name)
        biharmonic = distance(shapes.laplacian(name), "biharmonic")
        source = shapes.pictured_source(name, "front")
        field = biharmonic.from_source(source)
        row = parts.do(f"numbers of the field on {name}", _row, shapes, name, source, field)
        rows += [row] if row is not None else []
        # The picture has marks where the statement fails, and nowhere else.
        shown = tuple(mark for mark in marks(surface, field, source) if mark.kind != "maximum")
        spec = spec_of("biharmonic", biharmonic)
        panels.append(Panel(name, name, field, "biharmonic", shown, ("front", "back"), distance=spec))
        count = QUICK if quick else RANDOM.get(name, 24 if shapes.own is not None else FEW)
        found.add(MINIMA.name, deepest_minimum(surface, field, source), is_pictured=True)
        for vertex in random_sources(surface, count):
            depth = deepest_minimum(surface, biharmonic.from_source(vertex), vertex)
            found.add(MINIMA.name, depth, is_pictured=False)
        gather_shared_circles(found, parts, shapes, name, count, FRONT, part(step, 0.3, 1))
    return Result(
        "fig1",
        TITLE,
        "Source: on the front, at a fixed share of width and height; the numbers are also taken from random vertices "
        "of each shape. Twenty isolines at equal steps of the distance. " + PROTOCOL,
        {name: shapes[name] for name in names},
        tuple(panels),
        tables=(Table("fields", FIELD_COLUMNS, tuple(rows)),) if rows else (),
        claims=(found.claim("fig1-1"), found.claim("fig1-2")),
        not_done=tuple(parts.not_done),
    )


def _row(shapes: Shapes, name: str, source: int, field: FloatArray) -> tuple[Cell, ...]:
    geodesic = distance(shapes.laplacian(name), "geodesic").from_source(source)
    return field_row(shapes[name], name, "front", source, "biharmonic", field, geodesic)
