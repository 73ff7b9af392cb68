"""Answers on their way: what is slow is worked on beside the rest, what is old is dropped, drags follow."""

import threading
import time
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest

from app.document.document import MeshFile
from app.document.edits import add_panel
from app.document.quantities import DistanceFrom
from app.session import loaded_mesh
from app.session.answering import AnswerCache
from app.session.questions import DistanceQuestion
from bihdist_core import BiharmonicDistance, Cancelled
from bihdist_core.distances import distance_types
from bihdist_core.distances.answers import Answer
from bihdist_core.distances.distance_types import Spec
from bihdist_core.distances.power import PowerDistance
from bihdist_core.formats.mesh_io import surface_in
from tests.shapes import bumpy, grid
from tests.waiting import PATIENCE

BIHARMONIC, COMMUTE = Spec.of("biharmonic"), Spec.of("commute-time")


# ---------------------------------------------------------------------- distances that take their time
class Slow:
    """Makes panels whose distance is built step by step, as the test allows."""

    def __init__(self):
        self.allowed = threading.Semaphore(0)
        self.started = threading.Semaphore(0)
        self.built = self.cancelled = 0

    def panel(self, name="biharmonic"):
        return SlowSpec(name, slow=self)

    def build(self, laplacian, progress):
        self.started.release()
        try:
            while not self.allowed.acquire(timeout=0.01):
                progress(0.5, "slowly")
        except Cancelled:
            self.cancelled += 1
            raise
        self.built += 1
        return BiharmonicDistance(laplacian)


@dataclass(frozen=True)
class SlowSpec(Spec):
    slow: Slow = None

    def build(self, laplacian, progress=None):
        return self.slow.build(laplacian, progress)


@pytest.fixture
def slow_desk(desk, mesh_file):
    """A session whose middle panel is slow, open and with its quick panels answered."""
    slow = Slow()
    d = desk([BIHARMONIC, slow.panel(), COMMUTE])
    d.show(mesh_file(bumpy(200)), 0)
    d.until(lambda: slow.started.acquire(blocking=False))
    d.until(lambda: {0, 2} <= d.session.shown.keys())
    return d, slow


def test_quick_panels_do_not_wait_for_a_slow_one(slow_desk):
    d, _ = slow_desk
    d.click(9)
    d.until(lambda: d.sources_shown[0] == 9 and d.sources_shown[2] == 9)
    assert d.answers[1] is None


def test_a_click_while_a_panel_computes_is_kept_and_the_old_one_dropped(slow_desk):
    d, slow = slow_desk
    for vertex in (4, 5, 6):
        d.click(vertex)
    slow.allowed.release()
    d.complete()
    assert d.sources_shown[1] == 6
    assert d.view.told.count("answer 1") == 1
    assert slow.built == 1  # the work in progress served the last click


def test_choosing_another_distance_stops_the_work_for_the_old_one(slow_desk):
    d, slow = slow_desk
    d.choose(1, COMMUTE)
    d.complete()
    d.until(lambda: slow.cancelled == 1)
    assert slow.built == 0


def test_a_distance_is_built_once_for_two_panels(slow_desk):
    d, slow = slow_desk
    d.session.show(add_panel(d.session.document, DistanceFrom(slow.panel())))
    d.until(lambda: "panel 3" in [t.name for t in threading.enumerate()])
    slow.allowed.release()
    d.complete()
    assert slow.built == 1
    assert np.array_equal(d.answers[1].field, d.answers[3].field)


def test_a_panel_that_waits_for_the_other_builds_the_distance_itself_if_that_is_cancelled(slow_desk):
    d, slow = slow_desk
    d.session.show(add_panel(d.session.document, DistanceFrom(slow.panel())))
    d.choose(1, COMMUTE)
    d.until(lambda: slow.cancelled == 1)
    slow.allowed.release()
    d.complete()
    assert slow.built == 1


def test_progress_is_told_and_cancel_stops_the_work(slow_desk):
    d, slow = slow_desk
    d.until(lambda: d.session.progress.get(1) == (0.45, "slowly"))
    d.session.cancel()
    d.until(lambda: not d.session.progress)
    d.until(lambda: slow.cancelled == 1)
    # The next click asks again.
    d.click(8)
    slow.allowed.release()
    d.complete()


