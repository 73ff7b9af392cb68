"""Figures of a set: where their colours end, the contact sheet, the page."""

import html.parser
import json
from dataclasses import replace
from urllib.parse import unquote

import numpy as np
import pytest
from PIL import Image

from app.batch.execution import run_task
from app.batch.figures import length_power, shared_maxima
from app.batch.mesh_files import find_mesh_files
from app.batch.pages import write_pages
from app.batch.scheduler import tasks_for
from app.batch.storage import Folder
from app.batch.task import Failure
from app.batch.work_order import MAXIMA, RANGES, WorkOrder
from app.document.camera import Camera
from app.document.document import comparison
from app.document.file import recipe_text
from app.document.looks import Isolines
from app.document.page import Recipe
from app.figures.contact_sheet import LARGEST, SheetEntry, contact_sheet
from bihdist_core import Surface, write_mesh
from bihdist_core.distances.distance_types import BUILT_IN, Spec
from bihdist_core.laplacian import Laplacian
from tests.shapes import bumpy

SHOWS = (Spec.of("biharmonic"), Spec.of("commute-time"))


@pytest.fixture(scope="module")
def meshes(tmp_path_factory):
    """The same shape twice, once 50 times as large."""
    place = tmp_path_factory.mktemp("meshes")
    small = bumpy(200)
    write_mesh(place / "a small.off", small)
    write_mesh(place / "large.off", Surface(50 * small.vertices, small.faces))
    return place


def drawn(meshes, out, range, document):
    """The rows of all figures."""
    # Of meshes of other sizes, round values would be elsewhere.
    document = replace(document, isolines=Isolines(round=False))
    recipe = recipe_text(Recipe(document), "1")
    wanted = WorkOrder((MAXIMA,), recipe=recipe, range=range)

    def rows(asked):
        tasks, _ = tasks_for(find_mesh_files([str(meshes)]).paths, asked, str(out), "1")
        reports = [run_task(task) for task in tasks]
        assert not [each.failures for each in reports if each.failures]
        return sorted((row for each in reports for row in each.rows), key=lambda row: row.name)

    ends = shared_maxima([row.metadata for row in rows(wanted)], range) if range != "own" else ()
    return rows(replace(wanted, works=("figure",), maxima=ends))


@pytest.mark.parametrize("range", RANGES)
def test_colours_end_where_the_set_says(meshes, tmp_path, range):
    small, large = drawn(meshes, tmp_path, range, comparison("mesh", SHOWS))
    for k, power in enumerate([1, 0]):
        one, other = small.metadata["panels"][k], large.metadata["panels"][k]
        assert other["maximum"] == pytest.approx(50**power * one["maximum"], rel=1e-6)
        ends = {"size": 50**power * one["maximum"], "shared": max(one["maximum"], other["maximum"])}
        assert other["colours_end_at"] == pytest.approx(ends.get(range, other["maximum"]), rel=1e-6)
    assert small.metadata["panels"][0]["colours_end_at"] == pytest.approx(
        large.metadata["panels"][0]["maximum"] if range == "shared" else small.metadata["panels"][0]["maximum"],
        rel=1e-6,
    )
    one, other = (np.asarray(Image.open(tmp_path / row.metadata["file"]).convert("RGB"), int) for row in (small, large))
    # The upper half has no numbers.
    half = len(one) // 2
    is_alike = np.abs(one[:half] - other[:half]).max(axis=2).mean() < 1
    assert is_alike == (range != "shared")


def test_a_camera_looks_the_same_way_and_as_near_as_it_fits(meshes, tmp_path):
    camera = Camera((9.0, 2.0, 1.0), (0.5, 0.0, 0.0), (0.0, 0.0, 1.0), (0.3, 0.3))
    document = replace(comparison("mesh", SHOWS[:1]), camera=camera)
    small, large = drawn(meshes, tmp_path, "size", document)
    one, other = (np.asarray(Image.open(tmp_path / row.metadata["file"]).convert("L"), int) for row in (small, large))
    half = len(one) // 2
    assert np.abs(one[:half] - other[:half]).mean() < 1
    assert (one[:half] < 200).mean() > 0.2
    (home, _) = drawn(meshes, tmp_path / "home", "size", comparison("mesh", SHOWS[:1]))
    other = np.asarray(Image.open(tmp_path / "home" / home.metadata["file"]).convert("L"), int)
    assert np.abs(one[:half] - other[:half]).mean() > 3


def test_the_page_links_what_is_there_and_says_what_is_not(meshes, tmp_path):
    rows = drawn(meshes, tmp_path, "size", comparison("mesh", SHOWS))
    failures = [Failure("lost <&>", "figure", "", "It is lost."), Failure("a small", "fields", "", "other work")]
    assert write_pages(Folder(str(tmp_path)), rows, failures) == ["contact_sheet.png", "index.html"]
    text = (tmp_path / "index.html").read_text()
    page = Page()
    page.feed(text)
    assert page.open == []
    names = ["a small", "large"]
    links = [unquote(each) for each in page.links]
    assert links == [f"{name}.figure.{ending}" for name in names for ending in ("png", "json")]
    assert [unquote(each) for each in page.pictures] == [f"thumbnails/{name}.jpg" for name in names]
    for each in (*links, *map(unquote, page.pictures)):
        assert (tmp_path / each).is_file()
    assert json.loads((tmp_path / links[1]).read_text())["panels"][0]["label"] == "biharmonic, exact"
    assert "lost &lt;&amp;&gt;" in text
    assert "It is lost." in text
    assert "other work" not in text
    assert "biharmonic: colours end at " in text
    assert "√area of each mesh<br>commute-time: colours end at " in text
    assert all((tmp_path / each).stat().st_size < 60_000 for each in map(unquote, page.pictures))


class Page(html.parser.HTMLParser):
    """What is open at the end, the links, the pictures."""

    def __init__(self):
        super().__init__()
        self.open, self.links, self.pictures = [], [], []

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        if tag == "a":
            self.links.append(named["href"])
        if tag == "img":
            assert named["loading"] == "lazy"
            self.pictures.append(named["src"])
        if tag not in ("meta", "img", "input", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_a_sheet_of_hundreds_is_no_larger_than_a_screen_or_two():
    picture = Image.new("RGB", (480, 400), "#0A7358")
    cells = [SheetEntry(f"{'a long name ' * 5}{k}", picture) for k in range(399)] + [
        SheetEntry("missing", failure="It is lost. " * 9)
    ]
    sheet = contact_sheet(cells, ["biharmonic: colours end at 1.2 √area of each mesh"])
    assert max(sheet.size) <= LARGEST
    counts = np.asarray(sheet.convert("RGB")).reshape(-1, 3)
    assert (np.abs(counts - [10, 115, 88]).max(axis=1) < 3).mean() > 0.5


@pytest.mark.parametrize("kind", BUILT_IN, ids=lambda kind: kind.word)
def test_units_tell_how_distances_scale(kind):
    values = {"alpha": 1.2, "k": 20}
    distance = Spec.of(kind.word, **{p.name: values[p.name] for p in kind.parameters if p.name in values})
    made = distance.build(Laplacian(bumpy(120)))
    assert length_power(made.unit) == pytest.approx(made.length_power, rel=1e-5)
