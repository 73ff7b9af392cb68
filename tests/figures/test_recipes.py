"""Recipes: read as they were written, old ones as they were meant, one clear sentence for what is wrong."""

import json
from dataclasses import replace

import pytest

from app.document.camera import Camera
from app.document.document import Inset, MeshFile, comparison
from app.document.edits import put_point
from app.document.file import read_recipe, recipe_text
from app.document.looks import Colours, Isolines, Shading
from app.document.page import Page, Recipe
from app.document.shared_parts.pins import Pin, Pins
from app.document.shared_parts.selections import Selection, Selections
from app.tools.interpolation.part import Anchor, Anchors
from app.tools.profile.part import Profile
from app.tools.regions.part import DividedPanels
from app.tools.scatter.part import Scatter
from bihdist_core import SurfacePoint
from bihdist_core.distances.distance_types import Spec
from tests.commands import refused


def test_a_recipe_is_read_as_it_was_written(tmp_path):
    specs = (
        Spec.of("biharmonic"),
        Spec.of("diffusion", t=1 / 15),
        Spec.of("power", alpha=2.5, k=7),
        Spec.of("truncated", k=11),
        Spec.of("geodesic", method="heat"),
        Spec.of("commute-time"),
    )
    document = put_point(
        comparison("mesh.off", specs, (3, None), "barycentric"), "tip", SurfacePoint(3, (0.25, 0.5, 0.25))
    )
    document = (
        replace(
            document,
            surfaces=(MeshFile("A", "mesh.off", "ab" * 32),),
            panels=tuple(replace(panel, maximum=0.1 * panel.id or None) for panel in document.panels),
            isolines=Isolines(7, values=(0.5, 0.25), bold=5, labels=True, through=("tip",)),
            range="fraction",
            colours=Colours("mine", ((0.0, (0.0, 0.5, 1.0)), (1.0, (1.0, 1.0, 1.0))), True, True),
            shading=Shading("creased", 35.0, True),
            up="-z",
            parallel_projection=True,
            axes=True,
            extrema=True,
            docks=("profile", "pins"),
            camera=Camera((1 / 3, 2.0, 3.0), (0.0, 0.0, 0.1), (0.0, 1.0, 0.0), (0.2, 0.3)),
            insets=(Inset(3, 2.5, "top left", 40),),
            warp_factor=0.25,
            next_id=99,
        )
        .with_part(Pins(pins=(Pin("tip", "the tip", 3),)))
        .with_part(Profile(("source", "tip"), "section", (0.0, 1.0, 0.0), False))
        .with_part(Scatter(2, 0, False))
        .with_part(Selections(selections=(Selection("ear", ((3, 3), (5, 9)), 4),)))
        .with_part(DividedPanels(regions=(1,)))
        .with_part(Anchors(anchors=(Anchor("tip", 0.5), Anchor("source", None))))
    )
    page = Page(
        "160mm@300dpi",
        "dark",
        "svg",
        views=("home", document.camera),
        columns=2,
        panel_letters=True,
        transparent=True,
        ground=True,
        feature_edges=True,
        crop=True,
        title="caption",
        font_family="DejaVu Serif",
        font_size=7.5,
        pin_names=True,
    )
    path = tmp_path / "recipe.json"
    path.write_text(recipe_text(Recipe(document, page), "0.1"))
    again = read_recipe(path)
    assert again == Recipe(document, page)
    assert hash(again) == hash(Recipe(document, page))
    assert recipe_text(again, "0.1") == path.read_text()


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
        (lambda r: r["document"]["surfaces"][0].update(path=""), "are missing"),
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
        (lambda r: r["document"].update(camera=camera_at(0)), "a focal point away"),
        (lambda r: r["document"].update(camera=camera_at(1e-300)), "a focal point away"),
        (lambda r: r["document"].update(camera={**camera_at(1), "extent": [1e-300, 1]}), "extent is from"),
        (lambda r: r["document"].update(camera={**camera_at(1), "up": [0, 0, 1]}), "an up direction across"),
        (lambda r: r["document"].update(insets=[{"vertex": 3, "factor": 1e308}]), "at most 100 times"),
        (lambda r: r["document"].update(areas="round"), "no areas 'round'"),
        (lambda r: r["document"].update(tool="hammer"), "no tool 'hammer'"),
        (lambda r: r["document"].update(isolines=10**6), "from 0 to 1,000"),
        (lambda r: r["page"].update(format="bmp"), "page: There is no format 'bmp'"),
        (lambda r: r["page"].update(columns=0), "at least one column"),
        (lambda r: r["page"].update(views=["inside"]), "no view 'inside'"),
        (lambda r: r["page"].update(views=[{"position": [1, 2]}]), "no 'extent'"),
        (lambda r: r["page"].update(size="huge"), "'huge' is not a size"),
        (lambda r: r["page"].update(size="100000px"), "16 to 32000 pixels"),
        (lambda r: r["page"].update(style="pink"), "no style 'pink'"),
        (lambda r: r["page"].update(crop="yes"), "crop must be true or false"),
        (lambda r: r["document"].update(warp_factor=0.3), "flat surface"),
        (lambda r: r["document"]["surfaces"][0].update(path=10_000 * "m"), "is not there"),
        (lambda r: r.update(format=1), "format 1 is no longer supported; draw the figure again"),
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


def camera_at(z):
    return {"position": [0, 0, z], "focal_point": [0, 0, 0], "up": [0, 1, 0], "extent": [0.5, 0.5]}


def test_a_recipe_without_panels_is_refused(mesh, tmp_path, capsys):
    document = replace(comparison(mesh), panels=())
    (tmp_path / "f.json").write_text(recipe_text(Recipe(document), "0.1"))
    for command, out in (("figure", "x.png"), ("movie", "x.gif")):
        assert "has no panels" in refused(capsys, command, "--recipe", tmp_path / "f.json", "-o", tmp_path / out)


def test_a_mesh_that_is_missing_is_not_to_be_named_twice(tmp_path, capsys):
    said = refused(capsys, "figure", tmp_path / "gone.off", "-o", tmp_path / "x.png")
    assert "gone.off. The samples are animal, " in said
    assert "--mesh" not in said


def test_what_is_no_recipe_at_all_gets_a_sentence(tmp_path, capsys):
    out = tmp_path / "out.png"
    for content, words in [
        ("{", "not JSON"),
        ("[" * 100_000, "nested more than 64 deep"),
        ('{"format": ' + "[" * 1000 + "]" * 1000 + "}", "nested more than 64 deep"),
        ("[]", "not a recipe"),
        ("\xff", "not a text file"),
    ]:
        (tmp_path / "bad.json").write_bytes(content.encode("latin-1"))
        assert words in refused(capsys, "figure", "--recipe", tmp_path / "bad.json", "-o", out)
    assert "cannot be read" in refused(capsys, "figure", "--recipe", tmp_path / "none.json", "-o", out)
    assert "name a mesh" in refused(capsys, "figure", "-o", out)
    assert "goes with --recipe" in refused(capsys, "figure", "hand", "--mesh", "hand", "-o", out)
