"""The pictures and charts of `bihdist paper`: what is marked is told apart and seen, and nothing covers anything."""

import itertools

import numpy as np
import pytest

from app.figures.draw import ComposedPage, draw_figure, lay_out, take_shots
from app.figures.page_output import page_pixels
from app.paper import reproduce as reproducing
from app.paper.charts import colours_of, drawn, plain
from app.paper.page import Section, page
from app.paper.pictures import ANCHOR, CANDIDATE, FINER, TARGET, WIDTH, figure_of
from app.paper.reproduce import Pictures, png, reproduce
from app.scene.camera import directions
from bihdist_core import BihdistError, SolverError
from bihdist_core.experiments import EXPERIMENTS, Chart, Mark, Panel, Result, Series
from bihdist_core.progress import silent
from tests.shapes import bumpy

SURFACE = bumpy(600)
HEIGHT = SURFACE.vertices @ [0.3, 0.9, 0.2]
FIELD = HEIGHT - HEIGHT.min()


def outermost(view):
    """The vertex farthest out towards a standard view."""
    return int(np.argmax(SURFACE.vertices @ directions(view, "y")[0]))


def result(*panels, charts=()):
    return Result("fig1", "A title", "The protocol.", {"bumpy": SURFACE}, panels, charts)


def only(panels):
    return figure_of(result(*panels), panels)


def correspondence():
    known = [Mark(outermost(view), "anchor") for view in ("front", "back", "top")]
    target, place, candidate = (outermost(view) for view in ("left", "right", "bottom"))
    return only(
        (
            Panel("known", "bumpy", None, "row", (*known, Mark(target, "target")), ("back", "front")),
            Panel(
                "found",
                "bumpy",
                FIELD,
                "row",
                (*known, Mark(place, "place"), Mark(candidate, "candidate")),
                ("back", "front"),
            ),
        )
    )


# ---------------------------------------------------------------------- marks
def test_marks_are_told_apart_by_shape_and_colour():
    kinds = {"source", "anchor", "target", "candidate", "place", "minimum", "maximum"}
    figure = only((Panel("all", "bumpy", FIELD, "row", tuple(Mark(k, kind) for k, kind in enumerate(sorted(kinds)))),))
    marks = figure.panels[0].marks
    shapes = {mark.glyph for mark in marks}
    assert len(marks) == len(shapes) == len(figure.legend) == len(kinds)
    assert len({ANCHOR, TARGET, CANDIDATE}) == 3


def test_every_mark_of_a_correspondence_is_seen_inside_the_picture_from_one_side():
    figure = correspondence()
    layout = lay_out(figure)
    shots = take_shots(figure, layout, silent)
    for k, panel in enumerate(figure.panels):
        mine = [shot for shot in shots if shot.panel == k]
        seen = {mark[0] for shot in mine for mark in shot.marks}
        assert seen == set(range(len(panel.marks)))
        # What one view shows is not dashed in the other.
        assert not any(shot.ghosts for shot in mine)
        for shot in mine:
            for _, x, y in shot.marks:
                assert shot.box.holds(x, y)
                assert 0 < x < layout.width
                assert 0 < y < layout.height


def test_anchors_are_numbered_in_their_order_and_the_legend_has_their_values():
    marks = tuple(Mark(10 * k, "anchor", f"anchor, value {k}") for k in range(3))
    figure = only((Panel("one", "bumpy", FIELD, "row", marks),))
    assert {mark.vertex: mark.number for mark in figure.panels[0].marks} == {0: 1, 10: 2, 20: 3}
    assert [words for _, words in figure.legend] == ["anchor, value 0", "anchor, value 1", "anchor, value 2"]
    assert [words for _, words in correspondence().legend] == [
        "1 to 3: landmarks",
        "the point to match",
        "its match",
        "ground truth",
    ]


# ---------------------------------------------------------------------- words
def boxes_of(figure):
    """The boxes (left, top, right, bottom) of all words on a page, in units, and of the samples of its legend."""
    layout = lay_out(figure)
    words = [words for cell in layout.cells for words in (*cell.words, *(cell.bar.texts if cell.bar else ()))]
    words += [entry[3] for entry in layout.legend]
    found = []
    for each in words:
        for k, line in enumerate(each.lines):
            half = layout.lettering.width(line, each.size) / 2
            y = each.y + 1.2 * k * each.size
            found.append((each.x - half, y - 0.75 * each.size, each.x + half, y + 0.2 * each.size))
    for _, x, y, _ in layout.legend:
        found.append((x - layout.mark / 2, y - layout.mark / 2, x + layout.mark / 2, y + layout.mark / 2))
    return layout, found


