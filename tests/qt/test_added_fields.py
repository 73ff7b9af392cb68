"""Fields of files in the window: by the menu, a drop and a choice; kept by sessions, and refused in a sentence."""

from dataclasses import replace

import numpy as np
import pytest
from qtpy import QtCore, QtWidgets

from app.document.quantities import OwnField
from app.drawing.shapes import Text
from app.qt.pages.messages import Which
from bihdist_core import read_surface
from tests.qt.parts import parts
from tests.qt.test_other_meshes import drop
from tests.shapes import bumpy


@pytest.fixture
def shown(screen, mesh_file, tmp_path):
    """A window with a mesh, and a file of its vertices' heights."""
    mesh, s = mesh_file(bumpy(300)), screen()
    heights = read_surface(mesh).vertices[:, 1]
    np.save(tmp_path / "height.npy", heights)
    s.open(mesh, 5)
    return s, tmp_path, heights


def added(s, count):
    s.until(lambda: (len(s.document.panels) == count and s.session.is_complete) or s.refusals)
    assert not s.refusals
    return s.answers[-1]


def annotation(path, z):
    nibabel = pytest.importorskip("nibabel")
    colours = np.array([(200, 30, 20, 0), (20, 20, 20, 0)])
    nibabel.freesurfer.write_annot(path, np.where(z > 0, 1, 0), colours, ["low & back", "high"], fill_ctab=True)
    return path


def test_the_menu_adds_a_field_which_undo_removes(shown, monkeypatch):
    s, folder, heights = shown
    path = str(folder / "height.npy")
    monkeypatch.setattr(QtWidgets.QFileDialog, "getOpenFileName", lambda *_: (path, ""))
    s.window.context.actions["add field"].trigger()
    answer = added(s, 4)
    np.testing.assert_array_equal(answer.field, heights)
    assert (answer.label, answer.is_signed) == ("height", True)
    assert s.window.status.message.text == "Added height from height.npy"
    assert [each.path for each in s.document.fields] == [path]
    # What a distance can do, it can: here, to be subtracted.
    menu = s.panels[0].head._choices
    s.session.show(
        replace(
            s.document,
            panels=(
                replace(s.document.panels[0], shows=menu.difference(s.document.panels[0].shows, OwnField("height"))),
                *s.document.panels[1:],
            ),
        )
    )
    s.until(lambda: s.session.is_complete)
    assert s.answers[0].label == "biharmonic, exact − height"
    s.session.undo()
    s.session.undo()
    s.until(lambda: s.session.is_complete)
    assert (len(s.document.panels), s.document.fields) == (3, ())
    s.session.redo()
    assert added(s, 4).label == "height"


def test_a_dropped_file_of_several_arrays_is_a_choice(shown, monkeypatch):
    s, folder, heights = shown
    np.savez(folder / "all.npz", a=heights, few=np.ones(7), b=-heights, c=np.full(300, np.nan))
    asked = []

    def ask(dialog):
        rows = (dialog.list.item(k) for k in range(dialog.list.count()))
        asked.append([(row.text(), row.data(QtCore.Qt.ItemDataRole.UserRole)) for row in rows])
        dialog.deleteLater()
        return answers.pop(0)

    monkeypatch.setattr(Which, "ask", ask)
    answers = [None, 1]
    drop(s, folder / "all.npz")
    s.until(lambda: len(asked) == 1)
    assert not s.document.fields
    drop(s, folder / "all.npz")
    np.testing.assert_array_equal(added(s, 4).field, -heights)
    assert [name for name, _ in asked[1]] == ["a", "b", "c"]
    assert [about.count(" to ") for _, about in asked[1]] == [1, 1, 0]
    assert asked[1][2][1] == "no values"
    (field,) = s.document.fields
    assert (field.name, field.array) == ("b", "b")


def test_what_does_not_fit_is_refused_in_a_sentence(shown):
    s, folder, _ = shown
    np.save(folder / "few.npy", np.ones(7))
    (folder / "words.csv").write_text("a\n1\nx\n")
    sentences = {
        "few.npy": "few.npy has 7 values, and mesh.off has 300 vertices.",
        "words.csv": "words.csv, line 2: 'x' is not a number.",
    }
    for name, sentence in sentences.items():
        drop(s, folder / name)
        s.until(lambda: s.refusals)
        assert s.refusals.pop() == sentence
    s.session.close_meshes()
    drop(s, folder / "few.npy")
    s.until(lambda: s.refusals)
    assert s.refusals.pop() == (
        "few.npy holds float64 values of shape (7,). Points need real numbers of shape (n, 3); "
        "if these are values at vertices, open their mesh first."
    )


def test_a_session_remembers_the_file_and_its_checksum(shown):
    s, folder, heights = shown
    drop(s, folder / "height.npy")
    added(s, 4)
    session = str(folder / "session.json")
    parts(s.window).session_file.save(session)
    assert '"path": "height.npy"' in (folder / "session.json").read_text()
    s.session.undo()
    parts(s.window).session_file.open(session)
    np.testing.assert_array_equal(added(s, 4).field, heights)
    np.save(folder / "height.npy", heights + 1)
    parts(s.window).session_file.open(session)
    s.until(lambda: s.refusals)
    assert "'height' has changed since its checksum was recorded" in s.refusals.pop()


def test_labels_have_a_legend_in_the_place_of_the_bar(shown):
    s, folder, heights = shown
    drop(s, annotation(folder / "lh.parts.annot", heights))
    answer = added(s, 4)
    panel = s.panels[-1]
    assert answer.field is None
    words = [shape.text for shape in panel.bar.shapes if isinstance(shape, Text)]
    assert words == ["low & back", "high"]
    assert "low &amp; back" in panel.bar.toolTip()
    high = int(heights.argmax())
    assert panel.words_at(high) == "parts: high"
    panel.point_at(high, True)
    assert panel.view.over.pointed.value == "high"
    # Faces have the colour of one label: red or dark, with nothing between them but smooth edges.
    picture = panel.view.shot().astype(int)
    assert (picture[..., 0] - picture[..., 1] > 60).sum() > 1000
    drop(s, folder / "height.npy")
    added(s, 5)
    assert not any(isinstance(shape, Text) and shape.text == "high" for shape in s.panels[-1].bar.shapes)


def test_a_legend_counts_what_has_no_room(shown, monkeypatch):
    nibabel = pytest.importorskip("nibabel")
    s, folder, _ = shown
    colours, names = np.array([(k, 9, 9, 0) for k in range(60)]), [f"a part with number {k}" for k in range(60)]
    nibabel.freesurfer.write_annot(folder / "lh.many.annot", np.arange(300) % 60, colours, names, fill_ctab=True)
    drop(s, folder / "lh.many.annot")
    added(s, 4)
    bar = s.panels[-1].bar
    words = [shape.text for shape in bar.shapes if isinstance(shape, Text)]
    assert words[:-1] == names[: len(words) - 1]
    assert words[-1] == f"{60 - len(words) + 1} more"
    right = max(shape.x for shape in bar.shapes if isinstance(shape, Text))
    assert right < bar.width()
    assert bar.toolTip().count("■") == 60
