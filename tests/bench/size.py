"""How large the benchmark is: in full, and quick enough for the test suite."""

from dataclasses import dataclass

import numpy as np

from .meshes import bumpy_sphere


@dataclass(frozen=True)
class Size:
    """main: vertices of rows 1 to 6, 9 to 11, 25; pairs: of row 4; growth: of row 7, row 8 takes the last; window: of
    rows 13 and 14; drag: of row 15; moving: of row 16; scatter: of row 18; live: of row 19; meshes: how many of row 21;
    cortex and parcels: of row 22; small: how many meshes of row 23; geodesic and geodesic_growth: of row 27; figure and
    figure_width: of row 28; graph: nodes of row 29; read: vertices of row 24; moves: of the source in row 15; seconds:
    of a drag in row 19; pointed: places in row 13; file: a mesh that takes the place of the bumpy sphere of `main`
    vertices."""

    main: int = 112_000
    pairs: int = 16_000
    growth: tuple[int, ...] = (16_000, 56_000, 112_000, 500_000, 1_000_000)
    sources: int = 400
    geodesic: tuple[int, int] = (15_000, 50_000)
    geodesic_growth: tuple[int, ...] = (16_000, 100_000, 500_000)
    eigenpairs: tuple[int, ...] = (50, 200)
    window: tuple[int, int] = (100_000, 500_000)
    drag: tuple[int, int] = (164_000, 16_000)
    moving: int = 1_000_000
    scatter: int = 500_000
    live: tuple[int, ...] = (50_000, 200_000)
    meshes: int = 400
    cortex: int = 160_000
    parcels: int = 400
    small: int = 1000
    read: int = 1_000_000
    figure: int = 100_000
    figure_width: int = 4000
    graph: int = 1_000_000
    moves: int = 188
    seconds: float = 3.0
    pointed: int = 100
    rounds: int = 3
    repeat: int = 5
    sample: str = "figure"
    file: str | None = None
    is_quick: bool = False

    def main_mesh(self) -> tuple[np.ndarray, np.ndarray]:
        """(n, 3) vertices and (m, 3) faces."""
        if self.file is None:
            return bumpy_sphere(self.main)
        from bihdist_core import read_surface

        surface = read_surface(self.file)
        if surface.n_components > 1:
            surface, _ = surface.component(0)
        return np.array(surface.vertices), np.array(surface.faces)


FULL = Size()
QUICK = Size(
    main=2000,
    pairs=1000,
    growth=(1000, 2000, 4000),
    sources=40,
    geodesic=(500, 1000),
    geodesic_growth=(500, 1000),
    eigenpairs=(10, 20),
    window=(4000, 8000),
    drag=(4000, 1000),
    moving=4000,
    scatter=4000,
    live=(4000,),
    meshes=2,
    cortex=2000,
    parcels=20,
    small=10,
    read=2000,
    figure=2000,
    figure_width=400,
    graph=2000,
    moves=20,
    seconds=0.3,
    pointed=20,
    rounds=1,
    repeat=2,
    is_quick=True,
)