def test_opening_another_mesh_stops_the_work_on_the_old_one(slow_desk, mesh_file):
    d, slow = slow_desk
    d.session.open(mesh_file(grid(4, 4), "grid.off"))
    d.until(lambda: slow.cancelled == 1)
    slow.allowed.release()
    d.complete()
    assert len(d.answers[1].field) == 25


def test_closing_stops_everything(slow_desk):
    d, slow = slow_desk
    d.session.close()
    assert slow.cancelled == 1
    assert not [t for t in threading.enumerate() if t.name.startswith("panel") and t.is_alive()]


def test_an_answer_that_comes_late_is_dropped(desk, mesh_file):
    d = desk([BIHARMONIC])
    d.loaded(mesh_file(bumpy(200)), source=1)
    kept, after = d.post_later()
    d.click(2)
    d.until(lambda: any("_answered" in function.__code__.co_names for function in kept))
    d.post = after
    d.click(3)
    for function in kept:
        function()
    assert d.sources_shown == [1]
    d.complete()
    assert d.sources_shown == [3]
    assert d.view.told.count("answer 0") == 2  # for 1 and 3


def test_an_answer_that_comes_after_a_stop_is_not_shown_until_it_is_asked_again(desk, mesh_file):
    d = desk([BIHARMONIC])
    d.loaded(mesh_file(bumpy(200)), source=1)
    kept, after = d.post_later()
    d.click(2)
    d.until(lambda: any("_answered" in function.__code__.co_names for function in kept))
    d.session.cancel()
    d.post = after
    for function in kept:
        function()
    assert (d.sources_shown, d.session.is_stopped_at(0)) == ([1], True)
    d.session.retry(0)
    d.complete()
    assert (d.sources_shown, d.session.is_stopped) == ([2], False)


# ---------------------------------------------------------------------- what asks nobody
@dataclass(frozen=True)
class DeafSpec(Spec):
    """A distance whose making asks nobody whether to go on, as somebody else's may."""

    slow: Slow = None

    def build(self, laplacian, progress=None):
        self.slow.started.release()
        assert self.slow.allowed.acquire(timeout=PATIENCE)
        return BiharmonicDistance(laplacian)


@pytest.fixture
def deaf_desk(desk, mesh_file):
    slow = Slow()
    d = desk([BIHARMONIC, DeafSpec("biharmonic", slow=slow)])
    d.show(mesh_file(bumpy(200)), 0)
    d.until(lambda: slow.started.acquire(blocking=False))
    yield d
    slow.allowed.release(10)


@pytest.mark.parametrize("stop", [lambda d: d.session.cancel(1), lambda d: d.session.cancel(), lambda d: None])
def test_nobody_waits_behind_what_was_given_up_and_asks_nobody(deaf_desk, stop):
    d = deaf_desk
    stop(d)
    d.until(lambda: 1 not in d.session.progress)
    d.choose(1, COMMUTE)
    d.complete()
    assert [answer.label for answer in d.answers] == ["biharmonic, exact", "commute-time, exact"]


def test_a_file_whose_reading_asks_nobody_does_not_hold_up_the_next(desk, mesh_file, monkeypatch):
    d = desk([BIHARMONIC])
    begun, gate, read = threading.Event(), threading.Event(), loaded_mesh.mesh_content

    def held(path):
        if "long" in path:
            begun.set()
            assert gate.wait(PATIENCE)
        return read(path)

    monkeypatch.setattr(loaded_mesh, "mesh_content", held)
    d.loaded(mesh_file(bumpy(60)))
    d.session.open(mesh_file(bumpy(80), "long.off"))
    assert begun.wait(PATIENCE)
    d.until(lambda: "load" in d.session.progress)
    d.session.cancel()
    d.until(lambda: "load" not in d.session.progress)
    d.session.open(mesh_file(bumpy(100), "next.off"))
    d.until(lambda: len(d.session.mesh().surface.vertices) == 100)
    gate.set()
    d.complete()
    assert len(d.session.mesh().surface.vertices) == 100


def test_the_checksum_is_of_the_bytes_that_were_read(mesh_file, monkeypatch):
    path = Path(mesh_file(bumpy(60)))
    written = sha256(path.read_bytes()).hexdigest()

    def changed_meanwhile(content, name):
        path.write_text("something else")
        return surface_in(content, name)

    monkeypatch.setattr(loaded_mesh, "surface_in", changed_meanwhile)
    loaded = loaded_mesh.open_mesh(MeshFile("A", str(path)))
    assert (len(loaded.surface.vertices), loaded.mesh.sha256) == (60, written)


