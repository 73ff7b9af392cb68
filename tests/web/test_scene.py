"""What a page shows is what figures and the window show of a document; what it cannot show is refused in a sentence."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

import app as bihdist
from app.document.camera import Camera
from app.document.document import Inset, MeshFile, comparison
from app.document.looks import Clip, Colours, Isolines, Shading
from app.document.on_surface import Hidden
from app.document.page import Page, Recipe
from app.document.quantities import quantity
from app.document.second_mesh_edits import open_second_mesh
from app.document.shared_parts.pins import Pins, add_pins, change_pin
from app.figures.export import compute, figure_of, open_document
from app.scene.camera import standard_camera
from app.scene.levels import levels
from app.scene.style import DARK, PAPER, style_of
from app.session.array_store import ArrayStore
from app.session.questions import first_source
from app.web.contents import Contents
from app.web.scene import _check_numbers, scene_of
from bihdist_core import ParameterError, Surface
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import SourceSet, SurfacePoint
from tests.commands import ran

from ..shapes import bumpy, two_pieces

SHOWN = ("biharmonic", "commute-time", "biharmonic - geodesic")


@pytest.fixture
def scene(mesh_file):
    """The scene of a small mesh, of a document that a function has changed; with the figure of the same."""

    def make(shows=SHOWN, edit=lambda document: document, page=None, surface=None, name="mesh.off", source=5):
        path = mesh_file(surface or bumpy(300), name)
        document = edit(comparison(path, tuple(map(quantity, shows)), (source,)))
        recipe = Recipe(Contents.of(document).document, page or Page())
        document, surfaces = open_document(recipe, ArrayStore())
        recipe = replace(recipe, document=document)
        contents = Contents.of(document)
        answers = compute(document, surfaces)
        made = scene_of(recipe, contents, surfaces, answers, {"bits": 24, "differs": {"biharmonic": 1e-7}})
        json.dumps(made, allow_nan=False)
        make.figure = figure_of(recipe, surfaces, answers)
        make.surface = surfaces["A"].surface
        return made

    return make


# ---------------------------------------------------------------------- what is refused
@pytest.mark.parametrize(
    ("shows", "sentence"),
    [
        (
            "interpolant by biharmonic",
            r"Panel 2 \(.*\) cannot be on a page that computes, which has biharmonic, .*leave it",
        ),
        ("geodesic(method=heat)", r"Panel 2 \(geodesic\(method=heat\)\) is not exact: .*say geodesic\(method=exact\)"),
        ("biharmonic - geodesic(method=dijkstra)", "is not exact"),
    ],
)
def test_a_panel_that_a_page_cannot_compute_is_named_with_the_reason(shows, sentence):
    with pytest.raises(ParameterError, match=sentence):
        Contents.of(comparison("hand", (quantity("biharmonic"), quantity(shows))))


def test_several_sources_and_sets_are_refused():
    with pytest.raises(ParameterError, match=r"start from 2 sources, .*choose one of them"):
        Contents.of(comparison("hand", sources=(1, 2)))
    for source, words in ((SourceSet((1, 2)), r"1\+2"), (SurfacePoint(3, (0.2, 0.5, 0.3)), "f3:")):
        with pytest.raises(ParameterError, match=f"start from {words}.*choose one with --sources"):
            Contents.of(comparison("hand", (Spec.of("biharmonic"),), (source,)))


def test_two_meshes_and_no_panels_are_refused():
    with pytest.raises(ParameterError, match="one mesh, and here are 2; make a page of each"):
        Contents.of(open_second_mesh(comparison("hand"), MeshFile("", "hare")))
    with pytest.raises(ParameterError, match="nothing to show"):
        Contents.of(replace(comparison("hand"), panels=()))


def test_a_number_that_is_not_finite_is_refused_with_its_place():
    with pytest.raises(ParameterError, match=r"the scene\.camera\.up\[1\] is nan"):
        _check_numbers({"camera": {"up": [0.0, math.nan]}}, "the scene")


# ---------------------------------------------------------------------- panels
def test_geodesic_distances_are_exact_and_each_distance_has_a_name():
    shows = ("geodesic", "diffusion", "diffusion(t=1/4)", "biharmonic - diffusion(t=1/4)", "truncated(k=20)")
    contents = Contents.of(comparison("hand", tuple(map(quantity, shows)), (3,)))
    assert {name: str(spec) for name, spec in contents.fields.items()} == {
        "geodesic": "geodesic(method=exact)",
        "diffusion@1.0": "diffusion",
        "diffusion@0.25": "diffusion(t=1/4)",
        "biharmonic": "biharmonic",
        "truncated": "truncated(k=20)",
    }
    assert set(contents.by_eigenpairs) == {"truncated"}
    assert contents.source == 3


def test_vertices_without_faces_do_not_count(tmp_path):
    s = bumpy(100)
    alone = Surface(np.vstack([s.vertices, [[9.0, 9, 9]]]), s.faces, name="alone")
    assert bihdist.page(alone, tmp_path / "p.html", ["biharmonic"]).scene["mesh"]["counts"]["vertices"] == 100


def test_panels_say_what_they_show(scene):
    made = scene()
    assert [panel["distance"] for panel in made["panels"]] == ["biharmonic", "commute_time", "difference"]
    assert made["panels"][2]["of"] == ["biharmonic", "geodesic"]
    assert [panel["label"] for panel in made["panels"]] == [p.heading for p in scene.figure.panels]
    assert [panel["unit"] for panel in made["panels"]] == ["mesh units", "no unit", "percentage points"]
    assert [panel["range"] for panel in made["panels"]] == [None] * 3
    assert made["source"] == 5
    assert made["mesh"] == {
        "name": "mesh.off", "unit": "mesh units", "bits": 24, "differs": {"biharmonic": 1e-7},
    }  # fmt: skip


def test_parameters_are_with_their_panels(scene):
    made = scene(("truncated(k=20)", "diffusion(t=1/4)"))
    assert [panel["parameters"] for panel in made["panels"]] == [{"k": 20}, {"time": 0.25}]


def test_an_end_that_was_typed_is_that_of_the_bar(scene):
    def typed(document):
        first, second, third = document.panels
        return replace(document, panels=(replace(first, maximum=0.5), second, replace(third, maximum=0.1)))

    made = scene(edit=typed)
    assert [panel["range"] for panel in made["panels"]] == [[0.0, 0.5], None, [-10.0, 10.0]]


def test_shared_ranges_end_alike_and_say_so(scene):
    made = scene(("biharmonic", "geodesic"), lambda document: replace(document, range="shared"))
    (one, two), tops = (panel["range"] for panel in made["panels"]), scene.figure.upper_limits()
    assert one == two == [0.0, pytest.approx(tops[0])]
    assert "from vertex 5" in made["notes"][0]
    alone = scene(("biharmonic",), lambda document: replace(document, range="shared"))
    assert alone["panels"][0]["range"] is None
    assert alone["notes"] == []


def test_in_shares_each_bar_ends_at_its_own_maximum_from_any_source(scene):
    made = scene(edit=lambda document: replace(document, range="fraction"))
    assert [panel["shares"] for panel in made["panels"]] == [True, True, False]
    assert [panel["range"] for panel in made["panels"]] == [None] * 3


# ---------------------------------------------------------------------- isolines
def test_isolines_are_counted_or_listed(scene):
    made = scene()
    assert made["isolines"] == {
        "count": 20, "values": None, "equal": False, "colour": [255, 255, 255], "width": PAPER.isoline_width
    }  # fmt: skip
    assert all("isolines" not in panel for panel in made["panels"])

    def with_lines(**how):
        return lambda document: replace(document, isolines=Isolines(**how))

    assert scene(edit=with_lines(count=8, round=False))["isolines"]["equal"]
    made = scene(edit=with_lines(values=(0.1, 0.25)))
    assert made["isolines"]["values"] == [0.1, 0.25]
    assert made["panels"][2]["isolines"]["values"] == [10.0, 25.0]


def test_a_spacing_is_listed_as_far_as_it_may_be_needed(scene):
    made = scene(edit=lambda document: replace(document, isolines=Isolines(spacing=0.05)))
    biharmonic, _, difference = scene.figure.panels
    for listed, panel in ((made["isolines"], biharmonic), (made["panels"][2]["isolines"], difference)):
        inside = [v for v in listed["values"] if (-panel.own_maximum if panel.signed else 0) < v < panel.own_maximum]
        shown = levels(panel.isolines, panel.upper_limit, panel.own_maximum, panel.signed).values
        np.testing.assert_allclose(inside, shown, rtol=1e-12)
        assert max(listed["values"]) > 3 * panel.own_maximum


def test_a_spacing_that_makes_too_many_lines_is_cut_short(scene):
    made = scene(("biharmonic",), lambda document: replace(document, isolines=Isolines(spacing=1e-6)))
    assert len(made["isolines"]["values"]) == 500


# ---------------------------------------------------------------------- pins, camera, colours
def test_pins_have_ids_of_the_file_and_names_as_they_are(scene):
    hostile = "</script><b onmouseover=alert(1)>"

    def pinned(document):
        document = add_pins(document, [7, SurfacePoint(3, (0.2, 0.7, 0.1))])
        return change_pin(document, replace(document[Pins].pins[0], name=hostile))

    made = scene(edit=pinned)
    corner = int(scene.surface.faces[3][1])
    assert made["pins"] == [{"id": 7, "name": hostile}, {"id": corner, "name": ""}]
    assert made["notes"] == [f"Pin 2 is in a face; on this page it is at the nearest corner, vertex {corner}."]


def test_hidden_pins_are_on_no_page(scene):
    def hidden(document):
        document = add_pins(document, [7, 9, 11])
        return document.with_part(Hidden(("source", "pins:pin 2")))

    made = scene(edit=hidden)
    assert [pin["id"] for pin in made["pins"]] == [7, 11]
    assert made["notes"] == [
        "The page leaves out that the source is hidden.",
        "Pins after those that are hidden have lower numbers on this page.",
    ]


def test_a_standard_view_is_that_of_the_shape(scene):
    made = scene(edit=lambda document: replace(document, camera="left", up="z"))["camera"]
    camera = standard_camera(scene.surface.vertices, 1.0, "left", up="z")
    np.testing.assert_allclose(made["position"], camera.position)
    np.testing.assert_allclose(made["focal"], camera.focal_point)
    assert made["angle"] == pytest.approx(math.degrees(2 * math.atan(camera.extent[1])))
    assert made["parallel"] is None


def test_a_camera_of_the_window_is_that_of_the_page(scene):
    camera = Camera((0.0, 0, 10), (0, 0, 1), (0, 1, 0), (0.4, 0.2))
    made = scene(edit=lambda document: replace(document, camera=camera, parallel_projection=True))["camera"]
    assert made["position"] == [0, 0, 10]
    assert made["up"] == [0, 1, 0]
    assert made["parallel"] == pytest.approx(0.2 * 9)


@pytest.mark.parametrize("word", ["paper", "dark"])
def test_colours_by_day_and_night_are_those_of_the_styles(scene, word):
    colours = scene(page=Page(style=word))["colours"]
    for name, style in (("map", PAPER), ("dark_map", DARK)):
        np.testing.assert_array_equal(colours[name], np.rint(255 * style.colours(256)))
    np.testing.assert_array_equal(colours["diverging"], np.rint(255 * PAPER.colours(256, signed=True)))
    assert colours["background"] is None
    assert colours["back"] == [round(255 * x) for x in PAPER.back]
    assert colours["dark_back"] == [round(255 * x) for x in DARK.back]
    assert colours["dark_section"] == [round(255 * x) for x in DARK.section]


def test_a_map_that_stays_at_night_is_there_once(scene):
    colours = scene(page=Page(style="uniform"))["colours"]
    assert colours["dark_map"] is None


@pytest.mark.parametrize(("shading", "crease"), [("auto", None), ("smooth", None), ("creased", 30.0), ("flat", 0.0)])
def test_creases_are_the_documents(scene, shading, crease):
    assert scene(edit=lambda document: replace(document, shading=Shading(shading, 30.0)))["crease"] == crease


def test_a_clip_plane_is_the_documents(scene):
    assert (scene()["clip"], scene()["opacity"]) == (None, 1)
    assert scene(edit=lambda document: replace(document, opacity=0.4))["opacity"] == 0.4
    x, y, z, offset = scene(edit=lambda document: replace(document, clip=Clip((0.0, -2.0, 0.0), 0.25)))["clip"]
    assert (x, y, z) == (0, -1, 0)
    heights = scene.surface.vertices[:, 1]
    assert offset == pytest.approx(-(heights.max() - 0.25 * np.ptp(heights)))


def test_a_chosen_map_is_that_of_the_page(scene):
    chosen = Colours(map="ember", reversed=True)
    made = scene(edit=lambda document: replace(document, colours=chosen))
    style = style_of("paper", chosen)
    np.testing.assert_array_equal(made["colours"]["map"], np.rint(255 * style.colours(256)))
    assert made["isolines"]["colour"] == [round(255 * x) for x in style.isoline]


# ---------------------------------------------------------------------- what is said
def test_what_the_page_leaves_out_is_said(scene):
    def adorned(document):
        return replace(
            document,
            isolines=Isolines(bold=5, labels=True, through=("source",)),
            insets=(Inset(3),),
            colours=Colours(bands=True),
            shading=Shading("flat", show_edges=True),
            extrema=True,
            axes=True,
        )

    (note,) = scene(edit=adorned, page=Page(views=("front", "back")))["notes"]
    assert note == (
        "The page leaves out isolines through points, bold isolines, the values of isolines, bands of one colour, "
        "insets, the triangles at extrema, the wireframe, directions of axes and views but the first."
    )
    assert scene()["notes"] == []


def test_what_is_to_be_minded_of_the_mesh_is_said(scene):
    (note,) = scene(("biharmonic",), surface=two_pieces(), source=0)["notes"]
    assert note.startswith("mesh.off: ")
    assert "2 components" in note


def test_names_of_files_are_plain_text(scene):
    made = scene(name="a<b>&\u202e\x07.off")
    assert made["mesh"]["name"] == "a<b>&��.off"
    assert made["title"] == "Distances on a<b>&��.off"


def test_a_panel_without_a_field_is_refused(scene, no_exact_geodesics):
    with pytest.raises(ParameterError, match=r"has no field: .*no room for windows"):
        scene(("biharmonic", "geodesic"))


# ---------------------------------------------------------------------- fields of one's own
def test_fields_of_ones_own_are_as_figures_show_them_and_said_to_stay(tmp_path):
    s = bumpy(300)
    values = np.linspace(-1, 3, 300)
    values[3] = np.nan
    fields = {"mine": values, "<b>": values**2}
    made = bihdist.page(
        s, tmp_path / "p.html", ["biharmonic", "raw biharmonic - mine"], 5, fields=fields, look={"clim": "own"}
    )
    shown = bihdist.figure(s, ["biharmonic", "raw biharmonic - mine"], 5, fields=fields)._figure
    panels = made.scene["panels"]
    assert [panel["distance"] for panel in panels] == ["biharmonic", "difference", "field <b>"]
    assert panels[1]["of"] == ["biharmonic", "field mine"]
    for panel, figure in zip(panels, shown.panels, strict=True):
        assert (panel["label"], panel["unit"], panel["signed"]) == (figure.heading, figure.unit, figure.signed)
    assert [panel["note"] for panel in panels] == [
        "", "mine is the same from every source", "the same from every source",
    ]  # fmt: skip
    assert made.scene["notes"] == [
        "mine is a field of the user's own, the same from every source.",
        "<b> is a field of the user's own, the same from every source.",
    ]
    assert {*made.differs} == {"biharmonic", "field mine", "field <b>"}
    assert 0 < made.differs["field mine"] <= 2**-24
    text = (tmp_path / "p.html").read_text(encoding="utf-8")
    assert "field \\u003cb>" in text
    assert "field <b>" not in text


def test_a_field_of_ones_own_alone_has_its_sign_and_the_highest_vertex(tmp_path):
    s = bumpy(200)
    made = bihdist.page(
        s, tmp_path / "p.html", [], fields={"mine": s.vertices[:, 2]}, view={"viewup": "z"}, look={"clim": 2.0}
    )
    (panel,) = made.scene["panels"]
    assert (panel["signed"], panel["range"], panel["note"]) == (True, [-2.0, 2.0], "the same from every source")
    assert made.scene["source"] == first_source(s, "z")
    assert {*made.differs} == {"field mine"}


def test_labels_are_places_among_those_that_are_there_and_have_no_isolines(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    s, path = bumpy(200), tmp_path / "lh.parts.annot"
    keys = np.where(s.vertices[:, 0] > 0, 3, 1)
    keys[7] = -1
    colours = np.array([(10 * k, 200, k, 0) for k in range(5)])
    nibabel.freesurfer.write_annot(path, keys, colours, [f"part {k}" for k in range(5)], fill_ctab=True)
    made = bihdist.page(s, tmp_path / "p.html", ["biharmonic"], 5, fields={"parts": str(path)}, isolines=12)
    first, panel = made.scene["panels"]
    assert panel["labels"] == [
        {"name": "part 1", "colour": [10, 200, 1]}, {"name": "part 3", "colour": [30, 200, 3]},
    ]  # fmt: skip
    assert (panel["range"], panel["isolines"]["count"], panel["label"]) == ([-0.5, 1.5], 0, "parts")
    assert "labels" not in first
    assert made.scene["isolines"]["count"] == 12
    stored = made.given["field parts"]
    places = np.where(keys[made.mesh.ids] < 0, np.nan, keys[made.mesh.ids] == 3)
    np.testing.assert_array_equal(stored.multiples * stored.scale, places)
    assert made.differs["field parts"] == 0


def test_a_field_of_another_length_is_refused(tmp_path):
    with pytest.raises(ParameterError, match="'mine' has 5 values"):
        bihdist.page(bumpy(200), tmp_path / "p.html", fields={"mine": np.arange(5)})


def test_a_recipe_with_fields_of_ones_own_becomes_a_page(mesh_file, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    s = bumpy(200)
    bihdist.figure(s, ["biharmonic - mine"], 5, fields={"mine": s.vertices[:, 0]}, layout={"size": "200x100"}).save(
        "f.png"
    )
    said = ran(capsys, "page", "--recipe", "f.json", "-o", "p.html", "--json")
    facts = json.loads(said.out)
    assert [panel["label"] for panel in facts["panels"]] == ["biharmonic, exact − mine"]
    assert facts["distances"][-1] == {
        "distance": "field mine",
        "difference": pytest.approx(3e-8, abs=3e-8),
        "difference_sources": None,
        "n_eigenpairs": 0,
    }
    assert "mine is a field of the user's own" in said.err
