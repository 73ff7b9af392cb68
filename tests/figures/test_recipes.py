"""Recipes and files: the same bytes again, another mesh, one clear sentence for what is wrong, no half files."""

import json
import os
import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from app.document.camera import Camera
from app.document.document import Anchor, MeshFile, Panel, Place, Point, Zoom, comparison
from app.document.edits import put_point
from app.document.file import checksum, read_recipe, recipe_text
from app.document.looks import Colours, Isolines, Shading
from app.document.page import Page, Recipe
from app.document.quantities import DistanceFrom
from app.main import main
from app.session.given import Given
from app.session.recipe_file import recipe_written
from bihdist_core.distances.kinds import Spec
from tests.shapes import bumpy

SMALL = ["--size", "300x200@96dpi"]


@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(300))


def refused(capsys, *arguments):
    """The one sentence a command refuses with."""
    capsys.readouterr()
    assert main([*map(str, arguments)]) == 2
    said = capsys.readouterr().err.strip()
    assert said.startswith("bihdist: ")
    assert "\n" not in said
    return said


def test_a_recipe_draws_the_same_bytes(mesh, tmp_path):
    words = ["--distance", "biharmonic", "--distance", "diffusion", "--t", "0.25", "--view", "left", "--zoom", "9,4"]
    looks = ["--style", "uniform", "--crop", "--transparent", "--isolines", "12", "--anchors", "3=0.2,8", *SMALL]
    for extension in ("png", "svg"):
        first, again = tmp_path / f"first.{extension}", tmp_path / f"again.{extension}"
        assert main(["figure", mesh, "--source", "4", *words, *looks, "-o", str(first)]) == 0
        assert main(["figure", "--recipe", str(tmp_path / "first.json"), "-o", str(again)]) == 0
        assert first.read_bytes() == again.read_bytes()
    assert read_recipe(tmp_path / "first.json") == read_recipe(tmp_path / "again.json")


def test_a_recipe_is_read_as_it_was_written(tmp_path):
    specs = (
        Spec.of("biharmonic"),
        Spec.of("diffusion", t=1 / 15),
        Spec.of("power", alpha=2.5, k=7),
        Spec.of("truncated", k=11),
        Spec.of("geodesic", method="heat"),
        Spec.of("commute-time"),
    )
    document = put_point(comparison("mesh.off", specs, (3, None), "barycentric"), "tip", Place(3, (0.25, 0.5, 0.25)))
    document = replace(
        document,
        surfaces=(MeshFile("A", "mesh.off", "ab" * 32),),
        panels=tuple(replace(panel, maximum=0.1 * panel.id or None) for panel in document.panels),
        isolines=Isolines(7, values=(0.5, 0.25), bold=5, labels=True, through=("tip",)),
        range="shares",
        colours=Colours("mine", ((0.0, (0.0, 0.5, 1.0)), (1.0, (1.0, 1.0, 1.0))), True, True),
        shading=Shading("creased", 35.0, True),
        up="-z",
        projection="orthographic",
        axes=True,
        camera=Camera((1 / 3, 2.0, 3.0), (0.0, 0.0, 0.1), (0.0, 1.0, 0.0), (0.2, 0.3)),
        zooms=(Zoom(3, 2.5, "top left", 40),),
        anchors=(Anchor("tip", 0.5), Anchor("source", None)),
        height=0.25,
        next_id=99,
    )
    page = Page(
        "160mm@300dpi", "dark", "svg", ("home", document.camera), 2, False, True, True, "caption", "DejaVu Serif", 7.5
    )
    path = tmp_path / "recipe.json"
    path.write_text(recipe_text(Recipe(document, page), "0.1"))
    again = read_recipe(path)
    assert again == Recipe(document, page)
    assert hash(again) == hash(Recipe(document, page))
    assert recipe_text(again, "0.1") == path.read_text()


