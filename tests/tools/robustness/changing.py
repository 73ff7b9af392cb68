"""What tests of robustness share: the dock, typing and pressing there, and whether the panels show a change."""

from dataclasses import replace

import numpy as np
import pytest

from app.tools.robustness.quantity import DistanceChange
from bihdist_core import BiharmonicDistance, GeodesicDistance
from bihdist_core.applications.perturbation import perturbed
from bihdist_core.distances.distance_types import Spec

pytest.importorskip("qtpy")
from qtpy import QtCore, QtTest

from tests.qt.parts import parts
from tests.shapes import bumpy

LEFT, KEYS = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.Key
KINDS = (BiharmonicDistance, GeodesicDistance)


def open_it(shared_screen):
    """A window with a mesh, two distances and the dock."""
    s = shared_screen(bumpy(400), (Spec.of("biharmonic"), Spec.of("geodesic", method="exact")), source=None)
    s.window.actions_by_word["dock robustness"].trigger()
    s.settle()
    return s


def dock_of(s):
    return parts(s.window).docks._instrument("robustness")


def complete(s):
    s.until(lambda: not s.session.is_opening and s.session.is_complete and not s.session.progress)
    s.settle(0.05)


def type_in(s, box, text):
    box.setFocus()
    box.selectAll()
    QtTest.QTest.keyClicks(box, text)
    QtTest.QTest.keyClick(box, KEYS.Key_Return)
    s.settle(0.02)
    complete(s)


def press(s, widget):
    QtTest.QTest.mouseClick(widget, LEFT)
    s.settle(0.02)
    complete(s)


def change_of(s):
    return s.document.surfaces[1].change if len(s.document.surfaces) > 1 else None


def seen(s, panel=0):
    """A vertex near the middle of a panel's view, and where."""
    view = s.panels[panel].view
    at = QtCore.QPoint(view.width() // 2, view.height() // 2)
    return view.pick(at).vertex, at


def check(s, expected):
    """The change is this, and the panels show it."""
    assert replace(change_of(s), pose_sha256="") == expected
    before = s.session.mesh().surface
    after, ids = perturbed(before, expected)
    assert np.array_equal(s.session.loaded("B").surface.vertices, after.vertices)
    assert np.array_equal(s.session.loaded("B").surface.faces, after.faces)
    start, there = s.document.point("source").at, s.document.point("source after").at
    assert ids[there] >= 0
    for row, kind in enumerate(KINDS):
        old, new = kind(before).from_source(start), kind(after).from_source(there)
        assert s.answers[3 * row].field == pytest.approx(old, rel=1e-9)
        assert s.answers[3 * row + 1].field == pytest.approx(new, rel=1e-9, nan_ok=True)
        assert isinstance(s.document.panels[3 * row + 2].shows, DistanceChange)
    return after, ids
