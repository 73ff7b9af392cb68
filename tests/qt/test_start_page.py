"""The page that is shown while no mesh is open, and what it knows of files opened before."""

import json
import os
from datetime import UTC, datetime, timedelta
from itertools import pairwise

import numpy as np
import pytest
from qtpy import QtWidgets
from qtpy.QtCore import Qt
from qtpy.QtTest import QTest

from app.document.document import Document, comparison
from app.qt.look.look import LOOK
from app.qt.pages.start_places import from_home, vertex_count, when, without_ground
from app.samples import mesh_path, sample_names, sample_title
from tests.shapes import bumpy


@pytest.fixture
def remembered(tmp_path, monkeypatch):
    from app.qt import remembered

    monkeypatch.setattr(remembered, "folder", lambda: tmp_path / "own")
    (tmp_path / "own").mkdir()
    return remembered


@pytest.fixture
def page(application, remembered):
    from app.qt.pages.start_page import StartPage

    page = StartPage()
    LOOK.apply_theme(page)
    page.resize(900, 502)
    page.show()
    application.processEvents()
    yield page
    LOOK.choose("light")
    page.close()
    page.deleteLater()
    application.sendPostedEvents(page, 52)  # QEvent.DeferredDelete
    application.processEvents()


def files_in(folder, count):
    paths = [folder / f"m{k}.off" for k in range(count)]
    for path in paths:
        path.touch()
    return [str(path) for path in paths]


def shown(page):
    return [row for row in page.rows if row.isVisible()]


# ---------------------------------------------------------------------- recent files
def test_recent_files_have_the_time_they_were_opened(remembered, tmp_path):
    first, second = files_in(tmp_path, 2)
    before = datetime.now(UTC)
    for path in (first, second, first):
        remembered.remember(path)
    files = remembered.recent_files()
    assert [file.path for file in files] == remembered.recent() == [first, second]
    assert before <= files[1].opened_at <= files[0].opened_at <= datetime.now(UTC)
    os.unlink(first)
    assert remembered.recent() == [second]


def test_a_list_of_paths_without_times_is_read_and_kept(remembered, tmp_path):
    old, new = files_in(tmp_path, 2)
    (remembered.folder() / "recent.json").write_text(json.dumps([old]))
    assert remembered.recent_files() == [remembered.Recent(old, None)]
    remembered.remember(new)
    assert [file.opened_at is None for file in remembered.recent_files()] == [False, True]


def test_what_is_damaged_in_the_list_is_left_out(remembered, tmp_path):
    path = files_in(tmp_path, 1)[0]
    file = remembered.folder() / "recent.json"
    for text in (b"[1, {", b"\xff\xfe\x00", b"7", b"null", b"[" * 100_000, b""):
        file.write_bytes(text)
        assert remembered.recent_files() == []
    times = [3, None, "soon", "2026-13-01", {}, []]
    damaged = [None, 5, [], {}, {"path": 7}, {"path": "a\0b"}, {"opened": "2026-01-01"}]
    file.write_text(json.dumps([*damaged, *({"path": path, "opened": time} for time in times)]))
    assert [found.path for found in remembered.recent_files()] == [path] * len(times)
    assert [found.opened_at for found in remembered.recent_files()] == [None] * len(times)


def test_a_pipe_in_the_place_of_the_list_is_not_waited_for(remembered, tmp_path):
    file = remembered.folder() / "recent.json"
    file.unlink(missing_ok=True)
    os.mkfifo(file)
    assert remembered.recent_files() == []
    os.mkfifo(remembered.own_state().with_suffix(remembered.SESSION))
    assert remembered.session_of(remembered.own_state()) is None


def test_times_are_said_in_plain_words():
    now = datetime(2026, 11, 22, 0, 30).astimezone()
    assert when(now - timedelta(minutes=10), now) == "today, 00:20"
    assert when(now - timedelta(minutes=40), now) == "yesterday"
    assert when(datetime(2026, 11, 12, 9).astimezone(), now) == "12 Nov"
    assert when(datetime(2025, 11, 9).astimezone(), now) == "9 Nov 2025"
    assert when(None, now) == ""


def test_folders_are_written_from_home(monkeypatch):
    monkeypatch.setenv("HOME", "/home/me")
    monkeypatch.setenv("USERPROFILE", "/home/me")
    assert from_home("/home/me/meshes") == "~/meshes"
    assert from_home("/home/me") == "~"
    assert from_home("/home/meshes") == "/home/meshes"


