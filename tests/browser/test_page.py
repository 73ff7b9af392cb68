"""Pages that compute, in browsers with no network: what they show is what the library says of their mesh."""

import io
import re

import numpy as np
import pytest
from PIL import Image

import app as bihdist
from app.document.quantities import quantity
from bihdist_core import PointCloud, TetrahedralMesh
from bihdist_core.distances.answers import Distances

from ..core.test_tetrahedra import ball
from ..shapes import bumpy
from .shown_page import VIEW, ShownPage, made

DISTANCES = ("biharmonic", "commute-time", "geodesic(method=exact)")
SPECS = [quantity(each).specs[0] for each in DISTANCES]


@pytest.fixture(scope="module", params=["hand", "hare"])
def hand_or_pieces(request, tmp_path_factory):
    """A closed mesh, and one in pieces with boundaries."""
    return made(request.param, DISTANCES, tmp_path_factory.mktemp("page"))


def test_each_click_shows_the_distances_of_the_library(browser, hand_or_pieces):
    shown, sources = ShownPage(browser, *hand_or_pieces), set()
    for x, y in shown.places(3):
        shown.click(x, y)
        sources.add(shown.shown[0])
        assert max(shown.worst(SPECS)) < 1e-9
    assert len(sources) == 3
    assert browser.errors == []
    assert browser.requests == []


def test_a_click_of_the_mouse_sets_the_source_and_a_drag_turns(browser, hand_or_pieces):
    shown = ShownPage(browser, *hand_or_pieces)
    (place,) = shown.places(1, seed=3)
    before, at = shown.shown[0], shown.at(*place)
    assert shown.click(*place)["since"] > 0
    after = shown.shown[0]
    assert after != before
    camera = browser.evaluate(f"JSON.stringify({VIEW}.sight.camera)")
    browser.drag(at, (at[0] + 60, at[1] + 20))
    assert shown.shown[0] == after
    assert browser.evaluate(f"JSON.stringify({VIEW}.sight.camera)") != camera


def test_each_panel_shows_its_field_as_soon_as_it_is_there(browser, tmp_path):
    shown = ShownPage(browser, *made("hand", ("biharmonic", "geodesic"), tmp_path))
    # What the worker says of geodesic distance is held back.
    browser.evaluate(f"void ({VIEW}.solver.slow.receive = (said) => (window.held = said))")
    before = shown.shown[0]
    browser.click(*shown.at(*shown.places(1, seed=3)[0]))
    sources = f"{VIEW}.answers.map(({{ source }}) => {VIEW}.mesh.ids[source])"
    browser.until(f"{sources}[0] !== {before}")
    after = shown.shown[0]
    assert browser.evaluate(sources) == [after, before]
    late = "[...document.querySelectorAll('.bihdist .panel')].map((each) => each.classList.contains('computing'))"
    browser.until(f"{late}[1]")
    assert browser.evaluate(late) == [False, True]
    bars = "[...document.querySelectorAll('.bihdist .scale')].map((each) => each.getAttribute('aria-label'))"
    assert browser.evaluate(bars)[0].startswith("Colours: ")
    assert browser.evaluate(bars)[1] == "Computing"
    pale = np.array(Image.open(io.BytesIO(browser.screenshot())).convert("L"))
    browser.until("window.held")
    browser.evaluate(f"void (delete {VIEW}.solver.slow.receive, {VIEW}.solver.slow.receive(window.held))")
    browser.until(f"!{late}[1]")
    full = np.array(Image.open(io.BytesIO(browser.screenshot())).convert("L"))
    assert browser.evaluate(sources) == [after, after]
    assert max(shown.worst([quantity(each).specs[0] for each in ("biharmonic", "geodesic(method=exact)")])) < 1e-9
    middle = full.shape[1] // 2
    assert (full[:, middle:] < 200).sum() > 1.5 * (pale[:, middle:] < 200).sum()
    assert browser.errors == []