def of_version_0_1(mesh):
    """What the first version wrote."""
    return {
        "format": 1,
        "program": "bihdist 0.1.0",
        "mesh": {"path": mesh},
        "areas": "voronoi",
        "panels": [{"distance": "diffusion", "t": 1.0, "source": 4, "maximum": None}],
        "views": ["home"],
        "zooms": [],
        "anchors": [],
        "isolines": 20,
        "shared_range": False,
        "height": 0.0,
        "hints": True,
        "columns": None,
        "size": "",
        "style": "paper",
        "transparent": False,
        "crop": False,
    }


def test_a_recipe_of_version_0_1_means_what_it_meant(tmp_path):
    camera = {"position": [1, 2, 3], "focal_point": [0, 0, 0], "up": [0, 1, 0], "extent": [0.2, 0.3]}
    data = of_version_0_1("mesh.off")
    data.update(
        panels=[
            {"distance": "power", "alpha": 2.5, "k": 7, "source": 4, "maximum": 3.0},
            {"distance": "geodesic", "method": "heat", "source": 9, "maximum": None},
            {"distance": "biharmonic", "source": 4, "maximum": None},
        ],
        areas="barycentric",
        views=["left", camera],
        zooms=[{"vertex": 3, "factor": 2.5, "corner": "top left"}],
        anchors=[{"vertex": 4, "value": 0.5}, {"vertex": 5, "value": None}],
        isolines=7,
        height=0.25,
        columns=2,
        size="160mm@300dpi",
        style="dark",
        crop=True,
    )
    (tmp_path / "old.json").write_text(json.dumps(data))
    recipe = read_recipe(tmp_path / "old.json")
    document, page = recipe.document, recipe.page
    shown = [(str(p.shows.spec), document.point(p.shows.point).at, p.maximum) for p in document.panels]
    assert shown == [("power(alpha=2.5, k=7)", 4, 3.0), ("geodesic(method=heat)", 9, None), ("biharmonic", 4, None)]
    assert (document.areas, document.isolines.count, document.height) == ("barycentric", 7, 0.25)
    assert document.zooms == (Zoom(3, 2.5, "top left"),)
    assert anchors(document) == [(4, 0.5), (5, None)]
    assert page.views[0] == document.camera == "left"
    assert page.views[1].position == (1, 2, 3)
    assert (page.columns, page.size, page.style, page.crop, page.hints) == (2, "160mm@300dpi", "dark", True, True)


def test_a_recipe_of_version_0_1_draws_the_same_figure(mesh, tmp_path):
    data = of_version_0_1("mesh.off")
    data.update(size="300x200@96dpi", views=["left"], zooms=[{"vertex": 9, "factor": 4}], isolines=12)
    (tmp_path / "old.json").write_text(json.dumps(data))
    words = [
        "--distance",
        "diffusion",
        "--source",
        "4",
        "--view",
        "left",
        "--zoom",
        "9,4",
        "--isolines",
        "12",
        "--hints",
    ]
    assert main(["figure", mesh, *words, *SMALL, "-o", str(tmp_path / "new.png")]) == 0
    assert main(["figure", "--recipe", str(tmp_path / "old.json"), "-o", str(tmp_path / "again.png")]) == 0
    assert (tmp_path / "new.png").read_bytes() == (tmp_path / "again.png").read_bytes()


