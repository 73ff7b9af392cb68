"""The command line without a window: what it writes and says."""

import json
import re

import numpy as np
import pytest

from app.document.file import read_recipe
from app.document.looks import Colours
from app.main import _with_values, main
from app.scene.field_actor import lookup_table
from app.scene.style import PAPER, style_of
from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    PowerDistance,
    Surface,
    TruncatedBiharmonicDistance,
    read_surface,
)
from tests.commands import ran, refused
from tests.programs import run_python
from tests.shapes import bumpy, caps, grid, two_pieces


@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(200))


# ---------------------------------------------------------------------- field
def test_field_writes_one_column_per_source(mesh, tmp_path, capsys):
    out = tmp_path / "d.npy"
    assert main(["field", mesh, "--sources", "3,7", "-o", str(out)]) == 0
    expected = BiharmonicDistance(read_surface(mesh)).from_sources([3, 7])
    assert np.allclose(np.load(out), expected, rtol=1e-12)
    assert "biharmonic, exact, 200 vertices, 2 sources" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "make"),
    [
        (["biharmonic", "--areas", "barycentric"], lambda s: BiharmonicDistance(Laplacian(s, "barycentric"))),
        (["truncated(k=20)"], lambda s: TruncatedBiharmonicDistance(s, k=20)),
        (["diffusion(t=1/4)"], lambda s: DiffusionDistance(s, t=0.25)),
        (["truncated", "--k", "20"], lambda s: TruncatedBiharmonicDistance(s, k=20)),
        (["commute"], CommuteTimeDistance),
        (["power", "--alpha", "3"], lambda s: PowerDistance(s, alpha=3)),
        (["commute-time"], CommuteTimeDistance),
        (["diffusion", "--t", "0.25"], lambda s: DiffusionDistance(s, t=0.25)),
        (["geodesic"], lambda s: GeodesicDistance(s, "exact")),
        (["geodesic", "--method", "heat"], lambda s: GeodesicDistance(s, "heat")),
    ],
)
def test_every_distance_has_its_word(mesh, tmp_path, words, make):
    out = tmp_path / "d.npy"
    assert main(["field", mesh, "--sources", "3", "--distance", *words, "-o", str(out)]) == 0
    assert np.allclose(np.load(out), make(read_surface(mesh)).from_source(3), rtol=1e-9)


def test_field_names_its_columns_in_csv(mesh_file, tmp_path):
    out = tmp_path / "d.csv"
    assert main(["field", mesh_file(two_pieces()), "--sources", "3,61", "-o", str(out)]) == 0
    lines = out.read_text().splitlines()
    assert lines[0] == "vertex,biharmonic_from_3,biharmonic_from_61"
    assert len(lines) == 66
    assert lines[1 + 3].startswith("3,0")
    assert lines[1 + 62].split(",")[1] == "nan"


@pytest.mark.parametrize("name", ["d.ply", "d.vtp"])
def test_field_writes_meshes_that_open_again(mesh, tmp_path, name):
    out = tmp_path / name
    assert main(["field", mesh, "--sources", "3", "-o", str(out)]) == 0
    again = read_surface(out)
    assert np.array_equal(again.faces, read_surface(mesh).faces)


# ---------------------------------------------------------------------- pairs
def test_pairs_of_a_set_as_a_matrix_and_as_rows(mesh, tmp_path):
    expected = BiharmonicDistance(read_surface(mesh)).pairwise([5, 1, 9])
    out = tmp_path / "p.npy"
    assert main(["pairs", mesh, "--sources", "5,1,9", "-o", str(out)]) == 0
    assert np.allclose(np.load(out), expected, rtol=1e-12)
    rows = tmp_path / "p.csv"
    assert main(["pairs", mesh, "--sources", "5,1,9", "-o", str(rows)]) == 0
    assert rows.read_text().splitlines()[0] == "i,j,distance"
    table = np.loadtxt(rows, delimiter=",", skiprows=1)
    assert table[:, :2].tolist() == [[5, 1], [5, 9], [1, 9]]
    assert table[:, 2] == pytest.approx([expected[0, 1], expected[0, 2], expected[1, 2]])