def test_the_page_lists_them_and_reads_them_anew_when_it_is_shown(page, remembered, application, tmp_path):
    assert not shown(page)
    assert page.nothing.isVisible()
    page.hide()
    paths = files_in(tmp_path, 9)
    for path in paths:
        remembered.remember(path)
    page.show()
    assert [row.path for row in shown(page)] == paths[:4:-1]  # four in a low page
    assert not page.nothing.isVisible()
    page.resize(900, 900)
    assert [row.path for row in shown(page)] == paths[:3:-1]
    assert shown(page)[0].when.startswith("today, ")
    chosen = []
    page.chosen.connect(chosen.append)
    QTest.mouseClick(shown(page)[1], Qt.MouseButton.LeftButton)
    assert chosen == [paths[-2]]


# ---------------------------------------------------------------------- samples
def test_each_sample_has_a_tile_of_equal_size_inside_the_page_at_any_width(page, application):
    tiles = page.tiles.tiles
    assert {tile.path for tile in tiles} == {mesh_path(name) for name in sample_names()}
    page.more.click()
    for width in (640, 900, 1600):
        page.resize(width, 502)
        application.processEvents()
        assert len({(tile.width(), tile.height()) for tile in tiles}) == 1
        assert not page.scroll.horizontalScrollBar().isVisible()
        assert page.scroll.horizontalScrollBar().maximum() == 0
        for tile in tiles:
            assert page.tiles.rect().contains(tile.geometry())
        for one, other in pairwise(tiles):
            assert not one.geometry().intersects(other.geometry())


def test_a_few_samples_are_seen_until_more_are_asked_for(page):
    few = [tile for tile in page.tiles.tiles if tile.isVisible()]
    assert 0 < len(few) < len(sample_names()) / 2
    assert len({tile.y() for tile in few}) == 1
    page.more.click()
    assert all(tile.isVisible() for tile in page.tiles.tiles)
    assert not page.more.isVisible()
    assert page.focusWidget() in page.tiles.tiles


def test_tiles_say_what_the_files_hold(page):
    from bihdist_core import read_surface

    assert sample_title("figure_pose2") == "Figure pose 2"
    tile = next(tile for tile in page.tiles.tiles if tile.sample == "genus3")
    assert tile.title == "Genus 3"
    assert tile.count == f"{len(read_surface(mesh_path('genus3')).vertices):,} vertices"
    assert vertex_count(__file__) == vertex_count("/nowhere.ply") == 0


def test_tab_reaches_samples_and_enter_opens_them(page, application):
    chosen = []
    page.chosen.connect(chosen.append)
    page.more.click()
    page.activateWindow()
    page.zone.open.setFocus()
    QTest.qWaitForWindowActive(page)
    for _ in range(len(page.tiles.tiles)):
        QTest.keyClick(application.focusWidget(), Qt.Key.Key_Tab)
    last = page.tiles.tiles[-1]
    assert application.focusWidget() is last
    # It has been scrolled to where it is seen.
    assert page.scroll.viewport().rect().contains(last.mapTo(page.scroll.viewport(), last.rect().center()))
    focused = last.grab().toImage()
    QTest.keyClick(last, Qt.Key.Key_Return)
    assert chosen == [last.path]
    last.clearFocus()
    assert last.grab().toImage() != focused


def test_only_the_white_ground_of_a_picture_is_seen_through():
    picture = np.full((40, 40, 3), 255, np.uint8)
    picture[8:32, 8:32] = (200, 0, 0)
    picture[8:32, 7] = (228, 128, 128)  # half covered
    picture[20, 8:32] = 255  # an isoline, up to both edges
    picture[24:29, 15:25] = 255  # a hole
    found = without_ground(picture)
    alpha = found[..., 3]
    assert (alpha[:6] == 0).all()
    assert (alpha[25:28, 16:24] == 0).all()
    assert (alpha[20, 12:28] == 255).all()
    assert (found[20, 12:28, :3] == 255).all()
    # Halved opacity, and the full colour.
    assert alpha[12, 7] == pytest.approx(127, abs=2)
    assert found[12, 7].tolist()[:3] == [200, 0, 0]
    inside = np.zeros((40, 40), bool)
    inside[9:19, 9:31] = True
    assert (found[inside] == (200, 0, 0, 255)).all()


