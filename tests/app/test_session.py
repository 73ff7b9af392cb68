"""The session without a window: what is asked is answered, what is old is dropped, what fails leaves things alone."""

import threading
from dataclasses import replace

import numpy as np
import pytest

from app.document.document import comparison
from app.document.edits import add_panel, remove_panel
from app.document.quantities import DistanceFrom, quantity
from bihdist_core import BiharmonicDistance, ParameterError, SolverError, Surface
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy, grid, two_pieces

BIHARMONIC, COMMUTE = Spec.of("biharmonic"), Spec.of("commute-time")


def test_opening_a_mesh_answers_every_panel(desk, mesh_file):
    surface = bumpy(200)
    d = desk()
    d.loaded(mesh_file(surface), source=7)
    assert [answer.label for answer in d.answers] == ["biharmonic, exact", "geodesic, exact", "diffusion, t = 1"]
    expected = BiharmonicDistance(surface).from_source(7)
    assert np.allclose(d.answers[0].field, expected, rtol=1e-9)
    assert d.sources_shown == [7, 7, 7]
    assert all(answer.field[7] == 0 for answer in d.answers)


def test_the_first_source_is_the_highest_vertex_of_the_largest_component(desk, mesh_file):
    surface = two_pieces()
    d = desk()
    d.loaded(mesh_file(surface))
    assert d.source == surface.vertices[:60, 1].argmax()


def test_a_click_asks_every_panel_anew(desk, mesh_file):
    d = desk()
    session = d.loaded(mesh_file(bumpy(200)))
    d.click(3)
    assert not session.is_complete
    d.complete()
    assert d.sources_shown == [3, 3, 3]
    assert d.view.told.count("answer 1") == 1 + 1


def test_a_bad_vertex_changes_nothing(desk, mesh_file):
    d = desk()
    session = d.loaded(mesh_file(two_pieces()), source=3)
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
    session = d.loaded(mesh_file(bumpy(200)), source=3)
    before = (session.mesh().surface, session.document, d.answers)
    bad = tmp_path / "bad.off"
    bad.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n")
    session.open(str(bad))
    d.until_told("bad.off")
    assert (session.mesh().surface, session.document) == before[:2]
    assert all(now is then for now, then in zip(d.answers, before[2], strict=True))
    session.open(mesh_file(grid(3, 3), "other.off"), source=99)
    d.until_told("has no vertex 99")
    assert (session.mesh().surface, session.document) == before[:2]
    assert not session.history.can_undo


def test_another_mesh_replaces_the_first(desk, mesh_file):
    d = desk()
    session = d.loaded(mesh_file(bumpy(200)))
    session.open(mesh_file(grid(5, 5), "grid.off"), source=0)
    d.until(lambda: session.mesh().surface.name == "grid.off" and session.is_complete)
    assert all(len(answer.field) == 36 for answer in d.answers)


def test_a_mesh_that_has_changed_is_read_again_and_not_taken_for_the_old_one(desk, mesh_file):
    d = desk([BIHARMONIC])
    path = mesh_file(bumpy(60))
    session = d.loaded(path)
    recorded = session.document
    mesh_file(bumpy(80))
    session.open(path)
    d.until(lambda: session.loaded() is not None and len(session.mesh().surface.vertices) == 80 and session.is_complete)
    session.show(replace(recorded, surfaces=(replace(recorded.mesh(), sha256="0" * 64),)))
    d.until_told("has changed since")
    assert len(session.mesh().surface.vertices) == 80


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
    d.loaded(mesh_file(bumpy(200)))
    first = d.answers[0]
    d.choose(2, Spec.of("diffusion", t=0.25))
    d.choose(1, Spec.of("geodesic", method="dijkstra"))
    d.complete()
    assert d.answers[0] is first
    assert d.answers[1].label == "geodesic, Dijkstra along edges"
    assert d.answers[2].label == "diffusion, t = 0.25"


