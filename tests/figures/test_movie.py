"""Movies: as many frames as asked for, that move, whole or not at all."""

import os
import sys
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

from app.document.document import comparison
from app.document.page import Page, Recipe
from app.figures.movie import Movie, route, write_movie
from app.main import main
from bihdist_core import Cancelled, ParameterError
from bihdist_core.distances.kinds import Spec
from tests.shapes import bumpy, grid, two_pieces


@pytest.fixture
def recipe(mesh_file):
    return Recipe(
        comparison(mesh_file(bumpy(200)), (Spec.of("biharmonic"),), (4,)), Page(size="121x141@96dpi", hints=False)
    )


def gif_frames(path):
    found = []
    with Image.open(path) as film:
        for k in range(film.n_frames):
            film.seek(k)
            found.append(np.asarray(film.convert("RGB")).astype(int))
        return found, film.info["duration"]


def test_a_turntable_turns_once_round(recipe, tmp_path):
    out = tmp_path / "turn.gif"
    write_movie(Movie(recipe, frames=4, fps=10), out)
    frames, duration = gif_frames(out)
    assert [f.shape for f in frames] == [(142, 122, 3)] * 4  # an even number of rows and columns
    assert duration == 100
    for a, b in zip(frames, frames[1:] + frames[:1], strict=True):
        assert (np.abs(a - b).max(axis=2) > 40).mean() > 0.02


def test_the_source_wanders_along_edges(recipe, tmp_path):
    flat = grid(6, 4)
    way = route(flat, (0, 34, 0))
    assert way[0] == way[-1] == 0
    assert 34 in way
    edges = {tuple(edge) for edge in flat.edges.tolist()}
    assert all((min(a, b), max(a, b)) in edges for a, b in pairwise(way.tolist()))
    length = np.linalg.norm(np.diff(flat.vertices[way], axis=0), axis=1).sum()
    assert length == pytest.approx(2 * (4 * 2**0.5 + 2))  # four diagonals and two sides, there and back
    with pytest.raises(ParameterError, match="no way from vertex 0 to vertex 62"):
        route(two_pieces(), (0, 62))
    out = tmp_path / "path.gif"
    write_movie(Movie(recipe, turn=0, path=(4, 150), frames=3), out)
    frames, _ = gif_frames(out)
    assert len(frames) == 3
    assert (np.abs(frames[0] - frames[-1]).max(axis=2) > 40).mean() > 0.02


# The library leaves the pipes of its ffmpeg to the garbage collector, which complains.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning", "ignore::ResourceWarning")
def test_mp4_has_the_frames(mesh_file, tmp_path):
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    out = tmp_path / "turn.mp4"
    words = ["--distance", "biharmonic", "--frames", "5", "--fps", "10", "--size", "121x141@96dpi"]
    assert main(["movie", mesh_file(bumpy(200)), *words, "-o", str(out)]) == 0
    reader = ffmpeg.read_frames(str(out))
    assert next(reader)["size"] == (122, 142)
    assert len(list(reader)) == 5


def test_a_movie_that_is_cancelled_leaves_nothing(recipe, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    told = []

    def stop(fraction, text):
        told.append(fraction)
        if text.startswith("frame 2"):
            raise Cancelled("Enough.")

    with pytest.raises(Cancelled):
        write_movie(Movie(recipe, frames=4), out / "turn.gif", stop)
    assert told == sorted(told)
    assert os.listdir(out) == []


def test_movies_that_make_no_sense_are_refused(recipe, mesh_file, tmp_path, capsys, monkeypatch):
    for wrong, words in [
        ({"frames": 1}, "not 1"),
        ({"fps": 60}, "not 60"),
        ({"turn": float("inf")}, "not inf"),
        ({"path": (3,)}, "two vertices"),
        ({"turn": 0.0}, "Nothing would move"),
    ]:
        with pytest.raises(ParameterError, match=words):
            Movie(recipe, **wrong)
    mesh = mesh_file(bumpy(200))
    assert main(["movie", mesh, "-o", str(tmp_path / "m.avi")]) == 2
    assert ".mp4, .gif" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    assert main(["movie", mesh, "-o", str(tmp_path / "m.mp4")]) == 2
    assert "pip install imageio-ffmpeg" in capsys.readouterr().err
