"""Recipes and files: the same bytes again, another mesh, one clear sentence for what is wrong, no half files."""

import json
import os
import re

import numpy as np
import pytest
from PIL import Image

from app.main import main
from app.recipe import Recipe, RecipeCamera, RecipePanel, RecipeZoom, read_recipe, recipe_text
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
    panels = tuple(
        RecipePanel(state, k, maximum)
        for k, (state, maximum) in enumerate(
            [
                (Spec.of("biharmonic"), None),
                (Spec.of("diffusion", t=1 / 15), 0.1),
                (Spec.of("power", alpha=2.5, k=7), 3.0),
                (Spec.of("truncated", k=11), None),
                (Spec.of("geodesic", method="heat"), None),
                (Spec.of("commute-time"), None),
            ]
        )
    )
    camera = RecipeCamera((1 / 3, 2.0, 3.0), (0.0, 0.0, 0.1), (0.0, 1.0, 0.0), (0.2, 0.3))
    recipe = Recipe(
        "mesh.off",
        panels,
        "ab" * 32,
        areas="barycentric",
        isolines=7,
        shared_range=True,
        views=("home", camera),
        zooms=(RecipeZoom(3, 2.5, "top left"),),
        anchors=((4, 0.5), (5, None)),
        height=0.25,
        hints=False,
        columns=2,
        size="160mm@300dpi",
        style="dark",
        transparent=True,
        crop=True,
    )
    path = tmp_path / "recipe.json"
    path.write_text(recipe_text(recipe, "0.1"))
    assert read_recipe(path) == recipe


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
    assert read_recipe(tmp_path / "h.json").mesh == str(tmp_path / "other.off")
    small = mesh_file(bumpy(300).__class__([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), "small.off")
    said = refused(capsys, "figure", "--recipe", moved / "f.json", "--mesh", small, "-o", tmp_path / "i.png")
    assert "no vertex 4" in said
    (moved / "mesh.off").write_text((moved / "mesh.off").read_text().replace("OFF", "OFF #", 1))
    assert "checksum" in refused(capsys, "figure", "--recipe", moved / "f.json", "-o", tmp_path / "i.png")


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
def test_a_bad_recipe_gets_a_sentence(mesh, tmp_path, capsys, change, words):
    recipe = Recipe(mesh, (RecipePanel(Spec.of("diffusion", t=1.0), 4),))
    data = json.loads(recipe_text(recipe, "0.1"))
    change(data)
    path, out = tmp_path / "bad.json", tmp_path / "out.png"
    path.write_text(json.dumps(data))
    assert words in refused(capsys, "figure", "--recipe", path, "-o", out)
    assert not out.exists()


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


def test_svg_has_text_paths_and_one_image_for_each_panel(mesh, tmp_path):
    out = tmp_path / "f.svg"
    words = ["--distance", "biharmonic", "--distance", "diffusion", "--size", "600x300@96dpi"]
    assert main(["figure", mesh, "--source", "4", *words, "-o", str(out)]) == 0
    text = out.read_text()
    assert text.count("<image") == 2
    assert re.search(r"<text[^>]*>biharmonic, exact</text>", text)
    assert re.search(r"<text[^>]*>diffusion, t = 1 \(1 / mesh units\), maximum [\d.]+</text>", text)
    curves = re.findall(r'<g id="isoline-(\d+)-\d+">\s*<path ', text)
    assert curves.count("0") >= 5
    assert curves.count("1") >= 5


def test_pdf_has_its_fonts_in_it(mesh, tmp_path):
    out = tmp_path / "f.pdf"
    assert main(["figure", mesh, "--source", "4", "--distance", "biharmonic", *SMALL, "-o", str(out)]) == 0
    content = out.read_bytes()
    assert content.count(b"/FontDescriptor /FontName") == content.count(b"/FontFile2") > 0
    assert content.count(b"/Subtype /Image") == 1
