"""Sources as values and as words: what is written is read again, and what is none is said."""

import json

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from bihdist_core import BoundaryLoop, Curve, ParameterError, SourceSet, SurfacePoint, source_from_words
from bihdist_core.sources.source import checked_source
from bihdist_core.sources.words import curve_text, read_curve, short_words_of, words_of

A, B = SurfacePoint.of(3, 0.25, 0.5), SurfacePoint.of(9, 0.1, 0.2)

VERTICES = st.integers(0, 10**9)
PLACES = st.builds(SurfacePoint.of, st.integers(0, 10**9), st.floats(0, 0.5), st.floats(0, 0.5))
MEMBERS = st.one_of(VERTICES, PLACES, st.builds(BoundaryLoop, st.integers(0, 99)))
SOURCES = st.one_of(MEMBERS, st.lists(MEMBERS, min_size=2, max_size=6, unique=True).map(tuple).map(SourceSet))
CURVES = st.builds(Curve, st.lists(PLACES, min_size=2, max_size=6).map(tuple), st.booleans())


@settings(max_examples=200, deadline=None, derandomize=True)
@given(SOURCES)
def test_words_give_back_what_they_are_of(source):
    assert source_from_words(words_of(source)) == source


@settings(max_examples=50, deadline=None, derandomize=True)
@given(curve=CURVES)
def test_a_file_gives_back_its_curve(curve, tmp_path_factory):
    path = tmp_path_factory.mktemp("curves") / "a+b.json"
    path.write_text(curve_text(curve))
    assert read_curve(path) == curve
    assert source_from_words(str(path)) == curve  # for all the plus in its name


def test_a_file_among_others_may_have_a_plus_in_its_path(tmp_path):
    folder = tmp_path / "a+b + c"
    folder.mkdir()
    path, curve = folder / "d+e.json", Curve((A, B))
    path.write_text(curve_text(curve))
    files = {}
    assert source_from_words(f"12+{path} + loop:0", files=files) == SourceSet((12, curve, BoundaryLoop(0)))
    assert files == {curve: str(path)}
    assert words_of(SourceSet((12, curve)), files) == f"12+{path}"


def test_words_that_are_known_mean_what_they_mean():
    curve = Curve((A, B))
    words = words_of(SourceSet((12, curve)))
    assert source_from_words(words.replace("12", "13"), {words_of(curve): curve}) == SourceSet((13, curve))
    with pytest.raises(ParameterError, match="is not a source"):
        source_from_words(words)


def test_words_as_they_are_typed(tmp_path):
    assert source_from_words(" 12 ") == 12
    assert source_from_words("12+40 + 7") == SourceSet((12, 40, 7))
    assert source_from_words("f311:0.2,0.5") == SurfacePoint(311, (0.2, 0.5, 0.3))
    assert source_from_words("loop:0") == BoundaryLoop(0)
    assert source_from_words("12+f3:0.25,.5+loop:1") == SourceSet((12, A, BoundaryLoop(1)))
    (tmp_path / "c.json").write_text('{"points": [[3, 0.25, 0.5], [9, 0.1, 0.2]], "closed": true}')
    assert source_from_words(f"12+{tmp_path / 'c.json'}") == SourceSet((12, Curve((A, B), closed=True)))
    assert checked_source("7") == checked_source(np.int64(7)) == 7