def test_an_error_nobody_foresaw_is_told(desk, mesh_file, monkeypatch):
    def broken(*_, **__):
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr(Spec, "build", broken)
    d = desk([BIHARMONIC])
    d.loaded(mesh_file(bumpy(200)))
    assert "ZeroDivisionError" in d.answers[0].failure


# ---------------------------------------------------------------------- a drag
def test_in_a_drag_what_was_computed_is_shown_though_the_source_has_moved_on(desk, mesh_file):
    d = desk([BIHARMONIC])
    d.loaded(mesh_file(bumpy(200)), source=1)
    kept, after = d.post_later()
    d.click(2, key="drag", live=True)
    d.until(lambda: any("_answered" in function.__code__.co_names for function in kept))
    d.post = after
    d.click(3, key="drag", live=True)
    for function in kept:
        function()
    assert (d.sources_shown, d.source) == ([2], 3)
    d.complete()
    assert d.sources_shown == [3]
    # Older than what is shown.
    for function in kept:
        function()
    assert d.sources_shown == [3]


def test_a_drag_hands_on_what_it_computes_in_order_and_is_one_step(desk, mesh_file):
    d = desk([BIHARMONIC, Spec.of("diffusion")])
    session = d.loaded(mesh_file(bumpy(3000)), source=0)
    seen = []
    answer_changed = d.view.answer_changed
    d.view.answer_changed = lambda id: (answer_changed(id), seen.append((id, session.shown[id].question.at)))
    for vertex in range(1, 60):
        d.click(vertex, key="drag", live=True)
        time.sleep(0.004)
        while not d.posted.empty():
            d.posted.get()()
    d.session.show(session.document)
    d.complete()
    for panel in (0, 1):
        sources = [source for id, source in seen if id == panel]
        assert sources == sorted(sources)
        assert sources[-1] == 59
    session.undo()
    assert d.source == 0
    assert not session.history.can_undo


def test_in_a_drag_what_gets_stuck_gives_way_to_the_next(desk, mesh_file, monkeypatch):
    d = desk([BIHARMONIC])
    d.loaded(mesh_file(bumpy(200)), source=1)
    d.click(4, key="drag", live=True)
    d.until(lambda: d.sources_shown == [4])
    from_source, asked, is_made = BiharmonicDistance.from_source, [], threading.Event()

    def waiting(distance, source, progress=None):
        asked.append(source)
        while source == 5 and not is_made.wait(0.01):
            progress(0.5, "something is made")
        return from_source(distance, source, progress)

    monkeypatch.setattr(BiharmonicDistance, "from_source", waiting)
    d.click(5, key="drag", live=True)
    d.until(lambda: asked == [5])
    d.click(6, key="drag", live=True)
    d.until(lambda: d.sources_shown == [6])
    d.click(5, key="drag", live=True)
    d.until(lambda: asked[-1] == 5)
    is_made.set()
    d.complete()
    assert d.sources_shown == [5]


def test_while_a_slider_moves_what_was_computed_is_shown_though_it_has_moved_on(desk, mesh_file):
    d = desk([Spec.of("power", alpha=2.5)])
    d.loaded(mesh_file(bumpy(200)), source=1)
    kept, after = d.post_later()
    d.choose(0, Spec.of("power", alpha=2.6), live=True)
    d.until(lambda: any("_answered" in function.__code__.co_names for function in kept))
    d.post = after
    d.choose(0, Spec.of("power", alpha=2.7), live=True)
    for function in kept:
        function()
    assert d.session.shown[0].question.spec["alpha"] == 2.6
    assert not d.session.is_answered(0)
    d.complete()
    for function in kept:  # older than what is shown
        function()
    assert d.session.is_answered(0)


