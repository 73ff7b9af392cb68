"""A mesh of which something is cut out, in the window: shown, undone, saved, put back; and two with masks."""

import numpy as np
import pytest
from qtpy import QtWidgets

from app.document.edits import move_source
from app.document.file import read_recipe
from app.document.shared_parts.pins import Pins, add_pins
from app.qt.files.mesh_repairs import MeshRepairs
from app.qt.files.session_actions import SessionFile
from bihdist_core import BiharmonicDistance, Surface
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import Curve, SourceSet, SurfacePoint
from tests.shapes import bumpy

ONE = (Spec.of("biharmonic"),)
BALL = bumpy(300)
KEEPS = BALL.vertices[:, 2] < 0.5
LOW, HIGH = int(BALL.vertices[:, 2].argmin()), int(BALL.vertices[:, 2].argmax())


pytestmark = pytest.mark.usefixtures("own_folder")


@pytest.fixture
def s(shared_screen, tmp_path):
    np.save(tmp_path / "mask.npy", KEEPS)
    return shared_screen(BALL, ONE, LOW)


def cut(s, tmp_path, monkeypatch):
    chosen = str(tmp_path / "mask.npy"), ""
    monkeypatch.setattr(QtWidgets.QFileDialog, "getOpenFileName", lambda *_: chosen)
    s.window.actions_by_word["cut"].trigger()
    s.until(lambda: s.document.surfaces[0].repairs.cut and s.session.is_complete)


def test_a_mask_cuts_and_what_it_cuts_comes_back(s, tmp_path, monkeypatch):
    cut(s, tmp_path, monkeypatch)
    expected = BALL.without(~KEEPS)
    assert s.session.mesh().surface.n_faces == expected.n_faces
    np.testing.assert_allclose(s.answers[0].field, BiharmonicDistance(expected).from_source(LOW), rtol=1e-9)
    assert expected.repairs[0] in s.window.status.notes.sentences
    s.window.actions_by_word["undo"].trigger()
    s.until(lambda: not s.document.surfaces[0].repairs.cut and s.session.is_complete)
    assert s.session.mesh().surface.n_faces == BALL.n_faces
    s.window.actions_by_word["redo"].trigger()
    s.until(lambda: s.document.surfaces[0].repairs.cut and s.session.is_complete)
    s.window.actions_by_word["put back"].trigger()
    s.until(lambda: not s.document.surfaces[0].repairs.cut and s.session.is_complete)
    assert s.session.mesh().surface.n_faces == BALL.n_faces
    assert not s.window.actions_by_word["put back"].isEnabled()


def test_the_largest_component_is_kept_and_the_others_come_back(shared_screen):
    small = bumpy(20, seed=1)
    both = Surface(np.vstack([small.vertices + 9, BALL.vertices]), np.vstack([small.faces, BALL.faces + 20]))
    s = shared_screen(both, ONE, 3)
    action = s.window.actions_by_word["largest"]
    assert action.isEnabled()
    action.trigger()
    s.until(lambda: s.document.surfaces[0].repairs.largest_component and s.session.is_complete)
    np.testing.assert_array_equal(s.session.mesh().surface.faces, BALL.faces + 20)
    assert s.document.sources[0] >= 20  # it was on the other
    assert not action.isEnabled()
    s.window.actions_by_word["put back"].trigger()
    s.until(lambda: not s.document.surfaces[0].repairs.is_any and s.session.is_complete)
    assert s.session.mesh().surface.n_components == 2


def test_a_source_that_goes_starts_anew(s, tmp_path, monkeypatch):
    s.session.show(move_source(s.document, 0, HIGH))
    s.until(lambda: s.session.is_complete)
    cut(s, tmp_path, monkeypatch)
    assert KEEPS[s.document.sources[0]]


def test_a_session_of_a_cut_mesh_opens_again(s, tmp_path, monkeypatch, screen):
    cut(s, tmp_path, monkeypatch)
    path = str(tmp_path / "session.json")
    s.window.context[SessionFile].save(path)
    assert read_recipe(path).document.surfaces[0].repairs.cut_sha256
    other = screen(ONE)
    other.window.context[SessionFile].open(path)
    other.until(lambda: other.session.is_complete and other.document.surfaces)
    assert other.session.mesh().surface.n_faces == BALL.without(~KEEPS).n_faces
    np.testing.assert_array_equal(other.answers[0].field, s.answers[0].field)


@pytest.mark.parametrize(("mask", "said"), [(KEEPS[:-1], "this one has the shape"), (0.5 * KEEPS, "not whole")])
def test_a_mask_that_does_not_fit_is_said(s, tmp_path, mask, said):
    np.save(tmp_path / "other.npy", mask)
    s.window.context[MeshRepairs].cut(str(tmp_path / "other.npy"))
    s.until(lambda: s.refusals)
    assert said in s.refusals[-1]
    assert s.session.mesh().surface.n_faces == BALL.n_faces


def test_another_mask_of_the_same_name_is_read(s, tmp_path, monkeypatch):
    cut(s, tmp_path, monkeypatch)
    np.save(tmp_path / "mask.npy", BALL.vertices[:, 2] < 0.2)
    s.window.context[MeshRepairs].cut(str(tmp_path / "mask.npy"))
    expected = BALL.without(BALL.vertices[:, 2] >= 0.2)
    s.until(lambda: s.session.mesh().surface.n_faces == expected.n_faces and s.session.is_complete)


def test_places_in_faces_and_pins_stay_or_go(s, tmp_path, monkeypatch):
    left = int(np.flatnonzero(KEEPS[BALL.faces].all(axis=1))[-1])
    gone = int(np.flatnonzero(~KEEPS[BALL.faces].all(axis=1))[0])
    weights = (0.2, 0.3, 0.5)
    curve = Curve((SurfacePoint(left, weights), SurfacePoint(left, (0.5, 0.25, 0.25))))
    places = [SurfacePoint(face, weights) for face in (left, gone)]
    document = add_pins(move_source(s.document, 0, SourceSet((LOW, HIGH, curve))), [*places, LOW, HIGH])
    s.session.show(document)
    s.until(lambda: s.session.is_complete)
    cut(s, tmp_path, monkeypatch)
    face = np.flatnonzero((s.session.mesh().surface.faces == BALL.faces[left]).all(axis=1))[0]
    assert [s.document.point(name).at for name in s.document[Pins].points] == [SurfacePoint(face, weights), LOW]
    low, drawn = s.source.members
    assert (low, [place.face for place in drawn.places]) == (LOW, [face, face])


def test_of_two_meshes_the_one_is_cut_that_is_active(s, tmp_path, mesh_file):
    s.session.open_second_mesh(str(mesh_file(bumpy(300, seed=1), "second.off")))
    s.until(lambda: len(s.document.surfaces) == 2 and s.session.is_complete and not s.session.is_opening)
    s.window.grid.activate(s.document.panels[1].id)
    s.window.context[MeshRepairs].cut(str(tmp_path / "mask.npy"))
    s.until(lambda: s.document.surfaces[1].repairs.cut and s.session.is_complete)
    assert not s.document.surfaces[0].repairs.cut
