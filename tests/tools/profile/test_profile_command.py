"""`bihdist profile`, against the library."""

import json

import numpy as np
import pytest

from app.main import main
from app.samples import mesh_path
from bihdist_core import Laplacian, read_surface
from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from bihdist_core.analysis.plane_sections import plane_section
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy

TWO = ["--distance", "biharmonic,geodesic(method=dijkstra)"]


@pytest.fixture(scope="module")
def surface():
    return read_surface(mesh_path("part"))


def field(surface, spec):
    return Distances(Laplacian(surface)).answer(spec, 17).field


def test_numbers_are_the_fields_along_the_path(surface, tmp_path, capsys):
    csv, array = tmp_path / "p.csv", tmp_path / "p.npy"
    path = GeodesicPaths(surface).path([17, "f40:0.2,0.5", 300])
    for out in (csv, array):
        options = ["--sources", "17", "--through", "source,f40:0.2,0.5,300", *TWO]
        assert main(["profile", "part", *options, "-o", str(out)]) == 0
        said = capsys.readouterr().out
        assert said == f"{out}: {path.label}, {len(path.points):,} points, {path.length:.6g} long\n"
    assert csv.read_text().startswith("arc,x,y,z,face,b0,b1,b2,biharmonic,geodesic(method=dijkstra)\n")
    table = np.load(array)
    assert np.array_equal(table, np.loadtxt(csv, delimiter=",", skiprows=1))
    assert np.array_equal(table[:, 0], path.arcs)
    assert np.array_equal(table[:, 1:4], path.points)
    for column, spec in zip(
        table[:, 8:].T, (Spec.of("biharmonic"), Spec.of("geodesic", method="dijkstra")), strict=True
    ):
        # Not by the same sums as in the file: corners and weights from the table itself.
        values = field(surface, spec)
        corners, weights = surface.faces[table[:, 4].astype(int)], table[:, 5:8]
        assert np.abs(column - (values[corners] * weights).sum(axis=1)).max() <= 1e-9 * values.max()


def test_pins_from_a_file_and_sections(surface, tmp_path):
    (tmp_path / "pins.csv").write_text("id,vertex,x,y,z,name\n4,17,,,,a\n9,6000,,,,b\n")
    out = tmp_path / "p.json"
    words = ["--pins", f"@{tmp_path}/pins.csv", "--way", "section-whole", "--across", "-0.5,1,0.2"]
    assert main(["profile", "part", *words, "--distance", "biharmonic", "-o", str(out)]) == 0
    said = json.loads(out.read_text())
    path = plane_section(surface, [17, 6000], (-0.5, 1, 0.2), "whole")
    assert said["method"] == path.label
    assert said["arcs"] == path.arcs.tolist()


@pytest.fixture
def mesh(mesh_file):
    """Small: what is drawn and refused is so on any mesh."""
    return mesh_file(bumpy(400))


@pytest.mark.usefixtures("unmeasured_fonts")
@pytest.mark.parametrize("extension", [".svg", ".pdf", ".eps", ".png"])
def test_charts(mesh, tmp_path, extension, capsys):
    files = [tmp_path / f"{name}{extension}" for name in ("shares", "values")]
    for file, words in zip(files, ([], ["--values", "--size", "column"]), strict=True):
        options = ["--sources", "17", "--through", "source,300", *TWO, *words]
        assert main(["profile", mesh, *options, "--chart", str(file)]) == 0
    assert files[0].read_bytes() != files[1].read_bytes()
    # The formats treat fonts differently, and say nothing of that.
    assert "font" not in capsys.readouterr().err
    if extension == ".svg":
        assert ">% of the maximum</text>" in files[0].read_text()
        assert ">mesh units</text>" in files[1].read_text()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "two points or more; name them, or pins"),
        (["--through", "3"], "two points or more"),
        (["--through", "3,3"], "There is no path from vertex 3 to vertex 3"),
        (["--through", "3,900000"], "900000"),
        (["--through", "3,pin:1"], "no pin 1"),
        (["--through", "3,4", "--way", "section"], "--across"),
        (["--through", "3,4", "--chart", "p.csv"], ".png"),
    ],
)
def test_what_makes_no_path_is_refused(mesh, tmp_path, capsys, words, said):
    out = tmp_path / "p.csv"
    assert main(["profile", mesh, "--sources", "17", "--distance", "biharmonic", *words, "-o", str(out)]) == 2
    assert said in capsys.readouterr().err
    assert not out.exists()


def test_a_profile_goes_somewhere_and_starts_from_one_source(mesh, tmp_path, capsys):
    assert main(["profile", mesh, "--through", "3,4"]) == 2
    assert "name a file of numbers with -o, or one with --chart" in capsys.readouterr().err
    assert main(["profile", mesh, "--through", "3,4", "--sources", "random:3", "-o", str(tmp_path / "p.csv")]) == 2
    assert "starts from one source, and --sources names 3" in capsys.readouterr().err


def test_another_extension_is_refused_first(tmp_path, capsys):
    assert main(["profile", "nowhere", "--through", "3,4", "-o", str(tmp_path / "p.txt")]) == 2
    assert ".csv" in capsys.readouterr().err
