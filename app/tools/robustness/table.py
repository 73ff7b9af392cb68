"""How far distances change, in numbers: for each distance the mean and the largest, as shares and in its unit."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError, Cancelled
from bihdist_core.progress import Progress

from ...document.document import Document
from ...document.quantities import kind_name
from ...qt.context import Context
from ...qt.look.look import LOOK
from ...qt.look.numbers import number, number_width, paint_number, share
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import questions
from .answers import ChangeNumbers, ChangeQuestion, change_numbers

LINE, HEAD = 24.0, 18.0
"""Height of a line and of each of the two above, in logical pixels."""

GAP = 10.0
UNKNOWN = ("…", "…", "…", "…")
NONE = ("–", "–", "–", "–")
GROUPS, HEADS = ("fraction of maximum", "in units"), ("mean", "largest", "mean", "largest")
SHORT_GROUPS = ("fraction", "in units")


@dataclass(frozen=True, eq=False)
class _Request:
    """asked: the questions of panels that show a change, with the surfaces these are of."""

    asked: tuple[tuple[ChangeQuestion, LoadedMesh], ...]


class ChangeTable(QtWidgets.QWidget):
    """A row for each distance whose change is shown.

    rows: the names and the four numbers, as they are written; numbers: the same as they were found, by the name.
    """

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self.rows: list[tuple[str, tuple[str, ...]]] = []
        self.numbers: dict[str, ChangeNumbers] = {}
        self._of: tuple[ChangeQuestion, ...] = ()
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Changes of the distances")
        self._background = context.background("changes", _found)
        self._background.answered.connect(self._take)
        self._background.failed.connect(self._refuse)
        LOOK.follow(self, self._fit)

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document) -> None:
        """What is asked of the changed mesh, once the panels show it."""
        session = self._context.session
        asked = []
        for panel, question in zip(document.panels, questions(document).values(), strict=True):
            loaded = session.loaded(panel.surface)
            if isinstance(question, ChangeQuestion) and loaded is not None:
                asked.append((panel.id, question, loaded))
        names = _names([question for _, question, _ in asked])
        if names != [name for name, _ in self.rows]:
            self.rows = [(name, UNKNOWN) for name in names]
            self._fit()
        of = tuple(question for _, question, _ in asked)
        if of == self._of or not all(session.is_answered(id) for id, _, _ in asked):
            return
        self._of = of
        self._background.ask(_Request(tuple((question, loaded) for _, question, loaded in asked)))

    def _take(self, request: _Request, found: list[ChangeNumbers | None]) -> None:
        names = _names([question for question, _ in request.asked])
        if names != [name for name, _ in self.rows]:
            return
        self.numbers = {name: each for name, each in zip(names, found, strict=True) if each is not None}
        self.rows = [(name, _words(each)) for name, each in zip(names, found, strict=True)]
        self.setAccessibleDescription("; ".join(f"{name}: {', '.join(words)}" for name, words in self.rows))
        self._fit()

    def _refuse(self, request: _Request, sentence: str) -> None:
        self._take(request, [None] * len(request.asked))
        self.setAccessibleDescription(sentence)

    def text(self) -> str:
        """With tabulators and all digits."""
        lines: list[tuple[str, ...]] = [("distance", "mean fraction", "largest fraction", "mean", "largest", "unit")]
        for name, each in self.numbers.items():
            cells = (each.share_mean, each.share_largest, each.mean, each.largest)
            lines.append((name, *map(repr, cells), each.unit))
        return "\n".join("\t".join(line) for line in lines)

    # ------------------------------------------------------------------ how it looks
    def _fit(self) -> None:
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QtCore.QSize:
        lines = len(self.rows)
        return QtCore.QSize(200, round((2 * HEAD + LINE * lines + 4 if lines else 0) * LOOK.scale))

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, self.sizeHint().height())

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if not self.rows:
            return
        theme, scale, painter = LOOK.theme, LOOK.scale, QtGui.QPainter(self)
        small, font = LOOK.font(12), LOOK.font(13)
        cells = [words for _, words in self.rows]
        widths = [max(number_width(small, HEADS[k]), *(number_width(font, row[k]) for row in cells)) for k in range(4)]
        # Where there is room columns stand as far apart as they can, up to a point.
        longest = max(number_width(font, name) for name, _ in self.rows)
        spare = self.width() - longest - sum(widths) - 4 * GAP
        gap = GAP + min(max(spare / 4, 0.0), 14.0)
        rights = [self.width() - sum(widths[k + 1 :]) - gap * (3 - k) for k in range(4)]
        painter.setFont(small)
        painter.setPen(QtGui.QColor(theme.quiet))
        baseline = _baseline(painter, 0.0, HEAD * scale)
        for first, last, group, short in ((0, 1, GROUPS[0], SHORT_GROUPS[0]), (2, 3, GROUPS[1], SHORT_GROUPS[1])):
            room = rights[last] - (rights[first] - widths[first])
            text = group if number_width(small, group) <= room + gap / 2 else short
            middle = rights[last] - room / 2
            paint_number(painter, middle - number_width(small, text) / 2, baseline, text)
            painter.fillRect(QtCore.QRectF(rights[last] - room, HEAD * scale, room, 1), QtGui.QColor(theme.border))
        baseline = _baseline(painter, HEAD * scale, HEAD * scale)
        for right, head in zip(rights, HEADS, strict=True):
            paint_number(painter, right - number_width(small, head), baseline, head)
        y = 2 * HEAD * scale + 3
        painter.fillRect(QtCore.QRectF(0, y - 1, self.width(), 1), QtGui.QColor(theme.border))
        painter.setFont(font)
        metrics = QtGui.QFontMetricsF(font)
        for name, words in self.rows:
            baseline = _baseline(painter, y, LINE * scale)
            painter.setPen(QtGui.QColor(theme.text))
            for right, cell in zip(rights, words, strict=True):
                paint_number(painter, right - number_width(font, cell), baseline, cell)
            room = max(rights[0] - widths[0] - GAP, 0)
            painter.drawText(
                QtCore.QPointF(0, baseline), metrics.elidedText(name, QtCore.Qt.TextElideMode.ElideRight, room)
            )
            y += LINE * scale


def _baseline(painter: QtGui.QPainter, top: float, height: float) -> float:
    metrics = QtGui.QFontMetricsF(painter.font())
    return float(top + (height + metrics.ascent() - metrics.descent()) / 2)


def _names(questions: Sequence[ChangeQuestion]) -> list[str]:
    """With parameters where these alone are different, and numbered where nothing is."""
    kinds = [kind_name(question.spec.kind) for question in questions]
    names = [k if kinds.count(k) == 1 else str(q.spec) for k, q in zip(kinds, questions, strict=True)]
    return [n if names.count(n) == 1 else f"{n}, {names[:k].count(n) + 1}" for k, n in enumerate(names)]


def _words(found: ChangeNumbers | None) -> tuple[str, ...]:
    if found is None:
        return NONE
    raw = (f"{value:.3g}" if 1e-3 <= value < 1e4 else number(value) for value in (found.mean, found.largest))
    return small_share(found.share_mean), small_share(found.share_largest), *raw


def small_share(value: float) -> str:
    """ "2.3 %", and "0.012 %" of what is less than half a thousandth."""
    return share(value) if value >= 5e-4 or value == 0 else f"{100 * value:.2g} %"


def _found(request: _Request, progress: Progress) -> Iterator[list[ChangeNumbers | None]]:
    found: list[ChangeNumbers | None] = []
    for question, loaded in request.asked:
        try:
            found.append(change_numbers(question, loaded, progress))
        except Cancelled:
            raise
        except (BihdistError, MemoryError):
            found.append(None)  # the panel says why
    yield found
