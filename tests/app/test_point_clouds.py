"""Commands on points without faces."""

import json
from pathlib import Path

import numpy as np
import pytest
import pyvista
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy

from app.figures.picture import figure, figure_again
from app.main import main
from app.scene.drawable import copies_of, drawable, faces_of
from app.scene.field_actor import UNDEFINED
from app.scene.prepared import prepare
from app.scene.splats import CORNERS, at_corners
from app.scene.stand_in import stand_in
from app.tools.source.gestures import source_from_strokes
from bihdist_core import BiharmonicDistance, PointCloud, SourceSet, SurfacePoint, read_surface
from tests.shapes import bumpy


@pytest.fixture
def cloud(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    points = bumpy(400).vertices
    np.savetxt("scan.xyz", points, fmt="%.17g")
    return PointCloud(points, "scan.xyz")


def test_field_pairs_and_info(cloud, capsys):
    expected = BiharmonicDistance(cloud).from_sources([3, 40])
    assert main(["field", "scan.xyz", "--sources", "3,40", "-o", "field.npy"]) == 0
    assert np.array_equal(np.load("field.npy"), expected)
    assert main(["pairs", "scan.xyz", "--pairs", "3:40", "-o", "pairs.csv"]) == 0
    assert float(Path("pairs.csv").read_text().split(",")[-1]) == pytest.approx(expected[40, 0])
    capsys.readouterr()
    assert main(["info", "scan.xyz", "--json"]) == 0
    (facts,) = json.loads(capsys.readouterr().out)["meshes"]
    assert (facts["n_vertices"], facts["n_faces"], facts["genus"]) == (400, 0, None)
    assert main(["info", "scan.xyz"]) == 0
    said = capsys.readouterr().out
    assert "points                    400\n" in said
    assert "mean spacing" in said
    assert "genus" not in said


def test_points_are_called_points(cloud, capsys):
    assert main(["field", "scan.xyz", "--sources", "3", "-o", "field.npy"]) == 0
    assert "400 points, 1 source" in capsys.readouterr().out
    assert main(["field", "scan.xyz", "--sources", "400", "-o", "field.npy"]) == 2
    assert "scan.xyz has no point 400" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("command", "reason"),
    [
        ("field scan.xyz --sources 3 --distance geodesic", "geodesic distance needs faces"),
        ("field scan.xyz --sources f1:0.2,0.3", "places in faces need faces"),
        ("field scan.xyz --sources 3 --areas barycentric", "barycentric areas need faces"),
        ("isolines scan.xyz --sources 3 -o lines.csv", "isolines need faces"),
        ("statistics scan.xyz --sources 3", "statistics need faces"),
        ("regions scan.xyz --sources 3,40 -o labels.csv", "regions need faces"),
        ("perturb scan.xyz --noise 0.1 -o noisy.ply", "changes need faces"),
        ("page scan.xyz -o page.html --distance geodesic", "geodesic distance needs faces"),
        ("figure scan.xyz --distance biharmonic --isoline-labels", "labels of isolines need faces"),
    ],
)
@pytest.mark.usefixtures("cloud")
def test_what_needs_faces_is_refused(capsys, command, reason):
    assert main(command.split()) == 2
    assert f"scan.xyz: {reason}" in capsys.readouterr().err


def test_fields_of_points_in_files_of_other_programs(cloud):
    for name in ("field.ply", "field.vtp", "field.vtu", "field.glb", "field.obj"):
        assert main(["field", "scan.xyz", "--sources", "3", "-o", name]) == 0
    assert np.allclose(read_surface("field.ply").vertices, cloud.vertices)
    assert pyvista.read("field.vtp").n_verts == pyvista.read("field.vtu").n_cells == 400
    content = Path("field.glb").read_bytes()
    data = json.loads(content[20 : 20 + int.from_bytes(content[12:16], "little")])
    (primitive,) = data["meshes"][0]["primitives"]
    assert (primitive["mode"], "indices" in primitive) == (0, False)
    assert [each["count"] for each in data["accessors"]] == [400] * len(data["bufferViews"])


# ---------------------------------------------------------------------- pictures
@pytest.fixture(scope="module")
def plane():
    """Points at random in a plane."""
    x = np.random.default_rng(2).random((800, 3))
    return PointCloud(x * [1, 1, 0], "plane")


