"""What a colour bar says, and where: the words above it, the round values under it, the isolines on it."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import pairwise

from qtpy import QtCore, QtGui

from ..look.look import LOOK
from ..look.numbers import MINUS, number, number_width, percent, share, ticks

WIDEST, NARROW, MARGIN = 440, 200, 16
"""Of the bar; a narrow one says only what cannot be left out, and the tooltip the rest."""

TICK_ROOM, TICK_GAP = 72, 8
"""From one tick to the next, and between their words, at least."""

LINE_ROOM, LINE_MARGIN = 5, 2
"""From one isoline to the next, and to an end of the bar, at least."""

GAP, SPACE, LEAST = 12, 4, 72
"""Between what stands left and right, between two words, and what is left of a text that is cut, at least."""

SLACK = 1e-6
"""Pixels by which lengths are off for being added up."""

TINY = 1e-300
"""Smaller ranges have no round values that could be told apart."""

UNDEFINED = "not connected to the source"


@dataclass(frozen=True)
class Reading:
    """What a bar has to say: values in `unit`; lines: those of the isolines; maximum: the field's own.

    bold, through: those of the lines that are bolder, and that pass through points.
    value: at the pointer, or None; words: in its place; note: in place of the maximum, short_note where that is too
    long.  in_shares: the ticks are shares
    of high.
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
    note: str = ""
    short_note: str = ""
    in_shares: bool = False
    bold: frozenset[float] = frozenset()
    through: frozenset[float] = frozenset()

    def place(self, value: float) -> float:
        """Of a value on the bar, 0 to 1."""
        if self.high > self.low:
            return min(max((value - self.low) / (self.high - self.low), 0.0), 1.0)
        return 0.5 if self.signed else 0.0

    @property
    def remark(self) -> str:
        """What stands right where there is no share."""
        return self.note or f"max {'±' if self.signed and self.maximum else ''}{number(self.maximum)}"

    @property
    def share(self) -> str:
        """Of the maximum; empty if there is none."""
        if not self.has_shares or self.value is None or not self.maximum > 0:
            return ""
        return share(self.value / self.maximum, self.signed)

    @property
    def sentence(self) -> str:
        """All of it, for the tooltip."""
        if self.words:
            return f"{self.words}, {self.remark}"
        value = "" if self.value is None else self.written(self.value)
        right = f"{self.share} of {number(self.maximum)}" if self.share else self.remark
        return ", ".join(part for part in (f"{value} {self.value_unit}".strip(), right) if part)

    def written(self, value: float) -> str:
        """A value as it stands above the bar."""
        return number(value, self.signed) + percent(self.unit)

    @property
    def value_unit(self) -> str:
        """What stands after a value; nothing where that is in percent."""
        return "" if self.value is not None and percent(self.unit) else self.unit


@dataclass(frozen=True)
class Word:
    """A text.  least: the width it needs: less than its own if it may be cut, 0 for its own; box: where it stands."""

    text: str
    is_quiet: bool = True
    is_bold: bool = False
    size: int = 13
    least: float = 0.0
    box: QtCore.QRectF = field(default_factory=QtCore.QRectF)

    @property
    def font(self) -> QtGui.QFont:
        """The font in which the word is painted."""
        return LOOK.font(self.size, self.is_bold)

    @property
    def width(self) -> float:
        """The width of the word in pixels."""
        return number_width(self.font, self.text)

    def at(self, x: float, row: QtCore.QRectF) -> "Word":
        """The word with its left end at x in a row."""
        return replace(self, box=QtCore.QRectF(x, row.top(), self.width, row.height()))

    def within(self, room: float) -> "Word":
        """With dots at its end if it has to be cut."""
        kept, word = self.text, self
        while kept and word.width > room + SLACK:
            kept = kept[:-1].rstrip()
            word = replace(self, text=f"{kept}…")
        return word


