"""`bihdist pairs --sources @pins.csv`: distances among the pins of a file."""

import json

import numpy as np
import pytest

from app.main import main
from bihdist_core import BiharmonicDistance, GeodesicDistance
from bihdist_core.formats.field_output import write_fields
from tests.shapes import bumpy


def test_the_command_writes_distances_among_pins(tmp_path, capsys):
    rough = bumpy(200)
    mesh, out = str(tmp_path / "a.ply"), str(tmp_path / "out.csv")
    write_fields(mesh, rough, {"x": rough.vertices[:, 0]})
    at = rough.vertices[[5, 17, 120]] + [[0, 0, 0], [0, 0, 0], [0.001, 0, 0]]
    entries = [{"id": k + 10, "position": p.tolist()} for k, p in enumerate(at)]
    pins = tmp_path / "pins.json"
    pins.write_text(json.dumps({"pins": entries}))
    assert main(["pairs", mesh, "--sources", f"@{pins}", "--distance", "biharmonic,geodesic", "-o", out]) == 0
    said = capsys.readouterr().err
    assert "1 pin moved to a vertex; the farthest, 12, by 0.001" in said
    table = np.loadtxt(out, delimiter=",", skiprows=1)
    assert table[:, :4].tolist() == [[10, 11, 5, 17], [10, 12, 5, 120], [11, 12, 17, 120]]
    pairs = table[:, 2:4].astype(int)
    assert table[:, 4] == pytest.approx(BiharmonicDistance(rough).of_pairs(pairs), rel=1e-9)
    assert table[:, 5] == pytest.approx(GeodesicDistance(rough).of_pairs(pairs), rel=1e-9)
    matrix = str(tmp_path / "out.npy")
    assert main(["pairs", mesh, "--sources", f"@{pins}", "-o", matrix]) == 0
    assert np.load(matrix) == pytest.approx(BiharmonicDistance(rough).pairwise([5, 17, 120]), rel=1e-9)
    assert main(["pairs", mesh, "--sources", f"@{tmp_path}/no.csv", "-o", out]) == 2
