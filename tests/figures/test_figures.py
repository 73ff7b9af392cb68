"""Headless pictures: right colours in the right places, lines where the field says, no screen needed."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.figures.draw import Figure, FigurePanel, check_offscreen, draw_figure
from app.figures.size import Size
from app.marks.primitives import PointMark
from app.scene.style import PAPER
from bihdist_core import BihdistError
from tests.shapes import bumpy, grid, two_pieces

ROOT = Path(__file__).parents[2]
SIZE = Size(400, 400, dpi=96)


def rows_of_lines(picture):
    """Rows where white lines cross the picture's middle column."""
    from scipy.signal import find_peaks

    darkest = picture[:, picture.shape[1] // 2 + 9].min(axis=1).astype(float)
    inside = np.flatnonzero(darkest < 235)
    return find_peaks(darkest[inside[0] : inside[-1] + 1], prominence=25, distance=5)[0]


def one(surface, field, **options):
    """A picture of one panel."""
    return draw_figure(Figure((FigurePanel(surface, field, **options),), size=SIZE))


def test_isolines_are_equally_spaced_where_the_field_is_linear():
    flat = grid(20, 20)
    height = flat.vertices[:, 1]
    picture = one(flat, height, isolines=10)
    lines = rows_of_lines(picture[:340])
    assert len(lines) == 9
    spacing = np.diff(lines)
    assert np.ptp(spacing) <= 2  # a pixel of rounding at each end


def test_colours_run_from_the_source_to_the_farthest_point():
    flat = grid(20, 20)
    picture = one(flat, flat.vertices[:, 1], isolines=0)
    column = picture[:, 200 + 9].astype(float)
    inside = np.flatnonzero((column < 240).any(axis=1))
    inside = inside[inside < 340]
    far, near = column[inside[3]], column[inside[-4]]
    assert near[2] > 2 * near[0]  # blue below, where the field is small
    assert far[0] > 2 * far[2]  # red above
    assert PAPER.colours()[0][2] > PAPER.colours()[0][0]


def test_what_is_undefined_is_grey_and_has_no_lines():
    surface = two_pieces()
    field = np.where(surface.component_of_vertex == 0, np.arange(65) / 65, np.nan)
    everything = np.full(65, np.nan)
    everything[0] = 0
    with_colour = one(surface, field)
    all_grey = one(surface, everything)
    assert np.ptp(with_colour.astype(int), axis=2).max() > 100

    def saturated(picture):
        # Above the colour bar.
        part = picture[:340].astype(int)
        return ((np.ptp(part, axis=2) > 60) & (part[..., 2] > part[..., 0])).sum()

    assert saturated(all_grey) < 0.02 * saturated(with_colour)


def test_panels_stand_side_by_side_and_scale_makes_all_larger():
    surface = bumpy(300)
    field = (surface.vertices[:, 0] + 2) / 4
    mark = (PointMark(0),)
    panels = (
        FigurePanel(surface, field, "one", marks=mark),
        FigurePanel(surface, 1 - field, "two", "a hint", "a distance", "mesh units", marks=mark),
    )
    small, large = (draw_figure(Figure(panels, size=Size(800 * k, 400 * k, dpi=96 * k))) for k in (1, 2))
    assert small.shape == (400, 800, 3)
    assert large.shape == (800, 1600, 3)
    assert (small[:, :400] != small[:, 400:]).mean() > 0.05
    shrunk = large.reshape(400, 2, 800, 2, 3).mean(axis=(1, 3))
    assert np.abs(shrunk - small).mean() < 6  # the same picture, sampled finer


def test_views_show_other_sides():
    surface, field = bumpy(300), np.linspace(0, 1, 300)
    front, back = (one(surface, field, views=(view,)) for view in ("front", "back"))
    assert (front != back).mean() > 0.05


def test_missing_libraries_are_named(monkeypatch):
    import app.figures.raster as figures

    def missing(name):
        raise OSError(name)

    monkeypatch.setattr(figures.sys, "platform", "linux")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setattr(figures.ctypes, "CDLL", missing)
    with pytest.raises(BihdistError, match=r"libEGL\.so\.1.*apt-get install libegl1 libgl1"):
        check_offscreen()


def test_the_command_draws_without_a_screen_and_without_qt(tmp_path):
    from PIL import Image

    out = tmp_path / "figure.png"
    code = (
        "import sys; from app.main import main\n"
        f"status = main(['figure', 'genus3', '--quiet', '-o', {str(out)!r}])\n"
        "print(status, [m for m in sys.modules if m.split('.')[0] in ('PyQt5', 'PySide6', 'qtpy', 'pyvistaqt')])"
    )
    without = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, env=without, capture_output=True, text=True)
    assert done.stdout.splitlines()[-1] == "0 []", done.stderr
    assert done.stderr == ""
    picture = np.asarray(Image.open(out))
    assert picture.shape == (640, 1680, 3)
    assert picture.std() > 20
