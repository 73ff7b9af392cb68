"""A tool of another package, `geodesic_circle`, beside the program's own: nothing of the program is changed for it."""

import os
import shutil
import sys
from pathlib import Path

import pytest

from tests.programs import run_python

PLUGIN = Path(__file__).parent


def run(*arguments, folder, has_tool=True):
    """Python with these arguments, in a folder."""
    own = {"XDG_DATA_HOME": str(folder / "data"), "PYTHONPATH": str(PLUGIN) if has_tool else ""}
    return run_python(*arguments, cwd=folder, **own)


def test_its_option_part_and_marks_are_in_figures(tmp_path):
    shown = ["figure", "hand", "--sources", "12", "--distance", "geodesic", "--size", "300x300", "-o"]
    plain = run("-m", "bihdist", *shown, "plain.png", folder=tmp_path)
    told = run("-m", "bihdist", *shown, "circle.png", "--circle", "2665", folder=tmp_path)
    assert (plain.returncode, told.returncode) == (0, 0), plain.stderr + told.stderr
    assert '"through": "circle"' in (tmp_path / "circle.json").read_text()
    again = run("-m", "bihdist", "figure", "--recipe", "circle.json", "-o", "again.png", folder=tmp_path)
    assert again.returncode == 0, again.stderr
    pictures = [(tmp_path / f"{name}.png").read_bytes() for name in ("plain", "circle", "again")]
    assert pictures[0] != pictures[1] == pictures[2]
    drawn = "bihdist.figure('hand', ['geodesic'], 12, marks={'circle': 2665}, layout={'size': '300x300'})"
    by_python = f"import bihdist; {drawn}.save('python.png')"
    assert run("-c", by_python, folder=tmp_path).returncode == 0
    assert (tmp_path / "python.png").read_bytes() == pictures[1]


def test_without_it_what_it_made_is_refused_in_a_sentence(tmp_path):
    assert run("-m", "bihdist", "figure", "hand", "--circle", "5", "-o", "a.png", folder=tmp_path).returncode == 0
    refused = run("-m", "bihdist", "figure", "--recipe", "a.json", "-o", "b.png", folder=tmp_path, has_tool=False)
    assert refused.returncode == 2
    assert "the unknown key 'circle'" in refused.stderr
    assert refused.stderr.count("\n") == 1


def test_one_that_cannot_be_loaded_leaves_the_program_as_it_is(tmp_path):
    broken = tmp_path / "broken"
    shutil.copytree(PLUGIN / "geodesic_circle-1.0.dist-info", broken / "geodesic_circle-1.0.dist-info")
    code = (
        f"import sys; sys.path.insert(0, {str(broken)!r}); import bihdist; print(bihdist.figure('hand', ['geodesic']))"
    )
    told = run("-c", code, folder=tmp_path, has_tool=False)
    assert told.returncode == 0, told.stderr
    assert "Picture(geodesic" in told.stdout
    assert "The tool 'circle' of geodesic_circle:TOOL cannot be loaded: No module named" in told.stderr


@pytest.mark.skipif(sys.platform == "linux" and not os.environ.get("DISPLAY"), reason="there is no display")
def test_its_menu_dock_and_click_are_in_the_window(tmp_path):
    told = run(PLUGIN / "clicking.py", tmp_path, folder=tmp_path)
    assert told.returncode == 0, told.stderr
    lines = told.stdout.splitlines()
    assert lines[0] == "Click on a panel of geodesic distance."
    assert lines[1].startswith("radius ")
    assert "--circle " in lines[2]
