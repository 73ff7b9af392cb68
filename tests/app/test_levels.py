"""Which values have an isoline."""

import numpy as np
import pytest

from app.document.document import Anchor, comparison
from app.document.edits import open_mesh
from app.document.isoline_edits import pass_through, pass_through_none
from app.document.looks import Isolines
from app.drawing.levels import levels, too_many


def values(isolines, maximum=1.0, own=1.0, **how):
    return levels(isolines, maximum, own, **how).values.tolist()


def test_steps_spacing_and_values():
    assert values(Isolines(4)) == [0.25, 0.5, 0.75]
    assert values(Isolines(4), own=1.1) == [0.25, 0.5, 0.75, 1.0]
    assert values(Isolines(4), signed=True) == [-0.5, 0.0, 0.5]
    assert values(Isolines(5), signed=True) == [-0.5, 0.0, 0.5]  # an even number, so that 0 has one
    assert values(Isolines(spacing=0.3)) == pytest.approx([0.3, 0.6, 0.9])
    assert values(Isolines(spacing=0.3), maximum=7.0) == pytest.approx([0.3, 0.6, 0.9])
    assert values(Isolines(spacing=0.4), signed=True) == pytest.approx([-0.8, -0.4, 0, 0.4, 0.8])
    assert values(Isolines(values=(0.9, -0.5, 0.0, 0.2, 1.0, 3.0))) == [0.2, 0.9]
    assert values(Isolines(values=(0.9, -0.5, 0.0, 0.2, 1.0, 3.0)), signed=True) == [-0.5, 0.0, 0.2, 0.9]
    assert values(Isolines(0)) == values(Isolines(20), own=0.0) == values(Isolines(20), maximum=0.0) == []
    assert values(Isolines(0, spacing=0.5)) == [0.5]


def test_some_are_bold():
    assert levels(Isolines(12, bold=5), 1.0, 1.0).is_bold.nonzero()[0].tolist() == [4, 9]
    signed = levels(Isolines(24, bold=5), 1.0, 1.0, signed=True)
    assert signed.values[signed.is_bold] == pytest.approx([-10 / 12, -5 / 12, 0, 5 / 12, 10 / 12])
    assert levels(Isolines(4), 1.0, 1.0, signed=True).is_bold.tolist() == [False, True, False]
    typed = levels(Isolines(values=(0.1, 0.2, 0.3, 0.4), bold=2), 1.0, 1.0)
    assert typed.widths.tolist() == [1, 2, 1, 2]


def test_lines_through_points_stand_out_once_each():
    found = levels(Isolines(4), 1.0, 1.0, through=(0.6, 0.5, np.nan, 0.0, 2.0, 0.6))
    assert found.values.tolist() == [0.25, 0.5, 0.6, 0.75]
    assert found.is_through.tolist() == [False, True, True, False]
    assert not found.is_bold.any()
    alone = levels(Isolines(0), 1.0, 1.0, signed=True, through=(-0.3,))
    assert (alone.values.tolist(), alone.is_through.tolist()) == ([-0.3], [True])


def test_too_fine_a_spacing_is_said():
    isolines = Isolines(spacing=1e-5)
    found = levels(isolines, 1.0, 1.0)
    assert (len(found.values), found.wanted) == (0, 99_999)
    assert "99,999 isolines" in too_many(found, isolines, 1.0)
    assert too_many(levels(Isolines(1000), 1.0, 1.0), Isolines(1000), 1.0) == ""
    # Of a field that goes far beyond its colour bar, the first thousand.
    assert len(values(Isolines(1000), 1.0, 50.0)) == 1000


def test_points_come_and_go_with_their_lines():
    document = pass_through(comparison("hand"), (5, 9))
    document = pass_through(document, (7,))
    assert [document.point(name).at for name in document.isolines.through] == [5, 9, 7]
    assert pass_through_none(document) == comparison("hand")
    other = open_mesh(document, document.mesh().__class__("A", "other.off"))
    assert (other.isolines.through, [point.name for point in other.points]) == ((), ["source"])
    from dataclasses import replace

    marked = replace(document, anchors=(Anchor("line"),))
    assert [point.name for point in pass_through_none(marked).points] == ["source", "line"]
