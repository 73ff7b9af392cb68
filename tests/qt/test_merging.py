"""Vertices of a mesh that is open merged in the window: asked, counted, undone, and their table written."""

import os
from dataclasses import replace

import numpy as np
import pytest
from qtpy import QtCore, QtTest

from app.document.document import Inset
from app.document.edits import move_source
from app.document.runs import ids_of
from app.document.shared_parts.pins import Pins, add_pins
from app.document.shared_parts.selections import Selections, select
from app.qt.files.mesh_repairs import MergeDialog, MeshRepairs, usual_tolerance
from bihdist_core import BiharmonicDistance
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import SurfacePoint
from tests.core.test_merging import torn
from tests.shapes import bumpy

ONE = (Spec.of("biharmonic"),)
TORN = torn(bumpy(120))
WHOLE, IDS = TORN.merged(1e-6)


pytestmark = pytest.mark.usefixtures("own_folder")


@pytest.fixture
def s(shared_screen):
    return shared_screen(TORN, ONE)


def asked(s):
    """The dialog, once it has counted."""
    s.window.actions_by_word["merge"].trigger()
    (dialog,) = s.window.findChildren(MergeDialog)
    counted(s, dialog)
    return dialog


def counted(s, dialog):
    s.until(lambda: not dialog._soon.isActive() and dialog.count.text() != "Counting…")
    return dialog.count.text()


def typed(s, dialog, text):
    dialog.box.selectAll()
    QtTest.QTest.keyClicks(dialog.box, text)
    return counted(s, dialog)


def merged(s):
    s.until(lambda: s.document.surfaces[0].repairs.merge is not None and s.session.is_complete)


def test_a_soup_becomes_a_surface_and_a_soup_again(s, tmp_path):
    dialog = asked(s)
    assert dialog.tolerance == usual_tolerance(np.linalg.norm(np.ptp(TORN.vertices, axis=0)))
    gone = TORN.n_vertices - WHOLE.n_vertices
    assert dialog.count.text() == f"{gone:,} of {TORN.n_vertices:,} vertices would be removed, and no face."
    QtTest.QTest.keyClick(dialog.box, QtCore.Qt.Key_Return)
    merged(s)
    assert s.window.status.message.text.startswith(f"{gone:,} vertices merged, {WHOLE.n_vertices} left; ")
    assert (s.session.mesh().surface.n_vertices, s.session.mesh().surface.n_components) == (WHOLE.n_vertices, 1)
    assert s.source == IDS[5]
    np.testing.assert_allclose(s.answers[0].field, BiharmonicDistance(WHOLE).from_source(IDS[5]), rtol=1e-9)
    assert WHOLE.facts[0].partition(" within")[0] in "\n".join(s.window.status.notes.sentences)
    s.window.context[MeshRepairs].save_ids(str(tmp_path / "ids.csv"))
    s.until(lambda: (tmp_path / "ids.csv").exists())
    found = np.loadtxt(tmp_path / "ids.csv", int, delimiter=",", skiprows=1)
    np.testing.assert_array_equal(found, np.stack([np.arange(len(IDS)), IDS], 1))
    s.window.actions_by_word["undo"].trigger()
    s.until(lambda: s.document.surfaces[0].repairs.merge is None and s.session.is_complete)
    assert (s.session.mesh().surface.n_vertices, s.source) == (TORN.n_vertices, 5)


def test_the_dialog_says_what_a_tolerance_would_do(s):
    dialog = asked(s)
    assert "vertices would be removed, with " in typed(s, dialog, "0.3")
    assert dialog.merge.isEnabled()
    assert typed(s, dialog, "100") == "No face would be left with a tolerance of 100."
    assert not dialog.merge.isEnabled()
    assert typed(s, dialog, "far") == "'far' is not a length of 0 or more."
    assert not dialog.merge.isEnabled()
    dialog.accept()
    assert dialog.isVisible()
    assert typed(s, dialog, "0").startswith(f"{TORN.n_vertices - WHOLE.n_vertices:,} of ")
    dialog.reject()
    s.settle()
    assert s.document.surfaces[0].repairs.merge is None


