"""`bihdist pairs --sources all` that is interrupted: what it says it leaves, what the next run makes of that."""

import numpy as np
import pytest

from app.main import main
from bihdist_core import BiharmonicDistance
from tests.shapes import bumpy


@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(200))


def interrupted(mesh, out, monkeypatch, error, after):
    """Begin all pairs, and let the computation end with an error after so many blocks of 20 rows."""
    ask, blocks = BiharmonicDistance.from_sources, []

    def from_sources(self, ids, *rest, **how):
        if len(blocks) == after:
            raise error
        blocks.append(ids)
        return ask(self, ids, *rest, **how)

    with monkeypatch.context() as patch:
        patch.setattr(BiharmonicDistance, "from_sources", from_sources)
        return main(["pairs", mesh, "--sources", "all", "--memory", "0.16", "-o", str(out)])


@pytest.mark.parametrize(("error", "status"), [(KeyboardInterrupt(), 130), (MemoryError(), 2)])
def test_an_interrupted_run_says_what_it_leaves_and_the_next_goes_on(
    mesh, tmp_path, capsys, monkeypatch, error, status
):
    out = tmp_path / "all.npy"
    assert interrupted(mesh, out, monkeypatch, error, 2) == status
    (partial,) = tmp_path.glob(".all-*.npy.part")
    known = f"{partial}, 40 of 200 rows (0.06 MB)"
    assert f"What is done is kept: {known}." in capsys.readouterr().err
    assert main(["pairs", mesh, "--sources", "all", "--dtype", "float32", "-o", str(tmp_path / "all.npy")]) == 0
    assert f"{partial} (0.06 MB) is left of a run with" in capsys.readouterr().err
    assert partial.exists()
    assert main(["pairs", mesh, "--sources", "all", "-o", str(out)]) == 0
    assert f"Going on from {known}; --fresh begins anew." in capsys.readouterr().err
    assert not partial.exists()
    assert main(["pairs", mesh, "--sources", "all", "-o", str(out)]) == 0
    assert capsys.readouterr().err == ""


def test_what_an_interrupted_run_has_left_may_be_discarded(mesh, tmp_path, capsys, monkeypatch):
    out = tmp_path / "all.npy"
    assert interrupted(mesh, out, monkeypatch, KeyboardInterrupt(), 2) == 130
    (partial,) = tmp_path.glob(".all-*.npy.part")
    with partial.open("r+b") as file:
        file.seek(200)
        file.write(100 * b"\0")  # what --fresh must not use
    capsys.readouterr()
    assert main(["pairs", mesh, "--sources", "all", "--fresh", "-o", str(out)]) == 0
    assert f"Discarding {partial}, 40 of 200 rows" in capsys.readouterr().err
    assert (np.load(out)[0, 1:] > 0).all()
    assert not partial.exists()


def test_an_interruption_before_the_first_row_leaves_nothing_to_tell(mesh, tmp_path, capsys, monkeypatch):
    assert interrupted(mesh, tmp_path / "all.npy", monkeypatch, KeyboardInterrupt(), 0) == 130
    assert capsys.readouterr().err == "bihdist: interrupted.\n"