def test_labels_have_their_colours_with_nothing_between_and_a_legend(browser, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    s, path = bumpy(2000), tmp_path / "lh.sides.annot"
    colours = np.array([(0, 0, 255, 0), (255, 0, 0, 0)])
    nibabel.freesurfer.write_annot(path, (s.vertices[:, 0] > 0).astype(int), colours, ["left", "right"], fill_ctab=True)
    page = bihdist.page(s, tmp_path / "p.html", [], fields={"sides": str(path)}, view={"cpos": "front"})
    shown = ShownPage(browser, page, tmp_path / "p.html")
    picture = np.array(Image.open(io.BytesIO(browser.screenshot())).convert("RGB")).astype(int)
    red, green, blue = np.moveaxis(picture[60:-120], 2, 0)
    is_red, is_blue = (red > 2 * blue + 40) & (green < 30), (blue > 2 * red + 40) & (green < 30)
    assert min(is_red.sum(), is_blue.sum()) > 5000
    between = (np.minimum(red, blue) > 50) & (green < 30)
    assert between.sum() < 0.02 * (is_red | is_blue).sum()
    bar = "document.querySelector('.bihdist .scale').getAttribute('aria-label')"
    assert browser.evaluate(bar) == "Colours: left, right, labels"
    browser.move(*shown.at(*shown.places(1)[0]))
    browser.until(f"{VIEW}.pointing.place")
    browser.until("/(left|right)/.test(document.querySelector('.bihdist .spoken').textContent)")
    assert browser.errors == []


def test_readers_choose_what_a_panel_shows(browser, tmp_path):
    page, path = made("hand", ("biharmonic", "geodesic"), tmp_path)
    shown = ShownPage(browser, page, path)
    heads = "[...document.querySelectorAll('.bihdist .panel select')].map((each) => each.selectedOptions[0].text)"
    assert browser.evaluate(heads) == ["biharmonic, exact", "geodesic, exact"]
    options = browser.evaluate("[...document.querySelector('.bihdist select').options].map((each) => each.text)")
    assert options == [
        "biharmonic, exact",
        "geodesic, exact",
        "commute-time, exact",
        "1/λ^1.5, exact",
        "diffusion, t = 1",
    ]

    def choose(panel, label):
        browser.evaluate(
            f"((head) => {{ head.selectedIndex = {options.index(label)}; head.dispatchEvent(new Event('change')) }})"
            f"(document.querySelectorAll('.bihdist select')[{panel}])"
        )
        browser.until(f"{VIEW}.current.every((each) => each?.source === {VIEW}.source)")

    choose(1, "diffusion, t = 1")
    choose(0, "commute-time, exact")
    specs = [quantity(each).specs[0] for each in ("commute-time", "diffusion")]
    assert max(shown.worst(specs)) < 1e-7
    shown.click(*shown.places(1, seed=3)[0])
    assert max(shown.worst(specs)) < 1e-7
    columns = browser.evaluate("[...document.querySelectorAll('.bihdist .pins th')].map((each) => each.textContent)")
    assert columns[2:4] == ["commute-time, exact", "diffusion, t = 1"]
    # The link holds what was chosen.
    link, source = browser.evaluate(f"{VIEW}.link.url"), shown.shown[0]
    assert "&panels=2,4&" in link
    browser.open("about:blank")
    browser.open(link)
    browser.until(f"{VIEW}?.answers.every(Boolean) && !{VIEW}.drawn", 100)
    assert browser.evaluate(heads) == ["commute-time, exact", "diffusion, t = 1"]
    assert shown.shown[0] == source
    assert max(shown.worst(specs)) < 1e-7
    assert browser.errors == []


def test_a_slider_moves_the_field_and_shows_what_is_there_until_the_next_is(browser, tmp_path):
    page, path = made("hand", ("biharmonic", "diffusion(t=1/4)", "power"), tmp_path)
    shown = ShownPage(browser, page, path)
    label, lane = "document.querySelectorAll('.bihdist select')[1].selectedOptions[0].text", f"{VIEW}.solver.shifted[0]"
    ready = f"!{VIEW}.isLate && {VIEW}.current.every((each) => each?.source === {VIEW}.source)"

    def slide(panel, word, value):
        at = [step["value"] for step in page.scene["functions"][word]["steps"]].index(value)
        browser.evaluate(
            f"((slider) => (slider.value = {at}, slider.dispatchEvent(new Event('input'))))"
            f"(document.querySelectorAll('.bihdist .panel input')[{panel}])"
        )

    hidden = "[...document.querySelectorAll('.bihdist .panel input')].map((each) => each.hidden)"
    assert browser.evaluate(hidden) == [True, False, False]
    # Where factors are missing, the field before is shown, pale, under the new name.
    browser.evaluate(f"(({lane}.receive = (data) => void (window.held ??= []).push(data)), 0)")
    slide(1, "diffusion", 0.016)
    browser.until(f"{VIEW}.isStale(1) && window.held?.length")
    assert browser.evaluate(label) == "diffusion, t = 0.016"
    assert re.search(r"Factoring, \d of 8", browser.evaluate("document.querySelector('.bihdist .status').textContent"))
    assert browser.evaluate(f"[{VIEW}.answers[1].source, {VIEW}.current[1], {VIEW}.isStale(0)]") == [None, None, False]
    browser.evaluate(f"void (delete {lane}.receive, window.held.forEach((each) => {lane}.receive(each)))")
    browser.until(ready)
    # Where they are there, the field moves within the event.
    slide(2, "power", 1.1)
    assert browser.evaluate(f"{VIEW}.answers[2].source === {VIEW}.source")
    browser.until(f"{VIEW}.scene.panels[2].unit === 'mesh units^0.1'")
    specs = [quantity(each).specs[0] for each in ("biharmonic", "diffusion(t=0.016)", "power(alpha=1.1)")]
    assert max(shown.worst(specs)) < 1e-7
    shown.click(*shown.places(1, seed=3)[0])
    browser.until(ready)
    assert max(shown.worst(specs)) < 1e-7
    # The link holds what was moved.
    link = browser.evaluate(f"{VIEW}.link.url")
    assert "&panels=0,1:0.016,2:1.1&" in link
    browser.open("about:blank")
    browser.open(link)
    browser.until(f"{VIEW}?.answers.every(Boolean) && {ready}", 100)
    assert browser.evaluate(label) == "diffusion, t = 0.016"
    assert max(shown.worst(specs)) < 1e-7
    assert browser.errors == []


def test_a_field_of_ones_own_is_shown_and_stays(browser, tmp_path):
    surface = bumpy(300)
    values = np.where(np.arange(300) < 20, np.nan, surface.vertices[:, 0])
    distances = ["biharmonic", "raw biharmonic - mine", "mine"]
    page = bihdist.page(surface, tmp_path / "p.html", distances, 0, fields={"mine": values})
    shown = ShownPage(browser, page, tmp_path / "p.html")
    (x, y), *_ = shown.places(1)
    shown.click(x, y)
    source, (biharmonic, difference, mine) = shown.shown
    assert source != 0
    np.testing.assert_allclose(mine, values[page.mesh.ids], atol=page.differs["field mine"] * np.nanmax(np.abs(values)))
    np.testing.assert_allclose(difference, biharmonic - mine, atol=1e-12)
    maps = browser.evaluate(f"[0, 1, 2].map((k) => {VIEW}.stage.mapOf(k) === {VIEW}.stage.colours.diverging)")
    assert maps == [False, True, True]
    own = "document.querySelectorAll('.bihdist .panel')[2].querySelector"
    assert browser.evaluate(f"{own}('h2 > *').title") == "mine; the same from every source"
    assert "the same from every source" in browser.evaluate(f"{own}('.scale').getAttribute('aria-label')")
    # One that is undefined is not said to be apart from the source.
    vertex = int(np.flatnonzero(page.mesh.ids == 3)[0])
    browser.evaluate(f"{VIEW}.pin({vertex})")
    browser.until("document.querySelectorAll('.bihdist .pins .value').length === 3")
    words = browser.evaluate("[...document.querySelectorAll('.bihdist .pins .value')].map((each) => each.textContent)")
    assert words[1:] == ["undefined", "undefined"]
    assert browser.errors == []


@pytest.mark.parametrize("kind", ["points", "solid", "tufted"])
def test_points_solids_and_operators_answer_clicks_by_their_matrices(browser, tmp_path, kind):
    meshes = {"points": PointCloud(bumpy(800).vertices, "scan"), "solid": TetrahedralMesh(*ball(500), "ball")}
    path, names = tmp_path / "p.html", ["biharmonic", "diffusion"]
    page = bihdist.page(meshes.get(kind, bumpy(800)), path, names, operator=kind if kind == "tufted" else "cotan")
    specs, distances = [quantity(each).specs[0] for each in names], Distances(page.mesh.laplacian("voronoi"))
    shown, sources = ShownPage(browser, page, path, distances), set()
    for place in shown.places(3):
        shown.click(*place)
        sources.add(shown.shown[0])
        assert max(shown.worst(specs)) < 1e-7
    assert len(sources) == 3
    assert browser.errors == []


def test_a_page_says_what_its_clip_plane_cuts_away(browser, tmp_path):
    surface = bumpy(800)
    far, near = int(surface.vertices[:, 0].argmax()), int(surface.vertices[:, 0].argmin())
    page = bihdist.page(surface, tmp_path / "p.html", ["biharmonic"], far, view={"clip": "x@0.6", "cpos": "front"})
    shown = ShownPage(browser, page, tmp_path / "p.html")
    said = f"{VIEW}.stage.views[0].getAttribute('aria-description')"
    assert browser.evaluate(said) == f"Vertex {far} is cut away by the clip plane."
    note = np.array(Image.open(io.BytesIO(browser.screenshot())).convert("L"))[: int(shown.box["y"]) + 30]
    browser.evaluate(f"{VIEW}.setSource({near})")
    browser.until(f"{said} === ''")
    gone = np.array(Image.open(io.BytesIO(browser.screenshot())).convert("L"))[: int(shown.box["y"]) + 30]
    assert (note[-28:] < 160).sum() > 100 + (gone[-28:] < 160).sum()


def test_a_page_in_the_scene_of_a_stranger_runs_nothing_of_it(browser, tmp_path):
    """Names end no element, and what would get in all the same is refused by the page's policy."""
    page, path = made("hand", ("biharmonic",), tmp_path)
    hostile = "</script><script>document.title = 'taken'</script><img src=x onerror=\"document.title = 'taken'\">"
    page.scene["mesh"]["name"] = page.scene["title"] = hostile
    page.scene["panels"][0]["label"] = hostile
    page.scene["pins"] = [{"id": page.scene["source"], "name": hostile}]
    page.write(path)
    ShownPage(browser, page, path)
    assert browser.evaluate("document.title") == hostile
    assert browser.evaluate("document.querySelectorAll('img, script:not([type]):not(:last-of-type)').length") == 0
    text = path.read_text(encoding="utf-8").replace("<main", "<img src=x onerror=\"document.title = 'taken'\"><main")
    path.write_text(text, encoding="utf-8")
    browser.open(path)
    browser.until(f"{VIEW}?.answers.every(Boolean)", 100)
    assert browser.evaluate("document.title") == hostile
