"""The protocols of the experiments: what they start from, their tables, and the printed times."""

import itertools

import numpy as np
import pytest

from bihdist_core import ParameterError, Surface
from bihdist_core.distances.diffusion import EigenpairDiffusion
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.experiments import EXPERIMENTS, SEEDS, Shapes, fig9, fig10, table1, table2
from bihdist_core.experiments._claims_growth import icosphere
from bihdist_core.experiments._claims_topology import APART, FAR_ROUND, far_pairs, nearly_touching
from bihdist_core.experiments.result import Table
from bihdist_core.experiments.shapes import spread_points, start_vertex, starts
from tests.shapes import bumpy, grid, torus, two_pieces


def test_a_missing_surface_is_named():
    with pytest.raises(ParameterError, match="needs the surface 'domain'"):
        EXPERIMENTS["fig2"].compute(Shapes({}))


def test_starts_and_sources_are_the_same_every_time():
    s = two_pieces()
    for seed in SEEDS:
        assert start_vertex(s, seed) == start_vertex(s, seed)
        assert s.component_of_vertex[start_vertex(s, seed)] == 0
    assert start_vertex(s) == 0
    assert len({start_vertex(bumpy(500), seed) for seed in SEEDS}) == 5
    points = spread_points(grid(10, 10), 4)
    assert points.tolist() == [0, 120, 10, 110]
    assert spread_points(s, 5).tolist() == spread_points(s, 8).tolist()[:5]


def test_there_are_as_many_starts_as_one_likes():
    s = bumpy(900)
    assert starts(5) == SEEDS
    assert len(starts()) == 25
    vertices = [start_vertex(s, start) for start in starts()]
    # Some two of 25 random vertices of 900 may be the same.
    assert len(set(vertices)) >= 23
    for start, vertex in zip(starts(3), vertices, strict=False):
        assert spread_points(s, 3, start).tolist() == spread_points(s, 3, vertex).tolist()
        assert fig10._clustered(s, start)[0] == vertex


def test_starts_that_lead_to_the_same_anchors_count_once():
    # Half of the surface is the head: the starts there are left out, and the same points remain.
    s = bumpy(400)
    head, nose = s.vertices[:, 0] > 0, int(s.vertices[:, 0].argmax())
    first = [tuple(fig9._anchors(s, seed, head, nose)) for seed in starts(25)]
    assert len(set(first)) < 25
    found = fig9.different_anchors(s, 25, head, nose)
    assert len(found) == len({tuple(anchors) for anchors in found.values()}) == 25
    assert [tuple(anchors) for anchors in found.values()][: len(set(first))] == list(dict.fromkeys(first))
    # With a head that is all but two vertices there are no more than so many.
    head = np.ones(len(s.vertices), bool)
    head[:2] = False
    few = fig9.different_anchors(s, 5, head, nose)
    assert len(few) == len({tuple(anchors) for anchors in few.values()}) < 5


def test_joins_are_apart_and_at_different_places():
    # A flattened ring: its inner sides face each other across the hole.
    ring = torus(40, 12)
    ring = Surface(ring.vertices * [1, 0.35, 1], ring.faces)
    unit = np.sqrt(ring.face_areas.sum())
    along = EdgeGeodesic(ring).distances(np.arange(len(ring.vertices)))
    pairs = far_pairs(ring, 12)
    assert len(set(pairs)) == 12
    assert all(along[i, j] > APART * unit for i, j in pairs)
    touching = nearly_touching(ring, 3)
    assert touching
    assert nearly_touching(ring) == touching[:1]
    ratios = [along[i, j] / np.linalg.norm(ring.vertices[i] - ring.vertices[j]) for i, j in touching]
    assert ratios == sorted(ratios, reverse=True)
    assert min(ratios) > FAR_ROUND
    for (a, b), (c, d) in itertools.combinations(touching, 2):
        for x, y in ((c, d), (d, c)):
            assert max(along[a, x], along[b, y]) >= APART * unit
    # On a convex surface no two points face each other.
    assert nearly_touching(icosphere(2), 3) == []


def test_vertices_are_found_by_their_place():
    s = bumpy(2000)
    x, y, z = s.vertices.T
    for side, sign in (("front", 1), ("back", -1)):
        # Within 1.5 edges of the ray: 6 % of the width.
        v = Shapes(own=s).vertex_at(s, 0.5, 0.7, side)
        assert sign * z[v] > 0.3
        assert (x[v] - x.min()) / np.ptp(x) == pytest.approx(0.5, abs=0.07)
        assert (y[v] - y.min()) / np.ptp(y) == pytest.approx(0.7, abs=0.07)
    # A ray beside the surface finds the vertex nearest to it.
    assert Shapes({}).vertex_at(grid(4, 4), 5, 5) == 24


def test_tables_are_asked_by_their_columns():
    table = Table("t", ("a", "b c"), ((1, "x"), (2, "y"), (3, "y")))
    assert table.values("a", b_c="y") == [2, 3]
    assert table.value("a", b_c="x") == 1
    with pytest.raises(ParameterError, match=r"a where .* is \[2, 3\], not one number"):
        table.value("a", b_c="y")


def test_the_printed_times_are_the_papers():
    biharmonic, dijkstra, diffusion = table1.PAPER[16_000]
    assert dijkstra / biharmonic == pytest.approx(1.81, abs=0.005)
    assert diffusion == 37.2
    assert table2.PAPER[111_000] == ((11.18, 37.13, 185.28), (1.05, 52.8, 200.39), 202.2)
    assert tuple(table1.PAPER) == table1.SIZES
    assert tuple(table2.PAPER) == table2.SIZES


def test_timed_distances_are_the_right_ones():
    # What is timed must also be right.
    s = bumpy(150)
    # As the paper times it; the usual way, without eigenpairs, depends on M.
    assert isinstance(table1._columns(s, table1.METHODS[2]).__self__, EigenpairDiffusion)
    assert isinstance(table2._set_up(s, table2.METHODS[2]).__self__, EigenpairDiffusion)
    for method in table1.METHODS:
        columns = table1._columns(s, method)(np.array([3, 7]))
        assert columns.shape == (150, 2)
        assert columns[3, 0] == 0
        assert columns[7, 0] == pytest.approx(columns[3, 1])
        among = table2.distances_among(s, np.array([3, 7, 100]), method)
        assert among[0, 1] == pytest.approx(columns[7, 0], rel=1e-9)
        assert among[1, 2] == pytest.approx(columns[100, 1], rel=1e-9)
