"""Shadows: how much of the light from all round arrives, in pictures and on the ground beneath; and colours in them."""

import numpy as np
import pytest

from app.document.camera import Camera
from app.document.looks import Isolines
from app.figures.description import Figure, FigurePanel
from app.figures.draw import draw_figure, save_figure
from app.figures.framing import Framed
from app.figures.layout import lay_out
from app.figures.occlusion import Occlusion
from app.figures.shadows import Shadows
from app.figures.shots import take_shots
from app.figures.size import Size
from app.scene.style import STYLES
from bihdist_core import BihdistError, Surface
from bihdist_core.analysis.ambient_light import light_reached, nearest_faces
from bihdist_core.kernel.library import PLAIN, library
from bihdist_core.progress import silent
from tests.figures.colour_vision import lab
from tests.shapes import bumpy, grid, sphere

SIZE = Size(240, 240, dpi=96)


@pytest.fixture(autouse=True)
def _compiled():
    if library() is None:
        pytest.skip("the kernel is not compiled")


def even(directions):
    return np.ones(len(directions))


def normals_of(surface):
    return surface.vertices / np.linalg.norm(surface.vertices, axis=1)[:, None]


# ---------------------------------------------------------------------- what arrives
def test_the_nearest_faces_are_those_of_an_exact_search():
    random = np.random.default_rng(3)
    at, faces = random.uniform(-5, 45, (60, 3)), np.arange(60).reshape(-1, 3)
    face, near = nearest_faces(faces, at, 40, 30)
    rows, columns = np.mgrid[:30, :40]
    exact = Occlusion(at[faces], faces).nearest(np.stack([columns.ravel() + 0.5, rows.ravel() + 0.5], 1))
    assert near.ravel() == pytest.approx(exact, rel=1e-6)
    assert ((face < 0) == np.isneginf(near)).all()


def test_all_light_reaches_a_convex_body():
    ball = sphere(800)
    n = normals_of(ball)
    assert (light_reached(ball.vertices, ball.faces, (ball.vertices, n, n), even) == 1).all()


def test_as_much_light_reaches_every_place_in_a_bowl_as_it_is_open():
    """Of a hollow sphere, parts of equal area send the same light to each place."""
    ball = sphere(6000)
    bowl = ball.faces[(ball.vertices[ball.faces][..., 2] < 0.01).all(axis=1)]
    inside = ball.vertices[ball.vertices[:, 2] < -0.1]
    share = light_reached(ball.vertices, bowl, (inside, -inside, -inside), even)
    # Of 192 directions some 96 count, each for up to a fiftieth.
    is_open = 1 - Surface(ball.vertices, bowl).face_areas.sum() / ball.face_areas.sum()
    assert share == pytest.approx(np.full(len(share), is_open), abs=0.06)
    assert share.mean() == pytest.approx(is_open, abs=0.01)


def test_without_the_compiled_kernel_shadows_are_refused(monkeypatch):
    monkeypatch.setenv(PLAIN, "1")
    library.cache_clear()
    try:
        with pytest.raises(BihdistError, match="compiled kernel"):
            nearest_faces(np.array([[0, 1, 2]]), np.eye(3), 4, 4)
    finally:
        monkeypatch.undo()
        library.cache_clear()


# ---------------------------------------------------------------------- pictures
def drawn(surface, style="cover", transparent=False, **options):
    panel = FigurePanel(surface, surface.vertices[:, 1] + 2, views=("home",), **options)
    return draw_figure(Figure((panel,), size=SIZE, style=STYLES[style], transparent=transparent))


def test_the_ground_has_a_black_shadow_with_alpha_below_the_shape():
    ball = bumpy(600)
    bare, shaded = drawn(ball, "paper", True), drawn(ball, "paper", True, ground=True)
    is_shadow = (shaded[..., 3] > 20) & (shaded[..., 3] < 200) & (shaded[..., :3] == 0).all(axis=2)
    assert is_shadow.sum() > 500 > ((bare[..., 3] > 20) & (bare[..., :3] == 0).all(axis=2)).sum()
    opaque = drawn(ball, "paper", ground=True).astype(float)
    alpha = shaded[..., 3:] / 255
    assert np.abs(opaque - (shaded[..., :3] * alpha + 255 * (1 - alpha)))[is_shadow].max() <= 2
    flat = grid(6, 5)
    assert (drawn(flat, ground=True) == drawn(flat)).all()


