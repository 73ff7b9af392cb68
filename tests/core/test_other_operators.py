"""Operators of other triangulations than a surface's faces, and distances by them."""

import pickle

import numpy as np
import pytest
import scipy.linalg
from scipy.spatial import Delaunay

from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    MeshError,
    ParameterError,
    PointCloud,
    Surface,
    intrinsic,
    read_surface,
)
from bihdist_core.distances.distance_types import Spec
from bihdist_core.intrinsic import INTRINSIC, OPERATORS, TUFTED, corners_of, delaunay, flip
from tests.programs import ROOT
from tests.shapes import bumpy, caps, fin, grid, plate, slivers, torus, two_pieces

OTHERS = [INTRINSIC, TUFTED]
SHAPES = {
    "closed": lambda: bumpy(150),
    "open": lambda: plate(12, 9, 0.3),
    "thin": lambda: caps(bumpy(100), 1e-4, 3),
    "slivers": slivers,
    "pieces": two_pieces,
    "three faces": fin,
}


def soup():
    """Faces between any vertices, many at an edge."""
    rng = np.random.default_rng(4)
    faces = np.sort([rng.choice(30, 3, replace=False) for _ in range(150)], axis=1)
    return Surface(rng.normal(size=(30, 3)), np.unique(faces, axis=0), "soup")


def dense(laplacian, power):
    """(n, n) distances from all eigenpairs with the weights 1 / lambda^power, NaN between components."""
    n = len(laplacian.areas)
    found = np.full((n, n), np.nan)
    for component in laplacian.components:
        values, vectors = scipy.linalg.eigh(component.stiffness.toarray(), np.diag(component.areas))
        points = vectors[:, 1:] * values[1:] ** (-power / 2)
        apart = np.linalg.norm(points[:, None] - points, axis=2)
        found[np.ix_(component.vertices, component.vertices)] = apart
    return found


@pytest.mark.parametrize("operator", OTHERS)
@pytest.mark.parametrize("shape", SHAPES)
def test_distances_are_those_of_the_dense_spectrum(shape, operator):
    laplacian = Laplacian(SHAPES[shape](), operator=operator)
    for kind, power in ((BiharmonicDistance, 2), (CommuteTimeDistance, 1)):
        distance, wanted = kind(laplacian), dense(laplacian, power)
        found, top = distance.from_sources([0, 5]).T, np.nanmax(wanted)
        assert np.array_equal(np.isnan(found), np.isnan(wanted[[0, 5]]))
        assert np.nanmax(np.abs(found - wanted[[0, 5]])) < 1e-9 * top
        assert np.nanmax(np.abs(found - wanted[[0, 5]])) < distance.error_estimate([0]).share * top


@pytest.mark.parametrize("operator", OTHERS)
def test_the_matrix_is_a_laplacian_of_the_same_area(operator):
    for make in SHAPES.values():
        surface = make()
        laplacian = Laplacian(surface, operator=operator)
        matrix = laplacian.stiffness
        assert abs(matrix - matrix.T).max() < 1e-12 * abs(matrix).max()
        assert np.abs(matrix.sum(axis=1)).max() < 1e-10 * abs(matrix).max()
        assert laplacian.areas.sum() == pytest.approx(surface.area, rel=1e-3)  # some thin faces are made less thin


def test_where_nothing_is_flipped_it_is_the_usual_operator():
    surface = grid(9, 7)
    usual, other = Laplacian(surface), Laplacian(surface, operator=INTRINSIC)
    assert abs(usual.stiffness - other.stiffness).max() < 1e-14
    assert np.allclose(usual.areas, other.areas, rtol=1e-14)


@pytest.mark.parametrize("shape", [*SHAPES, "soup"])
def test_the_tufted_cover_is_that_of_its_authors(shape):
    reference = pytest.importorskip("robust_laplacian")
    surface = SHAPES.get(shape, soup)()
    used, faces = np.unique(surface.faces, return_inverse=True)
    stiffness, areas = reference.mesh_laplacian(surface.vertices[used], faces.reshape(-1, 3))
    laplacian = Laplacian(surface, operator=TUFTED)
    off = laplacian.stiffness[used][:, used] - (stiffness + stiffness.T) / 2
    assert abs(off).max() < 1e-9 * abs(stiffness).max()
    np.testing.assert_allclose(laplacian.areas[used], areas.diagonal(), rtol=1e-9)


