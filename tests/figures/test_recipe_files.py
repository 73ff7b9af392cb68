"""The files of figures and their recipes: none is lost to another, none is left half, and what is in them."""

import json
import os
import re

from PIL import Image

from app.document.document import comparison
from app.document.file import checksum, read_recipe
from app.document.page import Recipe
from app.main import main
from app.session.array_store import ArrayStore
from app.session.recipe_file import recipe_written
from bihdist_core.distances.distance_types import Spec
from tests.commands import refused
from tests.figures.recipes import SMALL


def test_a_failure_keeps_the_old_figure_and_the_old_recipe(mesh, tmp_path, capsys, monkeypatch):
    out = tmp_path / "f.png"
    assert main(["figure", mesh, "--sources", "4", *SMALL, "-o", str(out)]) == 0
    before = {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)}

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", full)
    assert "No space left" in refused(capsys, "figure", mesh, "--sources", "9", *SMALL, "-o", out)
    assert {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)} == before


def test_another_json_file_is_not_replaced(mesh, tmp_path, capsys):
    (tmp_path / "f.json").write_text('{"mine": 1}')
    assert "another file" in refused(capsys, "figure", mesh, *SMALL, "-o", tmp_path / "f.png")
    assert (tmp_path / "f.json").read_text() == '{"mine": 1}'
    assert not (tmp_path / "f.png").exists()


def test_a_figure_without_a_name_is_called_as_its_mesh_and_replaces_only_figures(mesh, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["figure", mesh, "--distance", "biharmonic", *SMALL]
    assert main([*words, "--sources", "4"]) == 0
    assert "mesh.png: 1 panel on" in capsys.readouterr().out
    first = (tmp_path / "mesh.png").read_bytes()
    assert main([*words, "--sources", "9"]) == 0
    assert (tmp_path / "mesh.png").read_bytes() != first
    (tmp_path / "mesh.json").unlink()
    (tmp_path / "mesh.png").write_text("a photograph")
    assert "There is a file mesh.png already, without a recipe" in refused(capsys, *words)
    assert (tmp_path / "mesh.png").read_text() == "a photograph"
    # Whoever names it means it.
    assert main([*words, "-o", "mesh.png"]) == 0


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
    assert "f.svg.json, as f.json belongs to another file" in drawn_as(
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
    with recipe_written(Recipe(comparison(mesh, (Spec.of("biharmonic"),), (4,))), ArrayStore(), session, "0.1"):
        pass
    before = session.read_bytes()
    (tmp_path / "f.png").write_bytes(b"a picture from elsewhere")
    for _ in range(2):
        said = drawn_as(tmp_path, capsys, mesh, "f.png", "--sources", "9")
        assert session.read_bytes() == before
        assert read_recipe(tmp_path / "f.png.json").document.sources == (9,)
    assert said == ""
    # Drawn as it is, it stays a session.
    settled = json.loads(before)
    settled["document"]["surfaces"][0]["sha256"] = checksum(mesh)
    settled["document"] |= {"up": "y", "camera": "home"}
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
    words = ["--distance", "biharmonic,diffusion", "--size", "600x300@96dpi"]
    assert main(["figure", mesh, "--sources", "4", *words, "-o", str(out)]) == 0
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
    assert main(["figure", mesh, "--sources", "4", "--distance", "biharmonic", *SMALL, "-o", str(out)]) == 0
    content = out.read_bytes()
    assert content.count(b"/FontDescriptor /FontName") == content.count(b"/FontFile2") > 0
    assert content.count(b"/Subtype /Image") == 1