def test_a_linear_field_goes_on_over_hexagons(plane):
    mesh = drawable(plane)
    x, field = vtk_to_numpy(mesh.GetPoints().GetData()), 2 * plane.vertices[:, 0] - plane.vertices[:, 1]
    assert np.array_equal(copies_of(mesh), np.repeat(np.arange(800), CORNERS))
    inside = ((plane.vertices[:, :2] > 0.15) & (plane.vertices[:, :2] < 0.85)).all(axis=1)
    corners = at_corners(mesh, field, UNDEFINED).reshape(-1, CORNERS)
    there = x[800:].reshape(-1, CORNERS, 3)
    off = np.abs(corners - (2 * there[..., 0] - there[..., 1]))[inside]
    # Corners that are farther than all neighbours have the values of these.
    assert np.median(off) < 1e-12
    assert off.max() < 0.1
    lengths = np.linalg.norm(there - plane.vertices[:, None], axis=2)
    assert np.allclose(lengths, lengths[:, :1])
    assert (np.ptp(there[..., 2], axis=1) < 1e-9).all()


def test_what_is_undefined_leaves_no_trace_beside_it(plane):
    field = np.where(plane.vertices[:, 0] < 0.5, UNDEFINED, 1.0)
    corners = at_corners(drawable(plane), field, UNDEFINED)
    assert np.array_equal(corners, np.repeat(field, CORNERS))


def test_a_large_cloud_moves_as_some_of_its_hexagons(plane):
    mesh = drawable(plane)
    standing = stand_in(mesh, 400)
    assert standing.mesh.GetNumberOfPoints() == 200 * CORNERS
    values = np.arange(800 * (1 + CORNERS), dtype=float)
    assert standing.averaged(values, UNDEFINED)[:7].tolist() == [*values[800:806], values[800 + 4 * CORNERS]]
    area = [len(faces_of(each)) for each in (mesh, standing.mesh)]
    assert area[0] == 4 * area[1]
    assert stand_in(mesh) is None


def test_a_pick_finds_a_point_and_no_place_between(cloud):
    prepared = prepare(cloud)
    assert not prepared.is_flat
    eye = np.array([0.0, 0.0, 10.0])
    face, weights, _ = prepared.picker.blocks.first_hit(eye, -eye)
    assert weights.sum() == pytest.approx(1)
    assert cloud.shape.faces[face].max() < 400


def test_a_stroke_over_points_is_a_set_of_them(cloud):
    (a, b, c), face = cloud.shape.faces[0].tolist(), 0
    stroke = [SurfacePoint(face, weights) for weights in ((1, 0, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1))]
    assert source_from_strokes([stroke], cloud) == SourceSet((a, b, c))
    assert source_from_strokes([stroke[:1]], cloud) == a


@pytest.mark.usefixtures("cloud")
def test_a_figure_has_other_usual_distances_and_isolines(capsys):
    assert main(["figure", "scan.xyz", "--sources", "3", "--json"]) == 0
    panels = json.loads(capsys.readouterr().out)["panels"]
    assert [each["distance"] for each in panels] == ["biharmonic", "commute-time", "diffusion"]
    with Image.open("scan.png") as image:
        first = np.asarray(image)
    assert main(["figure", "--recipe", "scan.json", "-o", "again.png"]) == 0
    with Image.open("again.png") as image:
        assert np.array_equal(np.asarray(image), first)
    colours = first[..., :3].reshape(-1, 3).astype(int)
    assert (colours[:, 2] - colours[:, 0] > 60).mean() > 0.02  # blue near the source
    assert (colours[:, 0] - colours[:, 2] > 60).mean() > 0.02  # red far from it
    # Isolines are white and painted, so another number of them is another picture.
    assert main(["figure", "scan.xyz", "--sources", "3", "--isolines", "0", "-o", "none.png"]) == 0
    with Image.open("none.png") as image:
        assert not np.array_equal(np.asarray(image), first)


def test_points_from_python_are_drawn_and_kept(cloud, tmp_path):
    first = figure(cloud, ["biharmonic"], source=3)
    first.save(str(tmp_path / "cloud.png"))
    again = figure_again(tmp_path / "cloud.json")
    again.save(str(tmp_path / "again.png"))
    with Image.open("cloud.png") as one, Image.open("again.png") as other:
        assert np.array_equal(np.asarray(one), np.asarray(other))
