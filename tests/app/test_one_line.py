"""Lines that make a figure: read again they mean what they were made from, and every part of a document has a row."""

import argparse
import inspect
import re
import shlex
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

import app
from app.commands.figure import add_figure_options, chosen_recipe
from app.document.camera import VIEWS, Camera
from app.document.document import Document, FieldArray, Inset, MeshFile, Panel, Point, comparison
from app.document.looks import CURVATURE, UPS, Base, Clip, Colours, Isolines, Shading
from app.document.on_surface import Hidden
from app.document.option import curves_in
from app.document.page import Page, Recipe
from app.document.quantities import Difference, DistanceFrom, OwnField, quantity
from app.document.repairs import Repairs, with_repairs
from app.document.shared_parts.pins import Pin, Pins, add_pins, with_pins
from app.document.shared_parts.selections import select_instead
from app.document.tools import part_types
from app.figures import one_line
from app.figures.arguments import GROUPS
from app.figures.one_line import PANELS
from app.figures.options import arguments, rows
from app.tools.interpolation.part import Anchor, Anchors
from app.tools.profile.part import Profile, points_along, shows_path, with_profile
from app.tools.regions.part import DividedPanels, can_divide, divide
from bihdist_core import BoundaryLoop, Curve, ParameterError, SourceSet, SurfacePoint
from bihdist_core.applications.weights import Weights
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.words import curve_text
from tests.shapes import bumpy

COUNT = 60
BIHARMONIC, DIFFUSION = Spec.of("biharmonic"), Spec.of("diffusion", t=1 / 15)
GEODESIC = Spec.of("geodesic", method="heat")
PLACE = SurfacePoint.of(3, 0.2, 0.2)
CURVE = Curve((PLACE, SurfacePoint.of(9, 0.2, 0.2)))
CAMERA = Camera((0.1, 2.0, 1 / 3), (0.0, -1e-9, 0.0), (0.0, 1.0, 0.1), (0.4, 0.30000000000000004))


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    """A file whose name a shell would take apart."""
    surface = bumpy(COUNT)
    path = tmp_path_factory.mktemp("it's a folder") / "a mesh.off"
    rows = [
        f"OFF\n{len(surface.vertices)} {len(surface.faces)} 0",
        *(f"{x!r} {y!r} {z!r}" for x, y, z in surface.vertices.tolist()),
    ]
    path.write_text("\n".join([*rows, *(f"3 {a} {b} {c}" for a, b, c in surface.faces.tolist())]) + "\n")
    return str(path)


def read_again(line):
    """The recipe that a shell's line means."""
    words = shlex.split(line)
    assert words[:2] == ["bihdist", "figure"]
    parser = argparse.ArgumentParser()
    add_figure_options(parser, "")
    return chosen_recipe(parser.parse_args(words[2:]))


def run_again(line):
    """The recipe of the picture that a line of Python makes."""
    start, call = line.split("; ", 1)
    assert start == "import bihdist"
    picture = eval(call.rpartition(".save(")[0], {"bihdist": app})
    return picture._recipe


def shown(recipe):
    """What a recipe's figure depends on, with names and numbers that nobody sees as they come."""
    document = recipe.document
    names = dict.fromkeys(name for panel in document.panels for name in panel.shows.points)
    renamed = {name: f"source {k}" for k, name in enumerate(names)}
    marked = [*(each.point for each in (*document[Anchors].anchors, *document[Pins].pins)), *document.isolines.through]
    at = [document.point(name).at for name in (*names, *marked)]
    marks = [f"mark {k}" for k in range(len(marked))]

    def part(each):
        return replace(each, point=renamed[each.point]) if isinstance(each, DistanceFrom) else each

    panels = [
        replace(p, id=k, shows=p.shows.with_parts(tuple(map(part, p.shows.parts))))
        for k, p in enumerate(document.panels)
    ]
    anchors = tuple(replace(anchor, point=mark) for anchor, mark in zip(document[Anchors].anchors, marks, strict=False))
    points = tuple(Point(*each) for each in zip([*renamed.values(), *marks], at, strict=True))
    numbered = marks[len(anchors) : len(anchors) + len(document[Pins].pins)]
    pins = tuple(
        Pin(mark, pin.name if recipe.page.pin_names else "", pin.colour)
        for pin, mark in zip(document[Pins].pins, numbered, strict=True)
    )
    isolines = replace(document.isolines, through=tuple(marks[len(anchors) + len(pins) :]))
    through = points_along(document) if shows_path(document) else ()
    along = tuple(Point(f"path {k}", document.point(name).at) for k, name in enumerate(through))
    way = replace(document[Profile], points=tuple(point.name for point in along)) if along else Profile()
    regions = tuple(k for k, panel in enumerate(document.panels) if panel.id in document[DividedPanels].regions)
    own = {type(part): part for part in document.parts}
    own |= {type(part): part for part in (way, Anchors(anchors, document[Anchors].weights), Pins(pins))}
    drawn = replace(
        document,
        docks=("profile",) if along else (),
        surfaces=(
            MeshFile("A", document.surfaces[0].path, repairs=replace(document.surfaces[0].repairs, cut_sha256="")),
        ),
        points=(*points, *along),
        panels=tuple(panels),
        next_id=len(panels),
        isolines=isolines,
        camera=recipe.views[0],
        parts=tuple({**own, DividedPanels: DividedPanels(regions)}.values()),
    )
    views = recipe.views if len(recipe.views) > 1 else ()
    return Recipe(drawn, replace(recipe.page, views=views, format=""))