@dataclass(frozen=True)
class Layout:
    """Where everything stands, in pixels of the widget.

    bar: the colours; line: the words above it; ticks: those under it; isolines: (m,) their x; bold: the same of those
    that are bolder; through: of those through points, which are not among them; zero: x of the bold line at 0; pointer:
    x of the value's tick; is_whole: nothing had to be left out or cut.
    """

    bar: QtCore.QRectF
    line: tuple[Word, ...] = ()
    ticks: tuple[Word, ...] = ()
    isolines: tuple[float, ...] = ()
    bold: tuple[float, ...] = ()
    through: tuple[float, ...] = ()
    zero: float | None = None
    pointer: float | None = None
    is_whole: bool = True


def lay_out(reading: Reading | None, width: int, is_compact: bool = False) -> Layout:
    """Where all of a reading stands in a widget of this width, in letters of the present size."""
    scale = LOOK.scale
    across = max(min(width - 2 * MARGIN, round(WIDEST * scale)), 1)
    left = (width - across) // 2
    first, middle, under, thick = (0, 21, 32, 8) if is_compact else (3, 25, 40, 10)
    bar = QtCore.QRectF(left, round(middle * scale), across, round(thick * scale))
    if reading is None:
        return Layout(bar)
    line, is_whole = _first_line(reading, QtCore.QRectF(left, first * scale, across, 18 * scale))
    under_it = _tick_line(reading, QtCore.QRectF(left, under * scale, across, 16 * scale))
    zero = left + across * reading.place(0.0) if reading.signed else None
    pointer = None if reading.value is None else left + across * reading.place(reading.value)
    isolines, bold, through = _isolines(reading, bar)
    return Layout(bar, line, under_it, isolines, bold, through, zero, pointer, is_whole)


# ---------------------------------------------------------------------- the first line
def _first_line(reading: Reading, row: QtCore.QRectF) -> tuple[tuple[Word, ...], bool]:
    """As much as has room, and whether that is all."""
    is_narrow = row.width() < NARROW * LOOK.scale
    choices = _choices(reading)
    for left, right, is_wordy in choices:
        free = row.width() - _between(left, right)
        if not (is_narrow and is_wordy) and sum(word.least or word.width for word in (*left, *right)) <= free:
            line = _placed(left, right, row)
            all_of_it = [word.text for words in choices[0][:2] for word in words]
            return line, [word.text for word in line] == all_of_it
    return (), False


def _choices(reading: Reading) -> list[tuple[list[Word], list[Word], bool]]:
    """What could stand left and right, from all to little, and whether it is too much for a narrow bar.

    Words leave before numbers do, and nothing is cut as long as something else can leave.
    """
    cut = LEAST * LOOK.scale
    unit = [Word(reading.value_unit)] if reading.value_unit else []
    remark = [Word(reading.remark)]
    short_remark = [Word(reading.short_note)] if reading.short_note else remark
    cut_remark = [replace(short_remark[0], least=cut)] if reading.note else []
    if reading.words:
        word = Word(reading.words, is_quiet=False)
        return [([word], remark, False), ([word], [], False), ([replace(word, least=cut)], [], False)]
    if reading.value is None:
        whole = [(unit, remark, bool(unit)), ([], remark, False), (unit, short_remark, bool(unit))]
        return [*whole, ([], short_remark, False), ([], cut_remark, False)]
    text = reading.written(reading.value)
    alone = [Word(text, False, True)]
    # Room for values down to a tenth of the maximum, so that no word comes and goes while the pointer moves.
    usual = [reading.written(s * reading.maximum) for s in ((-1, -0.1) if reading.signed else (1, 0.1))]
    value = [replace(alone[0], least=max(Word(each, is_bold=True).width for each in (text, *usual)))]
    if not reading.share:
        whole = [(value + unit, remark, bool(unit)), (value, remark, False), (value, short_remark, False)]
        return [*whole, (value, cut_remark, False), (alone, [], False)]
    part = Word(reading.share, False)
    least = max(part.width, Word(share(1.0, reading.signed)).width)
    right = [replace(part, least=least), Word(f"of {number(reading.maximum)}")]
    return [(value + unit, right, True), (value, right, True), (alone, [part], False), (alone, [], False)]


