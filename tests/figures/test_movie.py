"""Movies: as many frames as asked for, that move, whole or not at all."""

import os
import sys
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

from app.document.document import comparison
from app.document.page import Page, Recipe
from app.figures import canvas
from app.figures.description import Figure, FigurePanel
from app.figures.frames import drawn_frames
from app.figures.hidden_lines import HiddenLineRemoval
from app.figures.layout import lay_out
from app.figures.movie import Movie, Sweep, angles, eased, route, way, with_digits, write_movie
from app.figures.movie_files import check_movie
from app.figures.size import Size
from app.figures.turning import fitted_size, start_and_axis
from app.figures.worker import Worker
from app.main import main
from app.scene.camera import Projection, turned
from app.scene.style import STYLES
from bihdist_core import BihdistError, Cancelled, DiffusionDistance, OutputError, ParameterError, Surface
from bihdist_core.distances.distance_types import Spec, distance_type
from bihdist_core.progress import silent
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


def test_few_colours_hold_those_of_marks_and_of_the_ground(recipe, tmp_path):
    document = replace(recipe.document, camera="source")
    large = Recipe(document, replace(recipe.page, size="400x300"))
    write_movie(Movie(large, turn=10, frames=2), tmp_path / "turn.gif")
    for frame in gif_frames(tmp_path / "turn.gif")[0]:
        assert frame[0, 0].tolist() == [255, 255, 255]
        yellow = np.round(255 * np.array(STYLES["paper"].source))
        assert (np.abs(frame - yellow).max(axis=2) <= 1).sum() > 4


def test_the_source_wanders_along_edges(recipe, tmp_path):
    flat = grid(6, 4)
    way = route(flat, (0, 34, 0))
    assert way[0] == way[-1] == 0
    assert 34 in way
    edges = {tuple(edge) for edge in flat.edges.tolist()}
    assert all((min(a, b), max(a, b)) in edges for a, b in pairwise(way.tolist()))
    length = np.linalg.norm(np.diff(flat.vertices[way], axis=0), axis=1).sum()
    assert length == pytest.approx(2 * (4 * 2**0.5 + 2))  # four diagonals and two sides, there and back
    with pytest.raises(ParameterError, match="no path from vertex 0 to vertex 62"):
        route(two_pieces(), (0, 62))
    out = tmp_path / "path.gif"
    write_movie(Movie(recipe, turn=0, path=(4, 150), frames=3), out)
    frames, _ = gif_frames(out)
    assert len(frames) == 3
    assert (np.abs(frames[0] - frames[-1]).max(axis=2) > 40).mean() > 0.02


# The library leaves the pipes of its ffmpeg to the garbage collector, which complains.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning", "ignore::ResourceWarning")
@pytest.mark.parametrize("extension", [".mp4", ".webm"])
def test_a_film_has_the_frames_and_their_colours_and_the_same_bytes_again(recipe, tmp_path, extension):
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    outs = [tmp_path / f"{name}{extension}" for name in "ab"]
    for out in outs:
        write_movie(Movie(recipe, frames=5, fps=10), out)
    assert outs[0].read_bytes() == outs[1].read_bytes()
    write_movie(Movie(recipe, frames=5), tmp_path / "%d.png")
    reader = ffmpeg.read_frames(str(outs[0]))
    about = next(reader)
    assert about["size"] == (122, 142)
    film = [np.frombuffer(frame, np.uint8).reshape(142, 122, 3).astype(int) for frame in reader]
    assert len(film) == 5
    for number, frame in enumerate(film, 1):
        with Image.open(tmp_path / f"{number}.png") as drawn:
            # In the mean: at edges neighbouring pixels share their colours.
            assert np.abs(frame - np.asarray(drawn)).mean(axis=(0, 1)).max() < 6


