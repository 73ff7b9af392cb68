"""What a page holds of a surface, and what its solver makes of it in node, held to the library."""

import json
import shutil
import subprocess
from base64 import b64encode

import numpy as np
import pytest
import scipy.linalg

from app.web.html_file import packed_contents, whole_scene
from app.web.modules import VIEWER
from app.web.stored_functions import stored_functions
from app.web.stored_mesh import StoredMesh, varints
from app.web.stored_values import StoredField, StoredPoints
from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    DiffusionDistance,
    ParameterError,
    PointCloud,
    PowerDistance,
    Surface,
    TetrahedralMesh,
)
from bihdist_core.distances.distance_types import Spec
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.distances.spectral import TruncatedBiharmonicDistance
from bihdist_core.laplacian import Laplacian
from bihdist_core.tetrahedra import boundary_of
from tests.core.test_tetrahedra import ball
from tests.shapes import bumpy, fin, grid, slivers, sphere, tetrahedron, torus, two_pieces
from tests.waiting import PATIENCE


def scaled(surface: Surface, by: float) -> Surface:
    return Surface(surface.vertices * by + by, surface.faces, surface.name)


def with_near_vertices() -> Surface:
    """A sphere with three faces around a point, much smaller than all others."""
    s = sphere(300)
    x, faces = [*s.vertices], [tuple(f) for f in s.faces]
    for _ in range(11):
        a, b, c = faces[0]
        i = len(x)
        x.append(x[a] + 0.3 * (x[b] - x[a]) + 0.3 * (x[c] - x[a]))
        faces[0] = (a, b, i)
        faces += [(b, c, i), (c, a, i)]
        x[i] = x[a] + 0.3 * (x[b] - x[a]) + 0.3 * (x[c] - x[a])
    return Surface(np.array(x), faces, "with near vertices")


SURFACES = {
    "closed": bumpy(400), "boundary": grid(9, 7), "genus 1": torus(), "four vertices": tetrahedron(),
    "pieces": two_pieces(), "not manifold": fin(), "small": scaled(bumpy(200), 1e-7), "large": scaled(bumpy(200), 1e7),
    "near vertices": with_near_vertices(),
}  # fmt: skip


def two_clouds() -> PointCloud:
    x = bumpy(300).vertices
    return PointCloud(np.concatenate([x[:100] + 50, x, x[:3]]), "two clouds")


WITH_MATRICES = {
    "points": lambda: Laplacian(PointCloud(bumpy(400).vertices)), "pieces": lambda: Laplacian(two_clouds()),
    "solid": lambda: Laplacian(TetrahedralMesh(*ball(300))), "tufted": lambda: Laplacian(fin(), operator="tufted"),
    "intrinsic": lambda: Laplacian(bumpy(300), "barycentric", "intrinsic-delaunay"),
    "small": lambda: Laplacian(PointCloud(1e-7 * bumpy(300).vertices)),
}  # fmt: skip


@pytest.fixture(scope="module", params=WITH_MATRICES)
def with_matrices(request):
    """A Laplacian that does not follow from faces, and what a page holds of it."""
    laplacian = WITH_MATRICES[request.param]()
    return laplacian, StoredMesh.of(boundary_of(laplacian.surface), laplacian=laplacian)


def said(mesh: StoredMesh, sources, names, points=None, areas="voronoi", given=None, functions=None):
    """What the page's solver answers in node."""
    if not shutil.which("node"):
        pytest.skip("there is no node")
    packed = packed_contents(mesh, points or {}, given or {})
    question = {
        "contents": {name: b64encode(content).decode() for name, content in packed.items()},
        "scene": whole_scene({"areas": areas, **(functions or {})}, mesh, given or {}),
        "sources": [int(v) for v in sources], "names": names,
    }  # fmt: skip
    script = VIEWER.parents[2] / "tests/web/solver.mjs"
    run = subprocess.run(
        ["node", script, VIEWER], input=json.dumps(question), capture_output=True, text=True, timeout=PATIENCE
    )
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


def field(values) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values], float)


def worst(found: np.ndarray, expected: np.ndarray) -> float:
    assert (np.isnan(found) == np.isnan(expected)).all()
    return float(np.nanmax(np.abs(found - expected)) / np.nanmax(expected))


