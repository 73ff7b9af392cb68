"""The heat method: accuracy against known distances, underflow, and meshes of any kind."""

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from bihdist_core.distances.geodesic import GeodesicDistance
from bihdist_core.distances.heat_geodesic import HeatGeodesic, _FaceFlow, heat_matrix, heat_time
from bihdist_core.errors import Cancelled, ParameterError, SolverError, VertexError
from bihdist_core.kernel.library import library
from bihdist_core.operators import stiffness, vertex_areas
from bihdist_core.surface import Surface
from tests.shapes import ORACLE, bumpy, caps, needs_oracle, oracle_surface


def heat_method(surface, factor=1.0):
    laplacian = stiffness(surface)
    matrix = heat_matrix(laplacian, vertex_areas(surface), heat_time(surface, factor))
    poisson = splu(laplacian[1:][:, 1:].tocsc())

    def solve_poisson(b):
        return np.concatenate([[0.0], poisson.solve(b[1:])])

    return HeatGeodesic(surface, matrix, splu(matrix.tocsc()).solve, solve_poisson)


def grid(k):
    """A flat square of side 1, k x k cells, diagonals alternating."""
    x, y = np.meshgrid(np.linspace(0, 1, k + 1), np.linspace(0, 1, k + 1))
    i, j = (a.ravel() for a in np.meshgrid(np.arange(k), np.arange(k)))
    a = j * (k + 1) + i
    b, c, d = a + 1, a + k + 2, a + k + 1
    odd = ((i + j) % 2 == 1)[:, None]
    first = np.where(odd, np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(odd, np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return Surface(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], 1), np.concatenate([first, second]))


def tube(length, ring=6):
    """A needle: an open tube of `length` edges of length 1 along z; the rings have radius 1."""
    angle = 2 * np.pi * np.arange(ring) / ring
    z = np.repeat(np.arange(length + 1.0), ring)
    x = np.stack([np.tile(np.cos(angle), length + 1), np.tile(np.sin(angle), length + 1), z], 1)
    i, j = np.arange(length)[:, None] * ring, np.arange(ring)
    a, b = (i + j).ravel(), (i + (j + 1) % ring).ravel()
    return Surface(x, np.concatenate([np.stack([a, b, b + ring], 1), np.stack([a, b + ring, a + ring], 1)]))


def test_square_converges_to_euclidean():
    errors = []
    for k in (10, 20, 40):
        surface = grid(k)
        exact = np.linalg.norm(surface.vertices - surface.vertices[0], axis=1)
        errors.append(np.abs(heat_method(surface).distances(0) - exact).mean())
    # First order in the edge length at best: each halving takes off a good third.
    assert errors[1] < errors[0] / 1.4
    assert errors[2] < errors[1] / 1.4
    assert errors[2] < 0.01


@needs_oracle
@pytest.mark.parametrize(
    ("name", "mean"),
    # Measured means over the sources, in fractions of the maximum, and some room.
    [("hand_lowres_boundary", 0.02), ("pelvis_genus1", 0.035), ("spot", 0.0125), ("lilium_boundary", 0.005)],
)
def test_mean_error_against_exact_distances(name, mean):
    solver = GeodesicDistance(oracle_surface(name), "heat")
    exact = np.load(ORACLE / f"{name}_exactgeo_pygeodesic.npy")
    sources = np.loadtxt(ORACLE / f"{name}_sources0.txt", dtype=int)
    assert np.abs(solver.from_sources(sources) - exact).mean() < mean * exact.max()


def test_zero_at_the_source_and_nowhere_negative():
    d = heat_method(grid(8)).distances(40)
    assert d[40] == 0
    assert (d >= 0).all()


def test_scales_like_length():
    surface = grid(8)
    d = heat_method(surface).distances(3)
    for scale in (1e-6, 1e6):
        scaled = heat_method(Surface(surface.vertices * scale, surface.faces)).distances(3)
        # Both matrices only change by factors, so only rounding differs.
        np.testing.assert_allclose(scaled, scale * d, rtol=0, atol=1e-10 * scale)


@pytest.mark.parametrize("source", [0, 15000])
def test_needle_of_5000_edges_where_heat_underflows(source):
    surface = tube(5000)
    solver = heat_method(surface)
    start = np.zeros(len(surface.vertices))
    start[source] = 1
    assert (solver._solve_heat(start) == 0).mean() > 0.5
    d = solver.distances(source)
    along = d.reshape(5001, 6).mean(axis=1)
    middle = source // 6
    # Ten rings from the source the flow runs along the needle, and each ring is an edge farther.
    assert (np.diff(along[middle + 10 :]) > 0.99).all()
    assert (np.diff(along[: max(middle - 10, 0)]) < -0.99).all()
    assert (np.diff(along[middle:]) > 0).all()
    # What the method is off around the source, less than an edge, stays the same however far the flow goes.
    off = along - np.abs(np.arange(5001) - middle)
    away = np.abs(np.arange(5001) - middle) > 10
    assert np.abs(off[away]).max() < 1
    assert np.ptp(off[middle + 10 :]) < 0.1


