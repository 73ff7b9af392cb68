"""Tetrahedra in commands and sessions: distances run through them, and the boundary is what is seen."""

import numpy as np
import pytest
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (mappers are of it)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from app.document.document import usual_specs
from app.figures.picture import figure, figure_again
from app.scene.clipping import INWARDS, ClipPlane, cut_through
from app.scene.drawable import drawable
from app.scene.field_actor import UNDEFINED, FieldActor
from app.scene.picking import Picker
from app.scene.style import STYLES
from bihdist_core import BiharmonicDistance, Surface, TetrahedralMesh
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.distances.distance_types import Spec
from bihdist_core.formats.field_output import write_fields
from tests.commands import ran, refused
from tests.core.test_tetrahedra import ball
from tests.shapes import bumpy


@pytest.fixture(scope="module")
def solid():
    return TetrahedralMesh(*ball(300), "ball.vtu")


@pytest.fixture
def path(solid, tmp_path):
    write_fields(tmp_path / "ball.vtu", solid, {"x": solid.vertices[:, 0]})
    return str(tmp_path / "ball.vtu")


def test_fields_are_written_with_the_tetrahedra(solid, path, tmp_path, capsys):
    ran(capsys, "field", path, "--sources", "250", "-o", tmp_path / "a.csv")
    found = np.loadtxt(tmp_path / "a.csv", delimiter=",", skiprows=1)[:, 1]
    assert np.array_equal(found, BiharmonicDistance(solid).from_source(250))
    ran(capsys, "field", path, "--sources", "250", "-o", tmp_path / "a.vtu")
    assert (tmp_path / "a.vtu").stat().st_size > solid.tetrahedra.nbytes


def test_info_counts_tetrahedra_and_their_volume(solid, path, capsys):
    said = ran(capsys, "info", path).out
    for words, value in [("tetrahedra", f"{len(solid.tetrahedra):,}"), ("volume", f"{solid.volume:.6g}")]:
        assert f"{words:<25} {value}\n" in said
    assert "points" not in said


def test_a_session_shows_the_boundary_with_distances_through_the_solid(desk, solid, path):
    d = desk([Spec.of("biharmonic"), Spec.of("geodesic")])
    session = d.loaded(path, source=5)
    assert session.loaded().surface.n_faces == solid.shape.n_faces
    field = BiharmonicDistance(solid).from_source(5)
    np.testing.assert_allclose(d.answers[0].field, field, rtol=0, atol=1e-12)
    assert d.answers[0].unit == "mesh units^0.5"
    assert "geodesic distance needs faces" in d.answers[1].failure


def test_files_of_tetrahedra_are_opened_without_geodesic_distance():
    assert [spec.word for spec in usual_specs("ball.mesh")] == ["biharmonic", "commute-time", "diffusion"]


def test_a_figure_of_a_solid_from_python_is_drawn_again_from_its_archive(solid, tmp_path):
    drawn = figure(solid, source=5, layout={"size": "300x150"})
    assert [answer.label.partition(",")[0] for answer in drawn.answers] == ["biharmonic", "commute-time", "diffusion"]
    drawn.save(tmp_path / "ball.png")
    again = figure_again(tmp_path / "ball.json")
    assert np.array_equal(again.answers[0].field, drawn.answers[0].field)
    assert np.array_equal(again.pixels, drawn.pixels)


def test_sources_of_pictures_are_on_the_boundary(solid, path, tmp_path, capsys):
    within = np.setdiff1d(np.arange(len(solid.vertices)), solid.shape.faces)[0]
    said = refused(capsys, "figure", path, "--sources", str(within), "-o", tmp_path / "a.png")
    assert f"vertex {within} is inside, and pictures take sources on the boundary only" in said


def test_a_solid_is_not_warned_of_what_matters_on_surfaces_alone():
    x = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0.001], [0, -1, 1], [9, 9, 9]]
    both = TetrahedralMesh(x, [[0, 1, 2, 3], [0, 3, 5, 4]], "two")  # with an edge of four faces
    notes = surface_notes(both.shape)
    assert (notes.facts, notes.warnings) == (("the boundary of 2 tetrahedra",), ())
    assert surface_notes(Surface(both.shape.vertices, both.shape.faces)).warnings


