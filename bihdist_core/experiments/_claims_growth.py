"""Claims of sections 2 and 4 about growth: cost with N, eigenvalues with k, commute-time distance under refinement."""

from functools import partial
from itertools import combinations

import numpy as np

from ..applications.resizing import refined
from ..distances.biharmonic import BiharmonicDistance
from ..laplacian import Laplacian
from ..progress import Progress
from ..solver.elimination_tree import EliminationTree
from ..surface import Surface
from .fig8 import resolved_by
from .measures import percent
from .parts import Parts
from .result import Cell, Chart, Claim, Findings, Series, Table
from .shapes import Shapes, distance
from .timing import Time, busy, timed
from .verdicts import Estimate, exponent

SIZES = (4_000, 8_000, 16_000, 28_000, 56_000, 111_000)
QUICK_SIZES = (1_000, 2_000, 4_000, 6_000, 8_000)
STRETCH = 2.0
"""The factor of the Moebius transformation in the plane."""
REPEATS, COLUMNS = 2, 10
"""How often the set-up is timed, and how many columns after each."""
CONFORMAL = ("commute-time", "biharmonic")
EIGENVALUES, FEWEST = 400, 200
"""How many are computed, if the mesh resolves them, and the fewest that are judged; the quick version has these."""
DECADE = 10
"""The law is one of large k: the last decade of the eigenvalues is fitted, at numbers spaced evenly in their logarithm,
as neighbours tell the same."""


def cost(shapes: Shapes, name: str, quick: bool, parts: Parts, progress: Progress) -> Findings:
    """Count operations and measure seconds for the set-up and for one column, N growing."""
    sizes = shapes.sizes(name, QUICK_SIZES if quick else SIZES, parts)
    rows: list[tuple[Cell, ...]] = []
    every: list[Time] = []
    BiharmonicDistance(Laplacian(shapes.at_most(name, 500))).from_source(0)
    for k, n in enumerate(sizes):
        surface = shapes.sized(name, n)
        set_ups, columns = [], []
        for repeat in range(REPEATS):
            progress((k + repeat / REPEATS) / len(sizes), f"cost at {n:,} vertices")
            biharmonic, set_up = timed(partial(_set_up, surface))
            biharmonic.from_source(0)
            vertices = np.random.default_rng(repeat).integers(n, size=COLUMNS).tolist()
            columns += [timed(partial(biharmonic.from_source, vertex))[1] for vertex in vertices]
            set_ups.append(set_up)
        seconds = (min(t.processor for t in times) for times in (set_ups, columns))
        rows.append((n, *operations(biharmonic.laplacian.components[0].tree()), *seconds))
        every += columns
    columns_of = {"factorization": 1, "one column": 2, "set-up": 3, "one column, time": 4}
    found = {name: np.array([row[k] for row in rows], float) for name, k in columns_of.items()}
    x = np.array(sizes)
    counted = tuple(Series(label, x, found[label]) for label in ("factorization", "one column"))
    seconds_of = (Series("set-up", x, found["set-up"]), Series("one column", x, found["one column, time"]))
    times = " and ".join(f"{one.name} {exponent(sizes, one.y):.2f}" for one in seconds_of)
    heads = ("vertices", "operations, factorization", "operations, one column")
    claim = Claim(
        "claims-cost",
        {
            f"exponent of N, operations of {label}": Estimate(exponent(sizes, one.y))
            for label, one in zip(("the factorization", "one column"), counted, strict=True)
        },
        f"In theory nested dissection makes them N^1.5 and N log N. The exponents of the least processor times "
        f"are {times}: the set-up has the factorization and the diagonal.",
        busy(every),
    )
    charts = (
        Chart("operations", "vertices", "operations", counted, log_x=True, log_y=True),
        Chart("cost", "vertices", "processor seconds", seconds_of, log_x=True, log_y=True),
    )
    columns_heads = (*heads, "set-up, processor seconds", "one column, processor seconds")
    return Findings(charts=charts, tables=[Table("cost", columns_heads, tuple(rows))], claims=[claim])