def test_frames_have_files_of_their_own_all_or_none(recipe, tmp_path):
    folder = tmp_path / "frames"
    folder.mkdir()
    write_movie(Movie(recipe, frames=3), folder / "turn-%04d.png")
    assert sorted(os.listdir(folder)) == ["turn-0001.png", "turn-0002.png", "turn-0003.png"]
    for path, frames, words in [
        (folder / "turn.png", 3, r"put %04d where .*: turn-%04d\.png"),
        (folder / "%d-%d.png", 3, "put %04d"),
        (folder / "turn-%04d.png", 2, r"turn-0003\.png would stay among the 2 new frames"),
        (folder / "none" / "%04d.png", 3, "no folder"),
    ]:
        with pytest.raises(OutputError, match=words):
            check_movie(path, frames)
    check_movie(folder / "turn-%03d.png", 2000)

    def stop(fraction, text):
        if text.startswith("frame 2"):
            raise Cancelled("Enough.")

    with pytest.raises(Cancelled):
        write_movie(Movie(recipe, frames=3), folder / "b%d.png", stop)
    assert len(os.listdir(folder)) == 3


# ---------------------------------------------------------------------- movements
def test_what_ends_elsewhere_starts_and_ends_slowly_and_loops_go_evenly():
    times = np.linspace(0, 1, 101)
    steps = np.diff(eased(times))
    assert eased(times)[[0, 50, -1]] == pytest.approx([0, 0.5, 1])
    assert steps == pytest.approx(steps[::-1])
    assert steps[0] < 0.1 * steps[50]
    assert steps[30:70] == pytest.approx(steps[50])
    assert way(4, is_loop=True).tolist() == [0, 0.25, 0.5, 0.75]
    assert angles(360.0, False, 4).tolist() == [0, 90, 180, 270]
    assert angles(90.0, False, 3) == pytest.approx([0, 45, 90])
    assert angles(90.0, True, 8)[[0, 2, 4, 6]] == pytest.approx([0, 45, 0, -45], abs=1e-9)


def test_a_sweep_goes_in_equal_ratios_from_value_to_value():
    t, k = (distance_type(word).parameters[0] for word in ("diffusion", "truncated"))
    found = Sweep.parse("t=4..1/60").values(t, 41)
    assert (found[0], found[-1]) == (4.0, pytest.approx(1 / 60))
    ratios = np.divide(found[1:], found[:-1])
    assert (ratios < 1).all()
    assert ratios[15:25] == pytest.approx(ratios[20])
    there_and_back = Sweep.parse("t = 1 .. 1/4 .. 1").values(t, 8)
    assert (there_and_back[0], there_and_back[4]) == (1, 0.25)
    assert there_and_back[1:4] == pytest.approx(there_and_back[:4:-1])
    assert Sweep.parse("k=1..9").values(k, 3) == [1, 5, 9]
    assert Sweep.parse("k=10,50").values(k, 5) == [10, 10, 10, 50, 50]
    for wrong in ("t", "t=4", "4..1", "t=4..", "=1..2"):
        with pytest.raises(ParameterError, match="A sweep is a range"):
            Sweep.parse(wrong)
    assert with_digits("diffusion, t = 0.25", 0.25) == "diffusion, t = 0.250"
    assert with_digits("1/λ^2, exact", 2.0) == "1/λ^2.00, exact"
    assert with_digits("biharmonic, 20 eigenpairs", 20) == "biharmonic, 20 eigenpairs"