def usual(path, **changes):
    # A picture's document says which way is up, and from where it is seen.
    return replace(comparison(path, (BIHARMONIC,), (5,)), **{"up": "y", "camera": "home", **changes})


def named_pins(document, *names):
    """The document with three pins, with these names."""
    document = add_pins(document, [9, SurfacePoint.of(3, 0.2, 0.5), 5])
    return with_pins(document, map(lambda pin, name: replace(pin, name=name), document[Pins].pins, names))


EXAMPLES = {
    "Document.points": lambda d, p: (replace(d, points=(Point("source", 7),)), p),
    "Document.panels": lambda d, p: (replace(d, panels=(*d.panels, Panel(1, DistanceFrom(DIFFUSION))), next_id=2), p),
    "Document.areas": lambda d, p: (replace(d, areas="barycentric"), p),
    "Document.isolines": lambda d, p: (replace(d, isolines=Isolines(7)), p),
    "Document.range": lambda d, p: (replace(d, range="shared"), p),
    "Document.camera": lambda d, p: (replace(d, camera=CAMERA), p),
    "Document.insets": lambda d, p: (replace(d, insets=(Inset(3), Inset(9, 1 / 0.3))), p),
    "Anchors.anchors": lambda d, p: (
        replace(d, points=(*d.points, Point("anchor", 8))).with_part(
            Anchors((Anchor("anchor", -1e-7), Anchor("source")))
        ),
        p,
    ),
    "Document.extrema": lambda d, p: (replace(d, extrema=True), p),
    "Pins.pins": lambda d, p: (add_pins(d, [9, SurfacePoint.of(3, 0.2, 0.5)]), p),
    "DividedPanels.regions": lambda d, p: (divide(add_pins(d, [9, 3]), "all"), p),
    "Selections.selections": lambda d, p: (select_instead(d, [((3, 3), (5, 9)), ((20, 22),)]), p),
    "Hidden.hidden": lambda d, p: (
        replace(select_instead(add_pins(d, [9, 3]), [((3, 3),)]), isolines=Isolines(5)).with_part(
            Hidden(("source", "pins:pin 2", "selections:selection"))
        ),
        p,
    ),
    "Document.docks": lambda d, p: (replace(add_pins(d, [9, 3]), docks=("profile",)), p),
    "Profile.points": lambda d, p: (with_profile(add_pins(d, [9, 3, 4]), ["pin:3", "pin:1"]), p),
    "Profile.way": lambda d, p: (with_profile(d, ["source", 9], "edges"), p),
    "Profile.across": lambda d, p: (with_profile(d, ["source", 9], "section-longer", (0.1, -1e-7, 1 / 3)), p),
    "Pin.point": lambda d, p: (d.with_part(Pins((Pin("source"),))), p),
    "Pin.name": lambda d, p: (named_pins(d, "", "ear (left)", ""), replace(p, pin_names=True)),
    "Pin.colour": lambda d, p: (d.with_part(Pins((Pin("source", colour=4),))), p),
    "Document.colours": lambda d, p: (replace(d, colours=Colours(reversed=True)), p),
    "Document.shading": lambda d, p: (replace(d, shading=Shading("flat")), p),
    "Document.clip": lambda d, p: (replace(d, clip=Clip((0.0, -1.0, 1 / 3), 0.1 + 0.2)), p),
    "Document.opacity": lambda d, p: (replace(d, opacity=0.1 + 0.2), p),
    "Document.up": lambda d, p: (replace(d, up="-x"), p),
    "Document.base": lambda d, p: (replace(d, base=Base(CURVATURE)), p),
    "Base.scalars": lambda d, p: (replace(d, base=Base(CURVATURE)), p),
    "Base.gradual": lambda d, p: (replace(d, base=Base(CURVATURE, gradual=True)), p),
    "Base.white_isolines": lambda d, p: (replace(d, base=Base(CURVATURE, white_isolines=True)), p),
    "Document.scale_bar": lambda d, p: (replace(d, scale_bar=True), p),
    "Document.unit": lambda d, p: (replace(d, unit="mm"), p),
    "Document.parallel_projection": lambda d, p: (replace(d, parallel_projection=True), p),
    "Document.axes": lambda d, p: (replace(d, axes=True), p),
    "Panel.shows": lambda d, p: (
        replace(
            d, panels=(replace(d.panels[0], shows=Difference(DistanceFrom(BIHARMONIC), DistanceFrom(GEODESIC), True)),)
        ),
        p,
    ),
    "Panel.maximum": lambda d, p: (replace(d, panels=(replace(d.panels[0], maximum=0.1 + 0.2),)), p),
    "Inset.vertex": lambda d, p: (replace(d, insets=(Inset(11),)), p),
    "Inset.factor": lambda d, p: (replace(d, insets=(Inset(11, 2.5),)), p),
    "Inset.corner": lambda d, p: (replace(d, insets=(Inset(11, corner="top left"),)), p),
    "Inset.isolines": lambda d, p: (replace(d, insets=(Inset(11, isolines=60),)), p),
    "Anchor.point": lambda d, p: (
        replace(d, points=(*d.points, Point("m", 8))).with_part(Anchors((Anchor("m"),))),
        p,
    ),
    "Anchor.left_out": lambda d, p: (d.with_part(Anchors((Anchor("source", 0.25, left_out=True),))), p),
    "Anchors.weights": lambda d, p: (d.with_part(Anchors(weights=Weights(2.5, 0.25))), p),
    "Anchor.value": lambda d, p: (d.with_part(Anchors((Anchor("source", 0.25),))), p),
    "Isolines.count": lambda d, p: (replace(d, isolines=Isolines(0)), p),
    "Isolines.spacing": lambda d, p: (replace(d, isolines=Isolines(spacing=1 / 3)), p),
    "Isolines.values": lambda d, p: (replace(d, isolines=Isolines(values=(0.1, 0.25))), p),
    "Isolines.bold": lambda d, p: (replace(d, isolines=Isolines(bold=5)), p),
    "Isolines.labels": lambda d, p: (replace(d, isolines=Isolines(labels=True)), p),
    "Isolines.round": lambda d, p: (replace(d, isolines=Isolines(round=False)), p),
    "Isolines.through": lambda d, p: (replace(d, isolines=Isolines(through=("source",))), p),
    "Colours.map": lambda d, p: (replace(d, colours=Colours("paper")), p),
    "Colours.stops": lambda d, p: (
        replace(d, colours=Colours("mine", ((0.0, (0.0, 0.0, 0.0)), (1.0, (1.0, 0.5, 0.1))))),
        p,
    ),
    "Colours.reversed": lambda d, p: (replace(d, colours=Colours(reversed=True)), p),
    "Colours.bands": lambda d, p: (replace(d, colours=Colours(bands=True)), p),
    "Shading.normals": lambda d, p: (replace(d, shading=Shading("smooth")), p),
    "Shading.feature_angle": lambda d, p: (replace(d, shading=Shading("creased", 30.5)), p),
    "Shading.show_edges": lambda d, p: (replace(d, shading=Shading(show_edges=True)), p),
    "Repairs.cut": lambda d, p: (with_repairs(d, cut=mask_beside(d.surfaces[0].path)), p),
    "Repairs.merge": lambda d, p: (with_repairs(d, merge=0.1 + 0.2), p),
    "Repairs.largest_component": lambda d, p: (with_repairs(d, largest_component=True), p),
    "Repairs.operator": lambda d, p: (with_repairs(d, operator="intrinsic-delaunay"), p),
    "Page.size": lambda d, p: (d, replace(p, size="160x80mm@300dpi")),
    "Page.style": lambda d, p: (d, replace(p, style="dark")),
    "Page.views": lambda d, p: (d, replace(p, views=("home", "back", CAMERA))),
    "Page.panel_letters": lambda d, p: (d, replace(p, panel_letters=True)),
    "Page.rows": lambda d, p: (d, replace(p, rows="source")),
    "Page.chart": lambda d, p: (d, replace(p, chart="histogram")),
    "Page.ground": lambda d, p: (d, replace(p, ground=True)),
    "Page.feature_edges": lambda d, p: (d, replace(p, feature_edges=True)),
    "Page.columns": lambda d, p: (d, replace(p, columns=2)),
    "Page.hints": lambda d, p: (d, replace(p, hints=True)),
    "Page.transparent": lambda d, p: (d, replace(p, transparent=True)),
    "Page.crop": lambda d, p: (d, replace(p, crop=True)),
    "Page.title": lambda d, p: (d, replace(p, title="caption")),
    "Page.font_family": lambda d, p: (d, replace(p, font_family="DejaVu Serif")),
    "Page.font_size": lambda d, p: (d, replace(p, font_size=7.5)),
    "Page.anchor_values": lambda d, p: (d, replace(p, anchor_values=True)),
    "Page.pin_names": lambda d, p: (named_pins(d, "the tip", "", "a = b"), replace(p, pin_names=True)),
}
"""For each part a change of it."""


