"""Points without faces: files, Laplacians against dense spectra, and what needs faces."""

import pickle

import numpy as np
import pytest
import pyvista
from scipy.spatial import Delaunay
from scipy.spatial.distance import cdist
from scipy.special import eval_legendre

import bihdist_core as bihdist
from bihdist_core import BihdistError, MeshError, ParameterError, PointCloud, Surface, VertexError, read_surface
from bihdist_core.analysis.first_view import first_look
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.analysis.upright import guess_up
from bihdist_core.surface import vertex_normals
from tests.core.mesh_samples import rows
from tests.shapes import MESHES, bumpy, needs_meshes

CLOSE = 1e-9
POINTS = np.round(np.random.default_rng(3).normal(size=(40, 3)), 3).astype(np.float32).astype(float)


@pytest.fixture(scope="module")
def surface():
    return bumpy(600)


@pytest.fixture(scope="module")
def cloud(surface):
    return PointCloud(surface.vertices, "cloud")


# ---------------------------------------------------------------------- files
def ply(points, faces=""):
    return (
        f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
        + (f"{faces}end_header\n{rows(points)}")
    )


def lzf(content):
    """Bytes as LZF writes them: a run of literals, and what repeats the four bytes before as copies of these."""
    out, at = bytearray(), 0
    while at < len(content):
        same = 0
        while at >= 4 and same < 264 and at + same < len(content) and content[at + same] == content[at + same - 4]:
            same += 1
        if same >= 9:
            out += bytes([7 << 5, same - 9, 3])
            at += same
        elif same >= 3:
            out += bytes([(same - 2) << 5, 3])
            at += same
        else:
            out += bytes([0, content[at]])
            at += 1
    return bytes(out)


def pcd(form, points=POINTS, cut=0):
    """Points among other fields, one of them of three numbers."""
    record = np.zeros(len(points), [("n", "<f4", (3,)), ("x", "<f4"), ("rgb", "<u4"), ("y", "<f8"), ("z", "<f4")])
    for axis, column in zip("xyz", points.T, strict=True):
        record[axis] = column
    head = (
        f"# .PCD v0.7\nVERSION 0.7\nFIELDS n x rgb y z\nSIZE 4 4 4 8 4\nTYPE F F U F F\nCOUNT 3 1 1 1 1\n"
        f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA {form}\n"
    ).encode()
    if form == "ascii":
        return (
            head
            + rows(
                np.column_stack([np.ones((len(points), 3)), points[:, 0], np.ones(len(points)), points[:, 1:]])
            ).encode()
        )
    if form == "binary":
        return head + record.tobytes()[: len(record.tobytes()) - cut]
    whole = b"".join(np.ascontiguousarray(record[name]).tobytes() for name in record.dtype.names)
    packed = lzf(whole)[: -cut or None]
    return head + np.array([len(packed), len(whole)], "<u4").tobytes() + packed


def npy(tmp_path, array):
    np.save(tmp_path / "array.npy", array)
    return (tmp_path / "array.npy").read_bytes()


FILES = {
    "a.ply": ply(POINTS),
    "b.ply": ply(POINTS, "element face 0\nproperty list uchar int vertex_indices\n"),
    "a.xyz": "# x y z intensity\n" + rows(np.column_stack([POINTS, np.ones(len(POINTS))])),
    "b.xyz": rows(POINTS).replace(" ", ", "),
    **{f"{form}.pcd": pcd(form) for form in ("ascii", "binary", "binary_compressed")},
}


@pytest.mark.parametrize("name", FILES)
def test_points_of_files(put, name):
    cloud = read_surface(put(name, FILES[name]))
    assert isinstance(cloud, PointCloud)
    assert cloud.n_faces == 0
    assert np.array_equal(cloud.vertices, POINTS)