def test_a_recipe_and_its_mesh_may_move_together_and_meet_another_mesh(mesh, mesh_file, tmp_path, capsys):
    assert main(["figure", mesh, "--source", "4", *SMALL, "-o", str(tmp_path / "f.png")]) == 0
    moved = tmp_path / "moved"
    moved.mkdir()
    for name in ("f.json", "mesh.off"):
        os.rename(tmp_path / name, moved / name)
    assert main(["figure", "--recipe", str(moved / "f.json"), "-o", str(tmp_path / "g.png")]) == 0
    other = mesh_file(bumpy(300, seed=5), "other.off")
    assert main(["figure", "--recipe", str(moved / "f.json"), "--mesh", other, "-o", str(tmp_path / "h.png")]) == 0
    pictures = [np.asarray(Image.open(tmp_path / name)) for name in ("f.png", "g.png", "h.png")]
    assert (pictures[0] == pictures[1]).all()
    assert (pictures[0] != pictures[2]).any()
    assert read_recipe(tmp_path / "h.json").document.mesh().path == str(tmp_path / "other.off")
    small = mesh_file(bumpy(300).__class__([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), "small.off")
    said = refused(capsys, "figure", "--recipe", moved / "f.json", "--mesh", small, "-o", tmp_path / "i.png")
    assert "no vertex 4" in said
    (moved / "mesh.off").write_text((moved / "mesh.off").read_text().replace("OFF", "OFF #", 1))
    said = refused(capsys, "figure", "--recipe", moved / "f.json", "-o", tmp_path / "i.png")
    assert "checksum differs). Name the mesh" in said


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda r: r.pop("mesh"), "names no mesh"),
        (lambda r: r["mesh"].update(path="gone.off"), "gone.off is not there"),
        (lambda r: r.update(format=99, program="bihdist 9.0"), "newer program (bihdist 9.0, format 99)"),
        (lambda r: r.update(colour="red"), "unknown key 'colour'"),
        (lambda r: r["panels"][0].update(colour="red"), "panels[0] has the unknown key 'colour'"),
        (lambda r: r["panels"][0].update(t="long"), "panels[0].t: t must be a number above 0, not 'long'"),
        (lambda r: r["panels"][0].update(t=-1), "panels[0].t: t must be a number above 0, not -1"),
        (lambda r: r["panels"][0].update(distance="euclidean"), "panels[0]: There is no distance 'euclidean'"),
        (lambda r: r["mesh"].update(path=10_000 * "m"), "is not there"),
        (lambda r: r["panels"][0].update(t=10**400), "panels[0].t: t must be a number above 0"),
        (lambda r: r["panels"][0].update(source=1.5), "panels[0].source must be a whole number"),
        (lambda r: r["panels"][0].update(source=5000), "no vertex 5000"),
        (lambda r: r["panels"].clear(), "no panels"),
        (lambda r: r.update(panels={}), "panels must be a list"),
        (lambda r: r.update(views=["inside"]), "no view 'inside'"),
        (lambda r: r.update(views=[{"position": [1, 2]}]), "no 'extent'"),
        (lambda r: r.update(zooms=[{"vertex": 5000}]), "no vertex 5000"),
        (lambda r: r.update(size="huge"), "'huge' is not a size"),
        (lambda r: r.update(size="100000px"), "16 to 32000 pixels"),
        (lambda r: r.update(style="pink"), "no style 'pink'"),
        (lambda r: r.update(crop="yes"), "crop must be true or false"),
        (lambda r: r.update(isolines=True), "isolines must be a whole number"),
        (lambda r: r.update(height=0.3), "flat surface"),
    ],
)
def test_a_bad_recipe_of_version_0_1_gets_a_sentence(mesh, tmp_path, capsys, change, words):
    data = of_version_0_1(mesh)
    change(data)
    path, out = tmp_path / "bad.json", tmp_path / "out.png"
    path.write_text(json.dumps(data))
    assert words in refused(capsys, "figure", "--recipe", path, "-o", out)
    assert not out.exists()


