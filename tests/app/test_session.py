"""The session without a window: what is asked is answered, what is old is dropped, what fails leaves things alone."""

import subprocess
import threading
import time
from dataclasses import dataclass, replace

import numpy as np
import pytest

from app.document.document import DistanceFrom, MeshFile, comparison, quantity
from app.document.edits import add_panel, remove_panel, show_in
from app.session.kept import KeptAnswers
from app.session.questions import DistanceQuestion
from bihdist_core import BiharmonicDistance, Cancelled, ParameterError, SolverError, Surface
from bihdist_core.distances.answers import Answer
from bihdist_core.distances.kinds import Spec
from tests.shapes import bumpy, grid, two_pieces

BIHARMONIC, COMMUTE = Spec.of("biharmonic"), Spec.of("commute-time")


def choose(d, panel, spec):
    """Another distance in a panel, from the same point."""
    shows = d.session.document.panel(panel).shows
    d.session.show(show_in(d.session.document, panel, replace(shows, spec=spec)))


def test_opening_a_mesh_answers_every_panel(desk, mesh_file):
    surface = bumpy(200)
    d = desk()
    d.opened(mesh_file(surface), source=7)
    assert [answer.label for answer in d.answers] == ["biharmonic, exact", "geodesic, exact", "diffusion, t = 1"]
    expected = BiharmonicDistance(surface).from_source(7)
    assert np.allclose(d.answers[0].field, expected, rtol=1e-9)
    assert d.sources_shown == [7, 7, 7]
    assert all(answer.field[7] == 0 for answer in d.answers)


def test_the_first_source_is_the_highest_vertex_of_the_largest_component(desk, mesh_file):
    surface = two_pieces()
    d = desk()
    d.opened(mesh_file(surface))
    assert d.source == surface.vertices[:60, 1].argmax()


def test_a_click_asks_every_panel_anew(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(bumpy(200)))
    d.click(3)
    assert not session.is_complete
    d.complete()
    assert d.sources_shown == [3, 3, 3]
    # The heat method's answer comes before the exact one.
    assert d.view.told.count("answer 1") == 4


def test_a_bad_vertex_changes_nothing(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(two_pieces()), source=3)
    d.view.failures_are_expected = True
    for vertex, words in [(60, "belongs to no face"), (1000, "no vertex 1000")]:
        d.click(vertex)
        assert words in d.view.told[-1]
    with pytest.raises(ParameterError):
        d.click(-1)
    assert d.source == 3
    assert not session.history.can_undo
    assert session.is_complete


def test_a_file_that_cannot_be_read_leaves_the_session_as_it_was(desk, mesh_file, tmp_path):
    d = desk()
    session = d.opened(mesh_file(bumpy(200)), source=3)
    before = (session.surface, session.document, d.answers)
    bad = tmp_path / "bad.off"
    bad.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n")
    session.open(str(bad))
    d.until_told("bad.off")
    assert (session.surface, session.document) == before[:2]
    assert all(now is then for now, then in zip(d.answers, before[2], strict=True))
    session.open(mesh_file(grid(3, 3), "other.off"), source=99)
    d.until_told("has no vertex 99")
    assert (session.surface, session.document) == before[:2]
    assert not session.history.can_undo


def test_another_mesh_replaces_the_first(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(bumpy(200)))
    session.open(mesh_file(grid(5, 5), "grid.off"), source=0)
    d.until(lambda: session.surface.name == "grid.off" and session.is_complete)
    assert all(len(answer.field) == 36 for answer in d.answers)


def test_a_mesh_that_has_changed_is_read_again_and_not_taken_for_the_old_one(desk, mesh_file):
    d = desk([BIHARMONIC])
    path = mesh_file(bumpy(60))
    session = d.opened(path)
    recorded = session.document
    mesh_file(bumpy(80))
    session.open(path)
    d.until(lambda: session.surface is not None and len(session.surface.vertices) == 80 and session.is_complete)
    session.show(replace(recorded, surfaces=(replace(recorded.mesh(), sha256="0" * 64),)))
    d.until_told("is not what it was")
    assert len(session.surface.vertices) == 80


