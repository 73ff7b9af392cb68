"""The session without a window: what is asked is answered, what is old is dropped, what fails leaves things alone."""

import threading
import time
from dataclasses import dataclass, replace

import numpy as np
import pytest

from app.state import COMPARISON, ViewerState
from bihdist_core import BiharmonicDistance, Cancelled, SolverError, Surface, VertexError
from bihdist_core.distances.kinds import Spec
from tests.shapes import bumpy, grid, two_pieces


def test_opening_a_mesh_answers_every_panel(desk, mesh_file):
    surface = bumpy(200)
    session = desk().opened(mesh_file(surface), source=7)
    assert [answer.label for answer in session.answers] == ["biharmonic, exact", "geodesic, exact", "diffusion, t = 1"]
    expected = BiharmonicDistance(surface).from_source(7)
    assert np.allclose(session.answers[0].field, expected, rtol=1e-9)
    assert all(answer.source == 7 and answer.field[7] == 0 for answer in session.answers)


def test_the_first_source_is_the_highest_vertex_of_the_largest_component(desk, mesh_file):
    surface = two_pieces()
    session = desk().opened(mesh_file(surface))
    assert session.state.source == surface.vertices[:60, 1].argmax()


def test_a_click_asks_every_panel_anew(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(bumpy(200)))
    session.select_source(3)
    assert not session.is_complete
    d.until(lambda: session.is_complete)
    assert [answer.source for answer in session.answers] == [3, 3, 3]
    # The heat method's answer comes before the exact one.
    assert d.view.told.count("answer 1") == 4


def test_a_bad_vertex_changes_nothing(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(two_pieces()), source=3)
    for vertex in (60, 1000, -1):
        with pytest.raises(VertexError):
            session.select_source(vertex)
    assert session.state.source == 3
    assert session.is_complete


def test_a_file_that_cannot_be_read_leaves_the_session_as_it_was(desk, mesh_file, tmp_path):
    d = desk()
    session = d.opened(mesh_file(bumpy(200)), source=3)
    before = (session.surface, session.state, session.path, [answer.field for answer in session.answers])
    bad = tmp_path / "bad.off"
    bad.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n")
    session.open(str(bad))
    d.until_told("bad.off")
    assert (session.surface, session.state, session.path) == before[:3]
    assert all(answer.field is field for answer, field in zip(session.answers, before[3], strict=True))
    session.open(mesh_file(grid(3, 3), "other.off"), source=99)
    d.until_told("has no vertex 99")
    assert session.surface is before[0]


def test_another_mesh_replaces_the_first(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(bumpy(200)))
    session.open(mesh_file(grid(5, 5), "grid.off"), source=0)
    d.until(lambda: session.surface.name == "grid.off" and session.is_complete)
    assert all(len(answer.field) == 36 for answer in session.answers)


def test_a_panel_can_show_another_distance(desk, mesh_file):
    d = desk()
    session = d.opened(mesh_file(bumpy(200)))
    first = session.answers[0]
    session.set_panel(2, Spec.of("diffusion", t=0.25))
    session.set_panel(1, Spec.of("geodesic", method="dijkstra"))
    d.until(lambda: session.is_complete)
    assert session.answers[0] is first
    assert session.answers[1].label == "geodesic, Dijkstra along edges"
    assert session.answers[2].label == "diffusion, t = 0.25"


def test_what_a_panel_cannot_show_it_says_itself_and_the_others_go_on(desk, mesh_file):
    d = desk(ViewerState(panels=(Spec.of("geodesic", method="exact"), Spec.of("biharmonic"))))
    session = d.opened(mesh_file(replace_last_face(grid(3, 3))))
    assert "is not manifold" in session.answers[0].failure
    assert session.answers[0].field is None
    assert session.answers[1].maximum > 0
    session.set_panel(0, Spec.of("geodesic", method="heat"))
    d.until(lambda: session.is_complete)
    assert session.answers[0].failure == ""