def operations(tree: EliminationTree) -> tuple[float, float]:
    """Count the multiplications and additions of a factorization, and those of a column.

    A front with c pivots and m boundary vertices: its pivots' block is inverted (2 c^3), multiplied into its side
    (2 c^2 m), and their product taken from the rest (2 c m^2). A solve multiplies with the block and, down and up,
    with the side; a column has two solves.
    """
    c, m = (size.astype(float) for size in tree.sizes)
    factorization = 2 * (c**3 + c**2 * m + c * m**2)
    column = 2 * 2 * (c**2 + 2 * c * m)
    return float(factorization.sum()), float(column.sum())


def _set_up(surface: Surface) -> BiharmonicDistance:
    return BiharmonicDistance(Laplacian(surface))


def eigenvalues(shapes: Shapes, name: str, quick: bool, progress: Progress) -> Findings:
    """Check that eigenvalues of a surface grow like k (Weyl): lambda_k ~ 4 pi k / area."""
    most = min(resolved_by(shapes[name]), shapes.laplacian(name).components[0].most_eigenpairs)
    count = max(min(FEWEST if quick else EIGENVALUES, most), 1)
    spectrum = shapes.laplacian(name).components[0].spectrum(count, progress)
    k = np.arange(1, count + 1)
    values = spectrum.eigenvalues[:count]
    area = float(shapes.laplacian(name).components[0].areas.sum())
    fitted = np.unique(np.geomspace(max(1, count // DECADE), count, 13).round().astype(int))
    slope = Estimate(exponent(fitted, values[fitted - 1]))
    ratio = values[-1] * area / (4 * np.pi * count)
    series = (
        Series("eigenvalues", k, values),
        Series("4πk / area", k, (4 * np.pi * k / area).astype(float, copy=False)),
    )
    claim = Claim(
        "claims-weyl",
        {"exponent of k": slope} if count >= FEWEST else {},
        f"Fitted over {len(fitted)} numbers k from {fitted[0]} to {count}, evenly in log k; the last eigenvalue over "
        f"4πk / area: {ratio:.2f}.",
        failure="" if count >= FEWEST else f"It takes {FEWEST} eigenvalues or more; the mesh resolves {most:,}.",
    )
    chart = Chart("eigenvalues", "k", "eigenvalue", series, log_x=True, log_y=True)
    return Findings(charts=[chart], claims=[claim])


def refinement(quick: bool, progress: Progress) -> Findings:
    """Measure antipodes of finer and finer spheres: commute-time grows without bound, biharmonic distance converges."""
    rows = []
    levels = range(2, 5 if quick else 7)
    for times in levels:
        laplacian = Laplacian(icosphere(times))
        # Antipodes of the icosahedron, whose vertices all levels share.
        far = int(np.argmin(laplacian.surface.vertices[:12] @ laplacian.surface.vertices[0]))
        commute = distance(laplacian, "commute-time").between(0, far)
        biharmonic = distance(laplacian, "biharmonic").between(0, far)
        rows.append((len(laplacian.surface.vertices), commute, commute**2, biharmonic))
        progress((times - 1) / len(levels), "finer spheres")
    n = np.array([row[0] for row in rows])
    # d^2 ~ p ln n is e^(d^2) ~ n^p.
    growth = Estimate(2 * np.pi * exponent(n, np.exp([row[2] for row in rows])))
    moved = abs(rows[-1][3] - rows[-2][3]) / rows[-1][3]
    chart = Chart(
        "commute-time under refinement",
        "vertices",
        "squared distance of antipodes",
        (
            Series("commute-time", n, np.array([row[2] for row in rows])),
            Series("biharmonic", n, np.array([row[3] ** 2 for row in rows])),
        ),
        log_x=True,
    )
    columns = ("vertices", "commute-time", "commute-time squared", "biharmonic")
    claims = (
        Claim(
            "claims-commute",
            {"growth of its square per e-fold of N, times 2π": growth},
            "Measured between antipodes of a sphere; the logarithmic singularity of the Green's function gives 1.",
        ),
        Claim(
            "claims-converges",
            {
                "change at the last refinement": Estimate(moved),
                "difference from the exact value on the sphere": Estimate(abs(rows[-1][3] / _antipodes() - 1)),
            },
            f"At {rows[-1][0]:,} vertices it is {rows[-1][3]:.5f}, on the unit sphere {_antipodes():.5f}.",
        ),
    )
    return Findings(charts=[chart], tables=[Table("refinement", columns, tuple(rows))], claims=claims)


def conformal(quick: bool, progress: Progress) -> Findings:
    """Compare two conformally equivalent spheres: commute-time distance is the same on both, biharmonic is not."""
    levels = (3, 4) if quick else (4, 5)
    rows: list[tuple[Cell, ...]] = []
    for k, times in enumerate(levels):
        sphere = icosphere(times)
        pair = [Laplacian(s) for s in (sphere, moebius(sphere, STRETCH))]
        points = np.random.default_rng(0).choice(len(sphere.vertices), 200, replace=False)
        for label in CONFORMAL:
            one, two = (distance(laplacian, label).pairwise(points) for laplacian in pair)
            apart = one > 0
            change = np.abs(two[apart] / one[apart] - 1)
            spread = change.mean(), *np.quantile(change, [0.05, 0.95]), change.max()
            rows.append((len(sphere.vertices), label, *(float(x) for x in spread)))
        progress((k + 1) / len(levels), "conformally equivalent spheres")
    columns = ("vertices", "distance", "mean relative change", "5 %", "95 %", "largest")
    table = Table("conformal", columns, tuple(rows))
    coarse, fine = (
        [table.value("mean relative change", vertices=rows[at][0], distance=label) for label in CONFORMAL]
        for at in (0, -1)
    )
    changes = ", ".join(f"{label} {percent(mean)}" for label, mean in zip(CONFORMAL, coarse, strict=True))
    claim = Claim(
        "claims-conformal",
        {f"mean change, {label}": Estimate(mean) for label, mean in zip(CONFORMAL, fine, strict=True)},
        f"A sphere and its image under a Moebius transformation (stretch {STRETCH:g}), all pairs of 200 points. With a "
        f"quarter of the vertices: {changes}.",
    )
    return Findings(tables=[table], claims=[claim])


def _antipodes() -> float:
    """Return the biharmonic distance of antipodes of the unit sphere.

    d^2 = sum_l (2l + 1) / (4 pi) (2 - 2 P_l(-1)) / (l(l+1))^2, where P_l(-1) is 1 for even l and -1 for odd ones.
    """
    degree = np.arange(1, 200_001, 2, dtype=float)
    return float(np.sqrt((4 * (2 * degree + 1) / (4 * np.pi) / (degree * (degree + 1)) ** 2).sum()))


# ---------------------------------------------------------------------- spheres
def icosphere(times: int) -> Surface:
    """Return the unit sphere: an icosahedron refined `times` times, 10 * 4^times + 2 vertices.

    Coarser vertices keep ids.
    """
    g = (1 + 5**0.5) / 2
    x = np.array([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0]], float)
    x = np.concatenate([x, np.roll(x, 1, axis=1), np.roll(x, 2, axis=1)])
    # Neighbours are at distance 2; a face is three mutual neighbours.
    near = np.isclose(np.linalg.norm(x[:, None] - x, axis=2), 2)
    faces = [f for f in combinations(range(12), 3) if near[np.ix_(f, f)].sum() == 6]
    turned = [f if np.linalg.det(x[list(f)]) > 0 else f[::-1] for f in faces]
    sphere = Surface(x / np.linalg.norm(x[0]), np.array(turned), "sphere")
    for _ in range(times):
        finer = refined(sphere)
        x = finer.vertices
        sphere = Surface(x / np.linalg.norm(x, axis=1, keepdims=True), finer.faces, "sphere")
    return sphere


def moebius(sphere: Surface, stretch: float) -> Surface:
    """Return the unit sphere after a Moebius transformation: stereographic projection from +z, times `stretch`, and
    back."""
    x, y, z = sphere.vertices.T
    # With the plane point (x, y) / (1 - z): back again its height is (r^2 - 1) / (r^2 + 1), written without division
    # by 1 - z, which is 0 at the pole.
    up, down = stretch**2 * (1 + z), 1 - z
    total = up + down
    return Surface(np.stack([2 * stretch * x / total, 2 * stretch * y / total, (up - down) / total], 1), sphere.faces)