def _between(left: list[Word], right: list[Word]) -> float:
    """What is kept free between words."""
    spaces = max(len(left) - 1, 0) + max(len(right) - 1, 0)
    return LOOK.scale * (SPACE * spaces + (GAP if left and right else 0))


def _placed(left: list[Word], right: list[Word], row: QtCore.QRectF) -> tuple[Word, ...]:
    """Words from the left end on, and up to the right end; the last may have to be cut."""
    found: list[Word] = []
    x, free = row.left(), row.width() - _between(left, right)
    for word in left:
        found.append(word.within(free).at(x, row))
        x, free = found[-1].box.right() + SPACE * LOOK.scale, free - found[-1].box.width()
    cut = [word.within(free) for word in right]
    x = row.right() - sum(word.width for word in cut) - _between([], right)
    for word in cut:
        found.append(word.at(x, row))
        x = found[-1].box.right() + SPACE * LOOK.scale
    return tuple(found)


# ---------------------------------------------------------------------- under and on the bar
def _tick_line(reading: Reading, row: QtCore.QRectF) -> tuple[Word, ...]:
    """Round values, as many as stand clear of each other; 0 if there is room for one only."""
    if reading.in_shares and reading.high > 0:
        # The same places, in percent.
        reading = replace(reading, low=100 * reading.low / reading.high, high=100.0)
    room, gap = TICK_ROOM * LOOK.scale, TICK_GAP * LOOK.scale
    most = max(int(row.width() / room), 1) if reading.high - reading.low > TINY else 0
    for count in range(most, 0, -1):
        values = ticks(reading.low, reading.high, count)
        places = [row.width() * reading.place(value) for value in values]
        words = _ticks_at(reading, values, row)
        is_clear = all(b.box.left() - a.box.right() >= gap for a, b in pairwise(words))
        if is_clear and all(b - a >= room for a, b in pairwise(places)):
            return words
    return _ticks_at(reading, [0.0], row) if reading.low <= 0 <= reading.high else ()


def _ticks_at(reading: Reading, values: list[float], row: QtCore.QRectF) -> tuple[Word, ...]:
    """Each centred under its value, but within the bar, or left out."""
    top, found = max(abs(reading.low), abs(reading.high)), []
    for value in values:
        sign = " %" if reading.in_shares and reading.high > 0 else percent(reading.unit)
        word = Word(tick_text(value, top, reading.signed) + sign, size=12)
        x = row.left() + row.width() * reading.place(value) - word.width / 2
        if word.width <= row.width():
            found.append(word.at(max(min(x, row.right() - word.width), row.left()), row))
    return tuple(found)


def tick_text(value: float, top: float, signed: bool = False) -> str:
    """As short as it goes; ticks of one bar, which ends at `top`, are all written in the same way."""
    if not value:
        return "0"
    plus = "+" if signed else ""
    if 1e-4 <= top < 1e7:
        text = f"{float(f'{value:.6g}'):{plus},.10f}".rstrip("0").rstrip(".")
    else:
        mantissa, _, power = f"{value:{plus}.5e}".partition("e")
        text = f"{mantissa.rstrip('0').rstrip('.')}e{int(power)}"
    return text.replace("-", MINUS)


def _isolines(reading: Reading, bar: QtCore.QRectF) -> tuple[tuple[float, ...], ...]:
    """The x of isolines, of the bold ones among them, and of those through points.

    Where they would be too close there are only those through points.
    """

    def places(values: Iterable[float]) -> list[float]:
        return [bar.left() + bar.width() * reading.place(v) for v in values if reading.low <= v <= reading.high]

    def inside(places: list[float]) -> tuple[float, ...]:
        return tuple(x for x in places if bar.left() + LINE_MARGIN <= x <= bar.right() - LINE_MARGIN)

    usual = places(value for value in reading.lines if value not in reading.through)
    if any(b - a < LINE_ROOM - SLACK for a, b in pairwise(usual)):
        usual = []
    bold = places(sorted(reading.bold)) if usual else []
    return inside(usual), inside(bold), inside(places(sorted(reading.through)))