def test_headings_are_short():
    assert short_words_of(SurfacePoint.of(3, 1 / 3, 0.1)) == "f3:0.333,0.1"
    assert short_words_of(SourceSet((1, 2, 3, 4, 5))) == "1+2+3 and 2 more"
    assert short_words_of(Curve((A, B), True)) == "a closed curve of 2 points"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("lop:0", "did you mean loop:0?"),
        ("12,40", r"did you mean 12\+40?"),
        ("12 40", r"did you mean 12\+40?"),
        ("f3:1,2,3", "the weights of the face's first two corners"),
        ("f3:0.2", "two weights"),
        ("f3", "two weights"),
        ("f3:a,0.1", "weights that are not numbers"),
        ("f3:nan,0.1", "weights that are not numbers"),
        ("f3:0.9,0.4", "0.9 and 0.4 leave -0.3"),
        ("f3:-0.1,0.4", "at least 0"),
        ("-3", "start at 0"),
        ("", "is not a source; write a vertex"),
        ("12+x", r"'x' in '12\+x' is not a source"),
        ("12+", "nothing beside it"),
        ("x" * 500, r"x\.\.\."),
        ("no such.json", "no such.json cannot be read"),
    ],
)
def test_words_that_mean_nothing(words, said):
    with pytest.raises(ParameterError, match=said):
        source_from_words(words)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("{", "not JSON"),
        ("[]", "is not a curve, which is"),
        ('{"points": 3}', "points must be a list"),
        ('{"points": [], "way": 1}', "unknown key 'way'"),
        ('{"points": [[1, 0, 0]]}', "from 2 to"),
        ('{"points": [[1, 0, 0], [2, 0.5]]}', r"points\[1\] must be a face and two weights, .* not \[2, 0.5\]"),
        ('{"points": [[1, 0, 0], [2.5, 0, 0]]}', r"points\[1\] must be"),
        ('{"points": [[1, 0, 0], [true, 0, 0]]}', r"points\[1\] must be"),
        ('{"points": [[1, 0, 0], [2, "a", 0]]}', r'points\[1\] .* \[2, "a", 0\]'),
        ('{"points": [[1, 0, 0], [2, NaN, 0]]}', r"points\[1\] must be"),
        ('{"points": [[1, 0, 0], [2, 0.9, 0.4]]}', r"points\[1\]: .*0.9 and 0.4 leave -0.3"),
        ('{"points": [[1, 0, 0], [2, 0, 0]], "closed": 1}', "closed is true or false, not 1"),
    ],
)
def test_files_that_are_no_curves_are_named_with_the_element_and_its_value(content, said, tmp_path):
    path = tmp_path / "curve.json"
    path.write_text(content)
    with pytest.raises(ParameterError, match=said) as error:
        read_curve(path)
    assert "curve.json" in str(error.value)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: SurfacePoint(-1, (1, 0, 0)), "numbered from 0"),
        (lambda: SurfacePoint(1.5, (1, 0, 0)), "whole number"),
        (lambda: SurfacePoint(0, (0.5, 0.6, 0.1)), "add up to 1"),
        (lambda: SurfacePoint(0, (0.5, 0.5)), "three weights"),
        (lambda: SurfacePoint(0, "abc"), "three weights"),
        (lambda: SurfacePoint(0, (float("nan"), 0.5, 0.5)), "three weights"),
        (lambda: BoundaryLoop(-1), "numbered from 0"),
        (lambda: BoundaryLoop(True), "whole number"),
        (lambda: Curve((A,)), "from 2 to"),
        (lambda: Curve((A, 3)), "through places in faces, not through 3"),
        (lambda: SourceSet(()), "from 1 to"),
        (lambda: SourceSet((1, SourceSet((2,)))), "no sets among its members"),
        (lambda: SourceSet((1, -2)), "start at 0, so -2"),
        (lambda: SourceSet((1, 2.5)), "A source is a vertex id"),
        (lambda: checked_source(None), "A source is a vertex id"),
        (lambda: checked_source(True), "A source is a vertex id"),
    ],
)
def test_values_that_cannot_be(make, said):
    with pytest.raises(ParameterError, match=said):
        make()


def test_a_set_has_each_member_once():
    assert SourceSet((3, 3, np.int64(3), A, A)).members == (3, A)


def test_curves_are_written_as_json_reads_them():
    assert json.loads(curve_text(Curve((A, B)))) == {"points": [[3, 0.25, 0.5], [9, 0.1, 0.2]]}


@pytest.mark.parametrize("corner", [(1, 0), (0, 1), (0, 0)])
def test_a_place_beside_a_corner_by_rounding_is_the_corner(corner):
    tiny = 2.0**-53
    near = [abs(weight - tiny) for weight in corner]
    assert SurfacePoint.of(3, *near) == SurfacePoint.of(3, *corner)
    assert SurfacePoint.of(3, *near).weights == (*corner, 1 - sum(corner))
    assert SurfacePoint.of(3, 1e-9, 0.5).weights == (1e-9, 0.5, 0.499999999)