def mask_beside(path):
    """A file that cuts two vertices out of the mesh at a path."""
    mask = f"{path}.mask.npy"
    np.save(mask, ~np.isin(np.arange(COUNT), (40, 41)))
    return mask


ELSEWHERE = {
    "Document.surfaces": "every line names the mesh",
    "Document.fields": "arrays: see the test of what is said in words",
    "Document.warp_factor": "needs a flat mesh: see its test",
    "Page.layout": "needs a brain",
}

WORDLESS = {"Inset.corner", "Pin.colour", "Anchor.left_out"} | {
    name
    for name in EXAMPLES
    if name == "Colours.stops" or name == "Isolines.through"  # the source itself
}
"""Parts that only a recipe's file says so far."""

ROWS = (PANELS, *rows())
PARTS = [
    f"{part.__name__}.{f.name}"
    for part in (Document, *part_types(), Panel, Inset, Anchor, Pin, Isolines, Colours, Shading, Base, Repairs, Page)
    for f in fields(part)
]


def test_every_part_of_a_document_and_its_page_has_a_row():
    """A new field fails here until a row of the table says it, or why none needs to."""
    assert sorted(part for row in ROWS for part in row.parts) == sorted(PARTS)
    unsaid = [part for row in ROWS for part in row.parts if row.reason]
    assert sorted([*EXAMPLES, *ELSEWHERE, *unsaid]) == sorted(PARTS)
    assert all(bool(row.reason) != bool(row.options) for row in ROWS)


