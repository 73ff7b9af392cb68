"""The layout of a colour bar: words above it, round values under it, isolines on it."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise

from ...drawing.numbers import MINUS, number, percent, share, ticks
from ...drawing.painters.qt import rgba_of, text_width
from ...drawing.shapes import Box, Text
from ..look.look import LOOK

WIDEST, NARROW, MARGIN = 440, 200, 16
"""Logical pixels of the widest bar, of one that leaves its longer words to the tooltip, and beside any."""

TICK_ROOM, TICK_GAP = 72, 8
"""Least logical pixels from one tick to the next, and between their words."""

LINE_ROOM, LINE_MARGIN = 5, 2
"""Least logical pixels from one isoline to the next, and to an end of the bar."""

GAP, SPACE, LEAST = 12, 4, 72
"""Logical pixels between what stands left and right, between two words, and of a text that is cut, at least."""

SLACK = 1e-6
"""Pixels by which sums of lengths may be off."""

TINY = 1e-300
"""Smaller ranges have no round values that could be told apart."""

NOWHERE = Box(0.0, 0.0, 0.0, 0.0)

UNDEFINED = "not connected to the source"


@dataclass(frozen=True)
class Reading:
    """The content of a colour bar.

    Attributes
    ----------
    low, high
        Values at its ends.
    lines, bold, through
        Values of isolines, of the bold ones, and of those through points.
    maximum
        The field's own maximum.
    has_shares
        Whether the value is also shown as a fraction of the maximum.
    value
        Value at the pointer, None for none.
    words
        Words in place of the value.
    notes
        Words in place of the maximum, from the longest to the shortest, of which the first with room is shown.  Beside
        a
        value the first is left out, if there are others.
    in_shares
        Whether ticks are fractions of `high`.
    """

    low: float
    high: float
    lines: tuple[float, ...]
    unit: str
    signed: bool
    maximum: float
    has_shares: bool = False
    value: float | None = None
    words: str = ""
    notes: tuple[str, ...] = ()
    in_shares: bool = False
    bold: frozenset[float] = frozenset()
    through: frozenset[float] = frozenset()

    def place(self, value: float) -> float:
        """Return the position of a value on the bar, 0 to 1."""
        if self.high > self.low:
            return min(max((value - self.low) / (self.high - self.low), 0.0), 1.0)
        return 0.5 if self.signed else 0.0

    @property
    def remarks(self) -> tuple[str, ...]:
        """The words at the right where no fraction is shown, from the longest to the shortest."""
        notes = self.notes if self.value is None else self.notes[1:] or self.notes
        return notes or (f"max {'±' if self.signed and self.maximum else ''}{number(self.maximum)}",)

    @property
    def share(self) -> str:
        """The value as a fraction of the maximum; empty if there is none."""
        if not self.has_shares or self.value is None or not self.maximum > 0:
            return ""
        return share(self.value / self.maximum, self.signed)

    @property
    def sentence(self) -> str:
        """All that the bar says, for the tooltip."""
        if self.words:
            return f"{self.words}, {self.remarks[0]}"
        value = "" if self.value is None else self.written(self.value)
        right = f"{self.share} of {number(self.maximum)}" if self.share else self.remarks[0]
        return ", ".join(part for part in (f"{value} {self.value_unit}".strip(), right) if part)

    def written(self, value: float) -> str:
        """Return a value as it stands above the bar."""
        return number(value, self.signed) + percent(self.unit)

    @property
    def value_unit(self) -> str:
        """The unit after a value; empty where that is in percent."""
        return "" if self.value is not None and percent(self.unit) else self.unit


@dataclass(frozen=True)
class Word:
    """A text in its box, which needs the width `least`: less than its own if it may be cut, 0 for its own."""

    text: str
    is_quiet: bool = True
    is_bold: bool = False
    size: int = 13
    least: float = 0.0
    box: Box = NOWHERE

    @property
    def width(self) -> float:
        """The width of the word in pixels."""
        return text_width(self.text, self.size * LOOK.scale, self.is_bold)

    @property
    def shape(self) -> Text:
        """The word where it stands, in the window's colours."""
        colour = rgba_of(LOOK.theme.quiet if self.is_quiet else LOOK.theme.text)
        x, y, size = self.box.x, self.box.middle[1], self.size * LOOK.scale
        return Text(self.text, x, y, size, colour, self.is_bold, level="line", are_digits_even=True)

    def at(self, x: float, row: Box) -> "Word":
        """Return the word with its left end at x in a row."""
        return replace(self, box=Box(x, row.y, self.width, row.height))

    def within(self, room: float) -> "Word":
        """Return the word, with an ellipsis if it has to be cut."""
        kept, word = self.text, self
        while kept and word.width > room + SLACK:
            kept = kept[:-1].rstrip()
            word = replace(self, text=f"{kept}…")
        return word