def test_a_surface_in_memory_is_shown_like_a_file(desk):
    surface = bumpy(60)
    d = desk([BIHARMONIC])
    mesh = d.session.given.add_surface(surface)
    document = comparison("", (BIHARMONIC,), (4,))
    d.session.show(replace(document, surfaces=(mesh,)))
    d.complete()
    assert np.array_equal(d.answers[0].field, BiharmonicDistance(surface).from_source(4))


def test_a_panel_can_show_another_distance(desk, mesh_file):
    d = desk()
    d.opened(mesh_file(bumpy(200)))
    first = d.answers[0]
    choose(d, 2, Spec.of("diffusion", t=0.25))
    choose(d, 1, Spec.of("geodesic", method="dijkstra"))
    d.complete()
    assert d.answers[0] is first
    assert d.answers[1].label == "geodesic, Dijkstra along edges"
    assert d.answers[2].label == "diffusion, t = 0.25"


def test_panels_come_and_go_and_keep_their_ids(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(bumpy(60)), source=2)
    session.show(remove_panel(session.document, 1))
    session.show(add_panel(session.document, DistanceFrom(COMMUTE)))
    d.complete()
    assert [panel.id for panel in session.document.panels] == [0, 2, 3]
    assert set(session.shown) == {0, 2, 3}
    assert session.shown[3].answer.label == "commute-time, exact"
    names = {thread.name for thread in threading.enumerate() if thread.name.startswith("panel")}
    d.until(lambda: not [t for t in threading.enumerate() if t.name == "panel 1"])
    assert "panel 3" in names


def test_a_panel_added_with_a_distance_that_is_there_costs_nothing(desk, mesh_file):
    d = desk([BIHARMONIC])
    session = d.opened(mesh_file(bumpy(60)), source=2)
    session.show(add_panel(session.document, DistanceFrom(BIHARMONIC)))
    assert session.is_complete
    assert d.answers[1] is d.answers[0]


def test_what_a_panel_cannot_show_it_says_itself_and_the_others_go_on(desk, mesh_file):
    d = desk([Spec.of("geodesic", method="exact"), BIHARMONIC])
    d.opened(mesh_file(replace_last_face(grid(3, 3))))
    assert "is not manifold" in d.answers[0].failure
    assert d.answers[0].field is None
    assert d.answers[1].maximum > 0
    choose(d, 0, Spec.of("geodesic", method="heat"))
    d.complete()
    assert d.answers[0].failure == ""


def test_a_failure_on_one_component_is_none_on_another(desk, mesh_file):
    s, g = bumpy(60), grid(3, 2)
    squashed = g.vertices * [1, 1e-9, 1] + 5
    both = Surface(np.concatenate([s.vertices, squashed]), [*s.faces.tolist(), *(g.faces + 60).tolist()])
    d = desk([BIHARMONIC])
    d.opened(mesh_file(both), source=3)
    for source, fails in [(60, True), (5, False)]:
        d.click(source)
        d.complete()
        assert bool(d.answers[0].failure) is fails


def test_a_stand_in_that_fails_does_not_cost_the_answer(desk, mesh_file, monkeypatch):
    def broken(*_):
        raise SolverError("no heat")

    monkeypatch.setattr("bihdist_core.distances.geodesic._heat", broken)
    d = desk([Spec.of("geodesic", method="exact")])
    d.opened(mesh_file(bumpy(60)))
    assert d.answers[0].maximum > 0


def test_an_answer_is_certified_after_it_was_shown(desk, mesh_file):
    d = desk([BIHARMONIC])
    d.show(mesh_file(bumpy(200)))
    d.until(lambda: d.session.shown)
    first = d.answers[0].field
    d.complete()
    assert d.answers[0].certificate.text.startswith("accurate to ")
    assert d.answers[0].field is first
    assert d.view.told.count("answer 0") == 1