def test_arguments_and_options_are_those_of_the_table():
    signature = {each.name: each.default for each in inspect.signature(app.figure).parameters.values()}
    others = {"mesh", "distances", "source", "fields", "second_mesh", "progress", "others"}
    known = {option.argument: option for option in arguments().values()}
    assert {*signature} - others == {name for name, _ in known}
    lone = {name: option.default for (name, key), option in known.items() if not key}
    assert {name: signature[name] for name in lone} == lone
    assert signature["isolines"] == known["isolines", "count"].default
    for name, group in GROUPS.items():
        assert {*group.__annotations__} == {key for of, key in known if of == name}
        assert all(
            re.search(rf"^    (.*, )?{key}(, .*)? : ", group.__doc__, re.MULTILINE) for key in group.__annotations__
        )
    with pytest.raises(TypeError, match="argument 'pin'"):
        app.figure("hand", pin=[3])


@pytest.mark.parametrize("part", sorted(EXAMPLES))
def test_each_part_is_said_by_both_lines_or_in_words(part, mesh):
    recipe = Recipe(*EXAMPLES[part](usual(mesh), Page()))
    assert shown(recipe) != shown(Recipe(usual(mesh)))
    reason = one_line.why_not(recipe)
    assert bool(reason) == (part in WORDLESS)
    if reason:
        with pytest.raises(ParameterError, match=r"\.$"):
            one_line.command_line(recipe, "out.png")
        return
    assert shown(read_again(one_line.command_line(recipe, "out.png"))) == shown(recipe)
    assert shown(run_again(one_line.python_line(recipe, "out.png"))) == shown(recipe)