@pytest.mark.parametrize("count", [1, 3, 4, 6])
def test_words_neither_cover_each_other_nor_leave_the_page(count):
    marks = (Mark(0, "source"), Mark(5, "minimum"), *(Mark(k, "anchor", f"anchor, value {k}") for k in range(7, 15)))
    panels = [
        Panel(f"diffusion t = 1, panel {k}", "bumpy", FIELD, "row", marks, ("front", "back")) for k in range(count)
    ]
    layout, boxes = boxes_of(only(panels))
    for left, top, right, bottom in boxes:
        assert left >= 0
        assert top >= 0
        assert right <= layout.width
        assert bottom <= layout.height
    for one, other in itertools.combinations(boxes, 2):
        apart = one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
        assert apart, (one, other)


# ---------------------------------------------------------------------- views
def test_a_row_is_seen_from_where_its_source_is():
    for view in ("front", "back", "left"):
        source = (Mark(outermost(view), "source"),)
        figure = only([Panel(f"biharmonic, {when}", "bumpy", FIELD, "noise", source, ("source",)) for when in "ab"])
        assert [panel.views for panel in figure.panels] == [(view,), (view,)]
        shots = take_shots(figure, lay_out(figure), silent)
        assert all(shot.marks and not shot.ghosts for shot in shots)


def test_before_and_after_stay_together():
    source = (Mark(outermost("back"), "source"),)
    headings = [f"{kind}, {when}" for kind in ("one", "two", "three") for when in ("before", "after")]
    figure = only([Panel(heading, "bumpy", FIELD, "noise", source, ("source",)) for heading in headings])
    assert figure.columns in (2, 6)
    assert [panel.heading for panel in figure.panels] == headings


def test_what_is_around_a_source_has_a_picture_and_isolines_of_its_own():
    vertex = outermost("front")
    radius = 0.2
    near = Panel("enlarged", "bumpy", FIELD, "row", (Mark(vertex, "source"),), ("zoom",), "surface", vertex, radius, 90)
    figure = only([Panel("all", "bumpy", FIELD, "row", (Mark(vertex, "source"),)), near])
    assert [panel.isolines.count for panel in figure.panels] == [20, 90]
    shots = take_shots(figure, lay_out(figure), silent)
    ((_, x, y),) = shots[1].marks
    assert (x, y) == pytest.approx(shots[1].box.middle, abs=1)
    assert len(shots) == 2


# ---------------------------------------------------------------------- resolution
def test_pictures_have_twice_the_pixels_of_the_page_and_look_as_its_size_says(tmp_path):
    panels = [Panel(f"panel {k}", "bumpy", FIELD, "row", (Mark(0, "source"),), ("front", "back")) for k in range(3)]
    figure = only(panels)
    layout = lay_out(figure)
    assert layout.scale == FINER == 2
    assert layout.width == pytest.approx(WIDTH, rel=0.2)
    pixels = draw_figure(figure)
    assert pixels.shape[1] == layout.page[0] == pytest.approx(FINER * layout.width, abs=1)
    # Labels and marks have the size of the page, in its pixels.
    assert layout.label == pytest.approx(8 / 0.75)
    assert 5 < layout.mark < 20
    shots = take_shots(figure, layout, silent)
    assert (page_pixels(ComposedPage(figure, layout, shots)) == pixels).all()


def test_the_page_shows_a_picture_half_as_wide_as_it_is():
    import io

    from PIL import Image

    picture = io.BytesIO()
    Image.new("RGB", (1200, 40)).save(picture, "PNG")
    text = page("Title", "", [Section(EXPERIMENTS["fig1"], result(), (("row", picture.getvalue()),))])
    assert 'width="600"' in text


# ---------------------------------------------------------------------- charts
def curves(*names, x=(1.0, 10.0, 100.0), y=(1.0, 2.0, 3.0), **logs):
    return Chart("a chart", "x", "y", tuple(Series(name, np.array(x), np.array(y)) for name in names), **logs)


def test_a_distance_has_one_colour_in_all_charts():
    one = colours_of(["biharmonic", "geodesic", "diffusion t = 1", "diffusion t = 1/4"])
    other = colours_of(["set-up", "diffusion t = 0.25", "Dijkstra", "biharmonic", "diffusion t = 1"])
    assert one[0] == other[3]
    assert one[1] == other[2]
    assert one[2] == other[4]
    assert one[3] == other[1]
    assert len(set(one)) == 4
    assert len(set(other)) == 5
    assert len(set(colours_of(["largest", "mean", "biharmonic", "commute-time"]))) == 4