def test_the_shadow_on_the_ground_ends_in_the_picture_and_fills_it():
    panel = FigurePanel(sphere(300), None, views=("high",), ground=True)
    figure = Figure((panel,), size=Size.parse("400"), style=STYLES["paper"], transparent=True, crop=True)
    alpha = take_shots(figure, lay_out(figure), silent)[0].image[..., 3]
    rim = np.concatenate([alpha[0], alpha[-1], alpha[:, 0], alpha[:, -1]])
    assert rim.max() <= 2
    assert (alpha > 2).any(axis=0).mean() > 0.9


def test_a_bowl_is_darker_inside_and_a_ball_is_not(tmp_path):
    def brightness(surface, style):
        picture = drawn(surface, style)
        return picture[110:130, 110:130].mean()

    ball = sphere(3000)
    assert brightness(ball, "cover") == pytest.approx(brightness(ball, "paper"), rel=0.05)
    bowl = Surface(ball.vertices, ball.faces[(ball.vertices[ball.faces][..., 2] < 0.3).all(axis=1)])
    assert brightness(bowl, "cover") < 0.8 * brightness(bowl, "paper")


@pytest.mark.parametrize("extension", ["png", "pdf", "svg"])
def test_a_cover_drawn_again_is_equal(tmp_path, extension):
    ball = bumpy(300)
    panel = FigurePanel(ball, ball.vertices[:, 1] + 2, ground=True)
    files = [tmp_path / f"{name}.{extension}" for name in "ab"]
    for path in files:
        save_figure(Figure((panel,), size=SIZE, style=STYLES["cover"], transparent=True), path)
    assert files[0].read_bytes() == files[1].read_bytes()


def test_panels_of_one_surface_share_their_shadows_on_pages_of_any_width(monkeypatch):
    ball, made = bumpy(300), []
    monkeypatch.setattr("app.figures.shots.Shadows", lambda *given: made.append(given) or Shadows(*given))
    panels = tuple(FigurePanel(ball, np.abs(ball.vertices[:, k])) for k in range(3))
    figure = Figure(panels, size=Size(400, 200, dpi=96), style=STYLES["cover"])
    shots = take_shots(figure, lay_out(figure), silent)
    assert len({shot.image.shape for shot in shots}) == len(made) == 1
    assert len({shot.image[..., 3].tobytes() for shot in shots}) == 1


# ---------------------------------------------------------------------- colours, see how-to/cover.md
def colour_error(style, tilt):
    """Return how far (CIE 1976) colours of a plate seen at an angle are from those of the colour bar, at most."""
    plate = grid(65, 65)
    x = plate.vertices - plate.vertices.mean(axis=0)
    x /= np.abs(x).max()
    line = np.column_stack([np.linspace(-0.95, 0.95, 77), np.zeros((77, 2))])
    errors = []
    for turn in np.radians(range(0, 360, 45)):
        a = np.radians(tilt)
        back = np.array([np.sin(a) * np.cos(turn), np.sin(a) * np.sin(turn), np.cos(a)])
        view = Camera(tuple(10 * back), (0, 0, 0), (0, 1, 0), (0.12, 0.12))
        surface = Surface(x, plate.faces)
        panel = FigurePanel(surface, x[:, 0] + 1, isolines=Isolines(0), views=(view,), is_parallel=True)
        figure = Figure((panel,), size=SIZE, style=style)
        (shot,) = take_shots(figure, lay_out(figure), silent)
        shares = shot.box.shares(Framed(view, panel, surface, shot.box, None).places(line))
        columns, rows = np.floor(shares * shot.image.shape[1::-1]).astype(int).T
        seen = shot.image[rows, columns, :3] / 255
        errors.append(np.linalg.norm(lab(seen) - lab(style.colours_at((line[:, 0] + 1) / 2)), axis=1).max())
    return max(errors)


@pytest.mark.parametrize("name", ["paper", "cover"])
def test_what_faces_the_reader_has_the_colours_of_its_bar(name):
    assert colour_error(STYLES[name], 0) < 3
    # As the guide says, of what is turned away.
    assert colour_error(STYLES[name], 15) < 7
    assert colour_error(STYLES[name], 30) < 17