def test_faces_about_an_edge_are_glued_to_the_next():
    turns = np.random.default_rng(1).uniform(0, 2 * np.pi, 500)
    tips = np.stack([0.3 * np.cos(turns), 0.3 * np.sin(turns), np.full(500, 0.5)], axis=1)
    x = np.concatenate([[[0, 0, 0], [0, 0, 1]], tips])
    book = Surface(x, [[0, 1, k] for k in range(2, 502)])
    laplacian = Laplacian(book, operator=TUFTED)
    # All pages are obtuse, so that the edge is flipped between each and the next.
    joined = np.argwhere(np.triu(laplacian.stiffness[2:, 2:].toarray() < 0))
    order = np.argsort(turns)
    around = np.sort(np.stack([order, np.roll(order, 1)], axis=1), axis=1)
    assert {*map(tuple, joined.tolist())} == {*map(tuple, around.tolist())}
    assert laplacian.stiffness[0, 1] == 0
    assert laplacian.areas.sum() == pytest.approx(book.area, rel=1e-12)


def test_of_a_closed_surface_both_are_one():
    for surface in (caps(bumpy(100), 0.05, 3), torus(7, 5), bumpy(300)):
        one, other = (Laplacian(surface, areas, operator=each).stiffness for each, areas in
                      ((INTRINSIC, "barycentric"), (TUFTED, "voronoi")))  # fmt: skip
        assert abs(one - other).max() < 1e-6 * abs(one).max()


@pytest.mark.parametrize("turned", [False, True])
def test_a_plane_gets_its_delaunay_triangulation(turned):
    rng = np.random.default_rng(5)
    points = np.vstack([[[0, 0], [1, 0], [1, 1], [0, 1]], rng.uniform(0.05, 0.95, (60, 2))])
    wanted = Delaunay(points).simplices
    # Another triangulation of the same points: the Delaunay one of a sheared plane.
    faces = Delaunay(points @ [[1, 0], [2.5, 0.2]]).simplices
    if turned:
        faces[::2] = faces[::2, ::-1]  # faces need not lead the same way round
    surface = Surface(np.column_stack([points, np.zeros(len(points))]), faces)
    found, lengths = delaunay(surface)
    inside = {tuple(sorted(face)) for face in wanted.tolist()}
    assert {tuple(sorted(face)) for face in found.tolist()} == inside
    assert corners_of(lengths)[2].sum() == pytest.approx(1, rel=1e-12)


def test_all_sides_are_delaunay_and_keep_their_lengths():
    surface = caps(torus(9, 6), 0.01, 2)
    found, lengths = delaunay(surface)
    assert (np.sort(found, axis=1) != np.sort(surface.faces, axis=1)).any()
    # With sides glued by their ends alone, where these are of one edge.
    pairs = np.sort(found[:, [[1, 2], [2, 0], [0, 1]]], axis=2) @ [len(surface.vertices), 1]
    edge = np.unique(pairs, return_inverse=True)[1].reshape(-1, 3)
    faces, same = flip(found, lengths, edge, "torus")
    assert np.array_equal(faces, found)
    assert np.array_equal(same, lengths)


def test_thin_faces_have_no_negative_weights():
    surface = caps(bumpy(100), 1e-3, 3)
    usual, other = (Laplacian(surface, operator=each).stiffness.tocoo() for each in OPERATORS[:2])
    off = [each.data[each.row != each.col].max() for each in (usual, other)]
    assert off[0] > 1
    assert off[1] < 1e-10


def test_labels_files_and_copies_name_it():
    surface = bumpy(60)
    laplacian = Laplacian(surface, operator=INTRINSIC)
    assert repr(laplacian).endswith("voronoi areas, intrinsic-delaunay)")
    assert Spec.of("biharmonic").build(laplacian).label == "biharmonic, exact, intrinsic-delaunay"
    assert Spec.of("biharmonic").build(Laplacian(surface)).label == "biharmonic, exact"
    again = pickle.loads(pickle.dumps(laplacian))
    assert again.operator == INTRINSIC
    assert abs(again.stiffness - laplacian.stiffness).max() == 0


def test_what_needs_faces_is_as_before():
    surface = caps(bumpy(100), 0.05, 3)
    for method in ("exact", "heat", "dijkstra"):
        usual = GeodesicDistance(surface, method)
        other = GeodesicDistance(Laplacian(surface, operator=INTRINSIC), method)
        assert np.array_equal(usual.from_source(3), other.from_source(3))
        assert other.label == usual.label