@dataclass(frozen=True)
class BarLayout:
    """The places of a colour bar's parts, in pixels of the widget.

    Attributes
    ----------
    bar
        Box of the colours.
    line, ticks
        Words above and under it.
    isolines, bold, through
        (m,) the x of isolines, of the bold ones among them, and of those through points.
    zero
        The x of the line at 0 of a signed field.
    pointer
        The x of the value's mark.
    is_whole
        Whether nothing had to be left out or cut.
    """

    bar: Box
    line: tuple[Word, ...] = ()
    ticks: tuple[Word, ...] = ()
    isolines: tuple[float, ...] = ()
    bold: tuple[float, ...] = ()
    through: tuple[float, ...] = ()
    zero: float | None = None
    pointer: float | None = None
    is_whole: bool = True


def lay_out(reading: Reading | None, width: int, is_compact: bool = False) -> BarLayout:
    """Place a reading in a widget of this width, at the present font size."""
    scale = LOOK.scale
    across = max(min(width - 2 * MARGIN, round(WIDEST * scale)), 1)
    left = (width - across) // 2
    first, middle, under, thick = (0, 21, 32, 8) if is_compact else (3, 25, 40, 10)
    bar = Box(left, round(middle * scale), across, round(thick * scale))
    if reading is None:
        return BarLayout(bar)
    line, is_whole = _first_line(reading, Box(left, first * scale, across, 18 * scale))
    under_it = _tick_line(reading, Box(left, under * scale, across, 16 * scale))
    zero = left + across * reading.place(0.0) if reading.signed else None
    pointer = None if reading.value is None else left + across * reading.place(reading.value)
    isolines, bold, through = _isolines(reading, bar)
    return BarLayout(bar, line, under_it, isolines, bold, through, zero, pointer, is_whole)


# ---------------------------------------------------------------------- the first line
def _first_line(reading: Reading, row: Box) -> tuple[tuple[Word, ...], bool]:
    """Return as many words as have room, and whether these are all."""
    is_narrow = row.width < NARROW * LOOK.scale
    choices = _choices(reading)
    for left, right, is_wordy in choices:
        free = row.width - _between(left, right)
        if not (is_narrow and is_wordy) and sum(word.least or word.width for word in (*left, *right)) <= free:
            line = _placed(left, right, row)
            all_of_it = [word.text for words in choices[0][:2] for word in words]
            return line, [word.text for word in line] == all_of_it
    return (), False


def _choices(reading: Reading) -> list[tuple[list[Word], list[Word], bool]]:
    """Return the choices of words left and right, from most to least, and whether each is too much for a narrow bar.

    Words leave before numbers do, and nothing is cut as long as something else can leave.
    """
    cut = LEAST * LOOK.scale
    unit = [Word(reading.value_unit)] if reading.value_unit else []
    remark, *shorter = [[Word(words)] for words in reading.remarks]
    cut_remark = [replace((shorter or [remark])[-1][0], least=cut)] if reading.notes else []
    if reading.words:
        word = Word(reading.words, is_quiet=False)
        return [([word], remark, False), ([word], [], False), ([replace(word, least=cut)], [], False)]
    if reading.value is None:
        whole = [(left, right, bool(left)) for right in (remark, *shorter) for left in (unit, [])]
        return [*whole, ([], cut_remark, False)]
    text = reading.written(reading.value)
    alone = [Word(text, False, True)]
    # Room for values down to a tenth of the maximum, so that no word comes and goes while the pointer moves.
    usual = [reading.written(s * reading.maximum) for s in ((-1, -0.1) if reading.signed else (1, 0.1))]
    value = [replace(alone[0], least=max(Word(each, is_bold=True).width for each in (text, *usual)))]
    if not reading.share:
        whole = [(value + unit, remark, bool(unit)), *((value, right, False) for right in (remark, *shorter))]
        return [*whole, (value, cut_remark, False), (alone, [], False)]
    part = Word(reading.share, False)
    least = max(part.width, Word(share(1.0, reading.signed)).width)
    right = [replace(part, least=least), Word(f"of {number(reading.maximum)}")]
    # What the value is of comes before what it is a fraction of, which is the end of the bar.
    return [(value + unit, right, True), (value + unit, right[:1], True), (alone, [part], False), (alone, [], False)]