def some_of(surface: Surface) -> list[int]:
    """The pinned vertex of the first component, the last vertex, and two more."""
    n = len(surface.vertices)
    return [0, n - 1, n // 3, n // 2]


# ---------------------------------------------------------------------- what is held
@pytest.mark.parametrize("precision", ["24", "float32"])
@pytest.mark.parametrize("name", SURFACES)
def test_a_page_unpacks_what_was_packed(name, precision):
    mesh = StoredMesh.of(SURFACES[name], precision)
    unpacked, stored = said(mesh, [0], [])["mesh"], mesh.surface
    assert (np.reshape(unpacked["positions"], (-1, 3)) == stored.vertices).all()
    assert (np.reshape(unpacked["faces"], (-1, 3)) == stored.faces).all()
    assert unpacked["ids"] == mesh.ids.tolist()
    assert unpacked["components"] == mesh.first_vertices.tolist()
    assert unpacked["faceComponents"] == mesh.first_faces.tolist()


@pytest.mark.parametrize(("precision", "share"), [("24", 2**-25), ("float32", 2**-24)])
@pytest.mark.parametrize("name", SURFACES)
def test_the_stored_surface_is_the_surface_but_for_rounding(name, precision, share):
    surface = SURFACES[name]
    mesh = StoredMesh.of(surface, precision)
    moved = np.abs(mesh.surface.vertices - surface.vertices[mesh.ids]).max()
    size = np.abs(surface.vertices).max() if precision == "float32" else np.ptp(surface.vertices, axis=0).max()
    assert moved <= 1.001 * share * size

    def of_any_side(faces):
        return sorted(map(tuple, np.sort(faces, axis=1).tolist()))

    assert of_any_side(mesh.ids[mesh.surface.faces]) == of_any_side(surface.faces)
    label = surface.component_of_vertex[mesh.ids]
    assert (np.diff(label) >= 0).all()
    assert label.min() == 0


def test_faces_turn_counterclockwise_outside_and_insides_are_known():
    ball = sphere(200)
    for faces in (ball.faces, ball.faces[:, ::-1]):
        whole = StoredMesh.of(Surface(ball.vertices, faces))
        assert not whole.has_backs
        open_one = StoredMesh.of(Surface(ball.vertices, faces[5:]))
        assert open_one.has_backs
        for mesh in (whole, open_one):
            a, b, c = (mesh.surface.vertices[mesh.surface.faces[:, k]] for k in range(3))
            assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a) > 0).all()
    assert not StoredMesh.of(grid(5, 5)).has_backs


def test_vertices_without_faces_are_left_out():
    assert 60 not in StoredMesh.of(two_pieces()).ids


def test_matrices_and_normals_are_unpacked_as_they_were_packed(with_matrices):
    laplacian, mesh = with_matrices
    unpacked, stored = said(mesh, [0], [])["mesh"], mesh.matrices
    assert (np.reshape(unpacked["positions"], (-1, 3)) == mesh.surface.vertices).all()
    assert (unpacked["start"], unpacked["index"]) == (stored.start.tolist(), stored.index.tolist())
    assert unpacked["weights"] == stored.weights.values.tolist()
    assert unpacked["areas"] == stored.areas.values.tolist()
    original = laplacian.stiffness[mesh.ids][:, mesh.ids]
    assert abs(stored.stiffness - original).max() < 1e-6 * abs(original).max()
    if isinstance(laplacian.surface, PointCloud):
        normals = 127 * laplacian.surface.normals[mesh.ids]
        assert np.abs(np.reshape(unpacked["normals"], (-1, 3)) - normals).max() <= 0.5


def test_an_unknown_precision_is_refused():
    with pytest.raises(ParameterError, match="24, float32, not '16'"):
        StoredMesh.of(tetrahedron(), "16")


def test_varints_have_seven_bits_a_byte():
    assert varints(np.array([0, -1, 1, 63, 64, -8192])) == bytes([0, 1, 2, 126, 128, 1, 255, 127])


# ---------------------------------------------------------------------- what it answers
@pytest.mark.parametrize("areas", ["voronoi", "barycentric"])
@pytest.mark.parametrize("name", SURFACES)
def test_the_solver_of_a_page_equals_the_library(name, areas):
    mesh = StoredMesh.of(SURFACES[name])
    laplacian, geodesic = Laplacian(mesh.surface, areas), ExactGeodesic(mesh.surface)
    biharmonic, commute_time = BiharmonicDistance(laplacian), CommuteTimeDistance(laplacian)
    sources = some_of(mesh.surface)
    found = said(mesh, sources, ["biharmonic", "commute_time", "geodesic"], areas=areas)["answers"]
    for source, fields in zip(sources, found, strict=True):
        assert worst(field(fields["biharmonic"]), biharmonic.from_source(source)) < 1e-9
        assert worst(field(fields["commute_time"]), commute_time.from_source(source)) < 1e-10
        assert worst(field(fields["geodesic"]), geodesic.distances(source)) < 1e-13


