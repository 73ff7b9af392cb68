"""Files drawn in the background: the window answers meanwhile, what is cancelled leaves nothing, mistakes are said."""

import os
from dataclasses import replace
from functools import partial
from itertools import pairwise

import pytest
from PIL import Image
from qtpy import QtCore, QtTest, QtWidgets

from app.document.document import comparison
from app.document.page import Recipe
from app.figures.movie import Movie, write_movie
from app.qt.files.exports import ExportBadge, Exports
from app.qt.files.figure_actions import export_figure, export_movie
from bihdist_core import OutputError
from bihdist_core.distances.distance_types import Spec
from tests.waiting import PATIENCE

pytestmark = pytest.mark.usefixtures("application")


def movie_dialog(small, frames, size="300x120"):
    dialog = export_movie(small.context)
    dialog.frames.setValue(frames)
    dialog.size.write(size)
    return dialog


def test_a_figure_is_drawn_while_the_window_answers(small, out):
    dialog = export_figure(small.context)
    dialog.size.write("400x300")
    beats = []
    heart = QtCore.QTimer(interval=20)
    heart.timeout.connect(lambda: beats.append(small.exports.running[:]))
    heart.start()
    dialog.export(str(out / "f.png"))
    assert not dialog.isVisible()
    assert not small.chip.isHidden()
    small.until(lambda: small.said)
    assert small.said == ["Saved f.png, and beside it its recipe f.json"]
    assert any(beats)
    assert small.chip.isHidden()
    assert sorted(os.listdir(out)) == ["f.json", "f.png"]
    with Image.open(out / "f.png") as picture:
        assert picture.size == (400, 300)


def test_a_movie_says_how_far_it_is(small, out):
    told, tips = [], []
    small.exports.changed.connect(lambda: told.extend((e.fraction, e.words) for e in small.exports.running))
    small.exports.changed.connect(lambda: tips.append((small.chip.share.text(), small.chip.share.toolTip())))
    movie_dialog(small, 4).export(str(out / "m.gif"))
    small.until(lambda: small.said)
    fractions = {words: fraction for fraction, words in told}
    assert [f"frame {k} of 4" in fractions for k in (1, 2, 3, 4)] == [True] * 4
    assert 0.45 < fractions["frame 3 of 4"] < 0.55
    assert any(text.startswith("Movie ") and f"{out}" in tip and "frame 2 of 4" in tip for text, tip in tips)
    with Image.open(out / "m.gif") as film:
        assert film.n_frames == 4


def test_a_movie_s_fractions_go_evenly_with_its_frames(small, out):
    recipe = Recipe(small.session.document, replace(small.context.page, size="120x100"))
    told = {}

    def note(fraction, words):
        told.setdefault(words, fraction)

    write_movie(Movie(recipe, turn=0, path=(5, 90), frames=10), out / "m.gif", note)
    at = [told[f"frame {k} of 10"] for k in range(1, 11)]
    steps = [later - earlier for earlier, later in pairwise(at)]
    assert max(steps) - min(steps) < 1e-9
    # The rest, before the first frame, is small; the tenth frame still has its own tenth to go.
    assert at[0] <= 0.05
    assert at[-1] + steps[0] == pytest.approx(1)


def test_what_is_cancelled_leaves_nothing(small, out):
    movie_dialog(small, 2000).export(str(out / "long.gif"))
    small.until(lambda: small.exports.running[0].words.startswith("frame"))
    small.chip.stop.click()
    assert small.chip.share.text() == "Movie, cancelling…"
    assert not small.chip.stop.isEnabled()
    small.until(lambda: not small.exports.running)
    assert os.listdir(out) == []
    assert (small.said, small.refusals) == ([], [])


def test_closing_cancels_and_waits(small, out, monkeypatch):
    monkeypatch.setattr("app.qt.files.exports.PATIENCE", PATIENCE)
    (out / "old.gif").write_bytes(b"as it was")
    for name in ("old.gif", "new.gif"):
        movie_dialog(small, 2000).export(str(out / name))
    jobs = [export.job for export in small.exports.running]
    small.until(lambda: all(export.words.startswith("frame") for export in small.exports.running))
    assert len(os.listdir(out)) == 3  # what was there, and two that are begun
    small.exports.close()
    assert small.exports.running == []
    assert not any(job.is_running for job in jobs)
    assert os.listdir(out) == ["old.gif"]
    assert (out / "old.gif").read_bytes() == b"as it was"


def test_a_drawing_may_outlive_its_window(small, out, monkeypatch):
    monkeypatch.setattr("app.qt.files.exports.PATIENCE", 0.0)
    movie_dialog(small, 2000).export(str(out / "long.gif"))
    (export,) = small.exports.running
    small.until(lambda: export.words.startswith("frame"))
    gone, job = small.exports, export.job
    gone.close()
    assert gone.running == []
    small.exports = Exports(small)
    gone.deleteLater()
    QtTest.QTest.qWait(1)
    job.wait(30)  # its last words reach nobody
    assert not job.is_running
    assert os.listdir(out) == []


