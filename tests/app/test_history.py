"""Steps through documents whose meshes are still being read, or come too late, or never."""

import gc
import time
import weakref
from dataclasses import replace

import numpy as np

from app.document.document import comparison, content
from app.document.edits import move_source
from app.document.history import History
from app.document.shared_parts.selections import select
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy, grid

BIHARMONIC, COMMUTE = Spec.of("biharmonic"), Spec.of("commute-time")


# ---------------------------------------------------------------------- history
def test_many_steps_are_kept_and_no_more(monkeypatch):
    monkeypatch.setattr("app.document.history.LONGEST", 5)
    document = comparison("mesh.off", [BIHARMONIC])
    history = History(document)
    for vertex in range(8):
        history.change(move_source(document, 0, vertex))
    back = [history.undo().point("source").at for _ in range(7)]
    assert back == [6, 5, 4, 3, 2, 2, 2]


def selected(document, count):
    """With so many selected vertices, no two beside each other, which takes about 150 bytes for each."""
    return select(document, "painted", 2 * np.arange(count))


def steps_back(history):
    count = 0
    while history.can_undo:
        history.undo()
        count += 1
    return count


def test_large_steps_are_kept_up_to_so_many_bytes(monkeypatch):
    monkeypatch.setattr("app.document.history.MOST_BYTES", 1_000_000)
    document = comparison("mesh.off", [BIHARMONIC])
    history = History(document)
    for count in range(1_000, 1_020):
        history.change(selected(document, count))
    kept, discarded = steps_back(history), history.discarded
    assert 1_000_000 / 300_000 < kept < 1_000_000 / 75_000
    assert kept + discarded == 20
    while history.can_redo:
        history.redo()
    assert steps_back(history) == kept
    assert history.discarded == discarded


def test_what_steps_share_counts_once(monkeypatch):
    monkeypatch.setattr("app.document.history.MOST_BYTES", 1_000_000)
    history = History(selected(comparison("mesh.off", [BIHARMONIC]), 2_000))
    for vertex in range(50):
        history.change(move_source(history.present, 0, vertex))
    assert history.discarded == 0
    assert steps_back(history) == 50


def test_what_the_oldest_step_shares_with_later_ones_counts_after_it_is_discarded(monkeypatch):
    monkeypatch.setattr("app.document.history.MOST_BYTES", 1_000_000)
    history = History(selected(comparison("mesh.off", [BIHARMONIC]), 4_000))
    for count in range(500, 550):
        history.change(select(history.present, "other", 2 * np.arange(count)))
    # The selection that all share leaves room for about five others; 13 would fit without it.
    assert steps_back(history) < 9


def test_the_last_step_is_kept_however_large(monkeypatch):
    monkeypatch.setattr("app.document.history.MOST_BYTES", 1_000)
    history = History(comparison("mesh.off", [BIHARMONIC]))
    for count in (100, 200, 300):
        history.change(selected(history.present, count))
    assert steps_back(history) == 1


def test_a_file_that_holds_what_is_shown_already_leaves_nothing_behind():
    first = comparison("mesh.off", [BIHARMONIC])
    history = History(first)
    edited = move_source(first, 0, 1)
    history.change(edited)
    history.change(edited, is_opened=True)
    assert history.closed == []


def test_the_memory_of_a_mesh_that_is_forgotten_is_given_back(desk, mesh_file, monkeypatch):
    monkeypatch.setattr("app.session.surfaces.SPARED", 0)
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60), "first.off"))
    laplacian = weakref.ref(session.mesh().distances("voronoi").laplacian)
    gc.disable()
    try:
        for name in ("second.off", "third.off"):
            d.show(mesh_file(grid(3, 3), name))
            d.until(lambda name=name: session.is_complete and session.mesh().surface.name == name)
        d.until(lambda: laplacian() is None, 60)
    finally:
        gc.enable()


