"""`bihdist.show`: the window from Python."""

import gc
import weakref
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from qtpy import QtCore, QtTest

import app
from app.document.document import Document
from app.document.edits import remove_panel
from app.document.file import read_recipe
from app.document.looks import Colours
from bihdist_core import (
    BiharmonicDistance,
    BihdistError,
    BoundaryLoop,
    Curve,
    MeshError,
    ParameterError,
    SourceSet,
    SurfacePoint,
    VertexError,
)
from tests.core.test_merging import torn
from tests.qt.parts import parts
from tests.qt.test_head import choose
from tests.shapes import bumpy, grid, torus, two_pieces

ROOT = Path(__file__).resolve().parents[2]
SURFACE = bumpy(300)
HEIGHT = SURFACE.vertices[:, 1]


pytestmark = pytest.mark.usefixtures("own_folder")


@pytest.fixture
def shown(application):
    """`show` without waiting; closes what was opened."""
    viewers = []

    def show(*arguments, **options):
        viewers.append(app.show(*arguments, block=False, **options))
        return viewers[-1]

    yield show
    for viewer in viewers:
        viewer.close()


# ---------------------------------------------------------------------- what it shows
def test_arrays_and_fields_have_panels_and_the_right_numbers(shown):
    viewer = shown(
        SURFACE, ["biharmonic", "biharmonic - height"], {"height": HEIGHT - HEIGHT.min(), "bend": -HEIGHT}, 7
    )
    exact, difference, bend = viewer.panels
    assert repr(viewer) == "Viewer(biharmonic, biharmonic - height, bend, of bumpy)"
    field = BiharmonicDistance(SURFACE).from_source(7)
    assert np.allclose(exact.field, field, atol=1e-12)
    height = HEIGHT - HEIGHT.min()
    assert np.allclose(difference.field, 100 * (field / field.max() - height / height.max()), atol=1e-10)
    assert (difference.quantity, difference.label, difference.unit) == (
        "biharmonic - height",
        "biharmonic, exact − height",
        "percentage points",
    )
    assert np.array_equal(bend.field, -HEIGHT)


def test_vertices_and_faces_or_a_file_are_the_same_mesh(shown, mesh_file):
    for mesh in ((SURFACE.vertices.tolist(), SURFACE.faces.tolist()), Path(mesh_file(SURFACE))):
        (panel,) = shown(mesh, ["biharmonic"], source=7).panels
        assert np.allclose(panel.field, BiharmonicDistance(SURFACE).from_source(7), rtol=1e-6)


def test_a_second_mesh_stands_beside_the_first(shown, mesh_file):
    surface = torus(16, 8)
    viewer = shown(mesh_file(SURFACE), ["biharmonic"], source=3, second_mesh=(surface.vertices, surface.faces))
    first, second = viewer.document.panels
    assert [panel.surface for panel in (first, second)] == ["A", "B"]
    there = BiharmonicDistance(surface)
    source = viewer.document.point(second.shows.point).at
    np.testing.assert_allclose(viewer.panels[1].field, there.from_source(source), rtol=1e-12, atol=1e-12)


def test_the_source_moves_and_the_numbers_are_those_from_there(shown):
    viewer = shown(SURFACE, ["biharmonic"], source=7)
    viewer.source = 20
    assert viewer.source == 20
    assert viewer.panels[0].field[20] == 0
    with pytest.raises(VertexError, match="no vertex 5000"):
        viewer.source = 5000
    assert viewer.source == 20


def test_the_source_is_of_any_kind_in_objects_and_in_words(shown):
    surface = grid(9, 9)
    viewer = shown(surface, ["biharmonic"], source="12+40")
    assert viewer.source == SourceSet((12, 40))
    place = SurfacePoint.of(31, 0.25, 0.5)
    curve = Curve((place, SurfacePoint.of(60, 0.2, 0.2)))
    exact = BiharmonicDistance(surface)
    for given, kept in [
        (place, place),
        ("f31:0.25,0.5", place),
        (BoundaryLoop(0), BoundaryLoop(0)),
        ("loop:0+7", SourceSet((BoundaryLoop(0), 7))),
        (curve, curve),
        (SourceSet((3, place)), SourceSet((3, place))),
        (np.int64(5), 5),
        ("5", 5),
    ]:
        viewer.source = given
        assert viewer.source == kept
        assert np.abs(viewer.panels[0].field - exact.from_source(kept)).max() <= 1e-9
    for wrong, said in [
        ("loop:3", "its only one is loop:0"),
        ("f900:0.2,0.2", "no face 900"),
        ("banana", "is not a source"),
        (None, "A source is a vertex id"),
        (-1, "start at 0"),
    ]:
        with pytest.raises(ParameterError, match=said):
            viewer.source = wrong
    assert viewer.source == 5