def test_what_is_usual_is_not_named(mesh):
    recipe = Recipe(comparison(mesh))
    assert shlex.split(one_line.command_line(recipe, "a b.png")) == ["bihdist", "figure", mesh, "-o", "a b.png"]
    assert one_line.python_line(recipe, "b.pdf") == f"import bihdist; bihdist.figure({mesh!r}).save('b.pdf')"
    assert one_line.command_line(Recipe(comparison("hand")), "h.png") == "bihdist figure hand -o h.png"


def test_a_mesh_is_named_wherever_the_line_is_run(mesh, monkeypatch, tmp_path):
    from app.samples import mesh_path

    assert one_line.mesh_word(mesh_path("hand")) == "hand"
    assert one_line.mesh_word("hand") == "hand"
    monkeypatch.chdir(tmp_path)
    (tmp_path / "hand.ply").write_text("another")
    assert one_line.mesh_word("hand.ply") == str(tmp_path / "hand.ply")


def test_a_relief_is_said(tmp_path):
    path = tmp_path / "flat.off"
    path.write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 3\n3 0 3 2\n")
    recipe = Recipe(replace(comparison(str(path), (BIHARMONIC,), (0,)), warp_factor=0.1 + 0.2, up="y", camera="home"))
    assert shown(read_again(one_line.command_line(recipe, "r.png"))) == shown(recipe)
    assert shown(run_again(one_line.python_line(recipe, "r.png"))) == shown(recipe)


def test_what_no_line_can_hold_is_said_in_words(mesh):
    field = FieldArray("mine", "00")
    document = usual(mesh)
    other = replace(document, points=(Point("source", 3), Point("b", 4)), next_id=2)
    for changed, words in [
        (replace(document, fields=(field,)), "arrays"),
        (replace(document, fields=(field,), panels=(Panel(0, OwnField("mine")),)), "arrays"),
        (replace(document, surfaces=(MeshFile("A", "", "00"),)), "arrays"),
        (replace(document, surfaces=(*document.surfaces, MeshFile("B", mesh))), "draws one mesh"),
        (replace(document, panels=()), "no panels"),
        (
            replace(document, points=(*document.points, Point("a", SurfacePoint(3, (0.2, 0.2, 0.6))))).with_part(
                Anchors((Anchor("a"),))
            ),
            "not at a vertex",
        ),
        (
            replace(other, panels=(Panel(0, DistanceFrom(BIHARMONIC)), Panel(1, DistanceFrom(DIFFUSION, "b")))),
            "different points",
        ),
        (
            replace(other, panels=(Panel(0, Difference(DistanceFrom(BIHARMONIC), DistanceFrom(BIHARMONIC, "b"))),)),
            "different points",
        ),
        (replace(document, camera="top"), ""),
    ]:
        assert words in one_line.why_not(Recipe(changed))
    assert "several cameras" in one_line.why_not(Recipe(document, Page(views=(CAMERA, CAMERA))))
    assert one_line.recipe_command_line("a b.json", "x.png") == "bihdist figure --recipe 'a b.json' -o x.png"


@pytest.mark.parametrize("source", [CURVE, SourceSet((3, CURVE, BoundaryLoop(0)))])
def test_a_curve_is_named_by_a_file(mesh, tmp_path, source):
    recipe = Recipe(replace(usual(mesh), points=(Point("source", source),)))
    assert curves_in(recipe.document) == [CURVE]
    for line in (one_line.command_line, one_line.python_line):
        with pytest.raises(ParameterError, match="save it first"):
            line(recipe, "out.png")
    folder = tmp_path / "a + b"
    folder.mkdir()
    path = folder / "it's a curve.json"
    path.write_text(curve_text(CURVE))
    files = {CURVE: str(path)}
    assert one_line.why_not(recipe) == ""
    assert shown(read_again(one_line.command_line(recipe, "out.png", files))) == shown(recipe)
    if isinstance(source, Curve):  # this mesh has no boundary
        assert shown(run_again(one_line.python_line(recipe, "out.png", files))) == shown(recipe)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_line_of_python_draws_a_recipe_again(mesh, tmp_path):
    from app.main import main

    assert main(["figure", mesh, "--distance", "biharmonic", "--size", "200x200", "-o", str(tmp_path / "a.png")]) == 0
    line = one_line.recipe_python_line(str(tmp_path / "a.json"), str(tmp_path / "b.png"))
    exec(line.partition("; ")[2], {"bihdist": app})
    assert (tmp_path / "b.png").read_bytes() == (tmp_path / "a.png").read_bytes()