def test_an_answer_that_is_too_poor_is_taken_back(desk, mesh_file, monkeypatch):
    monkeypatch.setattr(BiharmonicDistance, "_estimated_accuracy", lambda *_: 0.02)
    d = desk([BIHARMONIC, COMMUTE])
    d.opened(mesh_file(bumpy(200)))
    assert "may be off by 2e-02 of its maximum" in d.answers[0].failure
    assert d.answers[0].field is None
    assert d.answers[1].maximum > 0


def replace_last_face(surface):
    """Not manifold: a third face on the edge of the first."""
    a, b, _ = surface.faces[0]
    vertices = np.concatenate([surface.vertices, [[0.5, 0, 1], [0.5, 0.2, -1]]])
    n = len(surface.vertices)
    return Surface(vertices, np.concatenate([surface.faces, [[a, b, n], [a, b, n + 1]]]))


# ---------------------------------------------------------------------- differences
def test_a_difference_is_that_of_the_shares_or_of_the_values(desk, mesh_file):
    d = desk([BIHARMONIC, Spec.of("geodesic")])
    session = d.opened(mesh_file(bumpy(200)), source=3)
    a, b = (answer.field for answer in d.answers)
    session.show(add_panel(session.document, quantity("biharmonic - geodesic")))
    session.show(add_panel(session.document, quantity("raw biharmonic - geodesic")))
    d.complete()
    assert np.allclose(d.answers[2].field, a / a.max() - b / b.max())
    assert np.allclose(d.answers[3].field, a - b)
    assert d.answers[2].is_signed
    assert d.answers[2].largest == np.abs(d.answers[2].field).argmax()
    # The heat method stands in for exact geodesic distance here, too.
    assert d.view.told.count("answer 2") == 2


def test_a_raw_difference_of_two_units_says_why_there_is_none(desk, mesh_file):
    d = desk([quantity("raw biharmonic - diffusion"), quantity("biharmonic - diffusion")])
    d.opened(mesh_file(bumpy(60)))
    assert "mesh units and in 1 / mesh units have no difference" in d.answers[0].failure
    assert d.answers[1].maximum > 0


def test_a_difference_fails_with_either_of_its_distances(desk, mesh_file):
    d = desk([quantity("biharmonic - geodesic(method=exact)")])
    d.opened(mesh_file(replace_last_face(grid(3, 3))))
    assert "is not manifold" in d.answers[0].failure


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
    choose(d, 1, COMMUTE)
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
    choose(d, 1, COMMUTE)
    d.until(lambda: slow.cancelled == 1)
    slow.allowed.release()
    d.complete()
    assert slow.built == 1


def test_progress_is_told_and_cancel_stops_within_a_second(slow_desk):
    d, slow = slow_desk
    d.until(lambda: d.session.progress.get(1) == (0.45, "slowly"))
    begun = time.monotonic()
    d.session.cancel()
    d.until(lambda: not d.session.progress)
    assert time.monotonic() - begun < 1
    assert slow.cancelled == 1
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
    begun = time.monotonic()
    d.session.close()
    assert time.monotonic() - begun < 2
    assert slow.cancelled == 1
    assert not [t for t in threading.enumerate() if t.name.startswith("panel") and t.is_alive()]


def test_an_answer_that_comes_late_is_dropped(desk, mesh_file):
    d = desk([BIHARMONIC])
    d.opened(mesh_file(bumpy(200)), source=1)
    kept, after = post_later(d)
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


def test_an_error_nobody_foresaw_is_told(desk, mesh_file, monkeypatch):
    def broken(*_, **__):
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr(Spec, "build", broken)
    d = desk([BIHARMONIC])
    d.opened(mesh_file(bumpy(200)))
    assert "ZeroDivisionError" in d.answers[0].failure