def test_every_frame_of_a_sweep_has_the_distance_at_its_own_value(recipe, tmp_path, monkeypatch):
    drawn = []

    def kept(figures, *about):
        for figure in figures:
            drawn.append(figure)
            yield Image.new("P", (4, 4), len(drawn))

    monkeypatch.setattr("app.figures.movie.drawn_frames", kept)
    document = comparison(recipe.document.mesh().path, (Spec.of("biharmonic"), Spec.of("diffusion")), (4,))
    write_movie(Movie(Recipe(document, recipe.page), sweep="t=4..1/4", frames=3), tmp_path / "a.gif")
    assert [figure.panels[1].heading for figure in drawn] == [f"diffusion, t = {t}" for t in ("4.00", "1.00", "0.250")]
    for figure, t in zip(drawn, (4, 1, 0.25), strict=True):
        still, moving = figure.panels
        assert moving.field == pytest.approx(DiffusionDistance(moving.surface, t).from_source(4), rel=1e-5)
        assert still.heading == drawn[0].panels[0].heading
        # Maxima differ: each frame shows fractions of its own.
        assert (figure.range, moving.maximum) == ("fraction", None)
    drawn.clear()
    one = replace(document, range="shared", panels=document.panels[1:])
    write_movie(Movie(Recipe(one, recipe.page), sweep="t=4,1/4", frames=4), tmp_path / "a.gif")
    assert len({figure.panels[0].maximum for figure in drawn}) == 1
    with pytest.raises(ParameterError, match="alpha is not a parameter of biharmonic, diffusion"):
        Movie(Recipe(document), sweep="alpha=2..3")
    with pytest.raises(ParameterError, match="above 0"):
        Movie(Recipe(document), sweep="t=1..-1")


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
        ({"sweep": "t"}, "A sweep is a range"),
    ]:
        with pytest.raises(ParameterError, match=words):
            Movie(recipe, **wrong)
    mesh = mesh_file(bumpy(200))
    assert main(["movie", mesh, "-o", str(tmp_path / "m.avi")]) == 2
    assert ".mp4, .webm, .gif, .png" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    assert main(["movie", mesh, "-o", str(tmp_path / "m.mp4")]) == 2
    assert f"{sys.executable} -m pip install imageio-ffmpeg" in capsys.readouterr().err


# ---------------------------------------------------------------------- several processes
def numbers(count):
    """Figures that are told apart by their width."""
    surface = bumpy(60)
    field = np.linspace(0, 1, 60)
    for k in range(count):
        yield Figure((FigurePanel(surface, field),), size=Size(40.0 + 2 * k, 40.0, dpi=96))


def test_frames_of_several_processes_come_in_order_and_as_of_one():
    alone = list(drawn_frames(numbers(13), 13, "RGB", 1, silent))
    both = list(drawn_frames(numbers(13), 13, "RGB", 2, silent))
    assert [frame.shape[1] for frame in both] == [40 + 2 * k for k in range(13)]
    assert [np.array_equal(a, b) for a, b in zip(alone, both, strict=True)] == [True] * 13


def test_a_process_that_is_killed_is_said_and_the_others_end(monkeypatch):
    workers = []

    class Watched(Worker):
        def __init__(self, threads=None):
            super().__init__(threads)
            workers.append(self._child.process)

    monkeypatch.setattr("app.figures.frames.Worker", Watched)
    frames = drawn_frames(numbers(40), 40, "RGB", 2, silent)
    next(frames)
    workers[0].kill()
    with pytest.raises(BihdistError, match="process ended unexpectedly"):
        list(frames)
    assert [process.poll() is not None for process in workers] == [True, True]


def test_what_fails_in_another_process_is_said(recipe):
    def refused():
        yield from numbers(12)
        raise ParameterError("No more.")

    with pytest.raises(ParameterError, match="No more"):
        list(drawn_frames(refused(), 13, "RGB", 2, silent))
    worker = Worker()
    try:
        with pytest.raises(BihdistError, match=r"could not be drawn \(ZeroDivisionError: .*\)"):
            worker.ask(divmod, 1, 0)
        with pytest.raises(BihdistError, match="not a size"):
            worker.ask(Size.parse, "wide")
        large = np.arange(1 << 14)
        for _ in range(2):  # sent once, and named then
            assert worker.ask(np.sum, large) == large.sum()
        assert worker.ask(divmod, 7, 3) == (2, 1)
        assert worker.ask(np.sum, large) == large.sum()
    finally:
        worker.close()
    with pytest.raises(BihdistError, match="process ended unexpectedly"):
        worker.ask(divmod, 1, 1)


