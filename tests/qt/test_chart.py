"""Charts in docks: where values are, and what the pointer is told."""

import numpy as np
import pytest

from tests.qt.events import send_mouse

pytest.importorskip("qtpy.QtWidgets")


@pytest.fixture
def chart(application):
    from app.drawing.chart import Axis
    from app.qt.docks.chart import Chart

    made = Chart("Chart of a test")
    made.resize(600, 240)
    made.show_axes(Axis(0, 2.552, "mesh units"), Axis(0, 1, in_percent=True))
    made.show()
    application.processEvents()
    yield made
    made.close()


def test_pixels_and_values_are_each_others_inverse(chart):
    from qtpy.QtCore import QPointF

    for x, y in ((0.0, 0.0), (1.25, 0.4), (2.552, 1.0)):
        right, down = chart.pixels(x, y)
        assert chart.values(QPointF(float(right), float(down))) == pytest.approx((x, y), abs=1e-12)
    assert chart.pixels(0, 0)[0] == chart.plot.left()
    assert chart.pixels(0, 1)[1] == chart.plot.top()


def test_ticks_are_round_and_percent_stands_once(chart):
    across = chart.across.ticks(chart.plot.width(), 72)
    assert np.allclose(across, [0, 0.5, 1, 1.5, 2, 2.5])
    assert [chart.up.words(value, value == 1) for value in (0, 0.25, 1)] == ["0", "25", "100 %"]


def test_the_pointer_is_told_in_values_and_only_over_the_plot(chart, application):
    from qtpy import QtCore

    told = []
    application.processEvents()  # where the screen's own pointer is
    chart.pointed.connect(told.append)
    for place in (chart.plot.center(), QtCore.QPointF(2, 2)):
        send_mouse(chart, place)
    assert len(told) == 2
    assert told[0] == pytest.approx((1.276, 0.5), abs=0.02)
    assert told[-1] is None