def test_small_meshes_that_are_no_longer_shown_are_kept_in_small_numbers(desk, mesh_file, monkeypatch):
    monkeypatch.setattr("app.session.surfaces.SPARED", 35_000)
    d = desk([BIHARMONIC])
    for k in range(6):
        path = mesh_file(grid(3, 3 + k), f"{k}.off")
        d.show(path)
        d.until(lambda path=path: d.session.is_complete and d.session.document.surfaces[0].path == path)
    assert [loaded.surface.name for loaded in d.session._surfaces] == ["2.off", "3.off", "4.off", "5.off"]


def test_what_comes_back_by_undo_is_there_at_once(desk, mesh_file):
    d = desk()
    session = d.loaded(mesh_file(bumpy(200)), source=1)
    first = d.answers
    d.click(2)
    d.complete()
    session.undo()
    assert session.is_complete
    assert all(now is then for now, then in zip(d.answers, first, strict=True))
    session.redo()
    assert session.is_complete
    assert d.sources_shown == [2, 2, 2]
    session.redo()
    assert d.source == 2


def test_undo_brings_back_the_mesh_before(desk, mesh_file):
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60)), source=5)
    before = session.document
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.mesh().surface.name == "other.off" and session.is_complete)
    session.undo()
    d.complete()
    assert session.document == before
    assert len(d.answers[0].field) == 60


def test_undo_to_a_mesh_that_is_gone_is_refused_and_nothing_changes(desk, mesh_file, tmp_path, monkeypatch):
    monkeypatch.setattr("app.session.surfaces.SPARED", 0)
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60)), source=5)
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.mesh().surface.name == "other.off" and session.is_complete)
    before = session.document
    (tmp_path / "mesh.off").unlink()
    session.undo()
    d.until_told("is not there")
    assert session.document == before
    assert session.history.can_undo


def test_steps_taken_while_a_mesh_is_read_count(desk, mesh_file, monkeypatch):
    monkeypatch.setattr("app.session.surfaces.SPARED", 0)
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60)), source=5)
    first = session.document
    d.click(9)
    second = session.document
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.mesh().surface.name == "other.off" and session.is_complete)
    third = session.document
    session.undo()
    session.undo()
    session.undo()  # there is no third
    d.until(lambda: session.document == first and session.is_complete)
    assert not session.history.can_undo
    session.redo()
    session.redo()
    d.until(lambda: session.document == third and session.is_complete)
    # Back at once: the mesh that was asked for is not read.
    session.undo()
    session.redo()
    assert session.document == third
    session.undo()
    d.until(lambda: session.document == second and session.is_complete)
    session.redo()
    d.click(11)  # takes the step's place
    d.complete()
    assert (session.mesh().surface.name, d.source) == ("mesh.off", 11)
    assert not session.history.can_redo


def test_a_step_back_on_its_way_counts_no_more_once_something_was_done(desk, mesh_file, monkeypatch):
    monkeypatch.setattr("app.session.surfaces.SPARED", 0)
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60)), source=5)
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.mesh().surface.name == "other.off" and session.is_complete)
    session.undo()
    assert (session.can_undo, session.can_redo) == (False, True)
    d.click(9)
    assert (session.can_undo, session.can_redo) == (True, False)
    session.undo()
    d.complete()
    assert (session.mesh().surface.name, d.source) == ("other.off", 7)


def test_of_two_documents_from_files_the_later_is_shown_though_its_mesh_is_there(desk, mesh_file):
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60)), source=5)
    other = comparison(mesh_file(bumpy(5000), "other.off"), (BIHARMONIC,), (7,))
    arrived = []
    session.show_instead(other, lambda: None, lambda: arrived.append("other"))
    session.show_instead(replace(session.document, isolines=3), lambda: None, lambda: arrived.append("same"))
    d.complete()
    time.sleep(0.3)
    d.until(lambda: d.posted.empty())
    assert (arrived, session.mesh().surface.name, session.document.isolines.count) == (["same"], "mesh.off", 3)