def test_points_of_an_array(put, tmp_path):
    assert np.array_equal(read_surface(put("a.npy", npy(tmp_path, POINTS))).vertices, POINTS)
    for wrong in (POINTS[:, :2], POINTS.astype(str), POINTS[0]):
        with pytest.raises(MeshError, match=r"Points need real numbers of shape \(n, 3\)"):
            read_surface(put("b.npy", npy(tmp_path, wrong)))


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("a.xyz", "1 2 3\n1 2\n", "line 2: '1 2' is not a point; each line begins"),
        ("a.xyz", "3\nwater\nO 0 0 0\n", "a number"),
        ("a.pcd", "VERSION 0.7\n", "no line DATA"),
        ("a.pcd", "FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n1 2\n", "without x, y and z"),
        ("a.pcd", pcd("ascii")[:-30], "does not hold as many"),
        ("a.pcd", pcd("binary", cut=1), "holds at most 39"),
        ("a.pcd", pcd("binary_compressed", cut=9), "is damaged"),
        ("a.xyz", "0 0 0\n1 0 0\n0 1 0\n", "has 3 points in different places"),
        ("a.xyz", "".join(f"{k} 0 0\n" for k in range(50)), "may be in a line"),
        ("a.xyz", rows(POINTS) + "inf 0 0\n", "point 40 has the coordinate inf"),
    ],
)
def test_refused_files(put, name, content, reason):
    with pytest.raises(MeshError, match=reason):
        read_surface(put(name, content))


# ---------------------------------------------------------------------- distances
def test_distances_are_those_of_the_dense_spectrum(cloud):
    stiffness, areas = cloud.matrices
    half = np.sqrt(areas)
    values, vectors = np.linalg.eigh(stiffness.toarray() / np.outer(half, half))
    values, vectors = values[1:], vectors[:, 1:] / half[:, None]
    for distance, weights in [
        (bihdist.BiharmonicDistance(cloud), values**-2),
        (bihdist.CommuteTimeDistance(cloud), 1 / values),
        (bihdist.DiffusionDistance(cloud, 0.5), np.exp(-0.5 * values / values[0])),
        (bihdist.TruncatedBiharmonicDistance(cloud, 20), np.where(np.arange(len(values)) < 20, values**-2, 0)),
    ]:
        points = vectors * np.sqrt(weights)
        expected = cdist(points, points[[1, 7, 100]])
        off = np.abs(distance.from_sources([1, 7, 100]) - expected).max() / expected.max()
        assert off <= distance.accuracy
        assert off < CLOSE or not distance.label.endswith("exact"), distance.label
        assert distance.from_source("1+7") == pytest.approx(expected[:, :2].min(axis=1), abs=1e-7 * expected.max())
        assert "mesh units" in distance.unit or distance.unit in ("no unit", "1 / mesh units")


def test_distances_are_near_those_of_the_surface(surface, cloud):
    on_surface, on_points = (bihdist.BiharmonicDistance(each).from_source(3) for each in (surface, cloud))
    assert np.abs(on_surface - on_points).max() < 0.03 * on_surface.max()
    assert cloud.area == pytest.approx(surface.area, rel=0.05)
    assert cloud.mean_edge_length == pytest.approx(surface.mean_edge_length, rel=0.1)


@pytest.mark.parametrize("factor", [1e-20, 1e3, 1e20])
def test_a_larger_cloud_has_larger_distances(cloud, factor):
    large = bihdist.BiharmonicDistance(PointCloud(factor * cloud.vertices)).from_source(3)
    assert large / factor == pytest.approx(bihdist.BiharmonicDistance(cloud).from_source(3), rel=1e-6, abs=1e-9)


def test_points_that_repeat_others_or_have_no_place_keep_ids_and_have_no_distance(cloud):
    x, n = cloud.vertices, len(cloud.vertices)
    more = PointCloud(np.concatenate([x, x[:5], [[np.nan, 0, 0]]]), "more")
    assert more.facts == (
        "1 point without coordinates left out (NaN)",
        "5 points that repeat others left out (NaN)",
    )
    assert surface_notes(more).facts == more.facts
    field = bihdist.BiharmonicDistance(more).from_source(3)
    assert np.array_equal(field[:n], bihdist.BiharmonicDistance(cloud).from_source(3))
    assert np.isnan(field[n:]).all()
    with pytest.raises(VertexError, match=f"point {n} repeats another"):
        more.check_vertex(n)
    whole, ids = more.merged()
    assert whole.n_vertices in (n, n + 1)
    assert ids[n] == ids[0]


