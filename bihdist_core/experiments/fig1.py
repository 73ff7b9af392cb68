"""Figure 1: the biharmonic distance from one source, as equally spaced white lines.

The paper lists in section 1 what the picture stands for: the distance is gradual, isotropic near the source, and
shape-aware far from it.
"""

from ..applications.resizing import refined
from ..arrays import FloatArray
from ..distances.distance import Distance
from ..laplacian import Laplacian
from ..progress import Progress, part, steps
from ._stated_figures import DEEP, MINIMA
from .circles import FRONT, PROTOCOL, gather_shared_circles
from .measures import FIELD_COLUMNS, deepest_minimum, field_row, marks, percent
from .parts import Parts
from .result import Cell, Gathered, Panel, Result, Table
from .shapes import Shapes, distance, random_sources, spec_of

TITLE = "Biharmonic distance from a source"
RANDOM = {"figure": 24}
"""Random sources on each shape: as many as figures 4 and 5 have; on others `FEW`. The quick version has `QUICK`, and
circles on the first shapes alone."""
FEW, QUICK, QUICK_CIRCLES = 8, 4, 2


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Compute the field on each shape from its front, and numbers from random sources."""
    names = shapes.names("figure", "animal", "hand", "genus3")
    panels, rows = [], []
    found, parts, where = Gathered(), Parts(), list[str]()
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
        spec = spec_of("biharmonic")
        panels.append(Panel(name, name, field, "biharmonic", shown, ("front", "back"), distance=spec))
        count = QUICK if quick else RANDOM.get(name, 24 if shapes.own is not None else FEW)
        depths = {v: _depth(biharmonic, v) for v in dict.fromkeys([source, *random_sources(surface, count)])}
        finer = Laplacian(refined(surface)) if max(depths.values()) > DEEP else None
        for vertex, depth in depths.items():
            if finer is not None and depth > DEEP:
                # A counterexample is one on the refined mesh as well.
                again = _depth(distance(finer, "biharmonic"), vertex)
                where.append(f"{name} from vertex {vertex}, {percent(depth)} ({percent(again)} on the refined mesh)")
                depth = min(depth, again)
            found.add(MINIMA.name, depth, is_pictured=vertex == source)
        if not quick or len(panels) <= QUICK_CIRCLES:
            gather_shared_circles(found, parts, shapes, name, count, FRONT, part(step, 0.3, 1))
    return Result(
        "fig1",
        TITLE,
        "The source is on the front, at a fixed share of the width and height; numbers are also measured from random "
        "vertices of each shape. Twenty isolines at equal steps of the distance. A minimum deeper than "
        f"{percent(DEEP)} of the range is measured again on the mesh refined to four times as many faces, and the "
        "smaller "
        "depth counts. " + PROTOCOL,
        {name: shapes[name] for name in names},
        tuple(panels),
        tables=(Table("fields", FIELD_COLUMNS, tuple(rows)),) if rows else (),
        claims=(found.claim("fig1-1", f"Where: {'; '.join(where)}." if where else ""), found.claim("fig1-2")),
        not_done=tuple(parts.not_done),
    )


def _depth(distance: Distance, source: int) -> float:
    return deepest_minimum(distance.surface, distance.from_source(source), source)


def _row(shapes: Shapes, name: str, source: int, field: FloatArray) -> tuple[Cell, ...]:
    geodesic = distance(shapes.laplacian(name), "geodesic").from_source(source)
    return field_row(shapes[name], name, "front", source, "biharmonic", field, geodesic)
