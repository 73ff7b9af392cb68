"""Row 28: figures of three panels drawn, in the styles of papers and covers."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from bihdist_core import Surface

from .child import in_window_child
from .meshes import bumpy_sphere
from .size import Size
from .table import Line, compared
from .timing import Comparison, alternate

BOUNDS = {"paper": 8.0, "cover": 2.0}
STEPS = 20


def figures(size: Size) -> Iterator[Line]:
    """Pixels of a paper's figure against PyVista's screenshot, and of a cover's against the paper's."""
    found = in_window_child(size, _figures, size)
    notes = "peer: PyVista's screenshot with isolines, four samples a pixel", "with shadows and ground; peer: paper"
    for (style, bound), result, note in zip(BOUNDS.items(), found, notes, strict=True):
        work = f"figure drawn, {style}, {size.figure:,}, {size.figure_width:,} pixels across"
        yield compared(28, work, result, bound=bound, note=note)


def _figures(size: Size) -> list[Comparison]:
    import pyvista

    import app

    surface = Surface(*bumpy_sphere(size.figure))
    fields = {f"r{k}": np.linalg.norm(surface.vertices - surface.vertices[k], axis=1) for k in (0, 7, 90)}
    sides = size.figure_width, size.figure_width * 3 // 8

    def picture(style: str) -> Any:
        look = {"size": f"{sides[0]}x{sides[1]}", "style": style, "ground": style == "cover"}
        return app.figure(surface, list(fields), 0, fields=fields, layout=look)

    mesh = pyvista.make_tri_mesh(surface.vertices, surface.faces)

    def screenshot() -> Any:
        plotter = pyvista.Plotter(off_screen=True, shape=(1, 3), window_size=sides, border=False)
        for column, (name, field) in enumerate(fields.items()):
            plotter.subplot(0, column)
            plotter.add_mesh(mesh.copy(deep=False), scalars=field, scalar_bar_args={"title": name}, smooth_shading=True)
            plotter.add_mesh(mesh.contour(STEPS, scalars=field), color="white", line_width=3)
        plotter.enable_anti_aliasing("msaa", multi_samples=4)
        try:
            return plotter.screenshot(return_img=True)
        finally:
            plotter.close()

    paper, cover = picture("paper"), picture("cover")
    return [
        alternate(lambda: paper.pixels, screenshot, size.rounds),
        alternate(lambda: cover.pixels, lambda: paper.pixels, size.rounds),
    ]