# ---------------------------------------------------------------------- any of them
NUMBERS = st.floats(-1e6, 1e6)
SPECS = st.sampled_from(
    [
        BIHARMONIC,
        DIFFUSION,
        Spec.of("diffusion", t=0.1 + 0.2),
        Spec.of("truncated", k=7),
        Spec.of("geodesic", method="heat"),
    ]
)
QUANTITIES = st.one_of(
    SPECS.map(DistanceFrom), st.builds(Difference, SPECS.map(DistanceFrom), SPECS.map(DistanceFrom), st.booleans())
)
VERTICES = st.integers(0, COUNT - 1)
PLACES = st.builds(SurfacePoint.of, VERTICES, st.floats(0, 0.5), st.floats(0, 0.5))
MEMBERS = st.one_of(VERTICES, PLACES, st.builds(BoundaryLoop, st.integers(0, 9)))
SOURCES = st.one_of(MEMBERS, st.lists(MEMBERS, min_size=2, max_size=4, unique=True).map(tuple).map(SourceSet))
CAMERAS = st.builds(
    Camera,
    st.tuples(NUMBERS, NUMBERS, st.floats(1, 9)),
    st.tuples(NUMBERS, NUMBERS, st.floats(-9, 0)),
    st.sampled_from([(0.0, 1.0, 1e-9), (1e-3, 1.0, 0.1)]),
    st.tuples(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3)),
)


@st.composite
def recipes(draw):
    sources = tuple(draw(st.lists(SOURCES, min_size=1, max_size=3, unique=True)))
    document = comparison("hand", tuple(draw(st.lists(QUANTITIES, min_size=1, max_size=3, unique=True))), sources)
    marks = draw(st.dictionaries(VERTICES, st.none() | NUMBERS, max_size=3))
    views = [*draw(st.lists(st.sampled_from(VIEWS), max_size=2)), *draw(st.lists(CAMERAS, max_size=1))] or ["home"]
    document = replace(
        document,
        points=(*document.points, *(Point(f"anchor {vertex}", vertex) for vertex in marks)),
        areas=draw(st.sampled_from(["voronoi", "barycentric"])),
        isolines=Isolines(draw(st.integers(0, 1000)), round=draw(st.booleans())),
        range=draw(st.sampled_from(["own", "shared", "fraction"])),
        insets=tuple(draw(st.lists(st.builds(Inset, VERTICES, st.floats(1.001, 100)), max_size=2))),
        warp_factor=draw(st.sampled_from([0.0, 0.35, 1 / 3])),
        camera=views[0],
        up=draw(st.sampled_from(UPS)),
        parallel_projection=draw(st.booleans()),
        axes=draw(st.booleans()),
    ).with_part(Anchors(tuple(Anchor(f"anchor {vertex}", value) for vertex, value in marks.items())))
    document = add_pins(document, draw(st.lists(VERTICES, max_size=3)))
    able = [k for k, panel in enumerate(document.panels, 1) if can_divide(document, panel.id)]
    if able:
        document = divide(document, draw(st.lists(st.sampled_from(able), max_size=3)))
    page = Page(
        views=tuple(views) if len(views) > 1 else (),
        size=draw(st.sampled_from(["", "85mm", "column", "1920x1080", "160mm@600dpi"])),
        style=draw(st.sampled_from(["paper", "dark", "lines"])),
        columns=draw(st.integers(1, 9)) if len(sources) > 1 else draw(st.none() | st.integers(1, 9)),
        hints=draw(st.booleans()),
        transparent=draw(st.booleans()),
        crop=draw(st.booleans()),
    )
    return Recipe(document, page)


@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)
@given(recipes())
def test_any_line_read_again_is_what_it_was_made_from(recipe):
    line = one_line.command_line(recipe, "out.pdf")
    assert "\n" not in line
    assert shown(read_again(line)) == shown(recipe)
    assert one_line.command_line(read_again(line), "out.pdf") == line


def test_interpolants_alone_are_said_without_a_source(mesh):
    shows = (quantity("interpolant by biharmonic"), quantity("weights by geodesic"))
    points = (Point("a", 3), Point("b", 9))
    document = replace(comparison(mesh, shows), points=points).with_part(Anchors((Anchor("a", 0.0), Anchor("b", 1.0))))
    line = one_line.command_line(Recipe(document), "f.png")
    assert "--distance 'interpolant by biharmonic,weights by geodesic'" in line
    assert "--anchors 3=0.0,9=1.0" in line
    assert "--sources" not in line
