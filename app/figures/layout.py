"""The layout of a figure's page, in units of 1/96 inch from its top left corner, y down."""

from __future__ import annotations

from ..drawing.shapes import Box
from ..scene.corners import SIDE
from ..scene.style import PAPER
from . import bars
from .description import Figure
from .framing import Seen, height_for, seen, shown_surfaces
from .grid import VIEW_HEIGHT, Grid, grid_of, most_views, view_width
from .inset_places import insets_of
from .legend import with_legend
from .overhang import overhang
from .page_layout import PageLayout, PanelLayout
from .size import check_pixels
from .words import LINE, Lettering, TextLines

HEADING, HINT, LABEL = 17.0, 13.0, 12.0
"""The usual sizes of words, in units."""

NARROW, WIDE = 420.0, 600.0
"""Panels narrower than the one have smaller words; on paper those wider than the other have larger ones."""

SMALLEST_WORDS = 0.67
"""Smallest factor of words in narrow panels, before they have to fit."""

CLOSE, APART = 100.0, 200.0
"""In panels as narrow as the one headings are no larger than labels, lest they be larger than the shapes; from the
other on they have their usual size."""

STROKE = 400.0
"""Views narrower than this many units have thinner lines."""

THINNEST = 0.35
"""Smallest factor of lines in narrow views: what is white must still be seen in print."""

MARK, LEAST_MARK = 0.026, 4.0
"""Width of a mark as a fraction of the shorter side of a view, and in units at least."""

LEAST_VIEWS = 0.45
"""The share of a panel's height that its views have, if need be at the words' cost."""

MARGIN = 4.0
"""Units left at the edges of a page that is cropped."""

TALLEST = 1.4
"""Widths of a page that a cropped one is high at most."""

BETWEEN_VIEWS = 0.06
"""Heights of a view that are left between the cropped views of a panel."""

CHART, LARGEST_CHART = 20.0, 0.5
"""Least width of a chart in sizes of labels, as long as it is no more than this fraction of the page."""

WIDEST = 1.6
"""Heights of a view that a cropped one is wide at most; flatter shapes have lower ones."""


def lay_out(figure: Figure, least_scale: float = 0.0, share: float = 1.0) -> PageLayout:
    """Lay out a figure, at its own resolution or at least at `least_scale`, times `share`."""
    layout = _laid_out(figure, least_scale, share)
    above, beside = overhang(figure, layout)
    if above or (beside > MARGIN and figure.crop):
        # Markers of pins have room at the edges, too.
        layout = _laid_out(figure, least_scale, share, above, beside)
    if figure.legend:
        layout = with_legend(figure, layout)
    return layout


def _laid_out(figure: Figure, least_scale: float, share: float, above: float = 0.0, beside: float = 0.0) -> PageLayout:
    """Lay out a figure with so much free above views, and at the edges of a cropped page."""
    grid = grid_of(figure)
    room = grid.column
    factor = _factor(figure, grid, room)
    lettering = Lettering(figure.font, figure.text is not None, grid.is_printed)
    views = [_shapes(figure, k) for k in range(len(figure.panels))]
    rooms = [room] * grid.columns
    takes_room = figure.has_one_bar or figure.charts or figure.row_heads
    for _ in range(3 if figure.crop else 2 if takes_room else 1):
        for level in range(6):
            texts = _Texts(figure, lettering, factor, rooms, level, above)
            strip = _Strip(figure, grid, texts)
            sizes = _Sizes(figure, grid, texts, strip, views, max(MARGIN, beside))
            if grid.height is None or sizes.high >= LEAST_VIEWS * (sizes.high + sizes.words[0]):
                break
        rooms = sizes.columns
    return _placed(figure, grid, texts, strip, sizes, max(grid.scale, least_scale) * share)


def _factor(figure: Figure, grid: Grid, room: float) -> float:
    """Return the factor of words' sizes in panels of this width, the same in all."""
    if figure.text is not None:
        return figure.text / 0.75 / LABEL
    if grid.height is not None:
        room = min(room, 1.1 * grid.height / grid.rows)
    if grid.is_printed and room > WIDE:
        return room / WIDE
    return max(min(room / NARROW, 1.0), SMALLEST_WORDS)