def test_one_file_is_not_drawn_twice_at_once(small, out):
    movie_dialog(small, 2000).export(str(out / "m.gif"))
    dialog = movie_dialog(small, 2)
    dialog.export(str(out / ".." / "out" / "m.gif"))
    assert dialog.isVisible()
    assert dialog.refusal.text() == "m.gif is already being drawn; wait for it, cancel it, or choose another name."
    assert len(small.exports.running) == 1
    dialog.export(str(out / "other.gif"))
    assert not dialog.isVisible()
    assert len(small.exports.running) == 2


def test_several_are_one_chip_with_a_menu(small, out):
    for name in ("one & two.gif", "three.gif"):
        movie_dialog(small, 2000).export(str(out / name))
    first, second = small.exports.running
    first.fraction, second.fraction = 0.2, 0.61
    small.exports.changed.emit()
    assert small.chip.share.text() == "2 exports, 40 %"
    assert small.chip.stop.isHidden()
    assert small.chip.maximumWidth() == 220
    small.chip.open_menu()
    entries = [action for action in small.chip.menu.actions() if action.text()]
    assert [action.text() for action in entries] == [
        "Cancel movie one && two.gif, 20 %",
        "Cancel movie three.gif, 61 %",
        "Cancel all",
    ]
    entries[0].trigger()
    small.until(lambda: small.exports.running == [second])
    assert small.chip.share.text().startswith("Movie ")
    small.chip.open_menu()
    assert [action.text()[:24] for action in small.chip.menu.actions()] == ["Cancel movie three.gif, "]
    small.chip.menu.close()


def test_the_position_makes_room_for_the_words_of_the_chip_and_of_messages(small, out):
    status = small.context.status
    status.insert(chip := ExportBadge(small.exports))
    status.show_surface(small.session.mesh().surface)
    status.show_marks(3, 0)
    status.resize(700, 28)
    status.show()
    small.until(lambda: status.place.isVisible())
    movie_dialog(small, 2000).export(str(out / "m.gif"))
    small.until(lambda: not status.place.isVisible())
    small.until(lambda: chip.share.width() >= chip.share.sizeHint().width())
    small.exports.close()
    small.until(lambda: status.place.isVisible())
    status.say("The list of pins is on the clipboard")
    small.until(lambda: not status.place.isVisible())
    small.until(lambda: status.message.fitting == status.message.text)
    status.close()


def test_the_bar_of_the_chip_stays_where_it_is(small, out):
    movie_dialog(small, 2000).export(str(out / "m.gif"))
    widths = set()
    for fraction in (0.0, 0.04, 0.4, 0.99):
        small.exports.running[0].fraction = fraction
        small.exports.changed.emit()
        widths.add(small.chip.sizeHint().width())
    assert len(widths) == 1


def test_the_chip_stays_within_a_narrow_window(small, out):
    movie_dialog(small, 2000).export(str(out / "m.gif"))
    before = small.minimumSizeHint().width()
    small.resize(640, 200)
    small.until(lambda: small.chip.width() > 0)
    assert small.width() == 640
    assert small.chip.geometry().right() < 640
    small.exports.close()
    assert before <= 640


def test_the_chip_grows_with_the_letters_and_ends_with_its_window(small, out):
    from app.qt.look.look import LOOK

    movie_dialog(small, 2000).export(str(out / "m.gif"))
    LOOK.apply_theme(small)
    other = ExportBadge(small.exports)
    before = small.chip.share.sizeHint().width()
    try:
        LOOK.enlarge(1.35)
        assert before < small.chip.share.sizeHint().width()
        assert small.chip.width() <= 220
        other.deleteLater()
        QtTest.QTest.qWait(1)
        LOOK.enlarge(1.2)  # what is gone is not asked to change
    finally:
        LOOK.enlarge(1.0)


def test_a_work_that_fails_says_why(small, out):
    failures = []
    small.exports.failed.connect(failures.append)
    recipe = Recipe(comparison(str(out / "none.off"), (Spec.of("biharmonic"),), (0,)))
    movie = Movie(recipe)
    export = small.exports.start(partial(write_movie, movie, str(out / "m.gif")), str(out / "m.gif"), "Movie")
    own = []
    export.failed.connect(own.append)
    small.until(lambda: failures)
    assert "none.off" in failures[0]
    assert own == failures
    assert small.exports.running == []


def test_where_no_process_starts_it_is_said(small, out, monkeypatch):
    monkeypatch.setattr("sys.executable", str(out / "no-python"))
    with pytest.raises(OutputError, match=r"m\.gif cannot be drawn in the background"):
        small.exports.start(print, str(out / "m.gif"), "Movie")
    assert small.exports.running == []


def test_frames_of_a_swing_are_written_by_number(small, out):
    dialog = movie_dialog(small, 2)
    dialog.swing.click()
    assert dialog.turn.value() == 90
    dialog.kinds.choose("PNG")
    dialog.export(str(out / "one.png"))
    assert "put %04d where frames have their numbers" in dialog.refusal.text()
    dialog.export(str(out / "swing-%04d.png"))
    small.until(lambda: small.said)
    assert sorted(os.listdir(out)) == ["swing-0001.png", "swing-0002.png"]