PANEL = "document.panels[0]"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda r: r.pop("document"), "no format and document"),
        (lambda r: r.update(colour="red"), "the recipe has the unknown key 'colour'"),
        (lambda r: r.update(format=3, program="bihdist 9.0"), "newer program (bihdist 9.0, format 3)"),
        (lambda r: r["document"].pop("points"), "document has no 'points'"),
        (lambda r: r["document"].update(surfaces=[]), "document: There is no surface 'A'"),
        (lambda r: r["document"].update(surfaces=[], points=[], panels=[]), "names no mesh"),
        (lambda r: r["document"]["surfaces"][0].update(path=""), "is not there"),
        (lambda r: r["document"]["surfaces"][0].update(sha256=5), "document.surfaces[0].sha256 must be a text"),
        (lambda r: r["document"]["points"][0].update(at=5000), "no vertex 5000"),
        (lambda r: r["document"]["points"][0].update(at={"face": 10**6, "weights": [1, 0, 0]}), "no face 1000000"),
        (lambda r: r["document"]["points"][0].update(at={"face": 0, "weights": [2, 0, 0]}), "add up to 1"),
        (lambda r: r["document"]["points"].append(r["document"]["points"][0]), "two points 'source'"),
        (lambda r: shows(r).update({"from": "here"}), "no point 'here'"),
        (
            lambda r: shows(r).update(distance="diffusion(t=-1)"),
            f"{PANEL}.shows.distance: t",
        ),
        (
            lambda r: shows(r).update(distance=f"diffusion(t={10**400})"),
            "t must be a number",
        ),
        (lambda r: r["document"]["panels"][0].update(maximum=1e308), f"{PANEL}: A colour bar ends at"),
        (lambda r: r["document"]["panels"][0].update(maximum=1e-300), f"{PANEL}: A colour bar ends at"),
        (lambda r: r["document"]["panels"][0].update(maximum=10**400), "a number of many digits"),
        (lambda r: r["document"]["panels"][0].update(id=7), "next_id is 1, and there is a panel 7"),
        (lambda r: r["document"].update(camera="inside"), "document: There is no view 'inside'"),
        (lambda r: r["document"].update(camera=camera_at(1e308)), "none beyond 1e+100"),
        (lambda r: r["document"].update(camera=camera_at(0)), "a focal point elsewhere"),
        (lambda r: r["document"].update(camera=camera_at(1e-300)), "a focal point elsewhere"),
        (lambda r: r["document"].update(camera={**camera_at(1), "extent": [1e-300, 1]}), "extent is from"),
        (lambda r: r["document"].update(camera={**camera_at(1), "up": [0, 0, 1]}), "an up direction across"),
        (lambda r: r["document"].update(zooms=[{"vertex": 3, "factor": 1e308}]), "at most 100 times"),
        (lambda r: r["document"].update(areas="round"), "no areas 'round'"),
        (lambda r: r["document"].update(tool="hammer"), "no tool 'hammer'"),
        (lambda r: r["document"].update(isolines=10**6), "0 to 1000 steps"),
        (lambda r: r["page"].update(format="bmp"), "page: There is no format 'bmp'"),
        (lambda r: r["page"].update(columns=0), "at least one column"),
        (lambda r: r["page"].update(views=["inside"]), "no view 'inside'"),
    ],
)
def test_a_bad_recipe_gets_a_sentence(mesh, tmp_path, capsys, change, words):
    data = json.loads(recipe_text(Recipe(comparison(mesh, (Spec.of("diffusion"),), (4,))), "0.1"))
    change(data)
    path, out = tmp_path / "bad.json", tmp_path / "out.png"
    path.write_text(json.dumps(data))
    assert words in refused(capsys, "figure", "--recipe", path, "-o", out)
    assert not out.exists()


def shows(recipe):
    return recipe["document"]["panels"][0]["shows"]


def anchors(document):
    return [(document.point(anchor.point).at, anchor.value) for anchor in document.anchors]


def camera_at(z):
    return {"position": [0, 0, z], "focal_point": [0, 0, 0], "up": [0, 1, 0], "extent": [0.5, 0.5]}


# ---------------------------------------------------------------------- options beside a recipe
def changed(tmp_path, *words):
    """The recipe that is written when one is drawn with options beside it."""
    out = tmp_path / "changed.png"
    assert main(["figure", "--recipe", str(tmp_path / "f.json"), *words, "-o", str(out)]) == 0
    return read_recipe(tmp_path / "changed.json")