def test_a_failure_on_one_component_is_none_on_another(desk, mesh_file):
    s, g = bumpy(60), grid(3, 2)
    squashed = g.vertices * [1, 1e-9, 1] + 5
    both = Surface(np.concatenate([s.vertices, squashed]), [*s.faces.tolist(), *(g.faces + 60).tolist()])
    d = desk(ViewerState(panels=(Spec.of("biharmonic"),)))
    session = d.opened(mesh_file(both), source=3)
    for source, fails in [(60, True), (5, False)]:
        session.select_source(source)
        d.until(lambda: session.is_complete)
        assert bool(session.answers[0].failure) is fails


def test_a_stand_in_that_fails_does_not_cost_the_answer(desk, mesh_file, monkeypatch):
    def broken(*_):
        raise SolverError("no heat")

    monkeypatch.setattr("bihdist_core.distances.geodesic._heat", broken)
    d = desk(ViewerState(panels=(Spec.of("geodesic", method="exact"),)))
    assert d.opened(mesh_file(bumpy(60))).answers[0].maximum > 0


def test_an_answer_is_certified_after_it_was_shown(desk, mesh_file):
    d = desk(ViewerState(panels=(Spec.of("biharmonic"),)))
    session = d.opened(mesh_file(bumpy(200)))
    first = session.answers[0].field
    d.until(lambda: session.answers[0].certificate.text)
    assert session.answers[0].certificate.text.startswith("accurate to ")
    assert session.answers[0].field is first


def test_an_answer_that_is_too_poor_is_taken_back(desk, mesh_file, monkeypatch):
    monkeypatch.setattr(BiharmonicDistance, "_estimated_accuracy", lambda *_: 0.02)
    d = desk(ViewerState(panels=(Spec.of("biharmonic"), Spec.of("commute-time"))))
    session = d.opened(mesh_file(bumpy(200)))
    d.until(lambda: session.answers[0].failure)
    assert "may be off by 2e-02 of its maximum" in session.answers[0].failure
    assert session.answers[0].field is None
    assert session.answers[1].maximum > 0


def replace_last_face(surface):
    """Not manifold: a third face on the edge of the first."""
    from bihdist_core import Surface

    a, b, _ = surface.faces[0]
    vertices = np.concatenate([surface.vertices, [[0.5, 0, 1], [0.5, 0.2, -1]]])
    n = len(surface.vertices)
    return Surface(vertices, np.concatenate([surface.faces, [[a, b, n], [a, b, n + 1]]]))


# ---------------------------------------------------------------------- distances that take their time
class Slow:
    """Makes panels whose distance is built step by step, as the test allows."""

    def __init__(self):
        self.allowed = threading.Semaphore(0)
        self.started = threading.Semaphore(0)
        self.built = self.cancelled = 0

    def panel(self, name="biharmonic"):
        return SlowPanel(name, slow=self)

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
class SlowPanel(Spec):
    slow: Slow = None

    def build(self, laplacian, progress=None):
        return self.slow.build(laplacian, progress)


@pytest.fixture
def slow_desk(desk, mesh_file):
    """A session whose middle panel is slow, open and with its quick panels answered."""
    slow = Slow()
    d = desk(ViewerState(panels=(Spec.of("biharmonic"), slow.panel(), Spec.of("commute-time"))))
    d.session.open(mesh_file(bumpy(200)), 0)
    d.until(lambda: slow.started.acquire(blocking=False))
    d.until(lambda: d.session.answers[0] and d.session.answers[2])
    return d, slow


def test_quick_panels_do_not_wait_for_a_slow_one(slow_desk):
    d, _ = slow_desk
    d.session.select_source(9)
    d.until(lambda: d.session.answers[0].source == 9 and d.session.answers[2].source == 9)
    assert d.session.answers[1] is None


def test_a_click_while_a_panel_computes_is_kept_and_the_old_one_dropped(slow_desk):
    d, slow = slow_desk
    for vertex in (4, 5, 6):
        d.session.select_source(vertex)
    slow.allowed.release()
    d.until(lambda: d.session.is_complete)
    assert d.session.answers[1].source == 6
    assert d.view.told.count("answer 1") == 1
    assert slow.built == 1  # the work in progress served the last click