def test_two_clouds_are_two_components(cloud):
    both = PointCloud(np.concatenate([cloud.vertices, cloud.vertices[:300] + 50]))
    assert both.n_components == 2
    field = bihdist.BiharmonicDistance(both).from_source(0)
    assert np.isfinite(field[: cloud.n_vertices]).all()
    assert np.isnan(field[cloud.n_vertices :]).all()
    assert both.without(both.component_of_vertex == 1).n_components == 1


def test_neighbours_are_found_in_parts(monkeypatch, cloud):
    monkeypatch.setattr("bihdist_core.point_cloud.TOGETHER", 100)
    stiffness, areas = PointCloud(cloud.vertices).matrices
    assert np.array_equal(stiffness.data, cloud.matrices[0].data)
    assert np.array_equal(areas, cloud.matrices[1])


def test_a_pickle_holds_it_all(cloud):
    again = pickle.loads(pickle.dumps(cloud))
    assert repr(again) == "PointCloud(cloud: 600 points)"
    fields = [bihdist.BiharmonicDistance(each).from_source(3) for each in (cloud, again)]
    assert np.array_equal(*fields)


# ---------------------------------------------------------------------- the Laplacian
def stars(x):
    """The Delaunay triangles about each point in the plane of it and its 30 nearest, and how many stars have each."""
    found = []
    for point, apart in zip(x, cdist(x, x), strict=True):
        near = np.argsort(apart)[:31]
        axes = np.linalg.svd(x[near] - x[near].mean(axis=0))[2][:2]
        triangles = Delaunay((x[near] - point) @ axes.T).simplices
        found.append(np.sort(near[triangles[(triangles == 0).any(axis=1)]], axis=1))
    return np.unique(np.concatenate(found), axis=0, return_counts=True)


@pytest.mark.parametrize("name", ["curved", "flat", "in space"])
def test_the_matrices_are_those_of_the_tufted_covers_of_stars(name, cloud):
    reference, rng = pytest.importorskip("robust_laplacian"), np.random.default_rng(2)
    x = {
        "curved": cloud.vertices, "flat": rng.normal(size=(150, 3)) * (1, 1, 0), "in space": rng.normal(size=(90, 3))
    }[name]  # fmt: skip
    stiffness, areas, (triangles, times) = 0, 0, stars(x)
    for least in (1, 2, 3):
        used, faces = np.unique(triangles[times >= least], return_inverse=True)
        found, masses = reference.mesh_laplacian(x[used], faces.reshape(-1, 3))
        there = np.eye(len(x))[:, used]
        stiffness, areas = stiffness + there @ (found @ there.T) / 3, areas + there @ masses.diagonal() / 3
    matrices = PointCloud(x).matrices
    assert np.abs(matrices[0] - stiffness).max() < CLOSE * np.abs(stiffness).max()
    np.testing.assert_allclose(matrices[1], areas, rtol=CLOSE)


def test_where_stars_agree_and_are_acute_it_is_the_one_of_its_authors():
    reference, x = pytest.importorskip("robust_laplacian"), np.array(pyvista.Icosphere(nsub=3).points, float)
    stiffness, masses = reference.point_cloud_laplacian(x)
    matrices = PointCloud(x).matrices
    assert abs(matrices[0] - stiffness).max() < CLOSE * abs(stiffness).max()
    np.testing.assert_allclose(matrices[1], masses.diagonal(), rtol=CLOSE)


def test_distances_of_random_points_on_a_sphere_are_those_of_the_sphere():
    x = np.random.default_rng(1).normal(size=(1000, 3))
    x /= np.linalg.norm(x, axis=1)[:, None]
    cosine, order = x @ x[7], np.arange(1, 200)[:, None]
    terms = (2 * order + 1) * (1 - eval_legendre(order, cosine)) / (order * (order + 1)) ** 2
    wanted = np.sqrt(terms.sum(axis=0) / (2 * np.pi))
    # Those of their convex hull are 0.008 off; with flips between triangles in one place it would be 0.05.
    assert np.abs(bihdist.BiharmonicDistance(PointCloud(x)).from_source(7) - wanted).mean() < 0.015 * wanted.max()


