"""`bihdist statistics`: the numbers of Python, and the charts."""

import re

import numpy as np
import pytest
from scipy.stats import spearmanr

from app.main import main
from bihdist_core import BiharmonicDistance, GeodesicDistance, field_statistics, read_surface
from bihdist_core.analysis.truncation import truncation_loss
from tests.shapes import bumpy

TWO = ["--distance", "biharmonic,geodesic"]


@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(300))


@pytest.fixture
def fields(mesh):
    surface = read_surface(mesh)
    return [kind(surface).from_source(7) for kind in (BiharmonicDistance, GeodesicDistance)]


def test_one_distance_in_numbers(mesh, fields, tmp_path, capsys):
    surface, out = read_surface(mesh), str(tmp_path / "h.csv")
    assert main(["statistics", mesh, "--sources", "7", "--histogram", out, "--truncation", "--k", "20"]) == 0
    found, said = field_statistics(surface, fields[0], 40), capsys.readouterr().out
    assert f"greatest {found.greatest:.6g} at vertex {found.greatest_at}" in said
    assert f"mean by area {found.mean:.6g}, standard deviation {found.deviation:.6g}" in said
    assert f"50% {found.quantiles[2]:.6g}" in said
    loss = truncation_loss(surface, 7, counts=[20])
    assert f"mean loss {loss.means[0]:.3%} of the maximum, largest {loss.largest[0]:.3%} at vertex {loss.at[0]}" in said
    assert np.genfromtxt(out, delimiter=",", names=True)["area"] == pytest.approx(found.areas, abs=1e-12)


def test_two_distances_compared(mesh, fields, tmp_path, capsys):
    out = tmp_path / "s.npy"
    assert main(["statistics", mesh, "--sources", "7", *TWO, "--scatter", str(out)]) == 0
    said = capsys.readouterr().out
    x, y = (field / field.max() for field in fields)
    worst = int(np.abs(x - y).argmax())
    assert f"rank correlation {spearmanr(x, y)[0]:.6g}" in said
    assert f"largest difference {x[worst] - y[worst]:+.2%} at vertex {worst} (biharmonic" in said
    assert np.load(out) == pytest.approx(np.column_stack([np.arange(len(x)), x, y]), abs=1e-12)
    assert main(["statistics", mesh, "--sources", "7", *TWO, "--values"]) == 0
    far = int(np.abs(fields[0] - fields[1]).argmax())
    assert f"largest difference {fields[0][far] - fields[1][far]:+.6g} at vertex {far}" in capsys.readouterr().out


def test_charts_in_the_style_of_figures(mesh, tmp_path, capsys):
    files = tmp_path / "s.svg", tmp_path / "h.svg"
    words = ["--scatter", str(files[0]), "--histogram", str(files[1]), "--size", "60mm", "--style", "dark"]
    assert main(["statistics", mesh, "--sources", "7", *TWO, *words]) == 0
    texts = [file.read_text() for file in files]
    assert all(re.search(r'width="170\.0\d*pt"', text) for text in texts)
    assert all("fill: #12" in text for text in texts)
    correlation = float(re.search(r"rank correlation ([\d.]+)", capsys.readouterr().out)[1])
    assert f"rank correlation {correlation:.4f}" in texts[0]
    assert "biharmonic, exact (mesh units)" in texts[1]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--scatter", "s.pdf"], "two distances"),
        ([TWO[0], f"{TWO[1]},diffusion"], "not 3"),
        (["--distance", "biharmonic,diffusion", "--values"], "different units"),
        (["--histogram", "h.bmp"], ".bmp"),
        (["--truncation", "--k", "0"], "k must be a whole number above 0"),
        (["--histogram", "h.pdf", "--style", "grey"], "grey"),
        (["--histogram", "h.pdf", "--font-size", "1"], "72 points"),
    ],
)
def test_what_cannot_be_done_says_why(mesh, words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["statistics", mesh, "--sources", "7", *words]) == 2
    assert said in capsys.readouterr().err
    assert not list(tmp_path.glob("[sh].*"))
