"""The rules that judge statements: at their limits, beside them, and on ties."""

from dataclasses import replace

import numpy as np
import pytest

from bihdist_core import ParameterError
from bihdist_core.experiments import EXPERIMENTS, Claim
from bihdist_core.experiments.result import STATEMENTS, statements_of
from bihdist_core.experiments.verdicts import (
    FAILS,
    HOLDS,
    PARTLY,
    BySource,
    Estimate,
    Part,
    Statement,
    above,
    at_least,
    at_most,
    between,
    exponent,
    exponent_estimate,
    mean_estimate,
)


def sources(met, of, pictured=True):
    """Numbers of which some are within the limit of 1, by more than their spread, and the others beyond."""
    return BySource((0.9 if pictured else 1.1,), (0.9,) * met + (1.1,) * (of - met))


@pytest.mark.parametrize(
    ("numbers", "verdict"),
    [
        (sources(10, 10), HOLDS),
        (sources(9, 10), HOLDS),  # just 90 %
        (sources(89, 100), PARTLY),
        (sources(0, 10), PARTLY),  # the pictured source alone
        (sources(10, 10, pictured=False), PARTLY),  # all but the pictured one
        (sources(6, 10, pictured=False), PARTLY),
        (sources(5, 10, pictured=False), FAILS),  # half is no majority
        (BySource((0.9,)), PARTLY),  # no random ones
        (BySource((0.9, 1.1), (0.9,) * 10), PARTLY),  # one of two pictured ones
        (BySource((1.019,), (0.9,) * 10), PARTLY),  # within its spread of the limit
        (BySource((0.981,), (0.9,) * 10), PARTLY),
        (BySource((0.979,), (0.9,) * 10), HOLDS),
        (BySource((0.9,), (0.99,) * 10), PARTLY),  # the random ones
        (BySource((1.1,), (0.99,) * 10), PARTLY),
        (BySource((np.nan,), (np.nan,)), None),  # 0/0 is not judged
        (BySource((np.nan,), (0.9,) * 10), None),  # nor without the pictured source
        (BySource((0.9, np.nan), (0.9,) * 9 + (np.nan,)), HOLDS),  # what tells nothing is left out
        (BySource(()), None),
        (None, None),
    ],
)
def test_sources_are_judged_the_pictured_first(numbers, verdict):
    assert Part("number", at_most(1)).judge(numbers) == verdict


@pytest.mark.parametrize(
    ("numbers", "verdict", "quick"),
    [
        (BySource((0.9,), (0.9,) * 9), HOLDS, None),  # more sources may refute it
        (BySource((0.9, 0.9), (0.9,) * 99 + (1.1,)), FAILS, FAILS),  # a single counterexample
        (BySource((1.1,), (0.9,) * 9), FAILS, FAILS),
        (BySource((1.01,), (0.9,) * 9), PARTLY, None),
    ],
)
def test_one_counterexample_refutes_what_is_said_of_all_sources(numbers, verdict, quick):
    part = Part("number", at_most(1), "everywhere")
    assert (part.judge(numbers), part.judge(numbers, surely=True)) == (verdict, quick)
    found = Claim("fig1-1", {"deepest other minimum, biharmonic, of the range": BySource((0.06,), (0.0,))})
    assert (found.verdict, found.verdict_words) == (FAILS, "does not hold everywhere")