def test_while_a_slider_moves_no_value_waits_for_the_accuracy_of_the_one_before(desk, mesh_file, monkeypatch):
    d = desk([Spec.of("power", alpha=2.5)])
    d.loaded(mesh_file(bumpy(200)), source=1)
    error_estimate, checked = PowerDistance.error_estimate, []

    def waiting(distance, components=None, progress=None, pieces=()):
        checked.append(distance.alpha)
        while distance.alpha == 2.6:
            time.sleep(0.01)
            progress(0.5, "checking")
        return error_estimate(distance, components, progress, pieces)

    monkeypatch.setattr(PowerDistance, "error_estimate", waiting)
    d.choose(0, Spec.of("power", alpha=2.6), live=True)
    d.until(lambda: checked == [2.6])
    d.choose(0, Spec.of("power", alpha=2.7), live=True)
    d.complete()
    assert checked == [2.6, 2.7]


def test_while_a_slider_moves_coarse_fields_follow_and_long_work_waits_until_it_rests(desk, mesh_file, monkeypatch):
    monkeypatch.setattr("app.session.answering.REST", 1000.0)
    d = desk([Spec.of("diffusion", t=4.0)])
    session = d.loaded(mesh_file(bumpy(2000)), source=1)
    build, built = Spec.build, []
    monkeypatch.setattr(Spec, "build", lambda spec, *rest, **how: built.append(spec) or build(spec, *rest, **how))
    for t in (1 / 15, 1 / 20, 1 / 25):
        d.choose(0, Spec.of("diffusion", t=t), live=True)
        d.until(lambda t=t: session.shown[0].question.spec["t"] == t)
        assert session.is_preview(0)
    assert built == []
    session.show(session.document)  # let go
    d.complete()
    assert [spec["t"] for spec in built] == [1 / 25]


def test_in_a_drag_geodesic_panels_are_approximate_until_release(desk, mesh_file, monkeypatch):
    monkeypatch.setattr(distance_types, "FRAME_VERTICES", 0)  # as on a large mesh
    d = desk([Spec.of("geodesic", method="exact")])
    session = d.loaded(mesh_file(bumpy(200)), source=0)
    for vertex in (5, 6, 7):
        d.click(vertex, key="drag", live=True)
        d.until(lambda vertex=vertex: d.sources_shown == [vertex])
        assert d.answers[0].label == "geodesic, approximate"
        assert session.shown[0].is_preview
    session.show(session.document)
    d.complete()
    assert d.answers[0].label == "geodesic, exact"


def test_in_a_drag_small_meshes_show_exact_geodesics(desk, mesh_file):
    d = desk([Spec.of("geodesic")])
    session = d.loaded(mesh_file(bumpy(200)), source=0)
    d.click(5, key="drag", live=True)
    d.until(lambda: d.sources_shown == [5])
    assert d.answers[0].label == "geodesic, exact"
    assert not session.shown[0].is_preview


def test_a_drag_that_comes_back_shows_the_field_it_began_with(desk, mesh_file):
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(200)), source=1)
    kept, after = d.post_later()
    d.click(2, key="drag", live=True)
    d.until(lambda: any("_answered" in function.__code__.co_names for function in kept))
    d.click(1, key="drag", live=True)
    session.show(session.document)
    d.post = after
    for function in kept:
        function()
    assert d.sources_shown == [1]
    assert session.is_complete
    assert not session.history.can_undo


def test_drags_are_steps_of_their_own(desk, mesh_file):
    d = desk([BIHARMONIC])
    session = d.loaded(mesh_file(bumpy(60)), source=0)
    for vertices in ((1, 2, 3), (4, 5)):
        for vertex in vertices:
            d.click(vertex, key="drag", live=True)
        session.show(session.document)
    session.undo()
    assert d.source == 3
    session.undo()
    assert d.source == 0


def test_answers_are_kept_up_to_a_number(monkeypatch):
    monkeypatch.setattr("app.session.answering.MOST", 3)
    kept = AnswerCache()
    asked = [DistanceQuestion(MeshFile("A", ""), "voronoi", BIHARMONIC, vertex) for vertex in range(5)]
    for question in asked:
        kept.put(question, Answer(label="", field=np.zeros(1)))
    assert [kept.get(question) is not None for question in asked] == [False, False, True, True, True]


def test_answers_are_kept_within_a_memory():
    kept = AnswerCache(memory=2500)
    asked = [DistanceQuestion(MeshFile("A", ""), "voronoi", BIHARMONIC, vertex) for vertex in range(4)]
    for question in asked:
        kept.put(question, Answer(label="", field=np.zeros(100)))
        kept.get(asked[0])
    assert [kept.get(question) is not None for question in asked] == [True, False, True, True]