def test_no_white_box_is_round_a_sample_in_the_dark(page, application):
    page.resize(900, 1000)
    application.processEvents()
    LOOK.choose("dark")
    image, tile = page.grab().toImage(), page.tiles.tiles[0]
    place = tile.mapTo(page, tile.rect().topLeft())
    inside = [(place.x() + x, place.y() + y) for x in range(tile.width()) for y in range(8, 88)]
    colours = [image.pixelColor(*each) for each in inside]
    assert np.mean([colour.name() == LOOK.theme.canvas.lower() for colour in colours]) > 0.5
    # At most the isolines are white.
    assert np.mean([colour.lightness() > 240 for colour in colours]) < 0.1
    assert max(colour.lightness() for colour in colours) > 100


# ---------------------------------------------------------------------- the rest
def test_links_and_the_button_say_what_is_wanted(page):
    said = []
    page.open_wanted.connect(lambda: said.append("open"))
    page.guide_wanted.connect(lambda: said.append("guide"))
    for button in (page.zone.open, page.guide):
        button.click()
    assert said == ["open", "guide"]


def test_a_refusal_stands_above_the_title_on_a_few_lines(page, application):
    assert not page.message.isVisible()
    text = "<b>broken.off</b> cannot be opened: line 12 says 'abc'. " * 20
    page.scroll.verticalScrollBar().setValue(200)
    page.show_message(text)
    application.processEvents()
    assert page.scroll.verticalScrollBar().value() == 0
    lines = page.message.text().split("\n")
    assert len(lines) == 3
    assert lines[0].startswith("<b>broken.off</b> cannot be opened")
    assert lines[-1].endswith("…")
    width = page.message.contentsRect().width()
    assert all(page.message.fontMetrics().horizontalAdvance(line) <= width for line in lines)
    assert page.message.geometry().bottom() < page.title.geometry().top()
    assert page.message.textInteractionFlags() & Qt.TextInteractionFlag.TextSelectableByMouse
    assert page.message.textFormat() == Qt.TextFormat.PlainText
    page.show_message("Short.")
    assert page.message.text() == "Short."
    page.show_message("")
    assert not page.message.isVisible()


def test_the_place_for_drops_shows_that_a_file_is_over_it(page):
    before, word = page.zone.grab().toImage(), page.zone.word.text()
    page.set_dropping(True)
    assert page.zone.grab().toImage() != before
    assert page.zone.word.text() != word
    page.set_dropping(False)
    assert page.zone.word.text() == word


def test_the_ground_keeps_up_with_the_theme(page):
    for word in ("dark", "light"):
        LOOK.choose(word)
        assert page.grab().toImage().pixelColor(2, 2).name() == LOOK.theme.canvas.lower()


def test_the_first_dialog_begins_at_the_folder_of_the_mesh_on_the_command_line(screen, mesh_file, monkeypatch):
    from app.document.settings import Preferences
    from app.qt.start import beginning_at

    before, mesh = Preferences(last_folder="/before"), mesh_file(bumpy(60))
    monkeypatch.chdir(os.path.dirname(mesh))
    for shown in (mesh, os.path.basename(mesh), comparison(mesh)):
        assert beginning_at(before, shown).last_folder == os.path.dirname(mesh)
    for shown in (comparison(mesh_path("figure")), comparison(""), "gone.off"):
        assert beginning_at(before, shown) == before
    s, began = screen(), []
    s.window.context.preferences = beginning_at(before, mesh)
    monkeypatch.setattr(
        QtWidgets.QFileDialog, "getOpenFileName", lambda parent, title, folder, files: began.append(folder) or ("", "")
    )
    s.window.actions_by_word["open"].trigger()
    assert began == [os.path.dirname(mesh)]


def test_a_window_in_which_nothing_is_opened_has_its_first_page_before_what_draws(application, remembered):
    from app.qt.main_window import MainWindow

    window = MainWindow(Document())
    window.context.quiet, window.context.remembers = True, False
    window.show()
    application.processEvents()
    labels = [label.text() for label in window.centralWidget().findChildren(QtWidgets.QLabel) if label.isVisible()]
    assert [text for text in labels if text] == []
    page = window.show_start()
    application.processEvents()
    assert (page.isVisible(), window.context.is_built) == (True, False)
    window.close()
    window.deleteLater()
