"""`bihdist isolines`: curves and regions as Python has them, by the same words as figures."""

import json

import numpy as np
import pytest

from app.main import main
from app.scene.levels import round_step
from bihdist_core import BiharmonicDistance, GeodesicDistance, band, difference, isolines, read_surface
from bihdist_core.analysis.level_words import region_from_words, value_from_words
from bihdist_core.errors import ParameterError
from tests.commands import ran, refused
from tests.shapes import bumpy, grid


@pytest.fixture
def surface():
    return bumpy(300)


@pytest.fixture
def mesh(mesh_file, surface):
    return mesh_file(surface)


def rows(path):
    return np.genfromtxt(path, delimiter=",", names=True)


def test_curves_are_those_of_python(mesh, tmp_path, capsys):
    surface = read_surface(mesh)
    field = BiharmonicDistance(surface).from_source(7)
    out = str(tmp_path / "lines.csv")
    assert main(["isolines", mesh, "--sources", "7", "--isolines", "5", "--equal-isolines", "-o", out]) == 0
    expected = isolines(surface, field, field.max() * np.arange(1, 5) / 5)
    found = rows(out)
    points = np.concatenate([line.points for line in expected])
    assert np.allclose(np.column_stack([found[k] for k in "xyz"]), points, atol=1e-12)
    assert f"{len(expected)} curve" in capsys.readouterr().out
    # At round values where nothing else is said.
    assert main(["isolines", mesh, "--sources", "7", "--isolines", "5", "-o", out]) == 0
    step = round_step(field.max(), 5)
    assert np.unique(rows(out)["value"]).tolist() == pytest.approx(np.arange(step, field.max(), step))


def test_a_ridge_at_the_value_is_one_curve(mesh_file, tmp_path, capsys):
    mesh, out = mesh_file(grid(6, 2)), str(tmp_path / "lines.obj")
    # From the columns at 0 and 2: a ridge between them, and a usual isoline at 3.
    words = ["isolines", mesh, "--distance", "geodesic", "--sources", "0+7+14+2+9+16", "--isoline-values", "1"]
    facts = json.loads(ran(capsys, *words, "-o", out, "--json").out)
    assert (facts["n_curves"], facts["length"]) == (2, 4)


def test_values_may_be_named_and_lie_on_both_sides_of_0(mesh, tmp_path):
    surface, out = read_surface(mesh), str(tmp_path / "lines.csv")
    words = ["isolines", mesh, "--sources", "7+90", "--distance", "biharmonic - geodesic", "-o", out]
    assert main([*words, "--isoline-values", "-0.01,0.01"]) == 0
    fields = [kind(surface).from_source("7+90") for kind in (BiharmonicDistance, GeodesicDistance)]
    expected = isolines(surface, difference(*fields), [-0.01, 0.01])
    assert len(rows(out)) == sum(len(line.points) for line in expected)
    assert main([*words, "--isolines", "0", "--isoline-through", "12"]) == 0
    assert np.unique(rows(out)["value"]) == pytest.approx(100 * difference(*fields)[12], abs=1e-10)


def test_percent_of_a_difference_are_points_and_not_shares_of_its_largest(mesh, capsys):
    words = ["isolines", mesh, "--sources", "7+90", "--distance", "biharmonic - geodesic"]
    said = []
    for region in ("1%:", "0.01:"):
        said.append(ran(capsys, *words, "--region", region).out.partition(": ")[2])
    assert said[0] == said[1]
    # Nowhere do they differ by half of their maxima.
    assert main([*words, "--region", "50%:"]) == 2


def test_a_region_between_two_values(mesh, tmp_path, capsys):
    surface = read_surface(mesh)
    field = BiharmonicDistance(surface).from_source(7)
    ids, part = tmp_path / "ids.txt", tmp_path / "part.ply"
    words = ["isolines", mesh, "--sources", "7", "--region", "20%:40%"]
    assert main([*words, "--region-ids", str(ids), "--region-mesh", str(part)]) == 0
    expected = band(surface, field, 0.2 * field.max(), 0.4 * field.max())
    assert np.loadtxt(ids, dtype=int).tolist() == expected.vertices.tolist()
    assert read_surface(part).face_areas.sum() == pytest.approx(expected.area, rel=1e-12)
    assert f"area {expected.area:.6g}" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "nothing to do"),
        (["--region", "5"], "not a region"),
        (["--region", "a:b"], "'a' is not a value"),
        (["--region", "40%:20%"], "smaller first"),
        (["--region-ids", "ids.txt", "-o", "l.csv"], "Which region"),
        (["-o", "l.png"], ".csv"),
        (["-o", "l.csv", "--isolines", "0"], "no isolines"),
        (["-o", "l.csv", "--isolines", "3", "--isoline-spacing", "1"], "two ways"),
        (["-o", "l.csv", "--isoline-through", "300"], "300"),
    ],
)
def test_what_cannot_be_done_says_why(mesh, words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert said in refused(capsys, "isolines", mesh, "--sources", "7", *words)
    assert not list(tmp_path.glob("l.*"))


def test_values_in_words():
    assert value_from_words(" −20 % ", 5) == -1
    assert value_from_words("1,250.5", 5) == 1250.5
    assert value_from_words("  ", 5) is None
    assert region_from_words("0.5:", 2) == (0.5, np.inf)
    assert region_from_words(":25%", 2) == (-np.inf, 0.5)
    for words in ("", ":", "1:2:3"):
        with pytest.raises(ParameterError):
            region_from_words(words, 2)