def test_an_encoder_that_gives_up_is_said(recipe, tmp_path, monkeypatch):
    ffmpeg = pytest.importorskip("imageio_ffmpeg")

    def broken(*_args, **_options):
        yield
        raise OSError("ffmpeg says:\n\nno space left on device\n")

    monkeypatch.setattr(ffmpeg, "write_frames", broken)
    with pytest.raises(OutputError, match="could not be encoded: no space left"):
        write_movie(Movie(recipe, frames=3), tmp_path / "m.mp4")
    assert os.listdir(tmp_path) == ["mesh.off"]


# ---------------------------------------------------------------------- what is seen
def test_the_source_is_seen_in_the_first_frame():
    surface = bumpy(400)
    for vertex in range(0, 400, 37):
        camera, axis = start_and_axis("home", surface, (0.0, 360.0), 0.0, [(0.0, vertex)])
        sight = HiddenLineRemoval(surface, Projection(camera, 1.0, surface.vertices), (300, 300))
        away = abs(surface.vertices[vertex] @ axis) / np.linalg.norm(surface.vertices[vertex])
        assert sight.sees(surface.vertices[vertex]) or away > 0.9  # from above the poles alone
        # A swing has it in view at all times.
        looks = [(float(angle), vertex) for angle in angles(90.0, True, 12)]
        camera, axis = start_and_axis("home", surface, (-45.0, 45.0), 0.0, looks)
        for angle in (-45, 0, 45):
            seen = Projection(turned(camera, angle, axis), 1.0, surface.vertices)
            assert HiddenLineRemoval(surface, seen, (300, 300)).sees(surface.vertices[vertex]) or away > 0.7
    front = start_and_axis("front", surface, (0.0, 360.0), 0.0, [(0.0, 5)])[0]
    assert np.allclose(np.subtract(front.position, front.focal_point)[:2], 0)  # as it was asked for


def test_a_frame_is_as_large_as_what_turns_and_no_larger():
    long = Surface(bumpy(400).vertices * [0.3, 3, 0.2], bumpy(400).faces, "")
    for surface in (bumpy(400), long):
        for turn, size in ((360.0, Size(600)), (90.0, Size())):
            camera, axis = start_and_axis("home", surface, (0.0, turn), 0.0, [(0.0, 5)])
            figure = Figure((FigurePanel(surface, np.linspace(0, 1, 400)),), size=size)
            figure = replace(figure, size=fitted_size(figure, camera.extent))
            box = lay_out(figure).cells[0].views[0]
            reached = np.zeros(2)
            for k in range(37):
                seen = Projection(turned(camera, turn * k / 36, axis), box.width / box.height, surface.vertices, 0.03)
                reached = np.maximum(reached, np.abs(seen(surface.vertices)[:, :2]).max(axis=0))
            # Nothing is cut off; the wider side is filled, and the other unless the frame would be a strip.
            assert reached.max() <= 1
            assert reached.max() > 0.9
            assert reached.min() > (0.9 if surface is not long else 0.15)


def test_words_are_drawn_once_while_the_shape_turns(monkeypatch):
    drawn = []
    real = canvas.caption_shapes
    monkeypatch.setattr(canvas, "caption_shapes", lambda page: drawn.append(1) or real(page))
    surface, field = bumpy(60), np.linspace(0, 1, 60)
    figures = [
        Figure((FigurePanel(surface, field, "a", views=(view,)),), size=Size(90, 90)) for view in ("front", "left")
    ]
    both = list(drawn_frames(iter(figures), 2, "RGB", 1, silent))
    assert len(drawn) == 1
    other = replace(figures[0], panels=(replace(figures[0].panels[0], field=field / 2, heading="b"),))
    third = list(drawn_frames(iter([*figures, other]), 3, "RGB", 1, silent))
    assert len(drawn) == 3
    assert np.array_equal(third[0], both[0])
    assert not np.array_equal(third[2], both[0])