def test_a_document_is_shown_and_can_be_undone(shown):
    viewer = shown(SURFACE, ["biharmonic", "geodesic"])
    before = viewer.document
    viewer.document = replace(before, isolines=7, panels=before.panels[:1])
    assert len(viewer.panels) == 1
    viewer._window.session.undo()
    assert viewer.document == before
    with pytest.raises(BihdistError, match="not there"):
        viewer.document = replace(before, surfaces=(replace(before.surfaces[0], path="gone.off"),))
    with pytest.raises(ParameterError, match="no colour map 'jet'"):
        viewer.document = replace(before, colours=Colours("jet"))
    assert viewer.document == before


@pytest.mark.parametrize("end", ["cancel", "close"])
def test_waiting_ends_where_the_user_stops_it(shown, mesh_file, end):
    viewer = shown(SURFACE, ["biharmonic"])
    window = viewer._window
    QtCore.QTimer.singleShot(0, window.context.actions["stop"].trigger if end == "cancel" else window.close)
    other = replace(viewer.document.surfaces[0], path=mesh_file(bumpy(20_000)), sha256="")
    with pytest.raises(BihdistError, match="cancelled" if end == "cancel" else "closed"):
        viewer.document = replace(viewer.document, surfaces=(other,))


def test_numbers_of_numpy_are_numbers(shown, tmp_path):
    viewer = shown(SURFACE, ["biharmonic"], source=HEIGHT.argmax())
    parts(viewer._window).session_file.save(str(tmp_path / "s.json"))
    assert read_recipe(tmp_path / "s.json").document.sources == (int(HEIGHT.argmax()),)
    drawn = app.figure(
        SURFACE,
        ["biharmonic"],
        np.int64(5),
        marks={"anchors": {np.int64(7): np.float32(0.1)}},
        view={"insets": [np.int32(3)]},
    )
    assert drawn.save(tmp_path / "f.png").exists()


@pytest.mark.parametrize("document", [Document(), None])
def test_what_is_no_document_with_a_mesh_is_refused(shown, document):
    viewer = shown(SURFACE, ["biharmonic"])
    with pytest.raises(ParameterError, match="with one mesh"):
        viewer.document = document
    assert viewer.panels[0].field is not None


def test_on_pick_is_a_function(application):
    with pytest.raises(ParameterError, match="on_pick must be a function, not 3"):
        app.show(SURFACE, on_pick=3)


def test_where_a_difference_is_nothing_no_line_is_drawn(shown):
    plateau = np.where(np.median(HEIGHT) < HEIGHT, 0.0, 1.0)
    viewer = shown(
        SURFACE,
        ["same - same", "plateau - nothing"],
        {"same": np.ones(len(HEIGHT)), "plateau": plateau, "nothing": np.zeros(len(HEIGHT))},
    )
    viewer.panels  # noqa: B018
    window, views = viewer._window, {}
    for count in (0, 2):  # of so few only that at 0 is there
        parts(window).isolines.steps(count)
        viewer.panels  # noqa: B018
        views[count] = [panel.view.shot() for panel in window.grid.panels]
    lines = [(some != others).any(axis=2).mean() for some, others in zip(*views.values(), strict=True)]
    assert lines[0] == 0
    assert 0.001 < lines[1] < 0.006
    assert window.grid.panels[0].answer.largest is None


def test_where_a_field_ends_there_is_no_seam_of_other_values(shown):
    share = (HEIGHT - HEIGHT.min()) / np.ptp(HEIGHT)
    viewer = shown(SURFACE, [], {"upper": np.where(share < 0.4, np.nan, 0.5 + share)})
    viewer.panels  # noqa: B018
    picture = viewer._window.grid.panels[0].view.shot().astype(int)
    blue = (picture[..., 2] - picture[..., 0] > 40).sum()
    # All values are in the upper half of the colours, which has no blue.
    assert blue < 20


def test_the_screenshot_is_taken_once_all_is_there(shown, tmp_path):
    viewer = shown(SURFACE, ["biharmonic", "geodesic"])
    assert viewer.screenshot(tmp_path / "w.png").stat().st_size > 10_000
    assert viewer._window.session.is_complete