@pytest.fixture
def drawn(mesh, tmp_path):
    words = ["--distance", "biharmonic", "--distance", "diffusion", "--source", "4", "--isolines", "9", "--crop"]
    assert main(["figure", mesh, *words, *SMALL, "-o", str(tmp_path / "f.png")]) == 0
    return tmp_path


@pytest.mark.parametrize(
    ("words", "found", "wanted"),
    [
        (["--isolines", "3"], lambda r: r.document.isolines.count, 3),
        (["--source", "8"], lambda r: r.document.sources, (8,)),
        (["--t", "1/4"], lambda r: [str(p.shows.spec) for p in r.document.panels], ["biharmonic", "diffusion(t=1/4)"]),
        (["--distance", "commute-time"], lambda r: [str(p.shows.spec) for p in r.document.panels], ["commute-time"]),
        (["--areas", "barycentric"], lambda r: r.document.areas, "barycentric"),
        (["--view", "top"], lambda r: (r.document.camera, r.page.views), ("top", ())),
        (["--two-views"], lambda r: r.page.views, ("front", "back")),
        (["--camera=0,0,9,0,0,0,0,1,0,0.4,0.3"], lambda r: getattr(r.document.camera, "position", None), (0, 0, 9)),
        (["--columns", "1"], lambda r: r.page.columns, 1),
        (["--zoom", "7,5"], lambda r: r.document.zooms, (Zoom(7, 5.0),)),
        (
            ["--anchors", "3=0.2"],
            lambda r: anchors(r.document),
            [(3, 0.2)],
        ),
        (["--hints"], lambda r: r.page.hints, True),
        (["--no-crop"], lambda r: r.page.crop, False),
        (["--transparent"], lambda r: r.page.transparent, True),
        (["--size", "200x150"], lambda r: r.page.size, "200x150"),
        (["--style", "dark"], lambda r: r.page.style, "dark"),
    ],
)
def test_options_beside_a_recipe_change_it_and_leave_the_rest(drawn, words, found, wanted):
    before, after = read_recipe(drawn / "f.json"), changed(drawn, *words)
    assert found(before) != wanted
    assert found(after) == wanted
    if "--isolines" not in words:
        assert after.document.isolines.count == 9


def test_sources_beside_a_recipe_make_rows_as_they_do_without(drawn):
    recipe = changed(drawn, "--source", "8", "--source", "9")
    shown = [(p.shows.spec.word, recipe.document.point(p.shows.point).at) for p in recipe.document.panels]
    assert shown == [("biharmonic", 8), ("diffusion", 8), ("biharmonic", 9), ("diffusion", 9)]
    assert recipe.page.columns == 2


def test_options_that_cannot_apply_are_refused_by_name(drawn, mesh, capsys):
    figure = ["figure", "--recipe", drawn / "f.json", "-o", drawn / "x.png"]
    assert "--k 5 is no parameter of biharmonic, diffusion" in refused(capsys, *figure, "--k", "5")
    assert "cannot share a range" in refused(capsys, *figure, "--shared-range")
    assert "at least one column" in refused(capsys, *figure, "--columns", "0")
    assert "another mesh is named as --mesh" in refused(capsys, *figure, mesh)
    assert "flat surface" in refused(capsys, *figure, "--height")
    field = ["field", mesh, "--source", "3", "-o", drawn / "f.npy"]
    assert "--t 0.5 is no parameter of biharmonic" in refused(capsys, *field, "--t", "0.5")
    movie = ["movie", "--recipe", drawn / "f.json", "-o", drawn / "m.gif"]
    assert "--source beside --path" in refused(capsys, *movie, "--path", "1,5", "--source", "3")
    assert "takes no --transparent" in refused(capsys, *movie, "--transparent")
    assert "more than one view" in refused(capsys, *movie, "--two-views")


