"""Commands on points without faces."""

import json
from pathlib import Path

import numpy as np
import pytest

from app.main import main
from bihdist_core import BiharmonicDistance, PointCloud
from tests.shapes import bumpy


@pytest.fixture
def cloud(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    points = bumpy(400).vertices
    np.savetxt("scan.xyz", points, fmt="%.17g")
    return PointCloud(points, "scan.xyz")


def test_field_pairs_and_info(cloud, capsys):
    expected = BiharmonicDistance(cloud).from_sources([3, 40])
    assert main(["field", "scan.xyz", "--sources", "3,40", "-o", "field.npy"]) == 0
    assert np.array_equal(np.load("field.npy"), expected)
    assert main(["pairs", "scan.xyz", "--pairs", "3:40", "-o", "pairs.csv"]) == 0
    assert float(Path("pairs.csv").read_text().split(",")[-1]) == pytest.approx(expected[40, 0])
    capsys.readouterr()
    assert main(["info", "scan.xyz", "--json"]) == 0
    (facts,) = json.loads(capsys.readouterr().out)["meshes"]
    assert (facts["n_vertices"], facts["n_faces"], facts["genus"]) == (400, 0, None)


@pytest.mark.parametrize(
    ("command", "reason"),
    [
        ("field scan.xyz --sources 3 --distance geodesic", "geodesic distance needs faces"),
        ("field scan.xyz --sources f1:0.2,0.3", "places in faces need faces"),
        ("field scan.xyz --sources 3 --areas barycentric", "barycentric areas need faces"),
        ("isolines scan.xyz --sources 3 -o lines.csv", "isolines need faces"),
        ("statistics scan.xyz --sources 3", "statistics need faces"),
        ("regions scan.xyz --sources 3,40 -o labels.csv", "regions need faces"),
        ("perturb scan.xyz --noise 0.1 -o noisy.ply", "changes need faces"),
    ],
)
@pytest.mark.usefixtures("cloud")
def test_what_needs_faces_is_refused(capsys, command, reason):
    assert main(command.split()) == 2
    assert f"scan.xyz: {reason}" in capsys.readouterr().err


@pytest.mark.usefixtures("cloud")
def test_coloured_points(capsys):
    assert main(["field", "scan.xyz", "--sources", "3", "-o", "field.ply"]) == 0
    assert main(["info", "field.ply", "--json"]) == 0
    assert '"n_faces": 0' in capsys.readouterr().out