def test_choosing_another_distance_stops_the_work_for_the_old_one(slow_desk):
    d, slow = slow_desk
    d.session.set_panel(1, Spec.of("commute-time"))
    d.until(lambda: d.session.is_complete)
    assert slow.cancelled == 1
    assert slow.built == 0


def test_progress_is_told_and_cancel_stops_within_a_second(slow_desk):
    d, slow = slow_desk
    d.until(lambda: d.session.progress.get("panel 1") == (0.45, "slowly"))
    begun = time.monotonic()
    d.session.cancel()
    d.until(lambda: not d.session.progress)
    assert time.monotonic() - begun < 1
    assert slow.cancelled == 1
    # The next click asks again.
    d.session.select_source(8)
    slow.allowed.release()
    d.until(lambda: d.session.is_complete)


def test_opening_another_mesh_stops_the_work_on_the_old_one(slow_desk, mesh_file):
    d, slow = slow_desk
    d.session.open(mesh_file(grid(4, 4), "grid.off"))
    d.until(lambda: slow.cancelled == 1)
    slow.allowed.release()
    d.until(lambda: d.session.is_complete)
    assert len(d.session.answers[1].field) == 25


def test_closing_stops_everything(slow_desk):
    d, slow = slow_desk
    begun = time.monotonic()
    d.session.close()
    assert time.monotonic() - begun < 2
    assert slow.cancelled == 1
    assert not [t for t in threading.enumerate() if t.name.startswith("panel") and t.is_alive()]


def test_an_answer_that_comes_late_is_dropped(desk, mesh_file):
    d = desk(ViewerState(panels=(Spec.of("biharmonic"),)))
    session = d.opened(mesh_file(bumpy(200)), source=1)
    kept, after = post_later(d)
    session.select_source(2)
    d.until(lambda: any("_answered" in function.__code__.co_names for function in kept))
    d.session._post = after
    session.select_source(3)
    for function in kept:
        function()
    assert session.answers[0].source == 1
    d.until(lambda: session.is_complete)
    assert session.answers[0].source == 3
    assert d.view.told.count("answer 0") == 2  # for 1 and 3


def test_an_error_nobody_foresaw_is_told(desk, mesh_file, monkeypatch):
    def broken(*_, **__):
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr(Spec, "build", broken)
    d = desk(ViewerState(panels=(Spec.of("biharmonic"),)))
    session = d.opened(mesh_file(bumpy(200)))
    assert "ZeroDivisionError" in session.answers[0].failure


# ---------------------------------------------------------------------- state
def test_state_is_replaced_not_changed():
    state = ViewerState()
    other = state.with_panel(1, Spec.of("commute-time"))
    assert state.panels == COMPARISON
    assert [panel.word for panel in other.panels] == ["biharmonic", "commute-time", "diffusion"]
    assert replace(other, source=3).panels is other.panels


# ---------------------------------------------------------------------- a mesh that comes too late
def post_later(d):
    """What the session posts is kept until the test lets it go."""
    kept = []
    d.session._post, after = kept.append, d.session._post
    return kept, after


def test_a_mesh_that_was_cancelled_is_not_shown_when_it_comes(desk, mesh_file):
    d = desk()
    kept, after = post_later(d)
    d.session.open(mesh_file(bumpy(60)))
    d.until(lambda: any("_loaded" in function.__code__.co_names for function in kept))
    d.session.cancel()
    d.session._post = after
    for function in kept:
        function()
    assert d.session.surface is None
    assert "mesh" not in d.view.told


def test_of_two_meshes_the_later_is_shown_with_its_own_source(desk, mesh_file):
    d = desk()
    kept, after = post_later(d)
    d.session.open(mesh_file(bumpy(60)), source=5)
    d.until(lambda: any("_loaded" in function.__code__.co_names for function in kept))
    d.session._post = after
    d.session.open(mesh_file(grid(3, 3), "other.off"), source=7)
    for function in kept:
        function()
    assert d.session.surface is None
    d.until(lambda: d.session.is_complete)
    assert d.session.surface.name == "other.off"
    assert d.session.state.source == 7
    assert d.view.told.count("mesh") == 1