def test_the_solver_of_a_page_with_matrices_equals_the_library(with_matrices):
    """On what is stored to rounding, and on the original to that of single precision."""
    laplacian, mesh = with_matrices
    stored, sources = mesh.laplacian(laplacian.areas_kind), some_of(mesh.surface)
    found = said(mesh, sources, ["biharmonic", "commute_time"])["answers"]
    for name, kind in (("biharmonic", BiharmonicDistance), ("commute_time", CommuteTimeDistance)):
        on_page, original = kind(stored), kind(laplacian)
        for source, fields in zip(sources, found, strict=True):
            assert worst(field(fields[name]), on_page.from_source(source)) < 1e-9
            assert worst(field(fields[name]), original.from_source(int(mesh.ids[source]))[mesh.ids]) < 1e-6


def test_small_distances_have_as_many_digits():
    mesh = StoredMesh.of(with_near_vertices(), "float32")
    source = int(np.flatnonzero(mesh.ids == 310)[0])
    expected = BiharmonicDistance(mesh.surface).from_source(source)
    found = field(said(mesh, [source], ["biharmonic"])["answers"][0]["biharmonic"])
    others = np.delete(np.arange(len(expected)), source)
    assert expected[others].min() < 1e-5 * expected.max()
    assert np.abs(found[others] / expected[others] - 1).max() < 1e-6


def test_flat_faces_count_as_in_the_library_but_geodesics_are_refused():
    mesh = StoredMesh.of(slivers(), "float32")
    assert len(mesh.surface.degenerate_faces)
    laplacian = Laplacian(mesh.surface)
    found = said(mesh, [5], ["biharmonic"])["answers"][0]["biharmonic"]
    assert worst(field(found), BiharmonicDistance(laplacian).from_source(5)) < 1e-9
    assert "without flat faces" in said(mesh, [5], ["geodesic"])["answers"][0]["error"]


def test_the_latest_question_comes_first():
    found = said(StoredMesh.of(bumpy(200)), [1, 2, 3, 4, 5], ["biharmonic"])
    assert found["dropped"] == 3
    assert found["said"] == ["Ordering the vertices", "Factoring"]


@pytest.mark.parametrize("name", ["closed", "pieces"])
def test_points_have_the_distances_of_the_library_to_their_error(name):
    mesh = StoredMesh.of(SURFACES[name])
    distance = TruncatedBiharmonicDistance(mesh.surface, 20)
    points, sources = StoredPoints.of(distance), some_of(mesh.surface)
    for source, fields in zip(sources, said(mesh, sources, ["a"], {"a": points})["answers"], strict=True):
        expected = distance.from_source(source)
        off = worst(field(fields["a"]), expected) * np.nanmax(expected)
        assert off < 1.01 * points.error < 1e-3 * np.nanmax(expected)


def dense(laplacian: Laplacian, weight, source: int) -> np.ndarray:
    """Distances with the weights of all eigenpairs; weight(x, first) has them for eigenvalues x."""
    component = next(each for each in laplacian.components if source in each.vertices)
    values, vectors = scipy.linalg.eigh(component.stiffness.toarray(), np.diag(component.areas))
    points = vectors[:, 1:] * np.sqrt(weight(values[1:], values[1]))
    found = np.full(len(laplacian.areas), np.nan)
    found[component.vertices] = np.linalg.norm(points - points[component.vertices == source], axis=1)
    return found


WEIGHTS = {
    # A step that poles for one time serve, one between two, times of one's own beyond the slider, and the ends of it.
    **{
        f"diffusion@{t}": lambda x, first, t=t: np.exp(-t * x / first)
        for t in (1.0, 0.3, 1 / 15, 4.0, 0.016, 9.0, 0.01)
    },
    # All poles, those of whole powers, and none.
    **{f"power@{alpha}": lambda x, _, alpha=alpha: x**-alpha for alpha in (1.05, 1.5, 2.5, 3.0, 2.0)},
}