def test_anchors_and_panels_may_have_a_point_in_common(drawn):
    recipe = read_recipe(drawn / "f.json")
    document = replace(recipe.document, anchors=(Anchor("source", 0.5),))
    (drawn / "f.json").write_text(recipe_text(replace(recipe, document=document), "0.1"))
    assert anchors(changed(drawn, "--anchors", "5").document) == [(5, None)]
    other = changed(drawn, "--distance", "commute-time", "--source", "9").document
    assert (anchors(other), other.sources) == ([(4, 0.5)], (9,))


def two_meshes(mesh, mesh_file):
    """A panel on each of two meshes, neither called A."""
    other = mesh_file(bumpy(300, seed=5), "other.off")
    document = comparison(mesh, (Spec.of("biharmonic"),), (4,))
    return replace(
        document,
        surfaces=(MeshFile("left", mesh), MeshFile("right", other)),
        points=(Point("one", 4, "left"), Point("two", 9, "right")),
        panels=(
            Panel(0, DistanceFrom(Spec.of("biharmonic"), "one"), "left"),
            Panel(1, DistanceFrom(Spec.of("diffusion"), "two"), "right"),
        ),
        next_id=2,
    )


def test_two_meshes_are_drawn_and_options_for_one_are_refused(mesh, mesh_file, tmp_path, capsys):
    (tmp_path / "f.json").write_text(recipe_text(Recipe(two_meshes(mesh, mesh_file)), "0.1"))
    assert changed(tmp_path, *SMALL).document.sources == (4, 9)
    figure = ["figure", "--recipe", tmp_path / "f.json", "-o", tmp_path / "x.png"]
    for words in (["--distance", "geodesic"], ["--source", "3"], ["--anchors", "3"], ["--mesh", mesh]):
        assert f"{words[0]}" in refused(capsys, *figure, *words)
    single = replace(two_meshes(mesh, mesh_file), panels=(), points=(), surfaces=(MeshFile("left", mesh),))
    (tmp_path / "f.json").write_text(recipe_text(Recipe(single), "0.1"))
    document = changed(tmp_path, "--distance", "geodesic", "--source", "3", "--anchors", "8", *SMALL).document
    assert (document.sources, anchors(document)) == ((3,), [(8, None)])


def test_a_recipe_without_panels_is_refused(mesh, tmp_path, capsys):
    document = replace(comparison(mesh), panels=())
    (tmp_path / "f.json").write_text(recipe_text(Recipe(document), "0.1"))
    for command, out in (("figure", "x.png"), ("movie", "x.gif")):
        assert "has no panels" in refused(capsys, command, "--recipe", tmp_path / "f.json", "-o", tmp_path / out)


def test_a_mesh_that_is_missing_is_not_to_be_named_twice(tmp_path, capsys):
    said = refused(capsys, "figure", tmp_path / "gone.off", "-o", tmp_path / "x.png")
    assert "gone.off. The samples are animal, " in said
    assert "--mesh" not in said


def test_another_mesh_that_is_missing_is_named(drawn, capsys):
    figure = ["figure", "--recipe", drawn / "f.json", "-o", drawn / "x.png"]
    assert "no file hnad; did you mean hand?" in refused(capsys, *figure, "--mesh", "hnad")


def test_what_is_no_recipe_at_all_gets_a_sentence(tmp_path, capsys):
    out = tmp_path / "out.png"
    for content, words in [
        ("{", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("[]", "not a recipe"),
        ("\xff", "not JSON"),
    ]:
        (tmp_path / "bad.json").write_bytes(content.encode("latin-1"))
        assert words in refused(capsys, "figure", "--recipe", tmp_path / "bad.json", "-o", out)
    assert "cannot be read" in refused(capsys, "figure", "--recipe", tmp_path / "none.json", "-o", out)
    assert "name a mesh" in refused(capsys, "figure", "-o", out)
    assert "goes with --recipe" in refused(capsys, "figure", "hand", "--mesh", "hand", "-o", out)


def test_a_failure_keeps_the_old_figure_and_the_old_recipe(mesh, tmp_path, capsys, monkeypatch):
    out = tmp_path / "f.png"
    assert main(["figure", mesh, "--source", "4", *SMALL, "-o", str(out)]) == 0
    before = {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)}

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", full)
    assert "No space left" in refused(capsys, "figure", mesh, "--source", "9", *SMALL, "-o", out)
    assert {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)} == before