def _heading_size(figure: Figure, factor: float, room: float) -> float:
    """Return the size of headings in panels of this width."""
    share = 1.0 if figure.text is not None else min(max((room - CLOSE) / (APART - CLOSE), 0.0), 1.0)
    return (LABEL + share * (HEADING - LABEL)) * factor


# ---------------------------------------------------------------------- what has to find room
def _shapes(figure: Figure, panel: int) -> list[tuple[float, float, Seen | None]]:
    """Return each view's width and height, 1 for the usual height, and what it shows if that is cropped."""
    each = figure.panels[panel]
    if not figure.crop:
        return [(view_width(figure) / VIEW_HEIGHT, 1.0, None)] * len(each.views)
    shown = shown_surfaces(each, figure.upper_limits()[panel])
    parts = [seen(view, each, surface) for view, surface in zip(each.views, shown, strict=True)]
    # Marks at the edges of two views meet between them; pages without a legend stay as they were.
    more = BETWEEN_VIEWS if figure.legend and len(parts) > 1 else 0.0
    found: list[tuple[float, float, Seen | None]] = [
        (min(p.aspect, WIDEST) + more, min(WIDEST / p.aspect, 1.0), p) for p in parts
    ]
    if any(zoom.corner == "auto" for zoom in each.insets):
        wide, high, part = found[0]
        found[0] = (wide + SIDE * min(wide, high), high, part)  # an inset may need room beside the shape
    return found


def _tallest(figure: Figure, room: float) -> float:
    """Return the height beyond which views in panels of this width would be empty.

    Insets may need that, and what moves is to stay where it is.
    """
    if figure.is_moving or any(panel.insets for panel in figure.panels):
        return float("inf")
    tops = figure.upper_limits()
    return max(
        height_for(room / len(panel.views), view, panel, surface)
        for panel, top in zip(figure.panels, tops, strict=True)
        for view, surface in zip(panel.views, shown_surfaces(panel, top), strict=True)
    )


