"""What is shown, as frozen plain data: the words are the command line's too."""

from dataclasses import dataclass, field, replace

from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    DiffusionDistance,
    Distance,
    GeodesicDistance,
    Laplacian,
    ParameterError,
    PowerDistance,
    TruncatedBiharmonicDistance,
)
from bihdist_core.progress import Progress

DISTANCES = ("biharmonic", "truncated", "power", "commute-time", "diffusion", "geodesic")

PAPER_TIMES = (1 / 15, 1 / 8, 1 / 4, 1.0, 4.0)

HINTS = {
    "biharmonic": "round near the source, follows the shape far away",
    "truncated": "the biharmonic distance from its first eigenpairs: blurred at the source",
    "power": "larger α: smoother, less local",
    "commute-time": "a spike at the source, almost flat elsewhere",
    "diffusion": "small t: flat far away; large t: stretched near the source",
    "geodesic": "round near the source, creases where shortest paths meet",
}


@dataclass(frozen=True)
class PanelState:
    """Which distance a panel shows.  Only the parameters of that distance matter."""

    distance: str = "biharmonic"
    t: float = 1.0
    k: int = 200
    alpha: float = 1.5
    method: str = "auto"

    def __post_init__(self) -> None:
        if self.distance not in DISTANCES:
            raise ParameterError(f"There is no distance {self.distance!r}; choose one of {', '.join(DISTANCES)}.")

    @property
    def hint(self) -> str:
        """What to look for, in one line."""
        return HINTS[self.distance]

    def build(self, laplacian: Laplacian, progress: Progress | None = None) -> Distance:
        """The distance, ready to be asked; this is where the long work is."""
        if self.distance == "biharmonic":
            return BiharmonicDistance(laplacian, progress=progress)
        if self.distance == "truncated":
            return TruncatedBiharmonicDistance(laplacian, k=self.k, progress=progress)
        if self.distance == "power":
            return PowerDistance(laplacian, alpha=self.alpha, k=self.k, progress=progress)
        if self.distance == "commute-time":
            return CommuteTimeDistance(laplacian, progress=progress)
        if self.distance == "diffusion":
            return DiffusionDistance(laplacian, t=self.t, progress=progress)
        return GeodesicDistance(laplacian, method=self.method, progress=progress)


COMPARISON = (PanelState("biharmonic"), PanelState("geodesic"), PanelState("diffusion"))
"""The panels of the window and of figures where nothing else is asked for."""


@dataclass(frozen=True)
class ViewerState:
    """Everything the user chose; the camera belongs to the window."""

    panels: tuple[PanelState, ...] = field(default=COMPARISON)
    areas: str = "voronoi"
    source: int | None = None
    isolines: int = 20

    def with_panel(self, index: int, panel: PanelState) -> "ViewerState":
        return replace(self, panels=(*self.panels[:index], panel, *self.panels[index + 1 :]))
