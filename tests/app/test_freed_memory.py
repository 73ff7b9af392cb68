"""What commands and questions of tools compute is freed as soon as it is dropped, without the garbage collector."""

import numpy as np
import pytest

from app.document.document import MeshFile, comparison
from app.document.page import Recipe
from app.document.second_mesh_edits import open_second_mesh
from app.figures.export import compute, open_document
from app.main import main
from app.session.array_store import ArrayStore
from app.tools.correspondence.pairs import add_pairs
from app.tools.correspondence.quantity import predict
from bihdist_core import noisy, write_mesh
from tests.garbage import garbage_of
from tests.shapes import bumpy

OF_PARSERS = ("app.commands.", "app.main:", "app.document.option:")
"""Parsers of command lines refer to themselves, and hold nothing large."""

COMMANDS = (
    "field a.off --sources 3 --distance diffusion -o f.csv",
    "field a.off --sources f3:0.2,0.5 --distance geodesic --method heat -o f.csv",
    "pairs a.off --pairs 1:2 -o p.csv",
    "pairs a.off --sources all -o all.npy --fresh",
    "isolines a.off --sources 3 -o i.csv",
    "profile a.off --through 3,50 -o p.csv",
    "statistics a.off",
    "samples a.off --sources farthest:5 -o s.csv",
    "regions a.off --sources 3,50,100 -o r.csv",
    "interpolate a.off --anchors 1=0,100=1,200=2 -o i.csv",
    "correspond a.off b.off --pairs 1:1,100:100,200:200 -o map.txt",
    "evaluate a.off b.off map.txt --truth identity",
    "perturb a.off --noise 0.1 -o n.off",
    "info a.off --accuracy --solver",
)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working directory, with a shape, the same with a little noise, and a map."""
    shape = bumpy(300)
    write_mesh(tmp_path / "a.off", shape)
    write_mesh(tmp_path / "b.off", noisy(shape, 0.1))
    np.savetxt(tmp_path / "map.txt", np.arange(300), fmt="%d")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: " ".join(command.split()[:1]))
@pytest.mark.usefixtures("folder")
def test_commands_leave_no_circles(command):
    ended = []
    found = garbage_of(lambda: ended.append(main(command.split())))
    assert ended == [0]
    assert not [name for name in found if not name.startswith(OF_PARSERS)]


@pytest.mark.usefixtures("folder")
def test_surfaces_beside_each_other_leave_no_circles():
    def ask():
        shown = open_second_mesh(comparison("a.off"), MeshFile("", "b.off"))
        document, surfaces = open_document(
            Recipe(predict(add_pairs(shown, [(3, 3), (150, 150), (90, 90)]))), ArrayStore()
        )
        assert surfaces["A"].shown_with(document.mesh("B")) is surfaces["B"]
        compute(document, surfaces)

    ask()  # what is imported makes circles of its own
    assert not garbage_of(ask)