def test_fields_of_one_surface_alone(shown):
    viewer = shown(SURFACE, [], {"height": HEIGHT})
    assert viewer.source is None
    assert [panel.quantity for panel in viewer.panels] == ["height"]
    with pytest.raises(BihdistError, match="with a source"):
        viewer.source = 3


def test_after_closing_it_says_so(shown):
    viewer = shown(SURFACE, ["biharmonic"])
    viewer.close()
    viewer.close()
    assert (viewer.is_open, repr(viewer)) == (False, "Viewer(closed)")
    for name in ("source", "panels", "document"):
        with pytest.raises(BihdistError, match="closed"):
            getattr(viewer, name)


def test_a_window_that_was_closed_leaves_nothing_in_memory(shown):
    from qtpy.QtTest import QTest

    viewer = shown(SURFACE, ["biharmonic", "diffusion"])
    kept = [weakref.ref(each) for each in (viewer._window, viewer._session, viewer._window.grid)]
    viewer.close()
    QTest.qWait(50)
    gc.collect()
    assert [each() for each in kept] == [None] * 3


# ---------------------------------------------------------------------- picking
def click(viewer, share=(0.5, 0.5)):
    view = viewer._window.grid.panels[0].view
    place = QtCore.QPoint(int(share[0] * view.width()), int(share[1] * view.height()))
    QtTest.QTest.mouseClick(view, QtCore.Qt.MouseButton.LeftButton, pos=place)


def told(picks):
    """Wait for a pick."""
    from app.qt.application import run_until

    run_until(lambda: len(picks) > 0)


@pytest.mark.parametrize(
    ("act", "after"),
    [
        (lambda viewer, pick: setattr(viewer, "source", 5), lambda viewer: viewer.source == 5),
        (lambda viewer, pick: viewer.close(), lambda viewer: not viewer.is_open),
        (
            lambda viewer, pick: setattr(viewer, "document", remove_panel(viewer.document, pick.panel)),
            lambda viewer: [panel.quantity for panel in viewer.panels] == ["geodesic"],
        ),
        (lambda viewer, pick: viewer.panels, lambda viewer: viewer.panels[0].field[viewer.source] == 0),
    ],
)
def test_a_callback_may_do_anything_with_the_window(shown, act, after):
    done = []
    viewer = shown(SURFACE, ["biharmonic", "geodesic"], source=7)
    viewer._on_pick = lambda pick: (act(viewer, pick), done.append(pick))
    viewer.panels  # noqa: B018
    click(viewer)
    told(done)
    assert after(viewer)


def test_a_pick_tells_where_and_what_was_there_before_the_source_came(shown):
    picks = []
    viewer = shown(SURFACE, ["biharmonic", "geodesic"], {"height": HEIGHT}, 7, on_pick=picks.append)
    before = viewer.panels
    click(viewer)
    told(picks)
    (pick,) = picks
    assert pick.panel == 0
    assert pick.vertex in SURFACE.faces[pick.face]
    assert np.allclose(pick.weights @ SURFACE.vertices[SURFACE.faces[pick.face]], pick.position)
    assert pick.values == {panel.id: panel.field[pick.vertex] for panel in before}
    assert viewer.source == pick.vertex
    click(viewer, (0.01, 0.01))
    assert len(picks) == 1


def test_where_nothing_is_defined_a_pick_has_no_value(shown):
    from app.qt.panels.events import Click

    picks = []
    surface = two_pieces()
    viewer = shown(surface, ["biharmonic"], source=int(surface.faces[-1, 0]), on_pick=picks.append)
    field = viewer.panels[0].field
    viewer._window.grid.events.emit(0, Click(_met(surface, int(np.flatnonzero(np.isnan(field))[0]))))
    told(picks)
    assert np.isnan(picks[0].values[0])


def _met(surface, vertex):
    from app.scene.picking import Hit

    face = int(np.flatnonzero((surface.faces == vertex).any(axis=1))[0])
    weights = (surface.faces[face] == vertex).astype(float)
    return Hit(face, weights, surface.vertices[vertex], vertex)


def test_an_error_in_a_callback_is_told_and_the_window_lives_on(shown, capsys):
    def on_pick(pick):
        raise ZeroDivisionError("mine")

    viewer = shown(SURFACE, ["biharmonic"], source=7, on_pick=on_pick)
    viewer.panels  # noqa: B018
    click(viewer)
    viewer.panels  # noqa: B018
    assert "ZeroDivisionError: mine" in capsys.readouterr().err
    assert viewer.source != 7