def test_several_distances_are_a_column_each(mesh, tmp_path, capsys):
    out = tmp_path / "p.csv"
    words = ["--distance", "biharmonic,diffusion(t=1/4)"]
    assert main(["pairs", mesh, "--pairs", "1:2,3:4", *words, "-o", str(out)]) == 0
    assert out.read_text().splitlines()[0] == "i,j,biharmonic,diffusion(t=1/4)"
    table, s = np.loadtxt(out, delimiter=",", skiprows=1), read_surface(mesh)
    assert table[:, 2] == pytest.approx(BiharmonicDistance(s).of_pairs([[1, 2], [3, 4]]))
    assert table[:, 3] == pytest.approx(DiffusionDistance(s, t=0.25).of_pairs([[1, 2], [3, 4]]))
    assert len(capsys.readouterr().out.splitlines()) == 2
    assert "name one" in refused(capsys, "pairs", mesh, "--sources", "all", *words, "-o", tmp_path / "all.npy")


def test_listed_pairs_from_words_and_from_a_file(mesh, tmp_path):
    distance = BiharmonicDistance(read_surface(mesh))
    expected = [distance.between(1, 2), distance.between(3, 4), distance.between(2, 1)]
    file = tmp_path / "pairs.csv"
    file.write_text("i,j\n1,2\n3, 4\n\n2;1\n")
    for words in ("1:2,3:4,2:1", f"@{file}"):
        out = tmp_path / "p.npy"
        assert main(["pairs", mesh, "--pairs", words, "-o", str(out)]) == 0
        assert np.load(out)[:, 2] == pytest.approx(expected)


def test_all_pairs_go_to_disk(mesh, tmp_path, capsys):
    out = tmp_path / "all.npy"
    expected = BiharmonicDistance(read_surface(mesh)).from_sources(np.arange(200))
    # Rounded to single precision, and as it is computed.
    for dtype, near in (("float32", 1e-6), ("float64", 1e-12)):
        words = [] if dtype == "float64" else ["--dtype", dtype]
        assert main(["pairs", mesh, "--sources", "all", "--memory", "1", *words, "-o", str(out)]) == 0
        written = np.load(out)
        assert written.dtype == dtype
        assert np.abs(written - expected).max() <= near * expected.max()
    assert ".csv" in refused(capsys, "pairs", mesh, "--sources", "all", "-o", tmp_path / "all.csv")


def test_all_pairs_within_a_radius_are_inf_beyond(mesh, tmp_path, capsys):
    out, words = tmp_path / "near.npy", ("pairs", mesh, "--sources", "all", "--radius", "0.8")
    assert "geodesic, exact up to 0.8" in ran(capsys, *words, "--distance", "geodesic", "-o", out).out
    whole = GeodesicDistance(read_surface(mesh), "exact").from_sources(np.arange(200)).T
    assert 0.02 < (whole <= 0.8).mean() < 0.98
    # Windows that end at the radius are added in another order.
    np.testing.assert_allclose(np.load(out), np.where(whole <= 0.8, whole, np.inf), rtol=1e-12, atol=1e-12)
    assert "with --distance geodesic, not with biharmonic" in refused(capsys, *words, "-o", out)
    heat = ("--distance", "geodesic", "--method", "heat")
    assert "Only the exact method has a radius" in refused(capsys, *words, *heat, "-o", out)


# ---------------------------------------------------------------------- accuracy
ACCURATE = re.compile(r"accurate to \de-1\d of the maximum")


def test_answers_come_with_their_accuracy(mesh, tmp_path, capsys):
    out = str(tmp_path / "d.npy")
    for command in (
        ["field", mesh, "--sources", "3"],
        ["pairs", mesh, "--pairs", "1:2"],
        ["pairs", mesh, "--sources", "all"],
    ):
        assert ACCURATE.search(ran(capsys, *command, "-o", out).out)
    assert "accurate" not in ran(capsys, "field", mesh, "--sources", "3", "--distance", "geodesic", "-o", out).out
    assert main(["field", mesh, "--sources", "3", "--distance", "truncated", "--k", "9", "-o", out]) == 0
    of_what = (
        r"accurate to \de-\d\d of the maximum as a sum of 9 eigenpairs; all of them would change it by at most \de"
    )
    assert re.search(of_what, capsys.readouterr().out)
    assert len(ACCURATE.findall(ran(capsys, "info", mesh, "--accuracy").out)) == 2


