"""Boxes on a desktop whose numbers have a decimal comma: 0.5 and 0,5 are one number, and it is shown with a point."""

import pytest
from qtpy import QtCore, QtTest, QtWidgets

from app.qt.docks.slider_box import Scale, SliderBox
from app.qt.files.export_dialog import _LetterBox
from app.qt.files.size_boxes import SizeBoxes
from app.qt.panels.number_box import EndPopUp, NumberPopUp
from bihdist_core.distances.distance_types import Spec


@pytest.fixture
def german(application):
    QtCore.QLocale.setDefault(QtCore.QLocale(QtCore.QLocale.Language.German, QtCore.QLocale.Country.Germany))
    yield
    QtCore.QLocale.setDefault(QtCore.QLocale.system())


@pytest.fixture
def parent(german):
    widget = QtWidgets.QWidget()
    yield widget
    widget.deleteLater()


def typed(box, text):
    box.selectAll()
    QtTest.QTest.keyClicks(box, text)
    QtTest.QTest.keyClick(box, QtCore.Qt.Key.Key_Return)


@pytest.mark.parametrize("text", ["0.5", "0,5"])
def test_boxes_understand_a_comma(parent, text):
    found = []
    slider = SliderBox(Scale(0.0, 1.0, steps=100), 60)
    slider.valued.connect(lambda value, is_live: found.append(value))
    typed(slider.box, text)
    end = EndPopUp(parent)
    end.chosen.connect(found.append)
    typed(end.box, text)
    (parameter,) = Spec.of("diffusion").distance_type.parameters
    number = NumberPopUp(parameter, parent)
    number.chosen.connect(found.append)
    typed(number.box, text)
    assert found == [0.5] * 3
    letters = _LetterBox(decimals=1, suffix=" pt")
    typed(letters, text)
    assert (letters.value(), letters.text()) == (0.5, "0.5 pt")
    size = SizeBoxes((), parent)
    typed(size.width_box, f"8{text}")
    assert size.text() == "80.5mm"