def test_stages_give_what_one_flow_gives(monkeypatch):
    surface = grid(40)
    solver = heat_method(surface)
    expected = solver.distances(0)
    # Heat spans some 1e25 on this square, so this floor makes several stages of what needs one.
    monkeypatch.setattr("bihdist_core.distances.heat_geodesic.FLOOR", 1e95)
    calls = []
    flow = solver._solve_heat
    solver._solve_heat = lambda b: calls.append(1) or flow(b)
    staged = solver.distances(0)
    assert len(calls) > 2
    # Rounding of u relative to its values near the rim, 1e-16 * 1e5, and nothing else.
    np.testing.assert_allclose(staged, expected, rtol=0, atol=1e-8)


def test_what_no_heat_reaches_has_no_nan():
    surface = grid(6)
    solver = heat_method(surface)
    flow = solver._solve_heat
    solver._solve_heat = lambda b: np.where(surface.vertices[:, 0] < 0.5, flow(b), 0.0)
    assert np.isfinite(solver.distances(0)).all()


def test_where_heat_is_constant_nothing_flows():
    surface = grid(4)
    for heat in (0.0, 1.0, 1e-300):
        assert not _FaceFlow(surface).divergence(np.full(len(surface.vertices), heat)).any()


def test_nonmanifold_edge():
    fins = [[0, 0, 0], [0, 0, 1], [1, 0, 0], [-1, 1, 0], [-1, -1, 0]]
    d = heat_method(Surface(fins, [[0, 1, 2], [0, 1, 3], [0, 1, 4]])).distances(2)
    assert np.isfinite(d).all()
    assert d[2] == 0
    assert (np.delete(d, 2) > 0).all()
    # The two fins mirror each other.
    assert d[3] == pytest.approx(d[4], rel=1e-12)


def test_a_flat_face_changes_little():
    """A vertex in the middle of a side, joined to the side's far face by a face of no area."""
    k = 12
    whole = grid(k)
    face = 5 * k + 6
    i, j, opposite = whole.faces[face]
    middle = len(whole.vertices)
    vertices = np.concatenate([whole.vertices, [(whole.vertices[i] + whole.vertices[j]) / 2]])
    faces = np.concatenate(
        [np.delete(whole.faces, face, 0), [[i, middle, opposite], [middle, j, opposite], [i, j, middle]]]
    )
    cracked = Surface(vertices, faces)
    assert len(cracked.degenerate_faces) == 1
    d = heat_method(cracked).distances(0)
    # Within the method's own error on this grid, a third of its edge of 1/12.
    np.testing.assert_allclose(d[:-1], heat_method(whole).distances(0), atol=0.03)
    assert d[-1] == pytest.approx((d[i] + d[j]) / 2, abs=0.03)


def test_refusals_and_cancelling():
    surface = grid(3)
    for factor in (0, -1, np.nan, np.inf):
        with pytest.raises(ParameterError, match=str(factor)):
            heat_time(surface, factor)
    solver = heat_method(surface)
    with pytest.raises(VertexError):
        solver.distances(16)

    def progress(_fraction, _text):
        raise Cancelled("stop")

    with pytest.raises(Cancelled):
        solver.distances(0, progress)
    solver._solve_poisson = lambda b: np.full_like(b, np.nan)
    with pytest.raises(SolverError, match="finite"):
        solver.distances(0)
    solver = heat_method(surface)
    solver._solve_heat = lambda b: np.full_like(b, np.nan)
    with pytest.raises(SolverError, match="heat flow"):
        solver.distances(0)


def test_a_spread_source_is_shifted_by_how_far_its_vertices_are():
    method = heat_method(grid(12))
    vertices, loads = np.array([70, 71, 84, 70]), np.array([0.3, 0.2, 0.1, 0.2])
    near = method.distances_with(vertices, loads, np.zeros(4))
    farther = method.distances_with(vertices, loads, np.full(4, 0.25))
    away = near > 0
    assert farther[away] - near[away] == pytest.approx(0.25, rel=1e-9)
    # The load at 70 counts once, however it is told.
    locked_cached_property = method.distances_with(np.array([70, 71, 84]), np.array([0.5, 0.2, 0.1]), np.zeros(3))
    assert locked_cached_property == pytest.approx(near, rel=1e-9, abs=1e-12)


@pytest.mark.skipif(library() is None, reason="there is no compiled kernel")
@pytest.mark.parametrize("height", [None, 1e-9, 0.0])
def test_compiled_divergence_is_that_of_the_plain_one(height, monkeypatch):
    surface = bumpy(300) if height is None else caps(bumpy(300), height, every=4)
    assert (len(surface.degenerate_faces) > 0) == (height is not None)
    flow = _FaceFlow(surface)
    u = np.exp(-500 * np.random.default_rng(0).random(len(surface.vertices)))
    u[surface.faces[3]] = 0.25
    for faces in (None, np.arange(3, len(surface.faces), 2), np.arange(0)):
        compiled = flow.divergence(u, faces)
        with monkeypatch.context() as patch:
            patch.setattr("bihdist_core.distances.heat_geodesic.library", lambda: None)
            plain = flow.divergence(u, faces)
        # A few terms are added up in another order.
        np.testing.assert_allclose(compiled, plain, rtol=0, atol=1e-14 * np.abs(plain).max())