def test_a_poor_accuracy_is_a_warning_and_one_that_need_not_be_is_refused(mesh, tmp_path, capsys, monkeypatch):
    out = tmp_path / "d.npy"
    monkeypatch.setattr(BiharmonicDistance, "_estimated_accuracy", lambda *_: 9e-4)
    said = ran(capsys, "field", mesh, "--sources", "3", "-o", out)
    assert "accurate to 9e-04" in said.out
    assert "warning" not in said.err
    for method, words in (("heat", r"[\d.]+ % of the maximum in the mean"), ("dijkstra", "10 % of the maximum typ")):
        by = ["--distance", "geodesic", "--method", method]
        said = ran(capsys, "field", mesh, "--sources", "3", *by, "-o", out)
        assert re.search(f"accurate to {words}", said.out)
        assert re.search(f"on mesh.off is only accurate to {words}", said.err)
    assert main(["figure", mesh, *by, "-o", str(tmp_path / "d.png")]) == 0
    assert "is only accurate to 10 % of the maximum typically" in capsys.readouterr().err
    out.unlink()
    monkeypatch.setattr(BiharmonicDistance, "_estimated_accuracy", lambda *_: 0.37)
    for command in (
        ["field", mesh, "--sources", "3"],
        ["pairs", mesh, "--sources", "1,2"],
        ["pairs", mesh, "--sources", "all"],
    ):
        assert "may be off by 4e-01 of its maximum, so it is not given" in refused(capsys, *command, "-o", out)
        assert not out.exists()


def test_flat_faces_are_told_with_their_count(mesh_file, tmp_path, capsys):
    flat = mesh_file(caps(bumpy(60), 1e-9, every=10))
    words = "12 faces of almost no area, treated as 1e-7 of the longest side high"
    assert words in ran(capsys, "info", flat).out
    assert words in ran(capsys, "field", flat, "--sources", "3", "-o", tmp_path / "d.npy").err


def test_all_pairs_and_info_are_as_accurate_as_the_worst_component(mesh_file, tmp_path, capsys):
    s, g = bumpy(60), grid(3, 2)
    squashed = g.vertices * [1, 1e-9, 1] + 5
    both = mesh_file(Surface(np.concatenate([s.vertices, squashed]), [*s.faces.tolist(), *(g.faces + 60).tolist()]))
    ran(capsys, "field", both, "--sources", "3", "-o", tmp_path / "d.npy")
    out = tmp_path / "all.npy"
    assert "Remeshing would help" in refused(capsys, "pairs", both, "--sources", "all", "-o", out)
    assert not out.exists()
    assert "accurate" not in ran(capsys, "info", both, "--accuracy").out.replace("accurately", "")


# ---------------------------------------------------------------------- a panel that fails
NO_GEODESIC = ["--distance", "biharmonic,geodesic", "--method", "exact", "--sources", "0"]


@pytest.mark.parametrize("name", ["f.png", "f.svg", "f.gif"])
def test_a_failed_panel_is_named_and_the_others_are_drawn(mesh_file, tmp_path, capsys, no_exact_geodesics, name):
    out = tmp_path / name
    command = ["movie", "--frames", "2", "--size", "300px"] if name == "f.gif" else ["figure"]
    assert main([*command, mesh_file(bumpy(60)), *NO_GEODESIC, "-o", str(out)]) == 1
    assert "geodesic(method=exact): There is no room for windows" in capsys.readouterr().err
    assert out.stat().st_size > 1000
    if name == "f.svg":
        text = out.read_text()
        assert "biharmonic, exact" in text
        assert "no room for windows" in text  # the panel says so itself


