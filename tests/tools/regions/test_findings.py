"""What is found out in the background: the same as from Python, each once, and nothing that is stale."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.document import Panel, Point, comparison
from app.document.edits import mark_extrema, move_source, put_point
from app.document.panel_edits import panel_edits, possible_edits
from app.document.quantities import OwnField, quantity
from app.document.shared_parts.pins import Pins, add_pins, remove_pins
from app.drawing.glyphs import BOUNDARY, TRIANGLE_DOWN, TRIANGLE_UP
from app.session.chosen_sources import SamplesRequest, find_samples
from app.session.session import Session
from app.tools.quality.quality_worker import KnownQuality, QualityWorker
from app.tools.regions.division import Dividing, regions_questions
from app.tools.regions.part import DividedPanels, show_regions
from bihdist_core import (
    BihdistError,
    difference_quality,
    farthest_points,
    field_quality,
    triangle_sample,
    voronoi_regions,
)
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import BoundaryLoop, SourceSet, SurfacePoint
from tests.silent_view import SilentView

SHOWN = (Spec.of("biharmonic"), Spec.of("geodesic"), Spec.of("diffusion"))


class Watching(SilentView):
    """A session with nobody behind it, whose posted functions are run here."""

    def __init__(self, path, at=0):
        super().__init__()
        self.session = Session(self, self.posted.put)
        self.session.show(comparison(str(path), SHOWN, (at,)))
        self.run_until(lambda: self.session.is_complete)

    @property
    def asked(self):
        shown = [self.session.shown[id] for id in sorted(self.session.shown)]  # answers come in any order
        return {s.question: (self.session.loaded(), s.answer) for s in shown}

    def distance(self, spec):
        return self.session.loaded().distances("voronoi").get(spec)


@pytest.fixture
def watching(ply_path):
    made = []

    def make(at=0):
        made.append(Watching(ply_path, at))
        return made[-1]

    yield make
    for each in made:
        each.session.close()


@pytest.fixture
def ply_path(tmp_path):
    from bihdist_core.formats.field_output import write_fields
    from tests.shapes import bumpy

    surface = bumpy(400)
    path = tmp_path / "bumpy.ply"
    write_fields(path, surface, {"zero": np.zeros(len(surface.vertices))})
    return path


def judged(w):
    told = []
    quality = QualityWorker(w.posted.put, lambda: told.append(1))
    quality.ask(w.asked)
    w.run_until(lambda: all(quality.found(question).is_complete for question in w.asked))
    quality.close()
    return quality, told


def test_triangles_of_so_many_distances_are_remembered_and_no_more(monkeypatch):
    monkeypatch.setattr("app.tools.quality.quality_worker.MAX_REMEMBERED", 3)
    quality = QualityWorker(lambda function: None, lambda: None)
    for number in (0, 1, 2, 0, 3, 4):
        quality._learn((f"distance {number}", 0), KnownQuality(points=number))
    quality.close()
    assert [key for key, _ in quality._samples] == ["distance 0", "distance 3", "distance 4"]


def test_quality_is_that_of_python(watching):
    w = watching(7)
    quality, told = judged(w)
    surface = w.session.mesh().surface
    near = w.distance(Spec.of("geodesic")).from_source(7)
    for question, (_, answer) in w.asked.items():
        found, wanted = quality.found(question), field_quality(surface, answer.field, near, 7)
        assert found.extrema.minima.tolist() == wanted.minima.tolist()
        assert found.extrema.maxima_height == pytest.approx(wanted.maxima_height, abs=1e-12)
        assert found.whole.isotropy == pytest.approx(wanted.isotropy, rel=1e-9)
        assert (found.whole.kink, found.whole.kink_length) == pytest.approx((wanted.kink, wanted.kink_length), rel=1e-9)
        assert found.triangles == triangle_sample(w.distance(question.spec))
        assert (found.points, found.is_sampled) == (40, True)
    # Two stages for each panel, and the triangles of each distance in five.
    assert len(told) == 21
    quality.ask(w.asked)
    assert len(told) == 21


def test_what_was_found_is_of_its_own_question(watching):
    w = watching(7)
    quality, _ = judged(w)
    before = list(w.asked)
    w.session.show(move_source(w.session.document, 0, 90))
    w.run_until(lambda: w.session.is_complete)
    after = list(w.asked)
    assert all(quality.found(question).whole is None for question in after)
    # Triangles are a distance's, wherever it starts.
    assert all(quality.found(question).triangles is not None for question in after)
    assert all(quality.found(question).whole is not None for question in before)


def test_triangles_are_those_of_the_component_of_the_source(tmp_path):
    from bihdist_core.formats.field_output import write_fields
    from tests.shapes import two_pieces

    surface = two_pieces()
    write_fields(tmp_path / "two.ply", surface, {"zero": np.zeros(len(surface.vertices))})
    w = Watching(tmp_path / "two.ply", 7)
    quality = QualityWorker(w.posted.put, lambda: None)
    for at, component in ((7, 0), (62, 1), (8, 0)):
        w.session.show(move_source(w.session.document, 0, at))
        w.run_until(lambda: w.session.is_complete)
        quality.ask(w.asked)
        for question in w.asked:
            wanted = triangle_sample(w.distance(question.spec), component=component)
            w.run_until(lambda question=question, wanted=wanted: quality.found(question).triangles == wanted)
    quality.close()
    w.session.close()


@pytest.mark.parametrize("at", [SurfacePoint(3, (0.2, 0.5, 0.3)), SourceSet((3, 200))], ids=["place", "set"])
def test_sources_that_are_no_vertex_are_judged_too(watching, at):
    w = watching(at)
    quality, _ = judged(w)
    for question in w.asked:
        found = quality.found(question)
        assert not found.failure
        assert len(found.extrema.minima) == 0 or question.spec.word == "diffusion"
        # Around several places there are no circles.
        assert bool(found.whole.circles) == isinstance(at, SurfacePoint)


def shown_instead(w, *shows, **fields):
    """The panels of a mesh that is there, with fields from Python."""
    document = w.session.document
    arrays = tuple(w.session.given.add_field(name, values) for name, values in fields.items())
    panels = tuple(Panel(k, each) for k, each in enumerate(shows))
    w.session.show(replace(document, fields=arrays, panels=panels, next_id=len(panels)))
    w.run_until(lambda: w.session.is_complete)


def test_differences_and_fields_from_python_are_judged_too(watching):
    w = watching(7)
    surface = w.session.mesh().surface
    near = w.distance(Spec.of("geodesic")).from_source(7)
    own = w.distance(SHOWN[0]).from_source(7)
    height = surface.vertices[:, 2] - 9
    apart = quantity("biharmonic - geodesic")
    shown_instead(w, apart, OwnField("mine"), OwnField("height"), mine=own, height=height)
    quality, _ = judged(w)
    asked = dict(zip("abc", w.asked.items(), strict=True))
    wanted = {
        "a": difference_quality(surface, asked["a"][1][1].field, near, 7),
        "b": field_quality(surface, own, near, 7),
        "c": difference_quality(surface, height, None, None),
    }
    for name, (question, _) in asked.items():
        found = quality.found(question)
        assert not found.failure
        assert found.extrema.minima.tolist() == found.whole.minima.tolist() == wanted[name].minima.tolist()
        assert found.extrema.maxima.tolist() == wanted[name].maxima.tolist()
        assert found.whole.isotropy == pytest.approx(wanted[name].isotropy, rel=1e-9, nan_ok=True)
        assert found.whole.kink == pytest.approx(wanted[name].kink, rel=1e-9)
        assert found.whole.source == {"a": 7, "b": 7, "c": None}[name]
    words = [quality.found(question).triangles_failure for question, _ in asked.values()]
    assert "for distances only" in words[0]
    assert "one source only" in words[1] == words[2]
    # Of two sources both are left out.
    w.session.show(put_point(with_two_sources(w.session.document), "other", 200))
    w.run_until(lambda: w.session.is_complete)
    quality, _ = judged(w)
    (question, _), *_ = w.asked.items()
    assert quality.found(question).whole.source == SourceSet((7, 200))


def with_two_sources(document):
    first, *others = document.panels
    apart = replace(first.shows, subtrahend=replace(first.shows.subtrahend, point="other"))
    return replace(
        document, points=(*document.points, Point("other", 0)), panels=(replace(first, shows=apart), *others)
    )


def test_triangles_go_on_while_a_source_moves(watching):
    w = watching(7)
    asked = w.asked
    quality = QualityWorker(w.posted.put, lambda: None)
    quality.ask({}, on_its_way={question: loaded for question, (loaded, _) in asked.items()})
    w.run_until(lambda: all(quality.found(question).is_sampled for question in asked))
    assert all(quality.found(question).extrema is None for question in asked)
    quality.close()


def test_extrema_alone_are_found_without_the_rest(watching):
    w = watching(7)
    quality = QualityWorker(w.posted.put, lambda: None)
    quality.ask(w.asked, only_extrema=True)
    w.run_until(lambda: all(quality.found(question).extrema is not None for question in w.asked))
    quality.close()
    while not w.posted.empty():
        w.posted.get()()
    found = [quality.found(question) for question in w.asked]
    assert all(each.whole is None and each.triangles is None for each in found)


def test_figures_mark_the_extrema_where_the_document_says_so(watching):
    from app.document.page import Page, Recipe
    from app.figures.export import figure_of

    w = watching(7)
    quality, _ = judged(w)
    loaded, answers = w.session.loaded(), [w.session.shown[k].answer for k in range(3)]
    plain = figure_of(Recipe(w.session.document, Page()), {"A": loaded}, answers)
    marked = figure_of(Recipe(mark_extrema(w.session.document), Page()), {"A": loaded}, answers)
    for question, before, after in zip(w.asked, plain.panels, marked.panels, strict=True):
        found = quality.found(question).extrema
        ways = (TRIANGLE_UP, TRIANGLE_DOWN)
        assert not any(mark.glyph in ways for mark in before.marks)
        triangles = [(mark.vertex, mark.glyph) for mark in after.marks if mark.glyph in ways]
        assert [vertex for vertex, way in triangles if way is TRIANGLE_UP] == found.maxima.tolist() != []
        assert [vertex for vertex, way in triangles if way is TRIANGLE_DOWN] == found.minima.tolist()
        assert len(after.marks) == len(before.marks) + len(triangles)


def test_why_there_is_no_quality_is_said(watching):
    w = watching(7)
    (question, (loaded, answer)), *_ = w.asked.items()
    flat = replace(answer, field=np.zeros(len(answer.field)))
    quality = QualityWorker(w.posted.put, lambda: None)
    quality.ask({question: (loaded, flat)})
    w.run_until(lambda: quality.found(question).is_complete)
    quality.close()
    assert "values that differ" in quality.found(question).failure


def divided(w, dividing):
    document = w.session.document
    loaded = w.session.loaded()
    dividing.ask({id: (question, loaded) for id, question in regions_questions(document).items()})
    w.run_until(lambda: dividing.is_complete)


def test_regions_are_those_of_python_and_follow_a_pin(watching):
    w = watching(7)
    told = []
    dividing = Dividing(w.posted.put, told.append)
    w.session.show(add_pins(w.session.document, [7, 90, 300]))
    w.session.show(show_regions(show_regions(w.session.document, 0), 1))
    divided(w, dividing)
    for id, spec in ((0, SHOWN[0]), (1, SHOWN[1])):
        wanted = voronoi_regions(w.session.mesh().surface, w.distance(spec).from_sources([7, 90, 300]))
        assert dividing.divided(id).regions.areas == pytest.approx(wanted.areas, rel=1e-9)
        assert (dividing.divided(id).regions.labels == wanted.labels).all()
    assert dividing.divided(2) is None
    moved = w.session.document[Pins].pins[1].point
    w.session.show(put_point(w.session.document, moved, 91))
    divided(w, dividing)
    wanted = voronoi_regions(w.session.mesh().surface, w.distance(SHOWN[0]).from_sources([7, 91, 300]))
    assert dividing.divided(0).regions.areas == pytest.approx(wanted.areas, rel=1e-9)
    w.session.show(remove_pins(w.session.document, [pin.point for pin in w.session.document[Pins].pins]))
    divided(w, dividing)
    assert dividing.divided(0) is None
    assert told[-2:] == [0, 1]
    dividing.close()


def test_regions_that_cannot_be_had_say_why(watching):
    w = watching(7)
    dividing = Dividing(w.posted.put, lambda panel: None)
    w.session.show(add_pins(w.session.document, [7]))
    w.session.show(show_regions(w.session.document, 0))
    (question,) = regions_questions(w.session.document).values()
    bad = replace(question, places=(BoundaryLoop(0),))
    dividing.ask({0: (bad, w.session.loaded())})
    w.run_until(lambda: dividing.is_complete)
    assert "boundary" in dividing.divided(0).failure
    dividing.close()


def test_the_panel_offers_regions_while_there_are_pins(watching):
    document = watching(7).session.document
    word = "Regions of the pins"
    assert word not in possible_edits(document, 0, 6)
    with_pins = add_pins(document, [7, 90])
    assert word in possible_edits(with_pins, 0, 6)
    shown = panel_edits()[word].edit(with_pins, 0)
    assert shown[DividedPanels].regions == (0,)
    assert panel_edits()[word].edit(shown, 0)[DividedPanels].regions == ()


def test_samples_are_those_of_python(watching):
    w = watching(7)
    request = SamplesRequest(w.session.loaded(), "voronoi", SHOWN[0], 7, 9)
    (vertices,) = find_samples(request, lambda *_: None)
    assert vertices.tolist() == farthest_points(w.distance(SHOWN[0]), 7, 9).tolist()
    with pytest.raises(BihdistError, match="not a vertex"):
        next(find_samples(replace(request, at=SurfacePoint(3, (0.2, 0.5, 0.3))), lambda *_: None))


def test_figures_draw_the_boundaries_that_the_window_draws(watching):
    from app.document.page import Page, Recipe
    from app.figures.export import figure_of

    w = watching(7)
    w.session.show(add_pins(w.session.document, [7, 90, 300]))
    w.session.show(show_regions(w.session.document, 1))
    loaded, document = w.session.loaded(), w.session.document
    figure = figure_of(Recipe(document, Page()), {"A": loaded}, [w.session.shown[k].answer for k in range(3)])
    assert [any(line.look is BOUNDARY for line in panel.lines) for panel in figure.panels] == [False, True, False]
    found = voronoi_regions(loaded.surface, w.distance(SHOWN[1]).from_sources([7, 90, 300]))
    length = 0.0
    for line in (line for line in figure.panels[1].lines if line.look is BOUNDARY):
        points = line.positions(loaded.surface.vertices)
        points = np.vstack([points, points[:1]]) if line.is_closed else points
        length += np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert length == pytest.approx(found.lengths.sum(), rel=1e-9)