def _between(left: list[Word], right: list[Word]) -> float:
    """Return the pixels that are kept free between words."""
    spaces = max(len(left) - 1, 0) + max(len(right) - 1, 0)
    return LOOK.scale * (SPACE * spaces + (GAP if left and right else 0))


def _placed(left: list[Word], right: list[Word], row: Box) -> tuple[Word, ...]:
    """Place words from the left end on, and up to the right end; the last may have to be cut."""
    found: list[Word] = []
    x, free = row.x, row.width - _between(left, right)
    for word in left:
        found.append(word.within(free).at(x, row))
        x, free = found[-1].box.right + SPACE * LOOK.scale, free - found[-1].box.width
    cut = [word.within(free) for word in right]
    x = row.right - sum(word.width for word in cut) - _between([], right)
    for word in cut:
        found.append(word.at(x, row))
        x = found[-1].box.right + SPACE * LOOK.scale
    return tuple(found)


# ---------------------------------------------------------------------- under and on the bar
def _tick_line(reading: Reading, row: Box) -> tuple[Word, ...]:
    """Return as many round values as stand clear of each other; 0 if there is room for one only."""
    if reading.in_shares and reading.high > 0:
        # The same places, in percent.
        reading = replace(reading, low=100 * reading.low / reading.high, high=100.0)
    room, gap = TICK_ROOM * LOOK.scale, TICK_GAP * LOOK.scale
    most = max(int(row.width / room), 1) if reading.high - reading.low > TINY else 0
    for count in range(most, 0, -1):
        values = ticks(reading.low, reading.high, count)
        places = [row.width * reading.place(value) for value in values]
        words = _ticks_at(reading, values, row)
        is_clear = all(b.box.x - a.box.right >= gap for a, b in pairwise(words))
        if is_clear and all(b - a >= room for a, b in pairwise(places)):
            return words
    return _ticks_at(reading, [0.0], row) if reading.low <= 0 <= reading.high else ()


def _ticks_at(reading: Reading, values: list[float], row: Box) -> tuple[Word, ...]:
    """Centre each tick under its value, but within the bar; one that is wider is left out."""
    top, found = max(abs(reading.low), abs(reading.high)), []
    for value in values:
        sign = " %" if reading.in_shares and reading.high > 0 else percent(reading.unit)
        word = Word(tick_text(value, top, reading.signed) + sign, size=12)
        x = row.x + row.width * reading.place(value) - word.width / 2
        if word.width <= row.width:
            found.append(word.at(max(min(x, row.right - word.width), row.x), row))
    return tuple(found)


def tick_text(value: float, top: float, signed: bool = False) -> str:
    """Return a tick in as few digits as it has; all of one bar, which ends at `top`, are written in the same way."""
    if not value:
        return "0"
    plus = "+" if signed else ""
    if 1e-4 <= top < 1e7:
        text = f"{float(f'{value:.6g}'):{plus},.10f}".rstrip("0").rstrip(".")
    else:
        mantissa, _, power = f"{value:{plus}.5e}".partition("e")
        text = f"{mantissa.rstrip('0').rstrip('.')}e{int(power)}"
    return text.replace("-", MINUS)


def _isolines(reading: Reading, bar: Box) -> tuple[tuple[float, ...], ...]:
    """Return the x of isolines, of the bold ones among them, and of those through points.

    Where they would be too close there are only those through points.
    """

    def places(values: Iterable[float]) -> list[float]:
        return [bar.x + bar.width * reading.place(v) for v in values if reading.low <= v <= reading.high]

    def inside(places: list[float]) -> tuple[float, ...]:
        return tuple(x for x in places if bar.x + LINE_MARGIN <= x <= bar.right - LINE_MARGIN)

    usual = places(value for value in reading.lines if value not in reading.through)
    if any(b - a < LINE_ROOM - SLACK for a, b in pairwise(usual)):
        usual = []
    bold = places(sorted(reading.bold)) if usual else []
    return inside(usual), inside(bold), inside(places(sorted(reading.through)))