class _Texts:
    """The words of all panels, and the room that they take at the top and bottom of each.

    Parameters
    ----------
    rooms
        Widths of the columns.
    level
        The higher, the fewer words there are.
    above
        Room that is left free under the headings for marks that stand above views.
    """

    def __init__(
        self, figure: Figure, lettering: Lettering, factor: float, rooms: list[float], level: int, above: float
    ) -> None:
        count, columns = len(figure.panels), len(rooms)
        self.factor, self.lettering = factor, lettering
        # A chart at the end of a row has a letter, too.
        each = columns + bool(figure.charts)
        letters = range(-(-count // columns) * each)
        self.letters = [f"({letter_of(k)})" if figure.letters else "" for k in letters]
        self.letter_at = [k // columns * each + k % columns for k in range(count)]
        # As wide on the right, so that headings stay in the middle.
        aside = max(lettering.width(each, _heading_size(figure, factor, min(rooms)), True) for each in self.letters)
        room = min(rooms) - 8
        most = 2 if level < 2 else 1
        has_heads = figure.title == "heading" and level < 5
        heads = [p.heading if has_heads else "" for p in figure.panels]
        if figure.row_heads and has_heads:
            heads = [*figure.column_heads, *[""] * (count - columns)]
        self.heading, self.headings = lettering.fitted(
            heads, _heading_size(figure, factor, min(rooms)), room - 2 * aside, most, True
        )
        self.hint = 0.0
        self.hints: list[tuple[str, ...]] = [()] * count
        if level < 1:
            self.hint, self.hints = self._hints([p.hint for p in figure.panels], room)
        feet = [bars.bar_words(figure, k) if level < 3 else "" for k in range(count)]
        more = figure.title == "caption" or lettering.is_printed
        self.label, self.feet = lettering.fitted(feet, LABEL * factor, room, most + more)
        over = self.headings, self.headings[columns:]
        lines = [max([int(figure.letters), *(len(head) for head in some)]) for some in over]
        # Headings of columns stand over the first row only.
        self.head_lines = lines if figure.row_heads else lines[:1] * 2
        gap = 7 * factor if level < 2 else 2.0
        self.heads = []
        for count in self.head_lines:
            head = gap + count * LINE * self.heading + max(map(len, self.hints)) * LINE * self.hint
            self.heads.append(head + max(5 * factor if head > gap else 0.0, above))
        self.row_heads = figure.row_heads if has_heads else ()
        self.side = 4 * factor + LINE * self.heading if self.row_heads else 0.0
        has_bars = not figure.has_one_bar and level < 4
        self.bars = [has_bars and p.field is not None and p.upper_limit > 0 for p in figure.panels]
        foot_lines = max(map(len, self.feet))
        is_needed = any(self.bars) or foot_lines
        self.foot = bars.flat_foot(factor, self.label, foot_lines, any(self.bars)) if is_needed else 6 * factor

    def _hints(self, texts: list[str], room: float) -> tuple[float, list[tuple[str, ...]]]:
        """Return hints in one line or two; none at all if they do not fit."""
        size, found = self.lettering.fitted(texts, HINT * self.factor, room, 2)
        is_whole = all(
            "".join(lines).replace(" ", "") == text.replace(" ", "") for lines, text in zip(found, texts, strict=True)
        )
        return (size, found) if is_whole else (0.0, [()] * len(texts))


class _Strip:
    """The room for a colour bar of all panels: at the right or under them, where it takes the lesser share."""

    def __init__(self, figure: Figure, grid: Grid, texts: _Texts) -> None:
        self.panel = next((k for k, p in enumerate(figure.panels) if p.field is not None), 0)
        self.width = self.height = 0.0
        self.label = texts.label
        self.lines: tuple[str, ...] = ()
        tops = figure.upper_limits()
        self.is_there = figure.has_one_bar and tops[self.panel] > 0
        if not self.is_there:
            return
        words = [bars.shared_words(figure, self.panel)]
        self.label, (self.lines,) = texts.lettering.fitted(words, LABEL * texts.factor, grid.width - 8, 2)
        under = bars.flat_foot(texts.factor, self.label, len(self.lines))
        right = bars.upright_width(figure, self.panel, texts.factor, self.label, texts.lettering)
        cell = grid.column
        each = texts.heads[0] + texts.foot + cell / most_views(figure) * VIEW_HEIGHT / view_width(figure)
        high = grid.height or grid.rows * each
        # In one column of a journal the shapes need the width.
        if grid.width >= NARROW and right / grid.width < under / high:
            self.width = right
        else:
            self.height = under


class _Sizes:
    """The widths of columns, and the heights of rows and of the page.

    Attributes
    ----------
    high
        Usual height of views, of which each has its share.
    space
        Room above each row and under the last, where the page is higher than its shapes.
    """

    def __init__(
        self,
        figure: Figure,
        grid: Grid,
        texts: _Texts,
        strip: _Strip,
        shapes: list[list[tuple[float, float, Seen | None]]],
        margin: float,
    ) -> None:
        self.shapes, self.grid = shapes, grid
        self.words = [texts.heads[row > 0] + texts.foot for row in range(grid.rows)]
        least = min(CHART * texts.label, LARGEST_CHART * grid.width)
        self.chart = max(grid.column * grid.chart, least) if grid.chart else 0.0
        self.beside = strip.width + texts.side + self.chart  # of the columns
        self.pad, self._margin = 0.0, margin
        if not figure.crop:
            self.columns = [(grid.width - self.beside) / grid.columns] * grid.columns
            wide = self.columns[0] / most_views(figure) / view_width(figure)
            free = VIEW_HEIGHT * wide
            self.high = free if grid.height is None else (grid.height - strip.height - sum(self.words)) / grid.rows
            is_low = grid.height or figure.panels[0].parts  # hemispheres are
            self.high = max(min(self.high, _tallest(figure, self.columns[0])) if is_low else self.high, 4.0)
            self.rows = [self.high] * grid.rows
            self.width = grid.width
        else:
            self._crop(figure, texts, strip)
        self.height = (
            grid.height
            if grid.height is not None and not figure.crop
            else sum(self.rows) + sum(self.words) + strip.height + 2 * self.pad
        )
        free = self.height - sum(self.rows) - sum(self.words) - strip.height - 2 * self.pad
        self.space = max(free, 0.0) / (grid.rows + 1)

    def _crop(self, figure: Figure, texts: _Texts, strip: _Strip) -> None:
        grid, self.pad = self.grid, self._margin
        wide = [0.0] * grid.columns
        tall = [0.0] * grid.rows
        views = [1] * grid.columns
        for k, shapes in enumerate(self.shapes):
            row, column = divmod(k, grid.columns)
            wide[column] = max(wide[column], sum(w for w, _, _ in shapes))
            tall[row] = max(tall[row], *(h for _, h, _ in shapes))
            views[column] = max(views[column], len(shapes))
        # Markers of two panels meet between them; pages without a legend stay as they were.
        edge = self.pad if figure.legend else self.pad - MARGIN
        gap, least = max(8 * texts.factor, 2 * edge), 90.0 * min(texts.factor, 1.0)
        # What stands beside the columns, with the gaps between them.
        beside = self.beside + 2 * self.pad + gap * (grid.columns - 1 + bool(grid.chart))
        bound = grid.width - beside
        is_free = figure.size.width is None and figure.size.height is None
        most = grid.height if grid.height is not None else TALLEST * grid.width
        highest = (most - strip.height - 2 * self.pad - sum(self.words)) / sum(tall)
        high = max(min(highest, VIEW_HEIGHT) if is_free else highest, 8.0)

        def columns(high: float) -> list[float]:
            return [max(high * each, least) for each in wide]

        if not is_free and sum(columns(high)) > bound:
            low = 0.0
            for _ in range(40):
                middle = (low + high) / 2
                low, high = (middle, high) if sum(columns(middle)) <= bound else (low, middle)
            high = max(low, 8.0)
        self.high = high
        self.columns = columns(high)
        is_as_wide = grid.is_printed and figure.size.width is not None and figure.size.height is None
        if is_as_wide or (sum(self.columns) > bound and not is_free):
            self.columns = [each * bound / sum(self.columns) for each in self.columns]
        self.rows = [high * each for each in tall]
        self.gap = gap
        self.width = sum(self.columns) + beside


# ---------------------------------------------------------------------- where it stands
def _placed(figure: Figure, grid: Grid, texts: _Texts, strip: _Strip, sizes: _Sizes, scale: float) -> PageLayout:
    width, height = sizes.width, sizes.height
    page = (round(width * scale), round(height * scale))
    if scale == grid.scale and not figure.crop:
        page = (grid.pixels[0], page[1] if grid.pixels[1] is None else grid.pixels[1])
    check_pixels(*page)
    gap = sizes.gap if figure.crop else 0.0
    cells, charts, heads = [], [], list[TextLines]()
    top = sizes.pad + sizes.space
    for row, (high, words) in enumerate(zip(sizes.rows, sizes.words, strict=True)):
        left = sizes.pad + texts.side
        head = texts.heads[row > 0]
        if texts.row_heads:
            size, (lines,) = texts.lettering.fitted([texts.row_heads[row]], texts.heading, high, 1, True)
            x, y = sizes.pad + texts.heading, top + head + high / 2
            heads.append(TextLines(lines, x, y, size, is_bold=True, turned=True))
        for column, wide in enumerate(sizes.columns):
            k = row * grid.columns + column
            if k < len(figure.panels):
                box = Box(left, top, wide, high + words)
                cells.append(_cell(figure, k, box, texts, sizes, scale))
            left += wide + gap
        if figure.charts:
            letter = texts.letters[(row + 1) * (grid.columns + 1) - 1]
            heads += _letter(letter, left, top, texts)
            charts.append(Box(left, top + head, sizes.chart, high + texts.foot))
        top += high + words + sizes.space
    shared = None
    if strip.width:
        views = cells[0].views[0].y, cells[-1].views[0].bottom
        room = Box(width - sizes.pad - strip.width, views[0], strip.width, views[1] - views[0])
        shared = bars.upright_bar(figure, strip.panel, room, texts.factor, strip.label, texts.lettering)
    elif strip.height:
        under = height - sizes.pad - sizes.space - strip.height
        box = _bar_box(Box(0, 0, width, height), under + 7 * texts.factor, texts.factor)
        shared = bars.flat_bar(figure, strip.panel, box, (3, width - 3), strip.lines, strip.label, texts.lettering)
    narrowest = min(view.width for cell in cells for view in cell.views)
    stroke = min(max(narrowest / STROKE, THINNEST), 1.0)
    if grid.is_printed:
        stroke = max(stroke, narrowest / WIDE)
    sides = min(min(view.width, view.height) for cell in cells for view in cell.views)
    mark = max(MARK * sides, LEAST_MARK) * figure.style.marker_size / PAPER.marker_size
    return PageLayout(
        width,
        height,
        scale,
        page,
        tuple(cells),
        texts.label,
        texts.lettering,
        shared,
        stroke,
        mark,
        charts=tuple(charts),
        heads=tuple(heads),
    )


def letter_of(panel: int) -> str:
    """Return the letter of a panel, counted from 0: a to z, then aa, ab and so on."""
    before, last = divmod(panel, 26)
    return (letter_of(before - 1) if before else "") + chr(ord("a") + last)


def _bar_box(room: Box, y: float, factor: float) -> Box:
    wide = min(bars.SHARE * room.width, bars.LONGEST * max(factor, 1.0))
    return Box(room.x + (room.width - wide) / 2, y, wide, bars.THICK * factor)


def _letter(letter: str, left: float, top: float, texts: _Texts) -> list[TextLines]:
    """Return the letter of a panel or chart, if it has one, in its upper left corner."""
    half = texts.lettering.width(letter, texts.heading, True) / 2
    x, y = left + 4 * texts.factor + half, top + 7 * texts.factor + texts.heading
    return [TextLines((letter,), x, y, texts.heading, is_bold=True)] if letter else []


def _cell(figure: Figure, k: int, box: Box, texts: _Texts, sizes: _Sizes, scale: float) -> PanelLayout:
    panel, shapes = figure.panels[k], sizes.shapes[k]
    middle, factor = box.middle[0], texts.factor
    first = box.y + 7 * factor + texts.heading
    words = [TextLines(texts.headings[k], middle, first, texts.heading, is_bold=True)]
    words += _letter(texts.letters[texts.letter_at[k]], box.x, box.y, texts)
    is_later = k >= len(sizes.columns)
    head = texts.heads[is_later]
    hint_at = box.y + 7 * factor + texts.head_lines[is_later] * LINE * texts.heading + texts.hint
    words.append(TextLines(texts.hints[k], middle, hint_at, texts.hint, is_quiet=True))
    area = Box(box.x, box.y + head, box.width, max(box.height - head - texts.foot, 4.0))
    total = sum(w for w, _, _ in shapes)
    views, left = [], area.x
    for wide, _, _ in shapes:
        # Panels of equal size share their shadows, which take long.
        view = Box(left, area.y, area.width * wide / total, area.height)
        views.append(view.snapped(scale, keeps_size=figure.has_shadows))
        left += area.width * wide / total
    parts = tuple(part for _, _, part in shapes)
    insets: tuple[Box, ...] = ()
    if panel.insets:
        surface = shown_surfaces(panel, figure.upper_limits()[k])[0]
        views[0], insets = insets_of(figure, k, surface, views[0], parts[0], scale)
    bar = None
    if texts.bars[k]:
        room = (box.x + 3, box.right - 3)
        bar = bars.flat_bar(
            figure,
            k,
            _bar_box(box, area.bottom + 7 * factor, factor),
            room,
            texts.feet[k],
            texts.label,
            texts.lettering,
        )
    else:
        words.append(
            TextLines(texts.feet[k], middle, area.bottom + 7 * factor + texts.label, texts.label, is_quiet=True)
        )
    return PanelLayout(box, tuple(w for w in words if w.lines), tuple(views), parts, insets, bar)
