"""Which values have an isoline."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from app.document.document import comparison
from app.document.edits import open_mesh, pass_through, pass_through_none
from app.document.looks import TWENTY_STEPS, Isolines
from app.scene.levels import in_unit, levels, round_step, too_many, with_kept_step
from app.tools.interpolation.part import Anchor, Anchors


def values(isolines, maximum=1.0, own=1.0, **how):
    return levels(isolines, maximum, own, **how).values.tolist()


def test_steps_spacing_and_values():
    assert values(Isolines(4, round=False), 0.8, 0.8) == pytest.approx([0.2, 0.4, 0.6])
    assert values(Isolines(4, round=False), own=1.1) == [0.25, 0.5, 0.75, 1.0]
    assert values(Isolines(4, round=False), signed=True) == [-0.5, 0.0, 0.5]
    assert values(Isolines(5, round=False), signed=True) == [-0.5, 0.0, 0.5]  # an even number, so that 0 has one
    assert values(Isolines(spacing=0.3)) == pytest.approx([0.3, 0.6, 0.9])
    assert values(Isolines(spacing=0.3), maximum=7.0) == pytest.approx([0.3, 0.6, 0.9])
    assert values(Isolines(spacing=0.4), signed=True) == pytest.approx([-0.8, -0.4, 0, 0.4, 0.8])
    assert values(Isolines(values=(0.9, -0.5, 0.0, 0.2, 1.0, 3.0))) == [0.2, 0.9]
    assert values(Isolines(values=(0.9, -0.5, 0.0, 0.2, 1.0, 3.0)), signed=True) == [-0.5, 0.0, 0.2, 0.9]
    assert values(Isolines(0)) == values(Isolines(20), own=0.0) == values(Isolines(20), maximum=0.0) == []
    assert values(Isolines(0, spacing=0.5)) == [0.5]


def test_usual_lines_are_at_round_values():
    # 0.0208, 0.0416 ... they were.
    assert values(Isolines(20), 0.4159, 0.4159) == [round(0.02 * k, 2) for k in range(1, 21)]
    assert values(Isolines(8), 7.3, 2.4) == [1.0, 2.0]
    assert values(Isolines(10), 14.2, 14.2, signed=True) == [-12.5, -10, -7.5, -5, -2.5, 0, 2.5, 5, 7.5, 10, 12.5]


@pytest.mark.parametrize("signed", [False, True])
@given(st.floats(1e-12, 1e12), st.integers(1, 1000))
def test_round_steps_are_near_the_count_and_nothing_is_missing(signed, top, count):
    found = levels(Isolines(count), top, top, signed).values
    steps = max(1, round(count / 2)) if signed else count
    step = round_step(top, steps)
    digits = step / 10 ** np.floor(np.log10(step) + 1e-9)
    assert any(digits == pytest.approx(each, rel=1e-9) for each in (1, 2, 2.5, 5))
    # Between two round steps at most a factor of two, so half of that, in proportion, but for the most that are drawn.
    assert 1 / 1.42 <= top / step / steps <= 1.42 or (top / step / steps >= 0.4 and count > 700)
    assert found / step == pytest.approx(np.round(found / step), abs=1e-6)
    above = found[found > 0]
    assert np.diff(above) == pytest.approx(step, rel=1e-6)
    assert top - step * (1 + 1e-5) <= (above[-1] if len(above) else 0) < top


def test_panels_that_end_alike_have_the_same_lines_and_shares_round_percentages():
    one, other = (levels(Isolines(20), 0.4159, own).values for own in (0.4159, 0.2))
    assert other.tolist() == one[: len(other)].tolist()
    for count, steps in ((20, 20), (12, 10), (30, 40), (7, 5), (0, 0)):
        assert in_unit(Isolines(count), 1.0, True, False).count == steps
    assert values(in_unit(Isolines(14), 1.0, True, True), 0.8, 0.8, signed=True) == pytest.approx(
        [0.8 * k / 5 for k in range(-4, 5)]
    )
    typed = Isolines(spacing=0.05)
    assert in_unit(typed, 100.0, True, False).spacing == pytest.approx(5)
    assert Isolines(spacing=1e99).scaled(100.0).spacing == 1e100
    assert Isolines(values=(-1e100, 0.5)).scaled(100.0).values == (-1e100, 50.0)
    assert in_unit(Isolines(20, round=False), 1.0, True, False) == Isolines(20, round=False)


def test_a_step_is_kept_while_it_makes_half_to_twice_as_many():
    def kept(isolines=TWENTY_STEPS, maximum=1.0, own=None, signed=False):
        return with_kept_step(isolines, 0.05, maximum, maximum if own is None else own, signed)

    assert levels(Isolines(20), 1.0, 1.0).step == 0.05
    assert kept(maximum=0.51).spacing == kept(maximum=1.99).spacing == 0.05
    assert values(kept(maximum=0.51), 0.51, 0.51) == [round(0.05 * k, 2) for k in range(1, 11)]
    assert kept(Isolines(40), signed=True).spacing == 0.05
    for other in (kept(maximum=0.49), kept(maximum=2.01), kept(signed=True, maximum=1.01), kept(own=26.0)):
        assert other == Isolines(20)
    for own in (Isolines(0), Isolines(20, round=False), Isolines(spacing=0.1), Isolines(values=(0.1,))):
        assert kept(own) == own
    assert with_kept_step(Isolines(20), 0.0, 1.0, 1.0, False) == Isolines(20)


def test_some_are_bold():
    assert levels(Isolines(12, bold=5, round=False), 1.0, 1.0).is_bold.nonzero()[0].tolist() == [4, 9]
    signed = levels(Isolines(24, bold=5, round=False), 1.0, 1.0, signed=True)
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

    marked = document.with_part(Anchors(anchors=(Anchor("line"),)))
    assert [point.name for point in pass_through_none(marked).points] == ["source", "line"]
