"""Tetrahedra in commands and sessions: distances run through them, and the boundary is what is seen."""

import numpy as np
import pytest

from app.document.document import usual_specs
from bihdist_core import BiharmonicDistance, TetrahedralMesh
from bihdist_core.distances.distance_types import Spec
from bihdist_core.formats.field_output import write_fields
from tests.commands import ran, refused
from tests.core.test_tetrahedra import ball


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


def test_what_needs_a_surface_is_refused(path, tmp_path, capsys):
    assert "changes need faces" in refused(capsys, "perturb", path, "--noise", "1", "-o", tmp_path / "a.ply")
