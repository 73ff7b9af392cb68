"""The operator of a mesh, chosen in the window."""

import numpy as np
import pytest
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BiharmonicDistance, Laplacian
from bihdist_core.distances.distance_types import Spec
from bihdist_core.intrinsic import INTRINSIC
from tests.shapes import bumpy, caps

THIN = caps(bumpy(100), 0.05, 3)

pytestmark = pytest.mark.usefixtures("own_folder")


@pytest.fixture
def s(shared_screen):
    return shared_screen(THIN, (Spec.of("biharmonic"), Spec.of("commute-time")))


def choices(s):
    (menu,) = (each for each in s.window.findChildren(QtWidgets.QMenu) if each.title() == "Operator")
    return {action.data(): action for action in menu.actions()}


def test_it_is_chosen_ticked_named_and_undone(s):
    assert [word for word, action in choices(s).items() if action.isChecked()] == ["cotan"]
    choices(s)[INTRINSIC].trigger()
    s.until(lambda: s.session.is_complete and s.document.surfaces[0].repairs.operator == INTRINSIC)
    panel = s.window.context.grid.panels[0]
    s.until(lambda: panel.answer is not None and panel.answer.label == "biharmonic, exact, intrinsic-delaunay")
    source = s.document.sources[0]
    wanted = BiharmonicDistance(Laplacian(THIN, operator=INTRINSIC)).from_source(source)
    assert np.array_equal(panel.answer.field, wanted)
    assert [control.text() for control in panel.head.controls] == ["exact, intrinsic-delaunay"]
    assert [word for word, action in choices(s).items() if action.isChecked()] == [INTRINSIC]
    s.window.actions_by_word["undo"].trigger()
    s.until(lambda: [control.text() for control in panel.head.controls] == ["exact"])


def test_a_menu_that_closes_activates_no_other_panel(s):
    grid = s.window.context.grid
    first, _ = grid.panels
    grid.activate(s.document.panels[1].id)
    for reason, active in (
        (QtCore.Qt.FocusReason.PopupFocusReason, 1),
        (QtCore.Qt.FocusReason.MenuBarFocusReason, 1),
        (QtCore.Qt.FocusReason.TabFocusReason, 0),
    ):
        event = QtGui.QFocusEvent(QtCore.QEvent.Type.FocusIn, reason)
        QtWidgets.QApplication.sendEvent(first.view, event)
        assert grid.active == s.document.panels[active].id