# ---------------------------------------------------------------------- a drag
def test_in_a_drag_what_was_computed_is_shown_though_the_source_has_moved_on(desk, mesh_file):
    d = desk([BIHARMONIC])
    d.opened(mesh_file(bumpy(200)), source=1)
    kept, after = post_later(d)
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
    session = d.opened(mesh_file(bumpy(3000)), source=0)
    seen = []
    answer_changed = d.view.answer_changed
    d.view.answer_changed = lambda id: (answer_changed(id), seen.append((id, session.shown[id].asked.at)))
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


def test_in_a_drag_geodesic_panels_show_the_heat_method_until_release(desk, mesh_file, monkeypatch):
    d = desk([Spec.of("geodesic", method="exact")])
    session = d.opened(mesh_file(bumpy(200)), source=0)
    started = []
    popen = subprocess.Popen
    monkeypatch.setattr(subprocess, "Popen", lambda *a, **k: started.append(a) or popen(*a, **k))
    for vertex in (5, 6, 7):
        d.click(vertex, key="drag", live=True)
        d.until(lambda vertex=vertex: d.sources_shown == [vertex])
        assert d.answers[0].label == "geodesic, heat method"
        assert session.shown[0].is_preview
    session.show(session.document)
    d.complete()
    assert d.answers[0].label == "geodesic, exact"
    assert not started  # the process that computed the first field goes on


def test_a_drag_that_comes_back_shows_the_field_it_began_with(desk, mesh_file):
    d = desk([BIHARMONIC])
    session = d.opened(mesh_file(bumpy(200)), source=1)
    kept, after = post_later(d)
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
    session = d.opened(mesh_file(bumpy(60)), source=0)
    for vertices in ((1, 2, 3), (4, 5)):
        for vertex in vertices:
            d.click(vertex, key="drag", live=True)
        session.show(session.document)
    session.undo()
    assert d.source == 3
    session.undo()
    assert d.source == 0


# ---------------------------------------------------------------------- history
def test_what_comes_back_by_undo_is_there_at_once(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(bumpy(200)), source=1)
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
    session = d.opened(mesh_file(bumpy(60)), source=5)
    before = session.document
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.surface.name == "other.off" and session.is_complete)
    session.undo()
    d.complete()
    assert session.document == before
    assert len(d.answers[0].field) == 60


def test_undo_to_a_mesh_that_is_gone_is_refused_and_nothing_changes(desk, mesh_file, tmp_path, monkeypatch):
    monkeypatch.setattr("app.session.session.SPARED", 0)
    d = desk([BIHARMONIC])
    session = d.opened(mesh_file(bumpy(60)), source=5)
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.surface.name == "other.off" and session.is_complete)
    before = session.document
    (tmp_path / "mesh.off").unlink()
    session.undo()
    d.until_told("is not there")
    assert session.document == before
    assert session.history.can_undo


def test_steps_taken_while_a_mesh_is_read_count(desk, mesh_file, monkeypatch):
    monkeypatch.setattr("app.session.session.SPARED", 0)
    d = desk([BIHARMONIC])
    session = d.opened(mesh_file(bumpy(60)), source=5)
    first = session.document
    d.click(9)
    second = session.document
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.surface.name == "other.off" and session.is_complete)
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
    assert (session.surface.name, d.source) == ("mesh.off", 11)
    assert not session.history.can_redo


def test_a_click_while_the_mesh_of_an_undone_step_is_read_takes_its_place(desk, mesh_file, monkeypatch):
    monkeypatch.setattr("app.session.session.SPARED", 0)
    d = desk([BIHARMONIC])
    session = d.opened(mesh_file(bumpy(60)), source=5)
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: session.surface.name == "other.off" and session.is_complete)
    kept, after = post_later(d)
    session.undo()
    d.until(lambda: any("_loaded" in function.__code__.co_names for function in kept))
    d.post = after
    d.click(9)
    for function in kept:
        function()
    d.complete()
    assert (session.surface.name, d.source) == ("other.off", 9)