@pytest.mark.parametrize(
    ("numbers", "by", "verdict"),
    [
        (BySource((0.9,), (0.9, 0.88)), "sources", HOLDS),
        (BySource((1.1,), (1.11,)), "sources", FAILS),
        (BySource((0.9,), (0.9,) * 99 + (1.1,)), "sources", None),
        (BySource((0.9,), (0.9, 0.5)), "sources", None),  # three standard deviations reach beyond,
        (Estimate(0.5, 0.4, 0.6, 5), "interval", HOLDS),
        (Estimate(0.5, 0.4, 1.6, 5), "interval", None),
    ],
)
def test_quick_numbers_are_judged_where_they_are_on_one_side(numbers, by, verdict):
    part = Part("number", at_most(1), by)
    assert part.judge(numbers, surely=True) == verdict
    of_two = Statement("x-1", "It is so.", "ours", "nowhere", (part, Part("other", at_most(1), "once")))
    measured = {"number": numbers, "other": Estimate(0.0)}
    assert of_two.judge(measured, quick=True) == verdict if verdict != FAILS else PARTLY
    assert replace(of_two, whole=True).judge(measured, quick=True) is None


@pytest.mark.parametrize(
    ("limit", "met", "missed"),
    [
        (at_most(1), 1.0, np.nextafter(1, 2)),
        (at_least(1), 1.0, np.nextafter(1, 0)),
        (above(1), np.nextafter(1, 2), 1.0),
        (between(-1.25, -0.75), -1.25, -1.2500001),
        (between(-1.25, -0.75), -0.75, -0.7499999),
    ],
)
def test_limits_end_where_they_say(limit, met, missed):
    assert limit.meets(met)
    assert not limit.meets(missed)
    assert not limit.meets(np.nan)


@pytest.mark.parametrize(
    ("estimate", "verdict"),
    [
        (Estimate(1.0, 0.001, 2.0, 25), HOLDS),
        (Estimate(1.0, 0.0, 2.0, 25), PARTLY),  # 0 is in the interval
        (Estimate(1.0, -1.0, 3.0, 25), PARTLY),
        (Estimate(0.0, 0.0, 0.0, 25), FAILS),  # a tie
        (Estimate(0.0, -1.0, 1.0, 25), PARTLY),
        (Estimate(-1.0, -3.0, 1.0, 25), PARTLY),
        (Estimate(-1.0, -2.0, -0.5, 25), FAILS),
        (Estimate(1.0, np.inf * -1, np.inf, 2), PARTLY),  # nothing is known of its spread
    ],
)
def test_differences_must_be_outside_their_intervals(estimate, verdict):
    assert Part("difference", above(0), "interval").judge(estimate) == verdict


def test_a_number_without_spread_is_judged_as_it_is():
    part = Part("count", at_most(0), "once")
    assert part.judge(Estimate(0)) == HOLDS
    assert part.judge(Estimate(1)) == FAILS


def test_numbers_of_the_other_sort_are_refused():
    with pytest.raises(ParameterError, match="judged by sources, which Estimate is not for"):
        Part("number", at_most(1)).judge(Estimate(0.5))
    with pytest.raises(ParameterError, match="judged by interval, which BySource is not for"):
        Part("number", at_most(1), "interval").judge(BySource((0.5,)))


def test_a_mean_has_the_interval_of_resampled_ones():
    numbers = np.random.default_rng(3).standard_normal(100)
    found = mean_estimate(numbers)
    assert (found.value, found.count) == (pytest.approx(numbers.mean()), 100)
    # Of so many normal numbers it is nearly Student's; 2,000 resamples know their quantiles within some percent.
    assert found.high - found.low == pytest.approx(2 * 1.984 * numbers.std(ddof=1) / 10, rel=0.08)
    assert found == mean_estimate(numbers)
    # A mean of counts stays where means of counts can be.
    assert mean_estimate([0, 0, 0, 1]).low == 0
    assert mean_estimate([2, 2, 2]) == Estimate(2, 2, 2, 3)
    with pytest.raises(ParameterError, match="no numbers"):
        mean_estimate([])


