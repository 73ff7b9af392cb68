"""In small views lines and marks are smaller, so that the shape is seen; anchors are rings on every colour."""

from dataclasses import replace

import numpy as np
import pytest
from qtpy import QtCore

from app.document.document import Point
from app.document.looks import Isolines
from app.document.shared_parts.pins import add_pins
from app.qt.panels.overlay import LEAST_SCALE
from app.scene.levels import BOLD, ZERO, width_of
from app.scene.panel_scene import LEAST, USUAL, proportion
from app.scene.style import PAPER
from app.tools.interpolation.part import Anchor, Anchors
from tests.qt.painting import painted
from tests.shapes import bumpy


def test_marks_have_their_usual_size_from_a_usual_view_on_and_at_least_a_share_of_it():
    assert proportion(USUAL, 3 * USUAL) == proportion(5 * USUAL, USUAL) == 1.0
    assert proportion(0.8 * USUAL, 2 * USUAL) == pytest.approx(0.8)
    assert proportion(2 * USUAL, 10) == LEAST


def test_a_line_at_0_is_hardly_wider_than_others_unless_bold_ones_are_wanted():
    assert (width_of(Isolines(20), True, True), width_of(Isolines(20), False, False)) == (ZERO, 1.0)
    assert width_of(Isolines(20, bold=5), True, True) == BOLD


@pytest.fixture
def loaded(shared_screen):
    return shared_screen(bumpy(1500), size=(1500, 1000))


def white(picture):
    return int((picture.min(axis=2) > 240).sum())


def discs(view):
    """How many pixels have the colour in which sources are marked."""
    return int((np.abs(painted(view) / 255 - view.scene.style.source).max(axis=2) < 0.02).sum())


def test_a_small_view_has_thinner_lines_and_smaller_marks(loaded):
    s = loaded
    view = s.panels[0].view
    s.until(lambda: view.proportion == 1.0)
    s.pictures()
    usual = discs(view)
    s.window.resize(700, 560)
    s.until(lambda: view.proportion < 0.9)
    before = view.shot()
    assert discs(view) == pytest.approx(usual * view.proportion**2, rel=0.15)
    view.scene.set_proportion(1.0)  # as it would be without
    wide = s.window.grid.offscreen.picture(view.scene, view.pixels)[..., :3]
    ground = white(before)
    assert white(wide) > ground  # more of the shape was under white lines


def test_drops_are_smaller_in_small_views_where_they_are_clicked_too(loaded):
    s = loaded
    s.session.show(add_pins(s.document, s.seen(2)[:1]))
    s.settle()
    view = s.panels[0].view
    tip = view.place_of(view.over.points.positions("pins")[0])

    def reach(tip):
        """Pixels above the tip up to which the drop can be taken."""
        x, y, points = round(tip.x()), round(tip.y()), view.over.points
        return max(k for k in range(40) if points.standing_at(QtCore.QPoint(x, y - k)) == ("pins", 1))

    usual = reach(tip)
    s.window.resize(700, 560)
    s.until(lambda: view.proportion < 0.9)
    s.settle(0.1)
    share = max(view.proportion, LEAST_SCALE)
    tip = view.place_of(view.over.points.positions("pins")[0])
    if tip.y() > 40:  # upright, as before
        assert reach(tip) == pytest.approx(share * usual, abs=1.5)


def test_anchors_are_dark_rings_with_a_light_halo_whatever_the_field(loaded):
    s = loaded
    vertex = s.seen(3)[1]
    s.session.show(
        replace(s.document, points=(*s.document.points, Point("a", vertex))).with_part(
            Anchors(anchors=(Anchor("a", 0.0),))
        )
    )
    s.until(lambda: s.session.is_complete)
    s.settle()
    view = s.panels[0].view
    picture, place = painted(view), view.place_of(s.panels[0].positions[vertex])
    x, y = round(place.x() - 0.5), round(place.y() - 0.5)
    size = PAPER.marker_size * view.proportion
    around = picture[y - 12 : y + 13, x - 12 : x + 13].astype(int)
    away = np.hypot(*np.mgrid[-12:13, -12:13])
    centre, ring = around[away < 0.1 * size], around[np.abs(away - 0.33 * size) < 0.6]
    assert centre.min() > 220
    assert np.median(ring.max(axis=1)) < 70