def test_a_batch_measures_solids_and_says_that_they_have_no_areas(solid, path, tmp_path, capsys):
    words = ["batch", path, "--do", "fields", "--sources", "250", "--workers", "1", "-o"]
    ran(capsys, *words, tmp_path / "out")
    (found,) = (tmp_path / "out").glob("*.npy")
    np.testing.assert_allclose(np.load(found).ravel(), BiharmonicDistance(solid).from_source(250), rtol=1e-6)
    said = ran(capsys, *words, tmp_path / "scaled", "--normalise", "area", status=1).err
    assert "areas scaled to 1 need faces" in said


def test_what_needs_a_surface_is_refused(path, tmp_path, capsys):
    assert "changes need faces" in refused(capsys, "perturb", path, "--noise", "1", "-o", tmp_path / "a.ply")


# ---------------------------------------------------------------------- the cut
@pytest.fixture(scope="module")
def cut(solid):
    return cut_through(solid.shape, ClipPlane((0.6, 0.0, 0.8), 0.1))


def test_a_cut_lies_in_the_plane_and_faces_what_is_cut_away(solid, cut):
    plane = ClipPlane((0.6, 0.0, 0.8), 0.1 - INWARDS * np.ptp(solid.vertices, axis=0).max())
    np.testing.assert_allclose(plane.depths(cut.points), 0, atol=1e-12)
    p, q, r = (cut.points[cut.faces[:, k]] for k in range(3))
    twice = np.cross(q - p, r - p) @ cut.normal
    assert (twice >= 0).all()
    # Of a ball of radius 1, but for what its coarse boundary leaves out.
    assert 0.75 * np.pi < twice.sum() / 2 < np.pi


def test_fields_are_linear_on_the_edges_that_are_cut(solid, cut):
    slope = np.array([0.3, -1.0, 2.0])
    shift = INWARDS * np.ptp(solid.vertices, axis=0).max() * cut.normal
    found = cut.at_points(solid.vertices @ slope, UNDEFINED)
    np.testing.assert_allclose(found, (cut.points + shift) @ slope, atol=1e-12)
    assert (cut.at_points(np.full(300, UNDEFINED), UNDEFINED) == UNDEFINED).all()


def test_only_solids_are_closed_where_they_are_cut(solid):
    plane = ClipPlane((1.0, 0.0, 0.0), 0.0)
    assert cut_through(solid.shape, None) is None
    assert cut_through(bumpy(100), plane) is None


def test_an_actor_shows_the_field_on_the_cut_until_there_is_none(solid, cut):
    actor = FieldActor(STYLES["paper"])
    actor.show_surface(drawable(solid.shape))
    before = actor.actor.GetMapper().GetInput().GetNumberOfPolys()
    field = solid.vertices[:, 2] + 2
    actor.show_field(field, 4.0)
    actor.show_cut(cut)
    mesh = actor.actor.GetMapper().GetInput()
    values = vtk_to_numpy(mesh.GetPointData().GetArray("distance"))
    assert mesh.GetNumberOfPolys() == before + len(cut.faces)
    np.testing.assert_allclose(values[-len(cut.points) :], cut.at_points(field / 4, UNDEFINED), atol=1e-6)
    actor.show_field(field, 8.0)
    np.testing.assert_allclose(values[-len(cut.points) :], cut.at_points(field / 8, UNDEFINED), atol=1e-6)
    actor.show_cut(None)
    assert actor.actor.GetMapper().GetInput().GetNumberOfPolys() == before


def test_what_is_behind_the_cut_is_neither_picked_nor_seen(solid):
    plane, window, renderer = ClipPlane((1.0, 0.0, 0.0), 0.2), vtkRenderWindow(), vtkRenderer()
    window.SetSize(200, 200)
    window.AddRenderer(renderer)
    renderer.GetActiveCamera().SetPosition(5, 0, 0)
    renderer.ResetCameraClippingRange(-1, 1, -1, 1, -1, 1)
    picker, far = Picker(solid.shape), solid.vertices[solid.vertices[:, 0].argmin()]
    assert picker.pick(renderer, 100, 100).position[0] > 0.2
    assert picker.pick(renderer, 100, 100, plane) is None
    assert not picker.sees(renderer, far, plane)
    other = ClipPlane((-1.0, 0.0, 0.0), 0.2)
    assert picker.pick(renderer, 100, 100, other).position[0] > 0.2
