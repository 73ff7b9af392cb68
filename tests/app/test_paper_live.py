"""The pages that compute beside the paper's index: what they show of a figure, and what becomes of one that fails."""

import json
import re
import shutil

import numpy as np
import pytest

from app.paper import reproduce as reproducing
from app.paper.live import live_pages
from app.paper.reproduce import reproduce
from app.scene.camera import directions
from bihdist_core import Laplacian
from bihdist_core.distances.distance_types import Spec
from bihdist_core.experiments import Mark, Panel, Result, Shapes
from bihdist_core.experiments.fig1 import compute
from bihdist_core.experiments.shapes import distance as made_distance, spec_of
from tests.shapes import bumpy, grid

SURFACE, FLAT = bumpy(300), grid(6, 6)
FIELD = SURFACE.vertices[:, 1]
AT_THE_BACK = int(np.argmax(SURFACE.vertices @ directions("back", "y")[0]))


SOURCES = {"bumpy": (Mark(AT_THE_BACK, "source"),), "flat": (Mark(0, "source"),)}


def panel(heading="one", surface="bumpy", marks=None, distance="biharmonic", **more):
    field = FIELD if surface == "bumpy" else FLAT.vertices[:, 1]
    spec = None if distance is None else Spec.parse(distance)
    marks = SOURCES[surface] if marks is None else marks
    return Panel(heading, surface, field, "row", marks, ("front", "back"), distance=spec, **more)


def result(*panels):
    return Result("fig4", "A title", "The protocol.", {"bumpy": SURFACE, "flat": FLAT}, panels)


def pages(*panels):
    return live_pages(result(*panels), "row", panels)


def scene_in(path):
    text = path.read_text(encoding="utf-8")
    return json.loads(re.search(r'<script type="application/json" id="scene">(.*?)</script>', text, re.S)[1])


def test_a_page_has_the_panels_of_a_mesh_as_the_figure_shows_them():
    panels = panel(isoline_count=12), panel("two", distance="diffusion(t=1)"), panel("flat", "flat")
    bumpy_page, flat_page = pages(*panels)
    assert (bumpy_page.file, flat_page.file) == ("fig4-row-bumpy.html", "fig4-row-flat.html")
    document = bumpy_page.document
    assert [str(each.shows.specs[0]) for each in document.panels] == ["biharmonic", "diffusion"]
    assert bumpy_page.given.surface(document.surfaces[0]) is SURFACE
    assert document.points[0].at == AT_THE_BACK
    assert (document.isolines.count, document.isolines.round, document.camera) == (12, False, "back")
    assert not bumpy_page.notes
    assert [each.file for each in pages(panels[0])] == ["fig4-row.html"]


def test_what_the_figure_has_and_the_page_has_not_is_said():
    extrema = Mark(AT_THE_BACK, "source"), Mark(3, "minimum"), Mark(4, "maximum")
    bare = Panel("bare", "bumpy", None, "row", extrema[:1])
    failed = Panel("diffusion", "bumpy", None, "row", extrema[:1], failure="It was late.")
    heat = panel("geodesic, heat method", distance="geodesic(method=heat)", style="height")
    (page,) = pages(bare, failed, heat, panel(marks=extrema))
    assert page.left_out == (
        *("the bare surface", "diffusion", "geodesic, heat method", "fields as heights"),
        "marks of local minima and maxima",
    )
    assert [str(each.shows.specs[0]) for each in page.document.panels] == ["biharmonic"]
    assert page.notes[0].startswith("In the figure only: the bare surface, ")
    assert not pages(bare, failed, heat, panel(distance=None), panel(marks=()))


def test_geodesic_distance_is_exact_in_every_experiment():
    assert str(spec_of("geodesic")) == "geodesic(method=exact)"
    assert made_distance(Laplacian(bumpy(60)), "geodesic").method == "exact"
    assert str(spec_of("diffusion t = 1/4")) == "diffusion(t=1/4)"


def test_the_index_links_to_the_pages_and_one_that_fails_is_named(tmp_path, monkeypatch):
    panels = panel(marks=(Mark(AT_THE_BACK, "source"), Mark(3, "minimum"))), panel("flat", "flat", distance="truncated")
    monkeypatch.setattr(reproducing.Experiment, "compute", lambda *_: result(*panels))
    said = []
    made = reproduce(str(tmp_path / "out"), ["fig4"], say=said.append)
    text = made.page.read_text(encoding="utf-8")
    assert re.findall('<a href="([^#"]+)">', text) == ["fig4-row-bumpy.html"]
    assert "In the figure only: marks of local minima." in text
    assert made.not_done == 1
    assert "the live page fig4-row-flat.html: grid has 48 eigenpairs besides the constant" in text
    assert any("fig4: not done: the live page fig4-row-flat.html" in line for line in said)
    scene = scene_in(tmp_path / "out/fig4-row-bumpy.html")
    assert (scene["title"], scene["source"]) == ("fig4: bumpy", AT_THE_BACK)
    assert "In the figure only: marks of local minima." in scene["notes"]
    assert not (tmp_path / "out/fig4-row-flat.html").exists()


def test_links_of_a_folder_lead_into_the_folders_of_its_meshes(mesh_file, tmp_path, monkeypatch):
    monkeypatch.setattr(reproducing.Experiment, "compute", lambda *_: result(panel()))
    meshes = tmp_path / "meshes"
    meshes.mkdir()
    shutil.copy(mesh_file(bumpy(100)), meshes / "a b.off")
    made = reproduce(str(tmp_path / "out"), ["fig4"], str(meshes), say=lambda _: None)
    assert re.findall('<a href="([^#"]+)">', made.page.read_text(encoding="utf-8")) == ["a%20b/fig4-row.html"]
    assert (tmp_path / "out/a b/fig4-row.html").exists()


@pytest.mark.parametrize("up", ["y", "z"])
def test_figure_1_says_what_computes_its_fields(up):
    found = compute(Shapes(own=bumpy(200), up=up), quick=True)
    (page,) = live_pages(found, "biharmonic", found.panels, up)
    assert page.document.up == up
    assert page.document.camera == "front"