def test_a_figure_of_failures_only_is_refused(mesh_file, tmp_path, capsys, no_exact_geodesics):
    words = ["--distance", "geodesic", "--method", "exact", "--sources", "0"]
    assert "no room for windows" in refused(capsys, "figure", mesh_file(bumpy(60)), *words, "-o", tmp_path / "f.png")
    assert not list(tmp_path.glob("f.*"))


def test_a_recipe_with_more_eigenpairs_than_another_mesh_has_fails_in_that_panel_alone(
    mesh, mesh_file, tmp_path, capsys
):
    words = ["--distance", "truncated,biharmonic", "--k", "140", "--sources", "0"]
    assert main(["figure", mesh, *words, "-o", str(tmp_path / "f.png")]) == 0
    again = ["--recipe", str(tmp_path / "f.json"), "--mesh", mesh_file(bumpy(100), "small.off")]
    assert main(["figure", *again, "-o", str(tmp_path / "g.png")]) == 1
    assert "small.off has 99 eigenpairs besides the constant, and k is 140" in capsys.readouterr().err
    assert (tmp_path / "g.png").stat().st_size > 1000


# ---------------------------------------------------------------------- info and version
def test_info_counts_what_is_there(mesh_file, capsys):
    said = dict(line.split("  ", 1) for line in ran(capsys, "info", mesh_file(two_pieces())).out.splitlines())
    facts = {name.strip(): value.strip() for name, value in said.items()}
    assert facts["vertices"] == "65"
    assert facts["components"] == "2"
    assert facts["boundary loops"] == "0"
    assert facts["genus"] == "0"
    assert facts["vertices without a face"] == "1"
    assert (facts["facts"], facts["repairs"]) == ("1 vertex without a face", "none")
    assert facts["warnings"] == "2 components, with no distance from one to another (grey, NaN)"


