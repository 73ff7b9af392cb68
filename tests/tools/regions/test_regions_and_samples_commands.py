"""`bihdist samples` and `bihdist regions`, against the library."""

import json

import numpy as np
import pytest

from app.main import main
from app.samples import mesh_path
from bihdist_core import (
    BiharmonicDistance,
    GeodesicDistance,
    farthest_points,
    read_pins,
    read_surface,
    region_boundaries,
    region_mesh,
    voronoi_regions,
)
from tests.shapes import bumpy


@pytest.fixture(scope="module")
def surface():
    return read_surface(mesh_path("part"))


def test_samples_are_the_farthest_points(surface, tmp_path, capsys):
    wanted = farthest_points(BiharmonicDistance(surface), 17, 6)
    assert main(["samples", "part", "--sources", "farthest:6:17", "-o", str(tmp_path / "ids.txt")]) == 0
    assert (tmp_path / "ids.txt").read_text().split() == [str(id) for id in wanted]
    assert "6 samples by biharmonic" in capsys.readouterr().out
    options = ["--sources", "farthest:6:17", "-o", str(tmp_path / "ids.npy")]
    assert main(["samples", "part", *options]) == 0
    assert np.load(tmp_path / "ids.npy").tolist() == wanted.tolist()
    # As pins, from two sources, by another distance.
    options = [
        "--sources",
        "farthest:6:17+40",
        "--distance",
        "geodesic(method=heat)",
        "-o",
        str(tmp_path / "p.csv"),
    ]
    assert main(["samples", "part", *options]) == 0
    wanted = farthest_points(GeodesicDistance(surface, "heat"), [17, 40], 6)
    assert read_pins(tmp_path / "p.csv", surface).vertices.tolist() == wanted.tolist()


def test_regions_are_labelled_by_the_ids_of_their_pins(surface, tmp_path, capsys):
    pins = tmp_path / "pins.csv"
    pins.write_text("id,vertex,name\n4,17,left\n9,400,\n2,900,right\n")
    columns = BiharmonicDistance(surface).from_sources([17, 400, 900])
    wanted = voronoi_regions(surface, columns)
    written = ["-o", "labels.csv", "--region-mesh", "cut.ply", "--boundaries", "lines.json"]
    written = [word if word.startswith("-") else str(tmp_path / word) for word in written]
    assert main(["regions", "part", "--sources", f"@{pins}", *written]) == 0
    labels = np.loadtxt(tmp_path / "labels.csv", delimiter=",", skiprows=1)
    assert labels[:, 1].tolist() == np.array([4, 9, 2])[wanted.labels].tolist()
    assert len(read_surface(tmp_path / "cut.ply").faces) == len(region_mesh(surface, columns).surface.faces)
    curves = json.loads((tmp_path / "lines.json").read_text())["boundaries"]
    assert len(curves) == len(region_boundaries(surface, wanted))
    assert {(curve["region"], curve["other"]) for curve in curves} <= {(4, 9), (4, 2), (9, 2)}
    said = capsys.readouterr().out
    assert f"pin 4, left, vertex 17: area {wanted.areas[0]:.6g}" in said
    assert main(["regions", "part", "--sources", "17,400,900", "-o", str(tmp_path / "labels.npy")]) == 0
    assert np.load(tmp_path / "labels.npy").tolist() == (wanted.labels + 1).tolist()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["samples", "--sources", "farthest:5:f3:0.2,0.5", "-o", "x.txt"], "not a vertex"),
        (["samples", "--sources", "farthest:99999", "-o", "x.npy"], "points asked for"),
        (["samples", "--sources", "farthest:2", "-o", "x.stl"], ".txt"),
        (["samples", "--sources", "farthest:2", "--distance", "biharmonic - geodesic", "-o", "x.txt"], "is a field"),
        (["regions", "--sources", "1,2"], "nothing to write"),
        (["regions", "--sources", "1,2", "--region-mesh", "x.csv"], ".ply"),
        (["regions", "--sources", "1,99999", "-o", "x.npy"], "99999"),
    ],
)
def test_what_cannot_be_is_said(words, said, mesh_file, tmp_path, monkeypatch, capsys):
    command, *options = words
    mesh, here = mesh_file(bumpy(300)), tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    assert main([command, mesh, *options]) == 2
    assert said in capsys.readouterr().err
    assert not list(here.iterdir())


def test_a_count_that_is_none_is_refused(capsys):
    with pytest.raises(SystemExit):
        main(["samples", "part", "--sources", "farthest:0", "-o", "x.txt"])
    assert "needs a number of sources, 1 or more" in capsys.readouterr().err
