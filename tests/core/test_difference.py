"""Differences of fields: fractions of the maxima or values."""

import numpy as np
import pytest

from bihdist_core import ParameterError, difference
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, difference_of, plain
from bihdist_core.distances.difference import difference_in_unit


def test_shares_lie_between_minus_one_and_one_and_values_are_subtracted():
    a, b = np.array([0.0, 2.0, 4.0, np.nan]), np.array([10.0, 0.0, 5.0, 1.0])
    assert np.array_equal(difference(a, b), [-1, 0.5, 0.5, np.nan], equal_nan=True)
    assert np.array_equal(difference(a, b, raw=True), [-10, 2, -1, np.nan], equal_nan=True)


def test_each_column_has_its_own_maximum():
    a = np.array([[0.0, 0.0], [1.0, 8.0]])
    assert np.array_equal(difference(a, np.zeros((2, 2))), [[0, 0], [1, 1]])


def test_fields_of_other_shapes_are_refused():
    with pytest.raises(ParameterError, match="cannot be subtracted"):
        difference(np.zeros(3), np.zeros(4))


def test_the_accuracy_of_a_difference_is_at_most_the_sum():
    one, other = (
        Answer(label=label, unit="mesh units", field=np.array([0.0, 1.0]), error_estimate=ErrorEstimate.of(share))
        for label, share in (("a", 3e-10), ("b", 4e-10))
    )
    both = difference_of(one, other)
    assert both.error_estimate.share == pytest.approx(7e-10)
    assert both.label == "a − b"
    assert difference_of(one, Answer(label="b", failure="It broke.")).failure == "It broke."


@pytest.mark.parametrize(
    ("fields", "raw", "words"),
    [
        (([0.0, 1.0, 4.0], [0.0, 2.142, 5.0]), False, "largest −17.8 % at vertex 1: geodesic is farther"),
        (([0.0, 3.142, 4.0], [0.0, 1.0, 5.0]), False, "largest +58.5 % at vertex 1: biharmonic is farther"),
        (([0.0, 3.0, 4.0], [0.0, 1.0, 5.0]), True, "largest +2 mesh units at vertex 1: biharmonic is farther"),
        (([0.0, 3.0], [0.0, 3.0]), False, ""),
    ],
)
def test_a_difference_says_in_words_which_is_farther_and_by_how_much(fields, raw, words):
    labels = ("biharmonic, exact", "geodesic, exact")
    one, other = (
        Answer(label=label, unit="mesh units", field=np.array(field), is_distance=True)
        for label, field in zip(labels, fields, strict=True)
    )
    found = difference_of(one, other, raw)
    assert found.largest_words == words
    assert found.unit == ("mesh units" if raw else "percentage points")
    assert np.allclose(found.field, difference(*fields, raw=raw) * (1 if raw else 100))


def test_two_of_one_name_and_what_is_no_distance_are_told_apart():
    one = Answer(label="diffusion, t = 1", field=np.array([0.0, 1.0, 2.0]), is_distance=True)
    other = Answer(label="diffusion, t = 4", field=np.array([0.0, 2.0, 2.0]), is_distance=True)
    assert difference_of(one, other).largest_words == "largest −50 % at vertex 1: diffusion, t = 4 is farther"
    mine = Answer(label="height", field=np.array([0.0, 2.0, 2.0]))
    assert difference_of(one, mine).largest_words == "largest −50 % at vertex 1: height is larger"


def test_two_of_one_label_are_the_first_and_the_second():
    one, other = (Answer(label="commute-time, exact", field=np.array(f)) for f in ([0.0, 1.0, 2.0], [2.0, 1.0, 0.0]))
    assert difference_of(one, other).signs == ("the first is larger", "the second is larger")


def test_a_difference_has_a_unit_or_is_refused():
    one, other = np.array([0.0, 1.0, 2.0]), np.array([0.0, 3.0, 4.0])
    for units, raw, unit in [
        (("mm", "1"), False, "percentage points"),
        (("mm", "mm"), True, "mm"),
        (("", "mm"), True, "mm"),
    ]:
        field, found = difference_in_unit(one, other, units, raw)
        assert found == unit
        assert np.allclose(field, one - other if raw else 100 * (one / 2 - other / 4))
    with pytest.raises(ParameterError, match="Values in mm and in 1 cannot be subtracted"):
        difference_in_unit(one, other, ("mm", "1"), raw=True)


@pytest.mark.parametrize(("value", "words"), [(999.4, "999"), (999.7, "1,000"), (-999.7, "-1,000"), (0.1417, "0.142")])
def test_numbers_in_words_have_no_power_of_ten(value, words):
    assert plain(value) == words


def test_shares_are_of_the_largest_absolute_value():
    assert np.allclose(difference([0, 0.5, 1], [0, -5, -10]), [0, 1, 2])
    assert np.allclose(difference([0, 0.5, 1], [-1e3, 0, 1e-9]), [1, 0.5, 1])
