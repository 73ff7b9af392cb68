"""PyVista's own window, with the mesh and the fields on it."""

from collections.abc import Mapping

import pyvista
from pyvistaqt import BackgroundPlotter

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray


def background_plotter(surface: Surface, fields: Mapping[str, AnyArray]) -> BackgroundPlotter:
    """Fields (n,) by name become arrays of the points; the first is drawn, NaN in grey."""
    mesh = pyvista.PolyData.from_regular_faces(surface.vertices, surface.faces.astype(int, copy=False))
    for name, field in fields.items():
        mesh.point_data[name] = field
    plotter = BackgroundPlotter(title=f"{surface.name} - PyVista")
    plotter.add_mesh(mesh, scalars=next(iter(fields), None), nan_color="lightgrey", smooth_shading=True)
    return plotter
