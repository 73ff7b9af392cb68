"""The rules that judge statements: at their limits, beside them, and on ties."""

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
    exponent_estimate,
    mean_estimate,
)


def sources(met, of, pictured=True):
    """Numbers of which some are 1, the limit of `part`, and the others a little more."""
    return BySource((1.0 if pictured else 1.0001,), (1.0,) * met + (1.0001,) * (of - met))


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
        (BySource((1.0,)), PARTLY),  # no random ones
        (BySource((1.0, 1.0001), (1.0,) * 10), PARTLY),  # one of two pictured ones
        (BySource((np.nan,), (np.nan,)), None),  # 0/0 is not judged
        (BySource((np.nan,), (1.0,) * 10), None),  # nor without the pictured source
        (BySource((1.0, np.nan), (1.0,) * 9 + (np.nan,)), HOLDS),  # what tells nothing is left out
        (BySource(()), None),
        (None, None),
    ],
)
def test_sources_are_judged_the_pictured_first(numbers, verdict):
    assert Part("number", at_most(1)).judge(numbers) == verdict


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
        (Estimate(0.0, -1.0, 1.0, 25), FAILS),
        (Estimate(-1.0, -3.0, 1.0, 25), FAILS),
        (Estimate(-1.0, -2.0, -0.5, 25), FAILS),
        (Estimate(1.0), PARTLY),  # of one measurement there is no interval
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


def test_students_interval_of_differences():
    found = mean_estimate([1, 2, 3, 4, 5])
    # t = 2.776 for 4 degrees of freedom; the standard error is sqrt(2.5 / 5).
    assert (found.value, found.count) == (3, 5)
    assert found.high - 3 == pytest.approx(2.7764 * np.sqrt(0.5), rel=1e-4)
    assert found.low + found.high == pytest.approx(6)
    assert mean_estimate([2, 2, 2]).low == 2
    assert mean_estimate([2]).low == -np.inf
    with pytest.raises(ParameterError, match="no numbers"):
        mean_estimate([])


def test_exponents_with_their_interval():
    n = np.array([1000, 2000, 4000, 8000])
    exact = exponent_estimate(n, 3 * n**1.5)
    assert exact.value == pytest.approx(1.5)
    assert exact.high - exact.low == pytest.approx(0, abs=1e-9)
    rough = exponent_estimate(n, 3 * n**1.5 * [1.1, 0.9, 1.1, 0.9])
    assert rough.low < 1.5 < rough.high
    assert exponent_estimate(n[:2], n[:2]).high == np.inf
    with pytest.raises(ParameterError, match="positive"):
        exponent_estimate(n, n - 1000)


def statement(*needed):
    parts = tuple(Part(name, at_most(1), "once", needed=name in needed) for name in "ab")
    return Statement("x-1", "It is so.", "ours", "nowhere", parts)


@pytest.mark.parametrize(
    ("needed", "a", "b", "verdict"),
    [
        ("", 1, 1, HOLDS),
        ("", 1, 2, PARTLY),
        ("", 2, 2, FAILS),
        ("", 1, None, PARTLY),
        ("", 2, None, FAILS),
        ("", None, None, None),
        ("a", 2, 1, FAILS),
        ("a", 1, 2, PARTLY),
        ("a", 1, None, PARTLY),
        ("a", None, 1, None),
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
        "0/0 pictured; 3 % from 1 random source; 0/0 from 2 random sources"
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


def test_a_verdict_of_the_version_before_comes_with_what_changed():
    # Triangles and points apart are measured as before: their verdicts must be, too (see the experiments' tests).
    same = {id for id, each in STATEMENTS.items() if each.before and not each.changed}
    assert same == {"claims-triangle", "claims-identity"}
    assert {each.before for each in STATEMENTS.values()} == {"yes", "no", ""}
