"""Recipes drawn again: the same bytes, another mesh, and options beside them."""

import os
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from app.document.document import Inset, MeshFile, Panel, Point, comparison
from app.document.file import read_recipe, recipe_text
from app.document.page import Recipe
from app.document.quantities import DistanceFrom
from app.main import main
from app.tools.interpolation.part import Anchor, Anchors
from bihdist_core.distances.distance_types import Spec
from tests.commands import refused
from tests.figures.recipes import SMALL, anchors
from tests.shapes import bumpy


def test_a_recipe_draws_the_same_bytes(mesh, tmp_path):
    words = ["--distance", "biharmonic,diffusion", "--t", "0.25", "--cpos", "left", "--insets", "9:4"]
    looks = ["--style", "uniform", "--crop", "--transparent", "--isolines", "12", "--anchors", "3=0.2,8", *SMALL]
    for extension in ("png", "svg"):
        first, again = tmp_path / f"first.{extension}", tmp_path / f"again.{extension}"
        assert main(["figure", mesh, "--sources", "4", *words, *looks, "-o", str(first)]) == 0
        assert main(["figure", "--recipe", str(tmp_path / "first.json"), "-o", str(again)]) == 0
        assert first.read_bytes() == again.read_bytes()
    assert read_recipe(tmp_path / "first.json") == read_recipe(tmp_path / "again.json")


def test_a_recipe_and_its_mesh_may_move_together_and_meet_another_mesh(mesh, mesh_file, tmp_path, capsys):
    assert main(["figure", mesh, "--sources", "4", *SMALL, "-o", str(tmp_path / "f.png")]) == 0
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
    assert "has changed since its checksum" in said


def changed(tmp_path, *words):
    """The recipe that is written when one is drawn with options beside it."""
    out = tmp_path / "changed.png"
    assert main(["figure", "--recipe", str(tmp_path / "f.json"), *words, "-o", str(out)]) == 0
    return read_recipe(tmp_path / "changed.json")


@pytest.mark.parametrize(
    ("words", "found", "wanted"),
    [
        (["--isolines", "3"], lambda r: r.document.isolines.count, 3),
        (["--sources", "8"], lambda r: r.document.sources, (8,)),
        (["--t", "1/4"], lambda r: [str(p.shows.spec) for p in r.document.panels], ["biharmonic", "diffusion(t=1/4)"]),
        (["--distance", "commute-time"], lambda r: [str(p.shows.spec) for p in r.document.panels], ["commute-time"]),
        (["--areas", "barycentric"], lambda r: r.document.areas, "barycentric"),
        (["--cpos", "top"], lambda r: (r.document.camera, r.page.views), ("top", ())),
        (["--cpos", "front,back"], lambda r: r.page.views, ("front", "back")),
        (["--camera=0,0,9,0,0,0,0,1,0,0.4,0.3"], lambda r: getattr(r.document.camera, "position", None), (0, 0, 9)),
        (["--columns", "1"], lambda r: r.page.columns, 1),
        (["--insets", "7:5"], lambda r: r.document.insets, (Inset(7, 5.0),)),
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
    recipe = changed(drawn, "--sources", "8,9")
    shown = [(p.shows.spec.word, recipe.document.point(p.shows.point).at) for p in recipe.document.panels]
    assert shown == [("biharmonic", 8), ("diffusion", 8), ("biharmonic", 9), ("diffusion", 9)]
    assert recipe.page.columns == 2


def test_options_that_cannot_apply_are_refused_by_name(drawn, mesh, capsys):
    figure = ["figure", "--recipe", drawn / "f.json", "-o", drawn / "x.png"]
    assert "--k 5 is not a parameter of biharmonic, diffusion" in refused(capsys, *figure, "--k", "5")
    assert "cannot share a range" in refused(capsys, *figure, "--clim", "shared")
    assert "at least one column" in refused(capsys, *figure, "--columns", "0")
    assert "another mesh is named as --mesh" in refused(capsys, *figure, mesh)
    assert "flat surface" in refused(capsys, *figure, "--warp-factor")
    field = ["field", mesh, "--sources", "3", "-o", drawn / "f.npy"]
    assert "--t 0.5 is not a parameter of biharmonic" in refused(capsys, *field, "--t", "0.5")
    movie = ["movie", "--recipe", drawn / "f.json", "-o", drawn / "m.gif"]
    assert "--sources beside --path" in refused(capsys, *movie, "--path", "1,5", "--sources", "3")
    assert "takes no --transparent" in refused(capsys, *movie, "--transparent")
    assert "more than one view" in refused(capsys, *movie, "--cpos", "front,back")


def test_anchors_and_panels_may_have_a_point_in_common(drawn):
    recipe = read_recipe(drawn / "f.json")
    document = recipe.document.with_part(Anchors(anchors=(Anchor("source", 0.5),)))
    (drawn / "f.json").write_text(recipe_text(replace(recipe, document=document), "0.1"))
    assert anchors(changed(drawn, "--anchors", "5").document) == [(5, None)]
    other = changed(drawn, "--distance", "commute-time", "--sources", "9").document
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
    for words in (["--distance", "geodesic"], ["--sources", "3"], ["--anchors", "3"], ["--mesh", mesh]):
        assert f"{words[0]}" in refused(capsys, *figure, *words)
    single = replace(two_meshes(mesh, mesh_file), panels=(), points=(), surfaces=(MeshFile("left", mesh),))
    (tmp_path / "f.json").write_text(recipe_text(Recipe(single), "0.1"))
    document = changed(tmp_path, "--distance", "geodesic", "--sources", "3", "--anchors", "8", *SMALL).document
    assert (document.sources, anchors(document)) == ((3,), [(8, None)])


def test_another_mesh_that_is_missing_is_named(drawn, capsys):
    figure = ["figure", "--recipe", drawn / "f.json", "-o", drawn / "x.png"]
    assert "no file hnad; did you mean hand?" in refused(capsys, *figure, "--mesh", "hnad")