def test_info_says_whether_the_solver_is_compiled(mesh_file, capsys, monkeypatch):
    from bihdist_core.kernel.library import PLAIN, description, library

    assert ran(capsys, "info", "--solver").out == f"solver                    {description()}\n"
    assert json.loads(ran(capsys, "info", mesh_file(two_pieces()), "--solver", "--json").out)["solver"] == description()
    monkeypatch.setenv(PLAIN, "1")
    library.cache_clear()
    try:
        assert main(["info", "--solver", "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["solver"] == f"plain NumPy: the environment variable {PLAIN} is set"
    finally:
        library.cache_clear()
    assert "name a mesh" in refused(capsys, "info")


def test_samples_open_by_name(capsys):
    assert "components                1" in ran(capsys, "info", "figure").out


def test_version_and_help(capsys):
    for words, said in (
        (["--version"], "bihdist "),
        (["-V"], "bihdist "),
        (["version"], "bihdist "),
        (["help"], "COMMAND"),
    ):
        with pytest.raises(SystemExit) as stop:
            main(words)
        assert stop.value.code == 0
        assert said in capsys.readouterr().out
    for words in (["field", "--help"], ["help", "field"]):
        with pytest.raises(SystemExit):
            main(words)
        assert "usage: bihdist field" in capsys.readouterr().out


def test_light_commands_import_nothing_heavy():
    code = (
        "import sys; from app.main import main\n"
        "try: main(['--version'])\nexcept SystemExit: pass\n"
        "main(['info', 'figure'])\n"
        "print([m for m in sys.modules if m.split('.')[0] in ('pyvista', 'vtkmodules', 'PyQt5', 'qtpy')])"
    )
    done = run_python("-c", code)
    assert done.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize(
    ("given", "joined"),
    [
        (["--viewup", "-z", "-o", "a.png"], ["--viewup=-z", "-o", "a.png"]),
        (["--camera", "-1,0,2e-3,-.5", "--hints"], ["--camera=-1,0,2e-3,-.5", "--hints"]),
        (["--sources", "-1", "-o"], ["--sources", "-1", "-o"]),
        (["--distance", "alpha", "-o", "-1,2"], ["--distance", "alpha", "-o", "-1,2"]),
    ],
)
def test_values_that_begin_with_a_minus_belong_to_their_option(given, joined):
    assert _with_values(given) == joined


def test_a_figure_with_minus_z_up_and_isolines_below_0(mesh, tmp_path):
    out = tmp_path / "a.png"
    camera = ["--camera", "-3,1,2,0,0,0,0,1,0,0.4,0.4"]
    assert main(["figure", mesh, "--viewup", "-z", *camera, "--isoline-values", "-1,0.1", "-o", str(out)]) == 0
    document = read_recipe(out.with_suffix(".json")).document
    assert (document.up, document.isolines.values) == ("-z", (-1.0, 0.1))


# ---------------------------------------------------------------------- colours
def colours_in(path):
    """(n, 3) of the vertices of a .ply."""
    return np.asarray(pytest.importorskip("pyvista").read(path).point_data["RGB"])


@pytest.mark.parametrize(
    ("words", "colours", "share"),
    [
        ([], Colours(), 1),
        (["--cmap", "viridis"], Colours("uniform"), 1),
        (["--cmap", "safe", "--flip-scalars"], Colours("safe", (), True), 1),
        (["--clim", "0.4"], Colours(), 0.4),
    ],
)
def test_field_colours_vertices_as_panels_do(mesh_file, tmp_path, capsys, words, colours, share):
    """NaN, on the other piece, is grey, and what is beyond the range has the last colour."""
    mesh, out = mesh_file(two_pieces()), tmp_path / "d.ply"
    assert main(["field", mesh, "--sources", "3", *words, "-o", str(out)]) == 0
    field = BiharmonicDistance(read_surface(mesh)).from_source(3)
    top = np.nanmax(field) if share == 1 else share
    assert f"colours from 0 to {top:.4g}" in capsys.readouterr().out
    table = lookup_table(style_of("paper", colours))
    shown = np.zeros((len(field), 3))
    for colour, value in zip(shown, field, strict=True):
        table.GetColor(-1.0 if np.isnan(value) else min(value / top, 1.0), colour)
    # The panel's table has 512 colours.
    assert np.abs(colours_in(out) - 255 * shown).max() <= 2
    assert len(np.unique(colours_in(out), axis=0)) > 20
    assert np.isnan(field).any()
    assert (field > top).any() == (share != 1)


def test_a_difference_has_the_colours_of_both_sides(mesh, tmp_path):
    out = tmp_path / "d.ply"
    words = ["--sources", "3", "--distance", "biharmonic - geodesic", "--clim", "0.05"]
    assert main(["field", mesh, *words, "-o", str(out)]) == 0
    assert main(["field", mesh, *words[:-2], "-o", str(tmp_path / "d.npy")]) == 0
    field = np.load(tmp_path / "d.npy")  # percentage points
    expected = PAPER.vertex_colours(field, 5.0, signed=True)
    assert np.array_equal(colours_in(out), expected)
    assert (np.abs(field) > 5).any()


def test_colours_are_of_one_field_and_of_formats_that_have_them(mesh, tmp_path, capsys):
    field = ["field", mesh, "--sources", "3,4"]
    assert main([*field, "-o", str(tmp_path / "two.ply")]) == 0
    assert b"red" not in (tmp_path / "two.ply").read_bytes()[:500]
    for words in (["-o", tmp_path / "d.obj"], ["-o", tmp_path / "d.glb"], ["--cmap", "safe", "-o", tmp_path / "d.ply"]):
        assert "show one field, and --sources names 2; name one, or write .vtp" in refused(capsys, *field, *words)
    for option in (["--cmap", "safe"], ["--flip-scalars"], ["--clim", "2"]):
        said = refused(capsys, *field, *option, "-o", tmp_path / "d.csv")
        assert f"{option[0]} goes with .ply, .obj, .glb; .csv has no colours" in said
    assert "There is no colour map 'jet'" in refused(capsys, *field[:3], "3", "--cmap", "jet", "-o", tmp_path / "d.ply")
    assert not [*tmp_path.glob("d.*")]
