"""Fields that other programs have computed, in files: in every command, in recipes, and in figures from Python."""

import json
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import app
from app.document.document import Document, FieldArray, comparison, free_field_name
from app.document.edits import MOST_ADDED, show_field
from app.document.file import read_recipe
from app.document.page import Recipe
from app.figures.one_line import command_line, python_line
from app.main import main
from bihdist_core import BiharmonicDistance, GeodesicDistance, ParameterError, difference, read_surface
from tests.commands import ran, refused
from tests.shapes import bumpy

SOURCE = ("--sources", "7")
SMALL = ("--size", "400x160")


@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(300))


@pytest.fixture
def depth(mesh):
    return read_surface(mesh).vertices[:, 2] + 9


@pytest.fixture
def file(tmp_path, depth):
    path = tmp_path / "depth.npy"
    np.save(path, depth)
    return path


@pytest.fixture
def labels(tmp_path, mesh):
    """An annotation: red in front, blue behind, none at vertex 0."""
    nibabel = pytest.importorskip("nibabel")
    path, z = tmp_path / "lh.sides.annot", read_surface(mesh).vertices[:, 2]
    keys = np.where(z > 0, 1, 0)
    keys[0] = -1
    colours = np.array([(0, 0, 255, 0), (255, 0, 0, 0)])
    nibabel.freesurfer.write_annot(path, keys, colours, ["behind", "front"], fill_ctab=True)
    return path


def test_a_figure_shows_a_field_its_difference_and_the_same_again(mesh, file, depth, tmp_path, capsys):
    out, distances = tmp_path / "f.png", "biharmonic,depth,biharmonic - depth"
    ran(capsys, "figure", mesh, *SOURCE, *SMALL, "--field", f"depth={file}", "--distance", distances, "-o", out)
    recipe = read_recipe(out.with_suffix(".json"))
    assert [str(panel.shows) for panel in recipe.document.panels] == distances.split(",")
    (field,) = recipe.document.fields
    assert (field.name, Path(field.path), len(field.sha256)) == ("depth", file, 64)
    assert not list(tmp_path.glob("*.npz"))
    answers = app.figure_again(out.with_suffix(".json")).answers
    np.testing.assert_array_equal(answers[1].field, depth)
    biharmonic = BiharmonicDistance(read_surface(mesh)).from_source(7)
    np.testing.assert_allclose(answers[2].field, 100 * difference(biharmonic, depth), rtol=0, atol=1e-10)
    ran(capsys, "figure", "--recipe", out.with_suffix(".json"), "-o", tmp_path / "g.png")
    assert (tmp_path / "g.png").read_bytes() == out.read_bytes()


def test_a_file_that_has_changed_or_is_gone_is_refused(mesh, file, depth, tmp_path, capsys):
    recipe = tmp_path / "f.json"
    ran(capsys, "figure", mesh, *SOURCE, *SMALL, "--field", file, "-o", tmp_path / "f.png")
    again = ("figure", "--recipe", recipe, "-o", tmp_path / "g.png")
    np.save(file, depth + 1)
    assert refused(capsys, *again) == f"bihdist: {file}: 'depth' has changed since its checksum was recorded."
    file.unlink()
    assert "The field in depth.npy cannot be read: there is no such file." in refused(capsys, *again)