# ---------------------------------------------------------------------- what cannot be shown
@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ((SURFACE, ["euclidean"]), ParameterError, "no distance 'euclidean'"),
        (("gone.off",), ParameterError, "gone.off is not there"),
        ((SURFACE, ["biharmonic"], None, 5000), BihdistError, "no vertex 5000"),
        ((SURFACE, ["biharmonic"], {"mine": [1.0]}), BihdistError, "has 1 values"),
        (((SURFACE.vertices, [[0, 1, 99_999]]),), MeshError, "99999"),
        ((SURFACE, "biharmonic"), ParameterError, "not a text"),
        ((SURFACE, [7]), ParameterError, "7 is not a distance"),
        ((SURFACE, ["biharmonic"], HEIGHT), ParameterError, "by name"),
        ((SURFACE, ["biharmonic"], {1: HEIGHT}), ParameterError, "The name of a field is a string"),
        ((SURFACE, ["biharmonic"], None, 2.5), ParameterError, "a vertex id, .* not 2.5"),
        ((SURFACE, ["biharmonic - mie"], {"mine": HEIGHT}), ParameterError, "The fields are mine"),
        (("README.md",), BihdistError, "README.md"),
    ],
)
def test_what_cannot_be_shown_is_raised_and_no_window_stays(application, monkeypatch, arguments, error, words):
    monkeypatch.chdir(ROOT)
    with pytest.raises(error, match=words):
        app.show(*arguments, block=False)
    assert not [window for window in application.topLevelWidgets() if window.isVisible()]


# ---------------------------------------------------------------------- what is done with it
def test_a_mesh_is_shown_cut_and_merged(shown, tmp_path):
    soup = torn(SURFACE)
    keeps = soup.vertices[:, 2] < 0.5
    np.save(tmp_path / "keeps.npy", keeps)
    start = int(np.flatnonzero(keeps[soup.faces].all(axis=1))[0]) * 3
    expected, ids = soup.without(~keeps).merged(1e-9)
    viewer = shown(soup, ["biharmonic"], source=int(ids[start]), cut=tmp_path / "keeps.npy", merge=1e-9)
    field = BiharmonicDistance(expected).from_source(int(ids[start]))
    np.testing.assert_allclose(viewer.panels[0].field, field, rtol=1e-9)
    gone = int(np.flatnonzero(~keeps)[0])
    with pytest.raises(BihdistError, match=f"vertex {gone} belongs to no face.*the nearest that does is"):
        shown(SURFACE.without([gone]), ["biharmonic"], source=gone)


def test_the_session_of_such_a_window_is_saved_opened_and_drawn(shown, screen, tmp_path):
    from app.main import main

    viewer = shown(SURFACE, ["biharmonic", "biharmonic - height"], {"height": HEIGHT - HEIGHT.min()}, 7)
    fields = [panel.field for panel in viewer.panels]
    parts(viewer._window).session_file.save(str(tmp_path / "s.json"))
    archive = Path(read_recipe(tmp_path / "s.json").arrays)
    assert sorted(tmp_path.iterdir()) == [archive, tmp_path / "s.json"]
    assert read_recipe(tmp_path / "s.json").document == viewer.document
    s = screen()
    parts(s.window).session_file.open(str(tmp_path / "s.json"))
    s.until(lambda: s.session.is_complete)
    assert s.document == viewer.document
    for answer, field in zip(s.answers, fields, strict=True):
        assert np.array_equal(answer.field, field)
    assert s.panels[1].head.name.text() == "Biharmonic − height"
    assert (
        main(["figure", "--recipe", str(tmp_path / "s.json"), "--size", "600x300", "-o", str(tmp_path / "f.png")]) == 0
    )
    s.window.close()


def test_a_field_is_chosen_in_a_panel_like_a_distance(shown):
    viewer = shown(SURFACE, ["biharmonic", "height"], {"height": HEIGHT}, 7)
    head = viewer._window.grid.panels[0].head
    choose(head, "height")
    assert [panel.quantity for panel in viewer.panels] == ["height", "height"]
    choose(head, "Difference with", "Biharmonic")
    assert viewer.panels[0].quantity == "height - biharmonic"
    choose(head, "Show the first alone")
    choose(head, "Diffusion")
    assert viewer.panels[0].quantity == "diffusion"
    for _ in range(3):
        viewer._window.session.undo()
    assert (viewer.panels[0].quantity, head.name.text()) == ("height", "height")