def test_another_json_file_is_not_replaced(mesh, tmp_path, capsys):
    (tmp_path / "f.json").write_text('{"mine": 1}')
    assert "another file" in refused(capsys, "figure", mesh, *SMALL, "-o", tmp_path / "f.png")
    assert (tmp_path / "f.json").read_text() == '{"mine": 1}'
    assert not (tmp_path / "f.png").exists()


# ---------------------------------------------------------------------- several files of one stem
def drawn_as(tmp_path, capsys, mesh, name, *words):
    """Draw a figure; what is said on standard error."""
    capsys.readouterr()
    assert main(["figure", mesh, "--distance", "biharmonic", *SMALL, *words, "-o", str(tmp_path / name)]) == 0
    return capsys.readouterr().err


def jsons(tmp_path):
    return {path.name: path.read_bytes() for path in tmp_path.glob("*.json")}


def test_one_recipe_does_for_all_formats_of_a_figure(mesh, tmp_path, capsys):
    assert drawn_as(tmp_path, capsys, mesh, "f.png") == ""
    before = jsons(tmp_path)
    assert list(before) == ["f.json"]
    for name in ("f.svg", "f.png", "f.svg"):
        assert drawn_as(tmp_path, capsys, mesh, name) == ""
        assert jsons(tmp_path) == before


def test_another_figure_of_the_same_stem_has_a_recipe_of_its_own(mesh, tmp_path, capsys):
    drawn_as(tmp_path, capsys, mesh, "f.png")
    before = jsons(tmp_path)
    assert "f.svg.json: f.json is that of something else" in drawn_as(
        tmp_path, capsys, mesh, "f.svg", "--isolines", "5"
    )
    after = jsons(tmp_path)
    assert after["f.json"] == before["f.json"]
    assert read_recipe(tmp_path / "f.svg.json").document.isolines.count == 5
    for name, words in (("f.svg", ["--isolines", "5"]), ("f.png", [])):
        assert drawn_as(tmp_path, capsys, mesh, name, *words) == ""
        assert jsons(tmp_path) == after
    assert main(["figure", "--recipe", str(tmp_path / "f.svg.json"), "-o", str(tmp_path / "again.svg")]) == 0
    assert (tmp_path / "again.svg").read_bytes() == (tmp_path / "f.svg").read_bytes()
    # A figure's own recipe goes with it.
    assert drawn_as(tmp_path, capsys, mesh, "f.svg", "--isolines", "7") == ""
    assert drawn_as(tmp_path, capsys, mesh, "f.png", "--isolines", "9") == ""
    isolines = {name: read_recipe(tmp_path / name).document.isolines.count for name in jsons(tmp_path)}
    assert isolines == {"f.json": 9, "f.svg.json": 7, "again.json": 5}


def test_a_recipe_of_two_figures_is_kept_for_the_one_that_is_not_drawn_anew(mesh, tmp_path, capsys):
    drawn_as(tmp_path, capsys, mesh, "f.png")
    drawn_as(tmp_path, capsys, mesh, "f.svg")
    before = jsons(tmp_path)
    assert "f.png.json" in drawn_as(tmp_path, capsys, mesh, "f.png", "--isolines", "5")
    assert jsons(tmp_path)["f.json"] == before["f.json"]
    assert main(["figure", "--recipe", str(tmp_path / "f.json"), "-o", str(tmp_path / "again.svg")]) == 0
    assert (tmp_path / "again.svg").read_bytes() == (tmp_path / "f.svg").read_bytes()