@pytest.mark.parametrize("operator", OTHERS)
def test_other_distances_and_places_work(operator):
    laplacian = Laplacian(fin(), operator=operator)
    for t in (1, 0.1):
        assert np.isfinite(DiffusionDistance(laplacian, t).from_source(0)).all()
    bent = Laplacian(plate(12, 9, 0.3), operator=operator)
    distance = BiharmonicDistance(bent)
    face = bent.surface.faces[5]
    middle = distance.between("f5:0.33,0.33", int(face[0]))
    assert 0 < middle < distance.pairwise(face).max()


def test_what_there_is_not_is_refused(monkeypatch):
    with pytest.raises(ParameterError, match="no operator 'cot'; choose one of cotan, intrinsic-delaunay, tufted"):
        Laplacian(bumpy(20), operator="cot")
    with pytest.raises(ParameterError, match="tufted has areas of its own, and no barycentric ones"):
        Laplacian(bumpy(20), "barycentric", TUFTED)
    points = PointCloud(bumpy(30).vertices)
    with pytest.raises(ParameterError, match="the operator tufted needs faces"):
        _ = Laplacian(points, operator=TUFTED).stiffness
    monkeypatch.setattr(intrinsic, "library", lambda: None)
    monkeypatch.setattr(intrinsic, "why_plain", lambda: "as it is")
    for ask in (
        lambda: Laplacian(bumpy(20), operator=TUFTED).stiffness,
        lambda: Laplacian(bumpy(20), operator=INTRINSIC).stiffness,
        lambda: PointCloud(bumpy(30).vertices),
    ):
        with pytest.raises(MeshError, match=r"Delaunay triangulations need the compiled kernel \(as it is\)"):
            ask()


SHARED = ROOT.parent / "shared" / "meshes"


@pytest.mark.skipif(not SHARED.is_dir(), reason="the shared meshes are not there")
@pytest.mark.parametrize("operator", OTHERS)
@pytest.mark.parametrize("name", ["suzanne.obj", "teapot.obj"])
def test_shared_meshes_that_are_not_manifold(name, operator):
    (path,) = SHARED.rglob(name)
    laplacian = Laplacian(read_surface(path), operator=operator)
    distance = BiharmonicDistance(laplacian)
    component = laplacian.components[0]
    values, vectors = scipy.linalg.eigh(component.stiffness.toarray(), np.diag(component.areas))
    points = vectors[:, 1:] / values[1:]
    wanted = np.linalg.norm(points - points[0], axis=1)
    found = distance.from_source(int(component.vertices[0]))[component.vertices]
    assert np.abs(found - wanted).max() < 1e-9 * wanted.max()


# ---------------------------------------------------------------------- lengths without positions
def sides_of(surface):
    x = surface.vertices[surface.faces]
    return np.linalg.norm(np.roll(x, -1, axis=1) - np.roll(x, -2, axis=1), axis=2)


@pytest.mark.parametrize("operator", ["cotan", "intrinsic-delaunay"])
@pytest.mark.parametrize("areas", ["voronoi", "barycentric"])
def test_lengths_of_sides_give_the_operators_of_the_surface(operator, areas):
    surface = bumpy(300)
    known = Laplacian(surface, areas, operator)
    found = Laplacian.from_edge_lengths(surface.faces, sides_of(surface), areas, operator)
    scale = abs(known.stiffness).max()
    assert abs(found.stiffness - known.stiffness).max() < 1e-11 * scale
    np.testing.assert_allclose(found.areas, known.areas, rtol=1e-11)
    np.testing.assert_allclose(
        BiharmonicDistance(found).from_source(7), BiharmonicDistance(known).from_source(7), rtol=0, atol=1e-10
    )


SQUARE, SIDES = [[0, 1, 2], [0, 2, 3]], [[1, 1.4, 1], [1, 1, 1.4]]


@pytest.mark.parametrize(
    ("faces", "lengths", "options", "words"),
    [
        (SQUARE, [[1, 1.4, 1], [1, 1, 1.5]], {}, "edge 0, 2 is 1.4 long in a face, and 1.5"),
        (SQUARE, [[1, 1.4, 1], [1, 3, 1.4]], {}, r"the sides of face 1, \[1.0, 3.0, 1.4\], make no triangle"),
        (SQUARE, [[1, 1.4, 1]], {}, "three lengths"),
        ([[0, 1, 2], [0, 2, 4]], SIDES, {}, "vertex 3 belongs to no face"),
        (SQUARE, SIDES, {"operator": "tufted"}, "tufted needs positions"),
        (SQUARE, SIDES, {"areas": "circles"}, "no 'circles' vertex areas"),
    ],
)
def test_lengths_that_do_not_fit_are_named(faces, lengths, options, words):
    with pytest.raises(ParameterError, match=words):
        Laplacian.from_edge_lengths(faces, lengths, **options)