@pytest.mark.parametrize("name", [name for name in SURFACES if name != "near vertices"])
def test_steps_of_a_slider_are_sums_of_all_eigenpairs(name):
    """The rational functions are off by less than 1e-10 and 1e-8; at t = 9 near vertices have few digits left."""
    mesh = StoredMesh.of(SURFACES[name])
    laplacian, sources = Laplacian(mesh.surface), some_of(mesh.surface)
    specs = [Spec.of("diffusion", t=t) for t in (1 / 15, 9.0, 0.01)]
    found = said(mesh, sources, list(WEIGHTS), functions=stored_functions(laplacian, specs, laplacian))
    for source, fields in zip(sources, found["answers"], strict=True):
        for step, weight in WEIGHTS.items():
            off = worst(field(fields[step]), dense(laplacian, weight, source))
            assert off < (5e-8 if step.startswith(("power", "diffusion@9")) else 1e-9), step
    # Three workers have factors of theirs.
    assert sum(text.startswith("Ordering the vertices, ") for text in found["said"]) >= 3


def test_steps_of_a_slider_are_sums_of_all_eigenpairs_with_matrices_too(with_matrices):
    mesh = with_matrices[1]
    laplacian, sources, steps = mesh.laplacian("voronoi"), some_of(mesh.surface)[1:], ["diffusion@0.3", "power@1.5"]
    for source, fields in zip(
        sources,
        said(mesh, sources, steps, functions=stored_functions(laplacian, [], laplacian))["answers"],
        strict=True,
    ):
        for step in steps:
            assert worst(field(fields[step]), dense(laplacian, WEIGHTS[step], source)) < 5e-8


def test_units_of_sliders_are_those_of_the_library():
    solid = Laplacian(TetrahedralMesh(*ball(300)))
    functions = stored_functions(solid, [], solid)["functions"]
    for distance, value in ((DiffusionDistance(solid, 1.0), 1.0), (PowerDistance(solid, 1.5), 1.5)):
        steps = functions[type(distance).__name__.removesuffix("Distance").lower()]["steps"]
        assert next(each["unit"] for each in steps if each["value"] == value) == distance.unit


@pytest.mark.parametrize("areas", ["voronoi", "barycentric"])
def test_steps_of_a_slider_are_right_where_vertices_have_no_area(areas):
    mesh = StoredMesh.of(slivers(), "float32")
    laplacian = Laplacian(mesh.surface, areas)
    (found,) = said(
        mesh, [5], ["diffusion@0.3", "power@1.5"], areas=areas, functions=stored_functions(laplacian, [], laplacian)
    )["answers"]
    assert worst(field(found["diffusion@0.3"]), DiffusionDistance(laplacian, 0.3).from_source(5)) < 1e-7
    assert worst(field(found["power@1.5"]), PowerDistance(laplacian, 1.5).from_source(5)) < 1e-6


# ---------------------------------------------------------------------- fields of one's own
def values_with(largest: float) -> np.ndarray:
    values = np.sin(np.arange(60.0)) * largest
    values[7], values[9] = np.nan, largest
    return values


@pytest.mark.parametrize("largest", [1.0, 1e-300, 5e-324, 1.7e308, 1e12, 0.0])
def test_a_given_field_comes_out_of_the_solver_as_it_went_in_to_single_precision(largest):
    mesh, values = StoredMesh.of(two_pieces()), values_with(largest)
    values = np.concatenate([values, np.full(len(two_pieces().vertices) - 60, 0.75 * largest)])
    stored = StoredField.of(values, mesh.ids)
    for answer in said(mesh, [0, 5], ["field mine", "biharmonic"], given={"field mine": stored})["answers"]:
        found = field(answer["field mine"])
        np.testing.assert_array_equal(np.isnan(found), np.isnan(values[mesh.ids]))
        assert np.nanmax(np.abs(found - values[mesh.ids])) <= stored.error * largest * (1 + 1e-6)
        assert np.nanmin(field(answer["biharmonic"])) == 0
    assert stored.error <= 2.0**-24


def test_whole_numbers_of_a_given_field_stay_what_they_are():
    mesh = StoredMesh.of(bumpy(200))
    stored = StoredField.of(np.arange(200.0) * 1001, mesh.ids)
    assert stored.error == 0
    (answer,) = said(mesh, [0], ["b", "a"], given={"a": StoredField.of(np.full(200, np.nan), mesh.ids), "b": stored})[
        "answers"
    ]
    np.testing.assert_array_equal(field(answer["b"]), mesh.ids * 1001.0)
    assert np.isnan(field(answer["a"])).all()
