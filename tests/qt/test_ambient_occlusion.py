"""Ambient occlusion in the window: what the shape hides from the light is darker, and the rest stays as it is."""

import numpy as np
import pytest
import pyvista

import app.qt.panels.ambient_occlusion
from app.qt.panels.ambient_occlusion import light_at_vertices
from app.scene.drawable import drawable
from bihdist_core import BihdistError, Surface
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy


def test_light_is_whole_outside_and_gone_between_two_plates():
    ball = pyvista.Icosphere(nsub=3)
    assert light_at_vertices(drawable(Surface.of(ball))).min() == 1
    # Of the sky above the middle of a pit, of this radius and depth, the part through its opening.
    pit = pyvista.Cylinder(radius=1, height=1, direction=(0, 0, 1), resolution=180, capping=False).triangulate()
    floor = pyvista.Disc(center=(0, 0, -0.5), inner=0, outer=1, r_res=20, c_res=180).triangulate()
    both = Surface.of((pit + floor).clean().extract_surface(algorithm="dataset_surface"))
    light = light_at_vertices(drawable(both))
    middle = np.linalg.norm(both.vertices - [0, 0, -0.5], axis=1).argmin()
    assert light[middle] == pytest.approx(1 / 2, abs=0.05)


@pytest.fixture
def fold(shared_screen):
    """A sheet with a deep fold across it, seen from above."""
    x, y = (each.ravel() for each in np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41)))
    z = -0.8 * np.exp(-((x / 0.12) ** 2))
    quads = (np.arange(40)[:, None] * 41 + np.arange(40)).ravel()
    faces = np.concatenate([np.stack([quads, quads + 1, quads + 42], 1), np.stack([quads, quads + 42, quads + 41], 1)])
    s = shared_screen(Surface(np.stack([x, y, z], 1), faces), (Spec.of("biharmonic"),))
    s.window.actions_by_word["view top"].trigger()
    s.settle(0.1)
    yield s
    s.window.context.prefer(ambient_occlusion=False)


def test_a_fold_is_darker_until_it_is_switched_off_and_the_rim_is_not(fold):
    s, switch = fold, fold.window.actions_by_word["ambient_occlusion"]
    before = s.pictures()[0].astype(int)
    assert not switch.isChecked()
    switch.trigger()
    light = lambda: s.panels[0].loaded.prepared.meshes.light  # noqa: E731
    s.until(lambda: light() is not None)
    s.settle(0.2)
    assert s.window.context.preferences.ambient_occlusion
    after = s.pictures()[0].astype(int)
    assert (after > before + 2).mean() < 1e-3
    assert (before - after).max() > 40
    # From the bottom of the fold the sky is seen within 13.4 degrees of straight up.
    bottom, rim = light().reshape(41, 41)[20, [20, 0]]
    assert bottom == pytest.approx(np.sin(np.radians(13.4)), abs=0.05)
    assert rim > 0.95
    s.window.actions_by_word["ambient_occlusion"].trigger()
    s.settle(0.1)
    assert (s.pictures()[0] == before).all()


def test_the_window_says_why_there_is_none(shared_screen, monkeypatch):
    s = shared_screen(bumpy(300), (Spec.of("biharmonic"),))

    def refuse(mesh):
        raise BihdistError("Shadows need the compiled kernel.")

    monkeypatch.setattr(app.qt.panels.ambient_occlusion, "light_at_vertices", refuse)
    s.window.context.prefer(ambient_occlusion=True)
    s.until(lambda: s.refusals)
    s.window.context.prefer(ambient_occlusion=False)
    assert s.refusals.pop() == "Shadows need the compiled kernel."
