"""Where there is no room for it, what is written is one sentence, and what was there stays; no half file is left."""

import json
import sys

import pytest

from tests.conftest import write_off
from tests.programs import run_python
from tests.shapes import bumpy

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="a limit stands for a full disk there")

LIMITED = """
import contextlib, io, json, resource, sys
from app.program import run
resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
ends = []
for words in json.loads(sys.argv[1]):
    sys.argv = ["bihdist", *words]
    with contextlib.redirect_stderr(io.StringIO()) as said:
        code = run()
    ends.append((code, said.getvalue()))
print(json.dumps(ends))
"""
"""Runs one command after the other, and prints their exit codes and what each has said."""

COMMANDS = {
    "field.npy": "field MESH --sources 5 -o OUT",
    "field.csv": "field MESH --sources 5 -o OUT",
    "field.ply": "field MESH --sources 5 -o OUT",
    "field.vtp": "field MESH --sources 5 -o OUT",
    "pairs.npy": "pairs MESH --sources all -o OUT",
    "near.json": "pairs MESH --nearest --k 5 -o OUT",
    "near.npz": "pairs MESH --nearest --k 5 -o OUT",
    "lines.vtp": "isolines MESH --sources 5 -o OUT",
    "ids.csv": "samples MESH --sources farthest:200 -o OUT",
    "figure.png": "figure MESH --distance biharmonic --size 85mm -o OUT",
    "figure.svg": "figure MESH --distance biharmonic --size 85mm -o OUT",
    "figure.pdf": "figure MESH --distance biharmonic --size 85mm -o OUT",
    "movie.gif": "movie MESH --frames 2 --size 200x200 -o OUT",
    "batch": "batch MESH -o OUT --do fields --workers 1",
}


@pytest.fixture(scope="module")
def ended(tmp_path_factory):
    """What has become of each output: its path, the command's exit code, and what that has said."""
    folder = tmp_path_factory.mktemp("full")
    mesh, paths, commands = write_off(bumpy(300), folder / "mesh.off"), {}, []
    for name, words in COMMANDS.items():
        out = paths[name] = folder / name.replace(".", "-") / name
        if name != "batch":
            out.parent.mkdir()
            out.write_text("old")
        commands.append([{"MESH": mesh, "OUT": str(out)}.get(word, word) for word in words.split()])
    # What others keep for the next time would be cut off, too, and be found by it.
    own = {"PYTHONDONTWRITEBYTECODE": "1", "MPLCONFIGDIR": str(folder)}
    done = run_python("-c", LIMITED, json.dumps(commands), **own)
    assert done.returncode == 0, done.stderr
    ends = json.loads(done.stdout.splitlines()[-1])
    return {name: (paths[name], *end) for name, end in zip(COMMANDS, ends, strict=True)}


@pytest.mark.parametrize("name", [name for name in COMMANDS if name != "batch"])
def test_no_half_file_is_left(name, ended):
    out, code, said = ended[name]
    assert code == 2, said
    assert said.splitlines()[-1] == f"bihdist: {out} could not be written: File too large."
    assert "Traceback" not in said
    assert out.read_text() == "old"
    assert [each.name for each in out.parent.iterdir() if not each.name.endswith(".part")] == [name]


def test_results_of_a_batch_are_failures(ended):
    out, code, said = ended["batch"]
    assert code == 1, said
    assert "could not be written: File too large." in (out / "failures.csv").read_text()
    assert sorted(each.name for each in out.iterdir()) == ["failures.csv", "summary.csv"]
