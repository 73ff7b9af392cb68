"""The colour bar: nothing in it merges, is cut or jumps, and what it says is what it was told."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from qtpy import QtCore, QtGui

from app.qt.panels.bar_layout import Reading, lay_out, tick_text
from app.qt.panels.colour_bar import ColourBar

UNIT = "mesh units"
MAXIMA = (0.4597, 1.465, 0.1, 7.0, 1e-12, 3.2e7, 1.2e6, 0.0, 5e-324)
WIDTHS = [*range(60, 520), *range(520, 1201, 17)]
ROUNDING = 1e-6  # pixels, of sums of widths


@pytest.fixture
def look(application):
    from app.qt.look.look import LOOK

    yield LOOK
    LOOK.choose("light")
    LOOK.enlarge(1.0)


@pytest.fixture
def bar(look):
    """A bar of any width, on the screen, from red to blue over 0 to 0.4597."""
    made = []

    def make(width=472, high=0.4597, line_colour=(1.0, 1.0, 1.0), **more):
        look.choose("light")
        made.append(ColourBar())
        made[-1].show_range(reading(high, **more), red_to_blue(line_colour), np.empty(0))
        made[-1].resize(width, made[-1].height())
        made[-1].show()
        return made[-1]

    yield make
    for each in made:
        each.close()


def red_to_blue(line_colour=(1.0, 1.0, 1.0)):
    from app.scene.style import Style

    ends = (0.0, (1.0, 0.0, 0.0)), (1.0, (0.0, 0.0, 1.0))
    diverging = (-1.0, (1.0, 0.0, 0.0)), (0.0, (0.0, 0.0, 1.0)), (1.0, (0.0, 0.0, 1.0))
    return Style(stops=ends, diverging=diverging, isoline=line_colour)


def reading(high=0.4597, signed=False, **more):
    told = {"unit": UNIT, "maximum": high, "lines": (), "has_shares": True, **more}
    return Reading(-high if signed else 0.0, high, signed=signed, **told)


def laid_out(told, width, is_compact=False):
    return lay_out(told, width, is_compact)


def texts(words):
    return [word.text for word in words]


def colour_at(bar, x, y):
    return bar.grab().toImage().pixelColor(round(x), round(y)).name()


def states(high):
    for signed in (False, True):
        for value in (None, high, -0.37 * high if signed else 0.37 * high, high / 1000):
            for shares in (False, True):
                yield reading(high, signed, value=value, has_shares=shares)
        yield reading(high, signed, words="not connected to the source")
        yield reading(high, signed, notes=("largest −0.286 at vertex 5686",))
        yield reading(high, signed, notes=("largest −0.286 at vertex 5686",), value=high, unit="1 / mesh units")


@pytest.mark.parametrize("scale", [1.0, 1.35])
@pytest.mark.parametrize("high", MAXIMA)
def test_words_keep_clear_of_each_other_and_of_the_ends_at_any_width(look, scale, high):
    look.enlarge(scale)
    every = list(states(high))
    # Every sixth width, others with each maximum.
    for k, width in enumerate(WIDTHS[MAXIMA.index(high) % 6 :: 6]):
        is_compact = bool(k % 2)
        # All states at some widths, and at each width every fifth, in turn: all of them take a minute.
        for told in every if k % 40 == 0 else every[k % 5 :: 5]:
            check_clear(laid_out(told, width, is_compact), width, round((50 if is_compact else 60) * scale), scale)


def check_clear(layout, width, height, scale):
    assert layout.bar.x >= 16
    assert layout.bar.right <= width - 16
    for words, gap in ((layout.line, 4), (layout.ticks, 8)):
        for word in words:
            assert word.box.width >= word.width - ROUNDING, word
            assert word.box.x >= layout.bar.x - ROUNDING, (width, word)
            assert word.box.right <= layout.bar.right + ROUNDING, (width, word)
            assert word.box.y >= 0
            assert word.box.bottom <= height
        for a, b in pairwise(words):
            assert b.box.x - a.box.right >= gap * scale - ROUNDING, (width, a, b)
    assert all(word.box.bottom <= layout.bar.y for word in layout.line)
    assert all(word.box.y >= layout.bar.bottom for word in layout.ticks)


@pytest.mark.parametrize("high", MAXIMA[:-1])
def test_ticks_stand_at_their_values_and_at_least_72_pixels_apart(look, high):
    for signed in (False, True):
        for width in WIDTHS[MAXIMA.index(high) % 3 :: 3]:
            layout = laid_out(reading(high, signed), width)
            span, places = layout.bar.width, []
            for word in layout.ticks:
                value = float(word.text.replace("−", "-").replace(",", ""))
                share = (value / high + 1) / 2 if signed and high else value / high if high else 0.5 * signed
                places.append(layout.bar.x + share * span)
                at_end = word.box.x <= layout.bar.x or word.box.right >= layout.bar.right
                assert at_end or abs(word.box.middle[0] - places[-1]) < 1e-3 * span
            assert all(b - a >= 72 - 1e-3 * span for a, b in pairwise(places))
            assert "0" in texts(layout.ticks)


def test_a_tick_wider_than_the_bar_is_left_out(look):
    told = Reading(1.1e6, 1.9e6, (), UNIT, False, 1.9e6)
    assert texts(laid_out(told, 60).ticks) == []
    assert texts(laid_out(told, 472).ticks) == ["1,200,000", "1,400,000", "1,600,000", "1,800,000"]


def test_the_bar_is_the_panel_without_its_margins_and_at_most_440_wide(look):
    assert [laid_out(None, width).bar.width for width in (60, 300, 472, 1200)] == [28, 268, 440, 440]
    assert laid_out(None, 1200).bar.middle[0] == 600


def test_words_leave_before_numbers_do(look):
    told = reading(value=0.3567)
    assert texts(laid_out(told, 472).line) == ["0.3567", UNIT, "77.6 %", "of 0.4597"]
    assert texts(laid_out(told, 231).line) == ["0.3567", "77.6 %"]
    shown = [tuple(texts(laid_out(told, width).line)) for width in range(472, 59, -1)]
    left = list(dict.fromkeys(shown))
    assert all(set(after) < set(before) for before, after in pairwise(left))
    assert left[-1] == ()
    assert texts(laid_out(reading(), 472).line) == [UNIT, "max 0.4597"]
    assert texts(laid_out(reading(), 231).line) == ["max 0.4597"]


def test_what_is_left_out_or_cut_is_in_the_tooltip(bar):
    wide, narrow = bar(472), bar(182)
    for each in (wide, narrow):
        each.show_value(0.3567)
    assert wide.toolTip() == ""
    assert narrow.toolTip() == f"0.3567 {UNIT}, 77.6 % of 0.4597"
    narrow.show_words("not connected to the source")
    assert narrow._layout.line[0].text.endswith("…")
    assert narrow.toolTip().startswith("not connected to the source")


@pytest.mark.parametrize("width", [60, 182, 300, 472])
@pytest.mark.parametrize("signed", [False, True])
def test_only_the_tick_moves_between_values_of_equally_many_digits(look, width, signed):
    seen = set()
    for value in (0.1111, 0.3567, 0.2000, 0.4444, 0.1234):
        line = laid_out(reading(signed=signed, value=value), width).line
        seen.add(tuple((word.box.x, word.box.width) for word in line))
    assert len(seen) == 1


def test_no_word_comes_or_goes_over_the_last_nine_tenths_of_the_range(look):
    for width in WIDTHS[::3]:
        if width > 200:  # below, the value's own width may decide
            values = np.linspace(0.1, 1, 7) * 1.123
            counts = {len(laid_out(reading(1.123, value=float(value)), width).line) for value in values}
            assert len(counts) == 1, width


def test_the_tick_is_where_the_value_is_and_stays_on_the_bar(look):
    for value, x in ((0, 16), (0.4597, 456), (0.4597 / 4, 126), (-1, 16), (9, 456)):
        assert laid_out(reading(value=value), 472).pointer == pytest.approx(x)
    assert laid_out(reading(signed=True, value=0), 472).pointer == pytest.approx(236)
    assert laid_out(reading(), 472).pointer is None


def test_a_value_beyond_the_range_is_written_as_it_is(look):
    assert texts(laid_out(reading(value=0.9194), 472).line)[::2] == ["0.9194", "200.0 %"]


def test_isolines_are_left_out_where_they_would_run_together(look):
    told = reading(1.0, lines=tuple(np.arange(1, 20) / 20))
    assert len(laid_out(told, 132).isolines) == 19  # 5 pixels apart
    assert laid_out(told, 131).isolines == ()
    assert laid_out(told, 432).isolines == pytest.approx(16 + 20 * np.arange(1, 20))


def test_a_share_is_of_the_fields_own_maximum_and_only_if_wanted(look):
    told = reading(0.9, maximum=0.5, value=0.4)
    assert texts(laid_out(told, 472).line)[2:] == ["80.0 %", "of 0.5000"]
    assert texts(laid_out(replace(told, has_shares=False), 472).line) == ["0.4000", UNIT, "max 0.5000"]


def test_signed_values_have_a_sign_and_the_zero_a_tick_and_a_line(look):
    layout = laid_out(reading(0.286, signed=True, value=0.023), 472)
    assert texts(layout.line)[0] == "+0.02300"
    assert texts(layout.ticks) == ["−0.2", "−0.1", "0", "+0.1", "+0.2"]
    assert layout.zero == layout.bar.middle[0]
    assert texts(laid_out(reading(0.286, signed=True), 100).ticks) == ["0"]
    assert laid_out(reading(), 472).zero is None


def test_a_note_stands_in_for_the_maximum_until_something_is_pointed_at(bar):
    assert texts(bar(high=0.286, signed=True)._layout.line)[-1] == "max ±0.2860"
    signed = bar(high=0.286, signed=True, notes=("largest −0.286 at vertex 5686",))
    assert texts(signed._layout.line)[-1] == "largest −0.286 at vertex 5686"
    signed.show_value(0.1)
    assert texts(signed._layout.line)[-1] == "of 0.2860"
    signed.show_value(None)
    signed.resize(190, signed.height())
    cut = texts(signed._layout.line)[-1]
    assert cut.startswith("largest")
    assert cut.endswith("…")


@pytest.mark.parametrize("undefined", [np.nan, np.inf])
def test_where_there_is_no_value_words_say_so_and_no_tick_is_shown(bar, undefined):
    shown = bar()
    shown.show_value(undefined)
    assert texts(shown._layout.line) == ["not connected to the source", "max 0.4597"]
    assert shown._layout.pointer is None
    shown.show_value(0.1)
    assert texts(shown._layout.line)[0] == "0.1000"
    shown.show_words("undefined here")
    assert texts(shown._layout.line)[0] == "undefined here"
    assert shown._layout.pointer is None


def test_a_new_range_forgets_what_was_said_of_the_former_field(bar):
    shown = bar(notes=("largest at vertex 3",))
    shown.show_value(0.1)
    shown.show_range(reading(2.0), red_to_blue(), np.empty(0))
    assert texts(shown._layout.line) == [UNIT, "max 2.000"]


@pytest.mark.parametrize(
    ("top", "values", "expected"),
    [
        (0.4597, [0.1, 0.1 * 3], ["0.1", "0.3"]),
        (1.2e6, [5e5, 1e6], ["500,000", "1,000,000"]),
        (1.2e7, [2.5e6, 1e7], ["2.5e6", "1e7"]),
        (1e-12, [2e-13, 1e-12], ["2e−13", "1e−12"]),
        (2e-4, [5e-5], ["0.00005"]),
    ],
)
def test_ticks_of_one_bar_are_written_alike(application, top, values, expected):
    assert [tick_text(value, top) for value in values] == expected


def test_the_colours_run_from_low_to_high_with_lines_of_their_colour(bar):
    shown = bar(high=1.0, lines=(0.25,), line_colour=(0, 1, 0))
    y = shown._layout.bar.middle[1]
    left, middle, right = (QtGui.QColor(colour_at(shown, x, y)) for x in (18, 236, 453))
    assert left.red() > 245 > 10 > left.blue()
    assert right.blue() > 245 > 10 > right.red()
    assert abs(middle.red() - middle.blue()) < 10
    assert "#00ff00" in [colour_at(shown, x, y) for x in (125, 126)]


def test_a_field_that_is_0_everywhere_has_the_colour_of_0(bar):
    for signed, x, expected in ((False, 300, "#ff0000"), (True, 300, "#0000ff")):
        shown = bar(high=0.0, signed=signed)
        shown.show_value(0.0)
        assert colour_at(shown, x, shown._layout.bar.middle[1]) == expected
        assert texts(shown._layout.line) == ["0", UNIT, "max 0"]
        assert texts(shown._layout.ticks) == ["0"]


def test_the_value_has_a_tick_in_the_colour_of_text_beyond_the_bar(bar, look):
    shown = bar()
    shown.show_value(0.4597 / 2)
    above = shown._layout.bar.y - 2
    assert colour_at(shown, 236, above) == look.theme.text.lower()
    shown.show_value(None)
    assert colour_at(shown, 236, above) == look.theme.canvas.lower()


def test_without_a_field_it_is_empty_and_grey_until_there_is_one(bar, look):
    shown = bar()
    shown.clear()
    shown.show_value(0.1)
    assert shown._layout.line == shown._layout.ticks == ()
    assert colour_at(shown, 236, shown._layout.bar.middle[1]) == look.theme.hover.lower()
    assert shown.accessibleDescription() == "no values"
    shown.show_range(reading(1.0), red_to_blue(), np.empty(0))
    assert shown.accessibleDescription() == f"0 to 1.000: {UNIT}, max 1.000"


def test_it_follows_the_theme_and_the_size_of_letters(bar, look):
    shown = bar()
    assert shown.height() == 60
    look.choose("dark")
    assert colour_at(shown, 2, 2) == look.theme.canvas.lower() != "#ffffff"
    look.enlarge(1.35)
    assert shown.height() == 81
    shown.set_compact(True)
    assert shown.height() == round(50 * 1.35)
    look.enlarge(1.0)
    assert shown.height() == 50


def test_a_bar_that_is_gone_hears_no_more_of_the_look(look, application):
    gone = ColourBar()
    gone.deleteLater()
    application.sendPostedEvents(gone, QtCore.QEvent.Type.DeferredDelete)
    with pytest.raises(RuntimeError, match="deleted"):
        gone.height()
    look.enlarge(1.35)  # an exception in a slot would end the process


def test_colours_like_the_ground_have_an_outline(bar, look):
    shown = bar()
    from app.scene.style import LINES  # whose surfaces are white

    edge = QtCore.QPointF(200, shown._layout.bar.y)
    assert colour_at(shown, edge.x(), edge.y()) != look.theme.strong.lower()
    shown.show_range(reading(1.0), LINES, np.empty(0))
    assert colour_at(shown, edge.x(), edge.y()) == look.theme.strong.lower()


def test_what_a_value_is_of_stays_longer_than_where_the_bar_ends(bar):
    shown = bar(472)
    shown.show_rest(0.0083, "misfit of the best")
    assert texts(shown._layout.line) == ["0.008300", "misfit of the best", "1.8 %", "of 0.4597"]
    shown.resize(300, shown.height())
    assert texts(shown._layout.line) == ["0.008300", "misfit of the best", "1.8 %"]
