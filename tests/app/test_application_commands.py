"""`bihdist interpolate`, `correspond`, `evaluate` and `perturb`, as they are typed."""

import csv
import json

import numpy as np
import pytest

from app.main import main
from app.samples import mesh_path
from bihdist_core import (
    BiharmonicDistance,
    Correspondence,
    GeodesicDistance,
    Laplacian,
    ShepardInterpolant,
    Surface,
    error_curve,
    field_change,
    map_errors,
    noisy,
    read_surface,
    write_map,
    write_mesh,
)
from tests.commands import ran, refused
from tests.core.test_merging import torn
from tests.shapes import bumpy


@pytest.fixture
def meshes(tmp_path):
    """A shape, and the same with a little noise."""
    s = bumpy(400)
    write_mesh(tmp_path / "a.off", s)
    write_mesh(tmp_path / "b.off", noisy(s, 0.1))
    return str(tmp_path / "a.off"), str(tmp_path / "b.off")


def test_interpolate_writes_what_python_has(meshes, tmp_path, capsys):
    anchors, out = tmp_path / "anchors.csv", tmp_path / "field.npy"
    anchors.write_text("vertex,value\n3,1\n200,-2\n350,0.5\n")
    words = ["--exponent", "2", "--smoothness", "0.1", "--distance", "biharmonic,geodesic"]
    assert main(["interpolate", meshes[0], "--anchors", f"@{anchors}", *words, "-o", str(out)]) == 0
    surface = read_surface(meshes[0])
    for column, kind in zip(np.load(out).T, (BiharmonicDistance, GeodesicDistance), strict=True):
        alone = ShepardInterpolant(kind(surface), [3, 200, 350], [1, -2, 0.5], 2, 0.1).evaluate()
        assert column == pytest.approx(alone, abs=1e-12)
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 2
    assert "3 anchors" in said[0]
    assert "besides the anchors" in said[1]


def test_correspond_and_evaluate_say_what_python_has(meshes, tmp_path, capsys):
    pairs, out, curve = tmp_path / "pairs.csv", tmp_path / "map.txt", tmp_path / "curve.csv"
    pairs.write_text("i,j\n3,3\n200,200\n350,350\n90,90\n")
    said = ran(capsys, "correspond", *meshes, "--pairs", f"@{pairs}", "--truth", "identity", "-o", out).out.splitlines()
    one, two = map(read_surface, meshes)
    known = [[3, 3], [200, 200], [350, 350], [90, 90]]
    found = Correspondence(BiharmonicDistance(one), BiharmonicDistance(two), known).map()
    assert np.array_equal(np.loadtxt(out, int), found)
    judged = error_curve(map_errors(GeodesicDistance(two), found, np.arange(400)))
    assert (
        f"mean {judged.mean:.4g}, median {judged.median:.4g}, area under the curve to 0.25 {judged.area:.4g}" in said[1]
    )
    np.save(tmp_path / "zero.npy", np.zeros(400, int))
    maps = [str(out), str(tmp_path / "zero.npy")]
    said = ran(capsys, "evaluate", *meshes, *maps, "--truth", "identity", "-o", curve).out.splitlines()
    assert f"mean {judged.mean:.4g}" in said[0]
    rows = list(csv.DictReader(curve.read_text().splitlines()))
    assert float(rows[40]["map"]) == pytest.approx(judged.fractions(float(rows[40]["error"])))
    assert float(rows[-1]["zero"]) < 0.5


def test_evaluate_counts_partners_and_draws_the_curve(meshes, tmp_path, capsys):
    np.savetxt(tmp_path / "half.txt", np.roll(np.arange(400), 200), "%d")
    words = [
        "--truth",
        "identity",
        "--samples",
        "50",
        "--method",
        "dijkstra",
        "--symmetry",
        str(tmp_path / "half.txt"),
    ]
    assert main(["evaluate", *meshes, str(tmp_path / "half.txt"), *words, "-o", str(tmp_path / "curve.pdf")]) == 0
    without, counted, drawn = capsys.readouterr().out.splitlines()
    assert "mean 0," not in without
    assert "mean 0, median 0, area under the curve to 0.25 1; geodesic, Dijkstra" in counted
    assert counted.endswith("50 vertices, partners count")
    assert drawn.endswith("2 curves")
    assert (tmp_path / "curve.pdf").read_bytes().startswith(b"%PDF")


def test_errors_are_those_of_what_is_left(meshes, tmp_path, capsys):
    one, two = map(read_surface, meshes)
    n = len(one.vertices)
    keeps = one.vertices[:, 2] < 0.5
    write_map(tmp_path / "map.npy", np.roll(np.arange(n), 1))
    np.save(tmp_path / "keeps.npy", keeps)
    words = ["--truth", "identity", "--method", "dijkstra", "--cut", str(tmp_path / "keeps.npy"), "--json"]
    ((found),) = json.loads(ran(capsys, "evaluate", *meshes, tmp_path / "map.npy", *words).out)["maps"]
    cut = two.without(~keeps)
    left = np.flatnonzero(cut.component_of_vertex >= 0)
    distance = GeodesicDistance(Laplacian(cut), "dijkstra")
    curve = error_curve(map_errors(distance, np.roll(np.arange(n), 1)[left], left))
    assert found["n_vertices"] == len(left) < n
    assert found["median"] == pytest.approx(curve.median)
    # So many samples are among them.
    assert main(["evaluate", *meshes, str(tmp_path / "map.npy"), *words, "--samples", "20"]) == 0
    assert json.loads(capsys.readouterr().out)["maps"][0]["n_vertices"] == 20