def test_answers_are_kept_within_a_memory():
    kept = KeptAnswers(memory=2500)
    asked = [DistanceQuestion(MeshFile("A", ""), "voronoi", BIHARMONIC, vertex) for vertex in range(4)]
    for question in asked:
        kept.put(question, Answer(label="", field=np.zeros(100)))
        kept.get(asked[0])
    assert [kept.get(question) is not None for question in asked] == [True, False, True, True]


# ---------------------------------------------------------------------- a mesh that comes too late
def post_later(d):
    """What the session posts is kept until the test lets it go."""
    kept = []
    d.post, after = kept.append, d.post
    return kept, after


def test_a_mesh_that_was_cancelled_is_not_shown_when_it_comes(desk, mesh_file):
    d = desk()
    kept, after = post_later(d)
    d.show(mesh_file(bumpy(60)))
    d.until(lambda: any("_loaded" in function.__code__.co_names for function in kept))
    d.session.cancel()
    d.post = after
    for function in kept:
        function()
    assert d.session.surface is None
    assert "document" not in d.view.told


def test_of_two_meshes_the_later_is_shown_with_its_own_source(desk, mesh_file):
    d = desk()
    kept, after = post_later(d)
    d.show(mesh_file(bumpy(60)), source=5)
    d.until(lambda: any("_loaded" in function.__code__.co_names for function in kept))
    d.post = after
    d.show(mesh_file(grid(3, 3), "other.off"), source=7)
    for function in kept:
        function()
    assert d.session.surface is None
    d.complete()
    assert d.session.surface.name == "other.off"
    assert d.source == 7
    assert d.view.told.count("document") == 1


def test_a_click_while_another_mesh_is_read_does_not_keep_it_away(desk, mesh_file):
    d = desk([BIHARMONIC])
    session = d.opened(mesh_file(bumpy(60)), source=5)
    kept, after = post_later(d)
    session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.until(lambda: any("_loaded" in function.__code__.co_names for function in kept))
    d.post = after
    d.click(9)
    assert d.source == 9
    for function in kept:
        function()
    d.complete()
    assert (session.surface.name, d.source) == ("other.off", 7)


# ---------------------------------------------------------------------- before there is a mesh
def begin_late(desk, document):
    """A session that begins with a document, whose mesh is kept back by what `post_later` gives."""
    d = desk(document=document)
    kept, after = post_later(d)
    d.session.show(document)
    d.until(lambda: any("_loaded" in function.__code__.co_names for function in kept))
    d.post = after
    return d, kept


def test_what_is_chosen_while_the_first_mesh_is_read_is_shown_with_it(desk, mesh_file):
    d, kept = begin_late(desk, comparison(mesh_file(bumpy(60)), (BIHARMONIC,), (5,)))
    choose(d, 0, COMMUTE)
    d.session.show(replace(d.session.document, isolines=7))
    for function in kept:
        function()
    d.complete()
    assert (d.answers[0].label, d.session.document.isolines, d.source) == ("commute-time, exact", 7, 5)
    assert not d.session.history.can_undo


def test_what_is_chosen_while_another_first_mesh_is_read_does_not_keep_it_away(desk, mesh_file):
    d, kept = begin_late(desk, comparison(mesh_file(bumpy(60)), (BIHARMONIC,), (5,)))
    d.session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    d.session.show(replace(d.session.document, isolines=7))
    for function in kept:
        function()
    d.complete()
    assert (d.session.surface.name, d.source, d.session.document.isolines) == ("other.off", 7, 7)


def test_what_is_chosen_after_the_first_mesh_failed_is_shown_with_the_next(desk, mesh_file):
    d = desk(document=comparison("gone.off", (BIHARMONIC,)))
    d.session.show(d.session.document)
    d.until_told("gone.off is not there")
    choose(d, 0, COMMUTE)
    d.session.open(mesh_file(bumpy(60)))
    d.complete()
    assert d.answers[0].label == "commute-time, exact"
    assert len([words for words in d.view.told if "gone.off" in words]) == 1