def test_exponents_with_their_interval():
    n = np.array([1000, 2000, 4000, 8000])
    assert exponent(n, 3 * n**1.5) == pytest.approx(1.5)
    exact = exponent_estimate(n, 3 * n[:, None] ** 1.5)
    assert (exact.low, exact.high) == pytest.approx((1.5, 1.5))
    # Repetitions that differ, and meshes that do.
    assert exponent_estimate(n, n[:, None] ** 1.5 * [1, 1.2]).value == pytest.approx(1.5)
    for rough in (n[:, None] ** 1.5 * [1, 1.2], n[:, None] ** 1.5 * np.array([[1.1], [0.9], [1.1], [0.9]])):
        found = exponent_estimate(n, rough)
        assert found.low < 1.45 < 1.52 < found.high
    with pytest.raises(ParameterError, match="positive"):
        exponent(n, n - 1000)


def statement(*needed):
    parts = tuple(Part(name, at_most(1), "once", needed=name in needed) for name in "ab")
    return Statement("x-1", "It is so.", "ours", "nowhere", parts)


@pytest.mark.parametrize(
    ("needed", "a", "b", "verdict"),
    [
        ("", 0, 0, HOLDS),
        ("", 0, 2, PARTLY),
        ("", 2, 2, FAILS),
        ("", 0, 1, PARTLY),  # just at the limit
        ("", 0, None, PARTLY),
        ("", 2, None, FAILS),
        ("", None, None, None),
        ("a", 2, 0, FAILS),
        ("a", 0, 2, PARTLY),
        ("a", 0, None, PARTLY),
        ("a", None, 0, None),
    ],
)
def test_parts_make_a_verdict(needed, a, b, verdict):
    numbers = {name: Estimate(x) for name, x in (("a", a), ("b", b)) if x is not None}
    assert statement(*needed).judge(numbers) == verdict


def test_an_unknown_part_or_statement_is_named():
    with pytest.raises(ParameterError, match="x-1 has no part 'c' but a, b"):
        statement().judge({"c": Estimate(1)})
    with pytest.raises(ParameterError, match="no statement 'fig99-1'"):
        Claim("fig99-1")
    with pytest.raises(ParameterError, match="fig1-1 has no part 'height'"):
        Claim("fig1-1", {"height": Estimate(1)})


def test_numbers_are_said_with_their_spread():
    part = Part("change", at_most(0.05, "%"))
    assert part.formatted(BySource((0.021,), (0.018, 0.03))) == "2.1 % pictured; 1.8 to 3 % from 2 random sources"
    assert part.formatted(BySource((0.021, 0.05), (0.03,))) == "2.1 to 5 % pictured; 3 % from 1 random source"
    assert part.formatted(BySource((np.nan,), (0.03, np.nan, np.nan))) == (
        "undefined pictured; 3 % from 1 random source; undefined from 2 random sources"
    )
    exponent = Part("exponent", at_most(2), "interval")
    assert exponent.formatted(Estimate(1.9, 1.7, 2.1, 4)) == "1.9 (1.7 to 2.1)"
    assert exponent.formatted(Estimate(1.9, -np.inf, np.inf, 2)) == "1.9 (no interval)"
    assert exponent.formatted(Estimate(0.1, -0.1, 0.3, 4)) == "0.1 (−0.1 to 0.3)"
    assert exponent.formatted(Estimate(1.5, 1.4999, 1.5001, 4)) == "1.5"
    assert Part("count", at_most(0), "once").formatted(Estimate(3)) == "3"
    assert at_least(1e-6).words == "at least 10⁻⁶"
    assert at_most(1).formatted(-7.7e-5) == "−7.7 × 10⁻⁵"
    assert at_most(1).formatted(np.inf) == "inf"
    assert at_most(1, "%").formatted(0.0) == "0 %"


def test_every_statement_says_whose_it_is_by_what_rule():
    assert {id.partition("-")[0] for id in STATEMENTS} == set(EXPERIMENTS)
    for id, each in STATEMENTS.items():
        assert each.text.endswith(".")
        assert each.where
        assert each.parts
        assert len(set(each.names)) == len(each.names)
        assert all(part.rule for part in each.parts)
        assert each in statements_of(id.partition("-")[0])