def test_panels_come_and_go_and_keep_their_ids(desk, mesh_file):
    d = desk()
    session = d.loaded(mesh_file(bumpy(60)), source=2)
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
    session = d.loaded(mesh_file(bumpy(60)), source=2)
    session.show(add_panel(session.document, DistanceFrom(BIHARMONIC)))
    assert session.is_complete
    assert d.answers[1] is d.answers[0]


def test_what_a_panel_cannot_show_it_says_itself_and_the_others_go_on(desk, mesh_file, no_exact_geodesics):
    d = desk([Spec.of("geodesic", method="exact"), BIHARMONIC])
    d.loaded(mesh_file(bumpy(60)))
    assert "no room for windows" in d.answers[0].failure
    assert d.answers[0].field is None
    assert d.answers[1].maximum > 0
    d.choose(0, Spec.of("geodesic", method="heat"))
    d.complete()
    assert d.answers[0].failure == ""


def test_a_failure_on_one_component_is_none_on_another(desk, mesh_file):
    s, g = bumpy(60), grid(3, 2)
    squashed = g.vertices * [1, 1e-9, 1] + 5
    both = Surface(np.concatenate([s.vertices, squashed]), [*s.faces.tolist(), *(g.faces + 60).tolist()])
    d = desk([BIHARMONIC])
    d.loaded(mesh_file(both), source=3)
    for source, fails in [(60, True), (5, False)]:
        d.click(source)
        d.complete()
        assert bool(d.answers[0].failure) is fails


def test_a_stand_in_that_fails_does_not_cost_the_answer(desk, mesh_file, monkeypatch):
    def broken(*_):
        raise SolverError("no heat")

    monkeypatch.setattr("bihdist_core.distances.geodesic_solvers.HeatTimes", broken)
    d = desk([Spec.of("geodesic", method="exact")])
    d.loaded(mesh_file(bumpy(60)))
    assert d.answers[0].maximum > 0


def test_an_answer_is_certified_after_it_was_shown(desk, mesh_file):
    d = desk([BIHARMONIC])
    d.show(mesh_file(bumpy(200)))
    d.until(lambda: d.session.shown)
    first = d.answers[0].field
    d.complete()
    assert d.answers[0].error_estimate.text.startswith("accurate to ")
    assert d.answers[0].field is first
    assert d.view.told.count("answer 0") == 1


def test_an_answer_that_is_too_poor_is_taken_back(desk, mesh_file, monkeypatch):
    monkeypatch.setattr(BiharmonicDistance, "_estimated_accuracy", lambda *_: 0.02)
    d = desk([BIHARMONIC, COMMUTE])
    d.loaded(mesh_file(bumpy(200)))
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
def test_a_difference_is_in_percentage_points_or_that_of_the_values(desk, mesh_file):
    d = desk([BIHARMONIC, Spec.of("geodesic")])
    session = d.loaded(mesh_file(bumpy(200)), source=3)
    a, b = (answer.field for answer in d.answers)
    session.show(add_panel(session.document, quantity("biharmonic - geodesic")))
    session.show(add_panel(session.document, quantity("raw biharmonic - geodesic")))
    d.complete()
    assert np.allclose(d.answers[2].field, 100 * (a / a.max() - b / b.max()))
    assert np.allclose(d.answers[3].field, a - b)
    assert d.answers[2].is_signed
    assert d.answers[2].largest == np.abs(d.answers[2].field).argmax()


def test_a_raw_difference_of_two_units_says_why_there_is_none(desk, mesh_file):
    d = desk([quantity("raw biharmonic - diffusion"), quantity("biharmonic - diffusion")])
    d.loaded(mesh_file(bumpy(60)))
    assert "mesh units and in 1 / mesh units cannot be subtracted" in d.answers[0].failure
    assert d.answers[1].maximum > 0


def test_a_difference_fails_with_either_of_its_distances(desk, mesh_file, no_exact_geodesics):
    d = desk([quantity("biharmonic - geodesic(method=exact)")])
    d.loaded(mesh_file(bumpy(60)))
    assert "no room for windows" in d.answers[0].failure