def test_a_wrong_box_is_marked_and_says_why_under_it(small, out):
    dialog = movie_dialog(small, 2, size="wide")
    dialog.choose_path()
    sentence = dialog.form.errors[dialog.size.width_box]
    assert "'wide' is not a number of pixels" in sentence.text()
    assert sentence.isVisible()
    assert dialog.size.width_box.property("wrong")
    dialog.size.write("8px")
    dialog.choose_path()
    assert "16 to 32000 pixels" in sentence.text()
    dialog.size.write("")
    for wrong, words in [
        ("5,here", "not a list of vertex ids"),
        ("5,200", "No vertex 200 here: 0 to 199"),
        ("5", "two vertices"),
    ]:
        dialog.path_text.setText(wrong)
        dialog.choose_path()
        assert sentence.isHidden()
        assert words in dialog.form.errors[dialog.path_text].text()
    dialog.path_text.setText("")
    dialog.sweep_text.setText("t=4..1")
    dialog.choose_path()
    assert dialog.form.errors[dialog.sweep_text].text() == "t is not a parameter of biharmonic."
    dialog.sweep_text.setText("")
    dialog.turn.setValue(0)
    dialog.choose_path()
    assert "Nothing would move" in dialog.form.errors[dialog.turn].text()
    assert not dialog.path_text.property("wrong")
    dialog.turn.setValue(90)
    dialog.export(str(out / "no" / "m.gif"))
    assert "no folder" in dialog.refusal.text()
    assert dialog.isVisible()
    assert small.exports.running == []
    dialog.close()


def test_the_path_is_asked_for_in_the_format_that_is_chosen(small, out):
    small.exports.folder = str(out)
    dialog = export_figure(small.context)
    dialog.kinds.choose("PDF")
    dialog.save.click()
    files = dialog.findChild(QtWidgets.QFileDialog)
    assert os.path.basename(files.selectedFiles()[0]) == "mesh-figure.pdf"
    assert files.directory().absolutePath() == str(out)
    files.selectFile("other")
    files.accept()
    small.until(lambda: small.said)
    assert (out / "other.pdf").read_bytes().startswith(b"%PDF")


def test_a_size_has_a_name_or_is_one_s_own(small):
    dialog = export_figure(small.context)
    size = dialog.size
    assert size.name() == "Default"
    next(row for row in size.rows.buttons() if row.text() == "Two columns").click()
    assert dialog.chosen().page.size == "double"
    assert (size.width_box.text(), size.unit.currentText()) == ("178", "mm")
    for text in ("160x80mm", "640x480px@200", "90mm@600"):
        size.write(text)
        assert size.name() == "Custom"
        assert dialog.chosen().page.size == text
    for text, name in (("85mm", "One column"), ("1920×1080@288", "Slide"), ("", "Default"), ("slide", "Slide")):
        size.write(text)
        assert size.name() == name
    size.width_box.setFocus()
    QtTest.QTest.keyClicks(size.width_box, "0")
    assert size.name() == "Custom"
    assert dialog.chosen().page.size == "19200x1080px@288"
    size.width_box.clear()
    dialog.choose_path()
    assert "A height needs a width" in dialog.form.errors[size.width_box].text()
    dialog.close()


def test_every_letter_of_the_export_dialog_has_one_key(small):
    dialog = export_figure(small.context)
    kinds = (QtWidgets.QLabel, QtWidgets.QAbstractButton)
    named = [each.text() for kind in kinds for each in dialog.findChildren(kind) if each.isVisibleTo(dialog)]
    keys = [words[words.index("&") + 1].lower() for words in named if "&" in words]
    assert len(keys) > 10
    assert sorted(set(keys)) == sorted(keys)
    dialog.close()


def test_the_boxes_of_a_dialog_start_in_one_column(small):
    for dialog in (export_figure(small.context), export_movie(small.context)):
        QtTest.QTest.qWait(1)
        labels = [each for each in dialog.findChildren(QtWidgets.QLabel) if each.buddy() and each.isVisibleTo(dialog)]
        assert len(labels) > 4
        assert len({each.width() for each in labels}) == 1, {each.text(): each.width() for each in labels}
        dialog.close()


def test_every_box_has_a_name_and_a_tip(small):
    for dialog in (export_figure(small.context), export_movie(small.context)):
        boxes = [
            box
            for kind in (QtWidgets.QAbstractButton, QtWidgets.QComboBox, QtWidgets.QSpinBox)
            for box in dialog.findChildren(kind)
            if box.isVisibleTo(dialog)
        ]
        boxes += [box for box in dialog.findChildren(QtWidgets.QLineEdit) if box.parent() is dialog.scroll.widget()]
        assert len(boxes) > 10
        assert [box for box in boxes if not box.toolTip()] == []
        named = [box for box in boxes if box.accessibleName() or getattr(box, "text", str)()]
        assert len(named) == len(boxes)
        dialog.close()