def test_curves_of_one_colour_differ_by_their_dashes():
    axes = drawn(curves("biharmonic", "biharmonic, 200 eigenpairs")).axes[0]
    lines = axes.get_lines()
    assert lines[0].get_color() == lines[1].get_color()
    assert lines[0].get_linestyle() != lines[1].get_linestyle()


@pytest.mark.parametrize(
    "ends", [(1, 3), (100, 300), (1_000, 8_000), (1_000, 111_000), (2e-5, 0.9), (0.003, 0.04), (1, 1e9)]
)
@pytest.mark.parametrize("log", [False, True])
def test_ticks_are_plain_and_apart(ends, log):
    values = np.geomspace(*ends, 6)
    canvas = drawn(curves("biharmonic", x=values, y=values, log_x=log, log_y=log))
    canvas.draw_without_rendering()
    axes = canvas.axes[0]
    for axis, side in ((axes.xaxis, 0), (axes.yaxis, 1)):
        low, high = sorted(axis.get_view_interval())
        labels = [
            tick.label1
            for tick in axis.get_major_ticks() + axis.get_minor_ticks()
            if low <= tick.get_loc() <= high and tick.label1.get_text()
        ]
        assert len(labels) >= 2
        assert not any("$" in label.get_text() for label in labels)
        spans = sorted(
            (box.x0, box.x1) if side == 0 else (box.y0, box.y1)
            for box in (label.get_window_extent() for label in labels)
        )
        assert all(a[1] <= b[0] for a, b in itertools.pairwise(spans))


def test_numbers_at_ticks():
    assert [plain(x) for x in (0, 0.25, 100, 1_000, 16_000, -3.5)] == ["0", "0.25", "100", "1,000", "16,000", "−3.5"]
    assert [plain(x) for x in (1e-5, 2e-7, 1e9)] == ["10⁻⁵", "2 · 10⁻⁷", "10⁹"]


def test_a_picture_that_cannot_be_drawn_is_listed(tmp_path, monkeypatch):
    def broken(*_):
        raise SolverError("There is no light.")

    made = result(Panel("one", "bumpy", FIELD, "row"), charts=(curves("biharmonic"),))
    monkeypatch.setattr(reproducing.Experiment, "compute", lambda *_: made)
    monkeypatch.setattr("app.paper.reproduce.Worker.ask", broken)
    said = []
    done = reproduce(str(tmp_path), ["fig1"], say=said.append)
    assert done.not_done == 1
    assert "fig1: not done: the picture row: There is no light." in said
    assert "<svg" in done.page.read_text(encoding="utf-8")


def test_pictures_are_drawn_by_a_process_that_begins_with_the_first(tmp_path):
    figure = only([Panel("one", "bumpy", FIELD, "row")])
    with Pictures() as pictures:
        assert pictures._worker is None
        asked = [pictures.draw(tmp_path, name, figure) for name in ("a", "b")]
        assert [picture() for picture in asked] == [png(figure)] * 2
        assert {path.name for path in tmp_path.iterdir()} == {"a.png", "b.png"}
        process = pictures._worker._child.process
    assert process.returncode is not None, "it ends with the page"


def test_a_picture_that_ends_the_process_leaves_the_others(tmp_path):
    figure = only([Panel("one", "bumpy", FIELD, "row")])
    with Pictures() as pictures:
        pictures.draw(tmp_path, "a", figure)()
        pictures._worker._child.process.kill()
        with pytest.raises(BihdistError, match="process ended unexpectedly"):
            pictures.draw(tmp_path, "b", figure)()
        assert pictures.draw(tmp_path, "c", figure)() == png(figure)
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "c.png"}


def test_what_is_timed_comes_first(tmp_path, monkeypatch):
    monkeypatch.setattr(reproducing.Experiment, "compute", lambda *_: result(Panel("one", "bumpy", FIELD, "row")))
    said = []
    page = reproduce(str(tmp_path), ["fig1", "claims", "table2", "alpha"], say=said.append).page.read_text("utf-8")
    assert [line.partition(":")[0] for line in said if not line.startswith(" ")] == [
        "table2",
        "claims",
        "fig1",
        "alpha",
    ]
    places = [page.index(f'id="{id}"') for id in ("fig1", "table2", "alpha", "claims")]
    assert places == sorted(places)
    assert [id for id, each in EXPERIMENTS.items() if each.is_timed] == ["table1", "table2", "claims"]