def test_a_mesh_is_perturbed_once_it_is_cut_and_merged(meshes, tmp_path, capsys):
    one, out = read_surface(meshes[0]), tmp_path / "noisy.ply"
    keeps = one.vertices[:, 2] < 0.5
    np.save(tmp_path / "keeps.npy", keeps)
    cut, words = one.without(~keeps), ["--noise", "0.4", "--seed", "1", "--cut", str(tmp_path / "keeps.npy")]
    assert main(["perturb", meshes[0], *words, "-o", str(out)]) == 0
    np.testing.assert_array_equal(read_surface(out).faces, cut.faces)
    np.testing.assert_allclose(read_surface(out).vertices, noisy(cut, 0.4, 1).vertices)
    capsys.readouterr()
    gone = int(np.flatnonzero(~keeps)[0])
    words += ["--distance", "biharmonic", "--sources", str(gone)]
    assert main(["perturb", meshes[0], *words, "-o", str(out)]) == 2
    apart = np.linalg.norm(one.vertices - one.vertices[gone], axis=1)
    apart[cut.component_of_vertex < 0] = np.inf
    assert f"vertex {gone} belongs to no face, so no distance is defined from it; the nearest that does is " in (
        said := capsys.readouterr().err
    )
    assert said.strip().endswith(f" {apart.argmin()}.")
    write_mesh(tmp_path / "torn.ply", torn(one))
    words = ["--noise", "0.4", "--merge", "0", "--json", "-o", str(out)]
    about = json.loads(ran(capsys, "perturb", tmp_path / "torn.ply", *words).out)
    assert about["n_vertices"] == len(one.vertices)
    assert about["outputs"] == [str(out), str(tmp_path / "noisy.ids.csv")]


def test_perturb_writes_the_mesh_and_says_the_change(meshes, tmp_path, capsys):
    out = tmp_path / "noisy.off"
    words = ["--noise", "0.4", "--along", "normals", "--seed", "1", "--distance", "biharmonic", "--sources", "9"]
    assert main(["perturb", meshes[0], *words, "-o", str(out)]) == 0
    one, two = read_surface(meshes[0]), read_surface(out)
    assert np.array_equal(two.vertices, noisy(one, 0.4, 1, "normals").vertices)
    change = field_change(*(BiharmonicDistance(s).from_source(9) for s in (one, two)))
    said = capsys.readouterr().out.splitlines()
    assert said[0].endswith("noise of 0.4 edges along normals, seed 1")
    assert f"changes by {100 * change.normalised_mean:.3g} % of its maximum" in said[1]


def test_a_sample_is_simplified_and_compared_where_vertices_stay(tmp_path, capsys):
    out = tmp_path / "small.ply"
    assert main(["perturb", "hand", "--simplify", "900", "--distance", "biharmonic", "-o", str(out)]) == 0
    assert len(read_surface(out).vertices) == 900
    assert "biharmonic from" in capsys.readouterr().out
    assert len(read_surface(mesh_path("hand")).vertices) > 900


def test_perturb_takes_another_pose_and_cuts_faces_out(meshes, tmp_path, capsys):
    one, out = read_surface(meshes[0]), tmp_path / "posed.obj"
    pose = Surface(one.vertices * (1, 2, 0.5), one.faces)
    write_mesh(tmp_path / "pose.off", pose)
    words = ["--pose", str(tmp_path / "pose.off"), "--faces", "3+10-20"]
    assert main(["perturb", meshes[0], *words, "-o", str(out)]) == 0
    two = read_surface(out)
    assert np.array_equal(two.vertices, pose.vertices)
    assert np.array_equal(two.faces, np.delete(one.faces, [3, *range(10, 21)], axis=0))
    assert "pose of pose.off, without 12 faces" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["perturb", "hand", "-o", "x.off"], "Nothing would change"),
        (["perturb", "hand", "--pose", "figure", "-o", "x.off"], "another pose has the same"),
        (["perturb", "hand", "--faces", "9999999", "-o", "x.off"], "no face 9999999"),
        (["perturb", "hand", "--noise", "1", "-o", "x.stl"], ".off, .obj, .ply, .vtp"),
        (["interpolate", "hand", "--anchors", "@gone.csv", "-o", "x.npy"], "gone.csv"),
        (["interpolate", "hand", "--anchors", "3=1,4", "-o", "x.npy"], "Anchor 4 has no value; write 4=0.5"),
        (["interpolate", "hand", "--anchors", "3=1,3=2", "-o", "x.npy"], "Vertex 3"),
        (["correspond", "hand", "hand", "--pairs", "@gone.csv", "-o", "x.npy"], "gone.csv"),
        (["evaluate", "hand", "figure", "identity", "--truth", "identity"], "the same ids are not a map"),
    ],
)
def test_what_cannot_be_is_said(words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert said in refused(capsys, *words)
    assert not list(tmp_path.iterdir())