@pytest.mark.parametrize("shift", [0, 1e6])
def test_grids_have_ties_and_their_own_area(shift):
    x = np.stack(np.meshgrid(np.arange(12.0), np.arange(9.0), [0.0]), axis=-1).reshape(-1, 3)
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    grid = PointCloud(x[np.random.default_rng(1).permutation(len(x))] @ turn + shift)
    assert grid.area == pytest.approx(88, rel=1e-4)
    assert len(grid.shape.faces) == 2 * 88


def test_the_order_of_points_and_their_place_do_not_matter(cloud):
    rng = np.random.default_rng(0)
    order, turn = rng.permutation(cloud.n_vertices), np.linalg.qr(rng.normal(size=(3, 3)))[0]
    other = PointCloud(cloud.vertices[order] @ turn + 100)
    off = other.matrices[0] - cloud.matrices[0][order][:, order]
    assert abs(off).max() < CLOSE * abs(cloud.matrices[0]).max()
    np.testing.assert_allclose(other.matrices[1], cloud.matrices[1][order], rtol=CLOSE)


# ---------------------------------------------------------------------- shape
def test_normals_and_triangles_are_about_those_of_the_surface(surface, cloud):
    along = np.einsum("ij,ij->i", cloud.normals, vertex_normals(surface))
    along *= np.sign(np.median(along))
    assert (along > 0.7).mean() > 0.99
    a, b, c = cloud.vertices[cloud.shape.faces].transpose(1, 0, 2)
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), cloud.normals[cloud.shape.faces].sum(axis=1)) >= 0).all()
    assert np.unique(cloud.shape.faces).size == cloud.n_vertices


@needs_meshes
@pytest.mark.parametrize("name", ["bunny_3k.obj", "camelhead.off", "armadillo_15k.obj"])
def test_scans_are_seen_as_their_meshes_are(name):
    mesh = read_surface(MESHES / name)
    scan = PointCloud(mesh.vertices, name)
    up = guess_up(mesh)
    assert guess_up(scan) == up
    assert first_look(scan, up).view == first_look(mesh, up).view
    outwards = np.einsum("ij,ij->i", scan.normals, vertex_normals(mesh)) > 0
    assert outwards.mean() > 0.9


# ---------------------------------------------------------------------- what needs faces
@pytest.mark.parametrize(
    "ask",
    [
        bihdist.GeodesicDistance,
        lambda cloud: bihdist.BiharmonicDistance(cloud).from_source(bihdist.SurfacePoint(0, (1, 0, 0))),
        lambda cloud: bihdist.BiharmonicDistance(cloud).from_source("loop:0"),
        lambda cloud: bihdist.BiharmonicDistance(bihdist.Laplacian(cloud, areas="barycentric")),
        lambda cloud: bihdist.isolines(cloud, cloud.vertices[:, 0], [0]),
        lambda cloud: bihdist.band(cloud, cloud.vertices[:, 0], 0, 1),
        lambda cloud: bihdist.field_statistics(cloud, cloud.vertices[:, 0]),
        lambda cloud: bihdist.gradient_jumps(cloud, cloud.vertices[:, 0]),
        lambda cloud: bihdist.voronoi_regions(cloud, cloud.vertices),
        lambda cloud: bihdist.cut_out(cloud, [1, 2, 3]),
        lambda cloud: bihdist.noisy(cloud, 0.1),
        lambda cloud: bihdist.with_holes(cloud, 2),
        lambda cloud: bihdist.welded(cloud, 0, 1),
        lambda cloud: bihdist.with_handle(cloud, 0, 1),
        bihdist.GeodesicPaths,
    ],
)
def test_what_needs_faces_says_so(cloud, ask):
    with pytest.raises(ParameterError, match=r"need.* faces, and there are none"):
        ask(cloud)


def test_what_needs_none_is_there(cloud):
    distance = bihdist.BiharmonicDistance(cloud)
    field = distance.from_source(0)
    assert bihdist.extrema(cloud, field).minima.tolist() == [0]
    assert len(bihdist.farthest_points(distance, count=5)) == 5
    assert bihdist.nearest(distance, [0], 3)[0].shape == (1, 3)
    assert isinstance(Surface.of(cloud), PointCloud)


def test_other_formats_without_faces_are_refused(put):
    with pytest.raises(BihdistError, match="no faces"):
        read_surface(put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"))