def test_where_nothing_is_near_the_dialog_says_how_far(s, mesh_file):
    s.open(mesh_file(bumpy(60), "whole.off"))
    dialog = asked(s)
    apart = np.linalg.norm(bumpy(60).vertices[:, None] - bumpy(60).vertices, axis=2) + 9 * np.eye(60)
    assert dialog.count.text() == f"No two vertices are that close; the closest are {apart.min():.4f} apart."
    assert not dialog.merge.isEnabled()


def test_a_second_tolerance_starts_from_the_file_and_the_first(s):
    s.window.context[MeshRepairs].merge("A", 0.3)
    merged(s)
    dialog = asked(s)
    assert dialog.box.text() == "0.3"
    typed(s, dialog, "1e-6")
    dialog.accept()
    s.until(lambda: s.document.surfaces[0].repairs.merge == 1e-6 and s.session.is_complete)
    assert s.session.mesh().surface.n_vertices == WHOLE.n_vertices
    s.window.actions_by_word["put back"].trigger()
    s.until(lambda: s.document.surfaces[0].repairs.merge is None and s.session.is_complete)
    assert s.session.mesh().surface.n_vertices == TORN.n_vertices


def test_all_that_names_vertices_follows_and_comes_back(s):
    place = SurfacePoint(7, (0.2, 0.3, 0.5))
    document = add_pins(move_source(s.document, 0, 11), [40, place])
    document = replace(select(document, "some", np.arange(9)), insets=(Inset(13),))
    s.session.show(document)
    s.until(lambda: s.session.is_complete)
    s.window.context[MeshRepairs].merge("A", 1e-6)
    merged(s)
    at = [s.document.point(name).at for name in s.document[Pins].points]
    assert (s.source, at[0], s.document.insets[0].vertex) == (IDS[11], IDS[40], IDS[13])
    assert at[1].face == 7
    (some,) = s.document[Selections].selections
    assert ids_of(some.runs).tolist() == np.unique(IDS[:9]).tolist()
    s.window.actions_by_word["put back"].trigger()
    s.until(lambda: s.document.surfaces[0].repairs.merge is None and s.session.is_complete)
    assert TORN.vertices[s.source].tolist() == TORN.vertices[11].tolist()


def test_without_a_merge_there_is_no_table(s):
    actions = s.window.actions_by_word
    assert not actions["save ids"].isEnabled()
    assert not actions["put back"].isEnabled()
    s.window.context[MeshRepairs].save_ids()
    assert s.window.status.message.text == "No vertices of this mesh have been merged."
    s.window.context[MeshRepairs].put_back()
    assert s.window.status.message.text == "This mesh has not been cut or merged."
    s.window.context[MeshRepairs].merge("A", 0.0)
    merged(s)
    assert actions["save ids"].isEnabled()
    assert actions["put back"].isEnabled()


def test_a_changed_copy_is_named_by_ids_that_a_merge_would_change(s):
    from app.tools.robustness.perturbed_documents import perturb_mesh
    from bihdist_core.applications.changes import Perturbation

    s.session.apply(lambda document: perturb_mesh(document, Perturbation(noise=0.1)))
    s.until(lambda: len(s.document.surfaces) == 2 and s.session.is_complete)
    s.window.actions_by_word["merge"].trigger()
    assert s.refusals[-1].startswith("mesh.off has a perturbed copy")
    assert not s.window.findChildren(MergeDialog)


def test_a_mesh_that_is_gone_is_said_in_the_dialog(s, mesh_file):
    s.open(mesh_file(TORN, "torn.off"), 5)
    s.window.context[MeshRepairs].merge("A", 0.0)
    merged(s)
    path = s.document.surfaces[0].path
    os.unlink(path)
    dialog = asked(s)
    assert dialog.count.text().startswith(f"The mesh {path} is not there.")
    assert not dialog.merge.isEnabled()
