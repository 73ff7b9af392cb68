"""The hemispheres of a brain: which a mesh has, and the views of each."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bihdist_core import Surface
from bihdist_core.errors import ParameterError
from bihdist_core.formats.mesh_names import files_of, hemisphere_of, mesh_name
from bihdist_core.formats.vertex_count import announced_vertices

if TYPE_CHECKING:
    from .loaded_mesh import LoadedMesh

ASIDE = 0.1
"""The share of a component's width that its middle lies beside x = 0, at least, to tell a side."""

LATERAL_AND_MEDIAL = {"left": ("lateral-left", "medial-left"), "right": ("medial-right", "lateral-right")}
"""Views of each hemisphere, in the order of a figure."""


class Hemispheres:
    """The hemispheres of a surface, found when they are first asked for."""

    def __init__(self) -> None:
        self.sides: dict[str, Surface] = {}
        self.reason = ""

    def keep(self, areas: str, wanted: object) -> None:
        """Keep them: they depend on no distance."""

    def of(self, loaded: LoadedMesh) -> dict[str, Surface]:
        """Return the surface of each side, with the vertex ids of the whole; ParameterError where sides are unknown.

        The names of files tell the side, or else that of x = 0 on which a component lies: x points to the right.
        """
        if not self.sides:
            surface = loaded.surface
            side, self.reason = _sides(loaded)
            of_face = side[surface.component_of_vertex[surface.faces[:, 0]]]
            for name, number in (("left", -1), ("right", 1)):
                if (of_face == number).all():
                    self.sides = {name: surface}
                elif (of_face == number).any():
                    self.sides[name] = Surface(surface.vertices, surface.faces[of_face == number], surface.name)
        return self.sides

    def side(self, loaded: LoadedMesh) -> str:
        """Return the one side that a mesh has; ParameterError for two."""
        sides = self.of(loaded)
        if len(sides) > 1:
            raise ParameterError(
                f"{loaded.surface.name} has both hemispheres; choose lateral-left, medial-left, lateral-right or "
                "medial-right, or --layout hemispheres."
            )
        return next(iter(sides))

    def sentence(self, loaded: LoadedMesh) -> str:
        """Return which hemispheres there are and how that is known, as a sentence."""
        sides = self.of(loaded)
        what = f"the {next(iter(sides))} hemisphere" if len(sides) == 1 else "both hemispheres"
        return f"{loaded.surface.name} is taken for {what}, by {self.reason}."


def _sides(loaded: LoadedMesh) -> tuple[np.ndarray, str]:
    """Return the side of each component, -1 for the left and 1 for the right, and by what that is known."""
    surface = loaded.surface
    names, files = {"left": -1, "right": 1}, files_of(loaded.mesh.path) if loaded.mesh.path else [surface.name]
    sides = [names.get(hemisphere_of(mesh_name(file)), 0) for file in files]
    count = announced_vertices(files[0]) if len(files) == 2 else len(surface.vertices)
    label = surface.component_of_vertex
    used, first = np.unique(label[label >= 0], return_index=True)
    if all(sides) and count and loaded.new_ids is None:
        at = np.flatnonzero(label >= 0)[first]
        return np.where(at < count, sides[0], sides[-1])[np.argsort(used)], "its name"
    found = np.zeros(surface.n_components, int)
    for component in used:
        x = surface.vertices[label == component, 0]
        if abs(x.mean()) < ASIDE * np.ptp(x):
            raise ParameterError(
                f"Neither the name of {surface.name} nor its place tells its hemisphere, as x = 0 passes through it; "
                "choose lateral-left, medial-left, lateral-right or medial-right."
            )
        found[component] = np.sign(x.mean())
    return found, "the sign of x"
