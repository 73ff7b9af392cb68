"""The benchmark runs, prints a table of the right form, and its numbers are accurate.  Times are not checked here."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from bihdist_core import Surface, write_mesh
from tests.bench import before, chart, machine
from tests.bench.__main__ import ROWS
from tests.bench.batch_rows import _batch_alone
from tests.bench.child import in_child
from tests.bench.meshes import MAKERS, along_curve, bumpy_sphere
from tests.bench.table import BEFORE, COLUMNS, Line, render
from tests.bench.timing import alternate

pytest.importorskip("potpourri3d", reason="the benchmark's peer, of the extra `bench`, is not here")
ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """What a quick run prints, and what it writes."""
    path = tmp_path_factory.mktemp("bench") / "table.json"
    command = [sys.executable, "-m", "tests.bench", "--quick", "--json", str(path)]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=1800)
    assert said.returncode == 0, said.stderr
    return said.stdout, json.loads(path.read_text())


def is_a_count(line):
    """Of answers, processes or pictures, which may be none."""
    return line["row"] == 15 or line["work"].startswith("pictures drawn")


def is_a_rate(line):
    """An exponent, which two short times on a busy machine may turn over."""
    return "n^p" in line["work"]


def test_every_row_is_there_with_its_bound(quick):
    printed, written = quick
    lines = written["lines"]
    assert {line["row"] for line in lines} == set(ROWS) == set(range(1, 30))
    assert all(
        line["bound"] is not None for line in lines if "folded" not in line["work"] and "needle" not in line["work"]
    )
    assert not [
        (line["work"], line["value"])
        for line in lines
        if "skipped" not in line["note"] and not is_a_count(line) and not is_a_rate(line) and not line["value"] > 0
    ]
    table = [row for row in printed.splitlines() if row.startswith("|")]
    assert len(table) == len(lines) + 2
    assert {row.count("|") for row in table} == {len(COLUMNS) - len(BEFORE) + 1}
    assert "potpourri3d 1." in printed


def test_a_click_draws_each_panel_once_and_pointing_draws_none(quick):
    counts = [line for line in quick[1]["lines"] if line["row"] == 13 and is_a_count(line)]
    if any("skipped" in line["note"] for line in quick[1]["lines"] if line["row"] == 13):
        pytest.skip("there is no display")
    assert [(line["value"], line["bound"]) for line in counts] == [(3, 3), (0, 0)]
    assert int(counts[1]["note"].split()[0]) > 10


def test_the_memory_of_a_batch_is_that_of_its_own_processes(tmp_path):
    assert np.ones(10**8).sum() == 10**8  # 800 MB, which this process has had before
    (tmp_path / "meshes").mkdir()
    write_mesh(tmp_path / "meshes" / "a.off", Surface(*bumpy_sphere(500)))
    _, memory = in_child(_batch_alone, tmp_path / "meshes", tmp_path / "out", 4, 1)
    assert 5e7 < memory < 5e8


def test_what_is_fast_is_also_right(quick):
    lines = quick[1]["lines"]
    measured = [line for line in lines if line["error"] is not None]
    assert {line["row"] for line in measured} >= {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 23, 24}
    wrong = [(line["work"], line["error"]) for line in measured if not line["is_accurate"]]
    assert not wrong


@pytest.mark.parametrize("name", MAKERS)
def test_meshes_are_what_they_are_called(name):
    vertices, faces = MAKERS[name](6000)
    surface = Surface(vertices, faces)
    assert 0.85 < len(vertices) / 6000 < 1.15
    assert surface.is_manifold
    assert surface.n_components == 1
    assert not surface.repairs
    assert not surface.unreferenced_count
    assert surface.genus == (2 if name == "genus 2" else 0)
    assert surface.boundary_loop_count == {"folded sheet": 1, "needle": 2}.get(name, 0)
    assert all(np.array_equal(a, b) for a, b in zip(MAKERS[name](6000), (vertices, faces), strict=True))


def test_a_mesh_numbered_along_a_curve_is_the_same_with_near_numbers_near():
    vertices, faces = bumpy_sphere(2000)
    x, f = along_curve(vertices, faces)
    corners, expected = (np.unique(mesh.reshape(-1, 9), axis=0) for mesh in (x[f], vertices[faces]))
    assert np.array_equal(corners, expected)
    assert np.median(np.ptp(f, axis=1)) < np.median(np.ptp(faces, axis=1)) / 10


def test_ratios_are_taken_round_by_round():
    result = alternate(lambda: sum(range(1000)), lambda: "other", rounds=3, repeat=2)
    assert len(result.ours) == len(result.peer) == 3
    assert result.answer == 499500
    assert result.peer_answer == "other"
    assert result.ratio == sorted(a / b for a, b in zip(result.ours, result.peer, strict=True))[1]


def test_a_line_says_whether_it_holds():
    line = Line(1, "work", value=0.5, bound=0.4, error=1.0, tolerance=0.1)
    assert line.holds is False
    assert line.is_accurate is False
    assert "NO" in render([line])
    assert "BAD" in render([line])
    assert Line(1, "work", value=0.3, bound=0.4).holds is True
    assert Line(1, "work").holds is None


def test_the_machine_has_limits():
    assert machine.bandwidth(megabytes=4) > 1e8
    assert machine.matmul_rate(size=64) > 1e8


def test_a_commit_that_is_not_there_is_named():
    with pytest.raises(ValueError, match="no commit 'nonsense'"), before.checked_out("nonsense"):
        pass


def test_a_line_without_an_earlier_one_shows_a_dash_beside_those_that_have_one():
    lines = [Line(1, "work", ours=1.0, before=2.0), Line(2, "new work", ours=1.0)]
    known, new = ([cell.strip() for cell in row.split("|")] for row in render(lines).splitlines()[-2:])
    assert known[-4:-2] == ["2.00 s", "0.5"]
    assert new[-4:-2] == ["–", "–"]
    assert "before" not in render(lines[1:])


def test_the_chart_shows_what_is_a_ratio_to_another_program():
    peer = Line(2, "one field", 1.0, 2.0, 0.5, bound=0.4, note="peer: SciPy")
    own = Line(1, "accuracy of it", 1.0, 2.0, 0.5, note="peer: our set-up")
    drawn = chart.chart([peer, own])
    assert "one field" in drawn
    assert chart.OVER in drawn
    assert "accuracy" not in drawn
    assert drawn == chart.chart([peer, own])