def test_a_session_is_not_replaced_by_a_figure_of_its_name(mesh, tmp_path, capsys):
    session = tmp_path / "f.json"
    with recipe_written(Recipe(comparison(mesh, (Spec.of("biharmonic"),), (4,))), Given(), session, "0.1"):
        pass
    before = session.read_bytes()
    (tmp_path / "f.png").write_bytes(b"a picture from elsewhere")
    for _ in range(2):
        said = drawn_as(tmp_path, capsys, mesh, "f.png", "--source", "9")
        assert session.read_bytes() == before
        assert read_recipe(tmp_path / "f.png.json").document.sources == (9,)
    assert said == ""
    # Drawn as it is, it stays a session.
    settled = json.loads(before)
    settled["document"]["surfaces"][0]["sha256"] = checksum(mesh)
    settled["document"]["up"] = "y"
    session.write_text(json.dumps(settled))
    assert main(["figure", "--recipe", str(session), "-o", str(tmp_path / "f.svg")]) == 0
    assert read_recipe(session).page.format == ""
    assert not (tmp_path / "f.svg.json").exists()


def test_a_recipe_that_was_put_there_is_not_replaced_by_a_variant(drawn, capsys):
    put = drawn / "put"
    put.mkdir()
    for name in ("f.json", "mesh.off"):
        os.rename(drawn / name, put / name)
    before = (put / "f.json").read_bytes()
    variant = ["figure", "--recipe", str(put / "f.json"), "--isolines", "5", "-o", str(put / "f.png")]
    for _ in range(2):
        assert main(variant) == 0
        assert (put / "f.json").read_bytes() == before
        assert read_recipe(put / "f.png.json").document.isolines.count == 5


def test_a_recipe_of_a_newer_program_is_not_replaced(mesh, tmp_path, capsys):
    newer = '{"format": 99, "program": "bihdist 9.0", "document": {}}'
    (tmp_path / "f.json").write_text(newer)
    assert "f.png.json" in drawn_as(tmp_path, capsys, mesh, "f.png")
    assert (tmp_path / "f.json").read_text() == newer


def test_where_both_places_are_taken_nothing_is_written(mesh, tmp_path, capsys):
    (tmp_path / "f.json").write_text('{"format": 99, "program": "bihdist 9.0", "document": {}}')
    for content, words in (('{"mine": 1}', "is another file"), ((tmp_path / "f.json").read_text(), "something else")):
        (tmp_path / "f.png.json").write_text(content)
        assert words in refused(capsys, "figure", mesh, *SMALL, "-o", tmp_path / "f.png")
        assert (tmp_path / "f.png.json").read_text() == content
        assert not (tmp_path / "f.png").exists()


def test_svg_has_text_paths_and_one_image_for_each_panel(mesh, tmp_path):
    out = tmp_path / "f.svg"
    words = ["--distance", "biharmonic", "--distance", "diffusion", "--size", "600x300@96dpi"]
    assert main(["figure", mesh, "--source", "4", *words, "-o", str(out)]) == 0
    text = out.read_text()
    assert text.count("<image") == 2
    assert re.search(r"<text[^>]*>biharmonic, exact</text>", text)
    assert re.search(r"<text[^>]*>diffusion, t = 1</text>", text)
    assert re.search(r"<text[^>]*>1 / mesh units, max [\d.]+</text>", text)
    curves = re.findall(r'<g id="isoline-(\d+)-\d+">\s*<path ', text)
    assert curves.count("0") >= 5
    assert curves.count("1") >= 5


def test_pdf_has_its_fonts_in_it(mesh, tmp_path):
    out = tmp_path / "f.pdf"
    assert main(["figure", mesh, "--source", "4", "--distance", "biharmonic", *SMALL, "-o", str(out)]) == 0
    content = out.read_bytes()
    assert content.count(b"/FontDescriptor /FontName") == content.count(b"/FontFile2") > 0
    assert content.count(b"/Subtype /Image") == 1