def test_a_click_while_the_mesh_of_an_undone_step_is_read_takes_its_place(desk, mesh_file, monkeypatch):
    monkeypatch.setattr("app.session.surfaces.SPARED", 0)
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60)), source=5)
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.mesh().surface.name == "other.off" and session.is_complete)
    let_come = d.hold_reading(session.undo)
    d.click(9)
    let_come()
    d.complete()
    assert (session.mesh().surface.name, d.source) == ("other.off", 9)


# ---------------------------------------------------------------------- a mesh that comes too late
def test_a_mesh_that_was_cancelled_is_not_shown_when_it_comes(desk, mesh_file):
    d = desk()
    let_come = d.hold_reading(lambda: d.show(mesh_file(bumpy(60))))
    d.session.cancel()
    let_come()
    assert d.session.loaded() is None
    assert "document" not in d.view.told


def test_of_two_meshes_the_later_is_shown_with_its_own_source(desk, mesh_file):
    d = desk()
    let_come = d.hold_reading(lambda: d.show(mesh_file(bumpy(60)), source=5))
    d.show(mesh_file(grid(3, 3), "other.off"), source=7)
    let_come()
    assert d.session.loaded() is None
    d.complete()
    assert d.session.mesh().surface.name == "other.off"
    assert d.source == 7
    assert d.view.told.count("document") == 1


def test_a_click_while_another_mesh_is_read_does_not_keep_it_away(desk, mesh_file):
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60)), source=5)
    let_come = d.hold_reading(lambda: session.open(mesh_file(grid(3, 3), "other.off"), source=7))
    d.click(9)
    assert d.source == 9
    let_come()
    d.complete()
    assert (session.mesh().surface.name, d.source) == ("other.off", 7)


# ---------------------------------------------------------------------- before there is a mesh
def begin_late(desk, document):
    """A session that begins with a document, and what lets its mesh come."""
    d = desk(document=document)
    return d, d.hold_reading(lambda: d.session.show(document))


def test_what_is_chosen_while_the_first_mesh_is_read_is_shown_with_it(desk, mesh_file):
    d, let_come = begin_late(desk, comparison(mesh_file(bumpy(60)), (BIHARMONIC,), (5,)))
    d.choose(0, COMMUTE)
    d.session.show(replace(d.session.document, isolines=7))
    let_come()
    d.complete()
    assert (d.answers[0].label, d.session.document.isolines.count, d.source) == ("commute-time, exact", 7, 5)
    assert not d.session.history.can_undo


def test_what_is_chosen_while_another_first_mesh_is_read_does_not_keep_it_away(desk, mesh_file):
    d, let_come = begin_late(desk, comparison(mesh_file(bumpy(60)), (BIHARMONIC,), (5,)))
    d.session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.session.show(replace(d.session.document, isolines=7))
    let_come()
    d.complete()
    assert (d.session.mesh().surface.name, d.source, d.session.document.isolines.count) == ("other.off", 7, 7)


def test_what_is_chosen_after_the_first_mesh_failed_is_shown_with_the_next(desk, mesh_file):
    d = desk(document=comparison("gone.off", (BIHARMONIC,)))
    d.session.show(d.session.document)
    d.until_told("gone.off is not there")
    d.choose(0, COMMUTE)
    d.session.open(mesh_file(bumpy(60)))
    d.complete()
    assert d.answers[0].label == "commute-time, exact"
    assert len([words for words in d.view.told if "gone.off" in words]) == 1


# ---------------------------------------------------------------------- rows of equal steps
def test_a_dock_that_moves_during_a_drag_does_not_part_it():
    first = comparison("mesh.off", sources=(3,))
    history = History(first)
    history.change(move_source(first, 0, 4), "drag")
    history.change(replace(history.present, dock_places="moved"))
    history.change(move_source(history.present, 0, 5), "drag")
    assert content(history.undo()) == content(first)
    history.redo()
    # The present itself says that the drag is over.
    history.change(history.present)
    history.change(move_source(history.present, 0, 6), "drag")
    assert history.undo().point("source").at == 5
