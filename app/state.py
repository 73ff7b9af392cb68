"""What the user chose, as plain data: nothing here computes, draws or knows Qt."""

from dataclasses import dataclass, field, replace

from bihdist_core.distances.kinds import Spec

COMPARISON = (Spec.of("biharmonic"), Spec.of("geodesic"), Spec.of("diffusion"))
"""The panels of the window and of figures where nothing else is asked for."""


@dataclass(frozen=True)
class ViewerState:
    """Everything the user chose; the camera belongs to the window."""

    panels: tuple[Spec, ...] = field(default=COMPARISON)
    areas: str = "voronoi"
    source: int | None = None
    isolines: int = 20

    def with_panel(self, index: int, panel: Spec) -> "ViewerState":
        return replace(self, panels=(*self.panels[:index], panel, *self.panels[index + 1 :]))