def test_a_recipe_and_its_field_may_move_together(mesh_file, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("depth.npy", np.arange(100.0))
    mesh = mesh_file(bumpy(100))
    ran(capsys, "figure", mesh, *SMALL, "--field", "depth.npy", "--distance", "depth", "-o", "f.png")
    there = tmp_path / "there"
    there.mkdir()
    for path in (Path(mesh), Path("depth.npy"), Path("f.json")):
        path.rename(there / path.name)
    monkeypatch.chdir(there)
    np.testing.assert_array_equal(app.figure_again("f.json").answers[0].field, np.arange(100.0))


def test_every_command_takes_a_field(mesh, file, depth, tmp_path, capsys):
    field = (mesh, *SOURCE, "--field", f"depth={file}")
    biharmonic = BiharmonicDistance(read_surface(mesh)).from_source(7)
    facts = json.loads(ran(capsys, "statistics", *field, "--json").out)
    assert facts["fields"][0]["greatest_at"] == depth.argmax()
    both = ("--distance", "biharmonic,depth", "--scatter", tmp_path / "s.csv")
    ran(capsys, "statistics", *field, *both)
    found = np.loadtxt(tmp_path / "s.csv", delimiter=",", skiprows=1)
    order = found[:, 0].astype(int)
    np.testing.assert_allclose(found[:, 1:].T, [(each / each.max())[order] for each in (biharmonic, depth)])
    ran(capsys, "field", *field, "--distance", "raw depth - biharmonic", "-o", tmp_path / "d.npy")
    np.testing.assert_allclose(np.load(tmp_path / "d.npy"), depth - biharmonic, rtol=0, atol=1e-10)
    sources = (mesh, "--sources", "7,9", "--field", file, "-o", tmp_path / "d.csv")
    ran(capsys, "field", *sources, "--distance", "depth - geodesic")
    found = np.loadtxt(tmp_path / "d.csv", delimiter=",", skiprows=1)[:, 1:]
    geodesic = GeodesicDistance(read_surface(mesh)).from_sources([7, 9])
    np.testing.assert_allclose(found, 100 * difference(np.stack([depth] * 2, 1), geodesic), rtol=0, atol=1e-9)
    ran(capsys, "field", *sources)
    np.testing.assert_array_equal(np.loadtxt(tmp_path / "d.csv", delimiter=",", skiprows=1)[:, 1], depth)
    ran(capsys, "isolines", *field, "--isoline-values", "9.5", "-o", tmp_path / "l.csv")
    lines = np.genfromtxt(tmp_path / "l.csv", delimiter=",", names=True)
    np.testing.assert_allclose(lines["z"], 0.5, atol=1e-9)  # the depth is linear in each face
    ran(capsys, "profile", *field, "--pins", "3,200", "--distance", "depth", "-o", tmp_path / "p.csv")
    path = np.genfromtxt(tmp_path / "p.csv", delimiter=",", names=True)
    np.testing.assert_allclose(path["depth"], path["z"] + 9, atol=1e-9)
    ran(capsys, "movie", *field, "--frames", "2", "--size", "200x100", "-o", tmp_path / "m.gif")
    ran(capsys, "page", *field, "-o", tmp_path / "p.html")
    assert "field depth" in (tmp_path / "p.html").read_text()


COMMANDS = {
    "figure": ("-o", "f.png"),
    "movie": ("-o", "f.gif"),
    "page": ("-o", "f.html"),
    "view": ("--screenshot", "f.png"),
    "statistics": (),
    "isolines": ("-o", "f.csv"),
    "field": ("-o", "f.csv"),
    "profile": ("--pins", "1,2", "-o", "f.csv"),
}


@pytest.mark.parametrize("command", [name for name in COMMANDS if name != "view"])
def test_another_count_is_refused_in_a_sentence(mesh, tmp_path, capsys, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    np.save("few.npy", np.arange(7.0))
    said = refused(capsys, command, mesh, "--field", "few.npy", *COMMANDS[command])
    assert said == "bihdist: The field 'few' has 7 values, and mesh.off has 300 vertices."


@pytest.mark.parametrize("command", COMMANDS)
def test_one_of_several_arrays_is_named(mesh, depth, tmp_path, capsys, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    np.savez("all.npz", depth=depth, curv=-depth)
    said = refused(capsys, command, mesh, "--field", "all.npz", *COMMANDS[command])
    assert said == "bihdist: all.npz has 2 arrays, depth, curv; name one behind a colon, all.npz:depth."
    if command != "view":
        ran(capsys, command, mesh, "--field", "a=all.npz:depth,all.npz:curv", *SOURCE, *COMMANDS[command])


def test_names_that_make_no_sense_are_refused(mesh, file, tmp_path, capsys):
    def said(*words):
        return refused(capsys, "figure", mesh, "-o", tmp_path / "f.png", *words)

    assert "There are two fields 'a'" in said("--field", f"a={file},a={file}")
    with pytest.raises(SystemExit):
        said("--field", f"biharmonic={file}")
    assert "'biharmonic' is a distance" in capsys.readouterr().err
    assert "The fields are depth." in said("--field", file, "--distance", "thickness")
    assert "is of no kind of which fields are read" in said("--field", mesh)
    assert "there is no such file" in said("--field", "a=none.npy")
    assert "is a distance" not in ran(capsys, "statistics", mesh, "--field", file).err
    assert refused(capsys, "view", "--field", file, "--screenshot", "f.txt")
    recipe = tmp_path / "a.json"
    ran(capsys, "figure", mesh, "--distance", "biharmonic", *SMALL, "-o", tmp_path / "a.png")
    assert refused(capsys, "view", recipe, "--field", file).endswith("A session says field itself; leave out --field.")
    ran(capsys, "figure", "--recipe", recipe, "--field", file, "-o", tmp_path / "b.png")
    shown = [str(panel.shows) for panel in read_recipe(tmp_path / "b.json").document.panels]
    assert shown == ["biharmonic", "depth"]


def test_a_line_makes_the_figure_again(mesh, file, tmp_path):
    np.savez(tmp_path / "all.npz", a=np.arange(300.0), b=np.ones(300))
    fields = {"deep": file, "a": f"{tmp_path / 'all.npz'}:a"}
    picture = app.figure(mesh, ["biharmonic", "deep - geodesic", "a"], 7, fields=fields)
    line = command_line(Recipe(picture.document), str(tmp_path / "f.png"))
    assert main(shlex.split(line)[1:]) == 0
    again = read_recipe(tmp_path / "f.json").document
    run = {}
    exec(
        python_line(Recipe(picture.document), "f.png").rpartition(".save")[0].replace("bihdist.", "made = bihdist."),
        run,
    )
    for document in (again, run["made"].document):
        assert [str(panel.shows) for panel in document.panels] == ["biharmonic", "deep - geodesic", "a"]
        assert {each.sha256 for each in document.fields} == {each.sha256 for each in picture.document.fields}
    # Beside the usual panels, a field needs no words.
    usual = app.figure(mesh, fields={"deep": file})
    assert "--distance" not in command_line(Recipe(usual.document), "f.png")


def test_values_on_both_sides_of_0_are_signed_and_rounding_is_not(mesh, tmp_path, depth):
    cases = {"signed": (depth - 9, True), "rounding": (np.append(depth[1:], -0.001), False), "below": (-depth, True)}
    cases["none"] = (np.full(300, np.nan), False)
    for name, (values, is_signed) in cases.items():
        (answer,) = app.figure(mesh, [name], fields={name: values}).answers
        assert (answer.is_signed, answer.is_distance, answer.unit) == (is_signed, False, "")


def test_isolines_do_not_cover_noise():
    ball = bumpy(3000)
    noise = np.random.default_rng(0).normal(size=len(ball.vertices))
    fields = {"smooth": ball.vertices[:, 0] ** 3, "noise": noise}
    smooth, rough, less = app.figure(ball, ["smooth", "noise", "biharmonic - noise"], fields=fields).answers
    assert (smooth.is_rough, rough.is_rough, less.is_rough) == (False, True, True)


def test_labels_have_colours_names_and_a_legend(mesh, labels, tmp_path, capsys):
    picture = app.figure(mesh, ["sides"], fields={"sides": labels}, layout={"size": "500", "style": "lines"})
    (answer,) = picture.answers
    assert answer.field is None
    z = read_surface(mesh).vertices[1:, 2]
    np.testing.assert_array_equal(answer.colours[1:], np.where(z[:, None] > 0, [1.0, 0, 0], [0, 0, 1.0]))
    assert np.isnan(answer.colours[0]).all()
    assert (answer.labels.name_at(0), answer.labels.name_at(1)) == ("", "front" if z[0] > 0 else "behind")
    assert [(mark.colour, words) for mark, words in picture._figure.legend] == [
        ("#0000ff", "behind"),
        ("#ff0000", "front"),
    ]
    # Between two labels there is no third: without shading a pixel has the colour of one, but for smooth edges.
    red, green, blue = np.moveaxis(picture.pixels[60:400].astype(int), 2, 0)
    on_surface, between = (green == 0) & (red + blue > 200), (green == 0) & (red > 60) & (blue > 60)
    assert on_surface.sum() > 20_000
    assert between.sum() < 0.03 * on_surface.sum()
    assert 'id="labels-0"' in picture.save(tmp_path / "f.svg").read_text()
    out = tmp_path / "f.png"
    said = ran(capsys, "figure", mesh, "--field", labels, "--distance", "sides", *SMALL, "-o", out).err
    assert "There is no legend of labels on a page of given height; give its width only." in said
    movie = ("movie", mesh, "--field", labels, "--distance", "sides", "--frames", "2", "--size", "500")
    ran(capsys, *movie, "-o", tmp_path / "%d.png")
    for number in "12":
        with Image.open(tmp_path / f"{number}.png") as frame:
            under = np.asarray(frame)[-30:]
        assert [(under == colour).all(axis=2).sum() > 30 for colour in ([0, 0, 255], [255, 0, 0])] == [True, True]


def test_a_legend_of_many_labels_names_the_largest(mesh, tmp_path, capsys):
    nibabel = pytest.importorskip("nibabel")
    colours = np.array([(k, 0, 1, 0) for k in range(60)])
    keys = np.append(np.arange(300) % 59, [])
    path = tmp_path / "lh.many.annot"
    nibabel.freesurfer.write_annot(path, keys.astype(int), colours, [f"part {k}" for k in range(60)], fill_ctab=True)
    said = ran(capsys, "figure", mesh, "--field", path, "--distance", "many", "-o", tmp_path / "f.png").err
    assert "The legend names the 48 labels of most vertices among 59." in said


def test_labels_are_no_values(mesh, labels, tmp_path, capsys):
    field = (mesh, "--field", labels)
    assert refused(capsys, "statistics", *field) == "bihdist: sides has labels, and no values."
    assert refused(capsys, "profile", *field, "--pins", "1,2", "-o", tmp_path / "p.csv").endswith("and no values.")
    difference = ("--distance", "biharmonic - sides", "-o", tmp_path / "f.png")
    assert "sides is shown in colours, and has no values to subtract" in refused(capsys, "figure", *field, *difference)
    on_page = ("--distance", "biharmonic - sides", "-o", tmp_path / "f.html")
    assert "sides is shown in colours, and has no values to subtract" in refused(capsys, "page", *field, *on_page)


def test_a_field_is_added_once_and_where_there_is_room():
    field = FieldArray("depth", "00", "A", "/a/depth.npy")
    document = show_field(comparison("hand"), field, 0)
    assert str(document.panels[-1].shows) == "depth"
    again = show_field(document, field, 0)
    assert (len(again.fields), len(again.panels)) == (1, len(document.panels) + 1)
    other = show_field(document, replace(field, sha256="11"), 0)
    assert [each.name for each in other.fields] == ["depth", "depth 2"]
    while len(document.panels) < MOST_ADDED:
        document = show_field(document, field, 0)
    full = show_field(document, replace(field, sha256="22"), 1)
    assert (len(full.panels), str(full.panels[1].shows)) == (MOST_ADDED, "depth 2")


@pytest.mark.parametrize("text", ["thick - ness", "raw a", "geodesic", "", " a\n", "x" * 200, "diffusion(t=1)"])
def test_names_of_files_become_names_of_fields(text):
    name = free_field_name(text, ["a"])
    document = Document(surfaces=comparison("hand").surfaces, fields=(FieldArray(name, ""),))
    assert document.fields[0].name != "a"
    assert free_field_name("a", ["a"]) == "a 2"


def test_a_path_that_is_none_is_refused(mesh):
    with pytest.raises(ParameterError, match="there is no such file"):
        app.figure(mesh, ["biharmonic"], fields={"a": Path("none.npy")})
