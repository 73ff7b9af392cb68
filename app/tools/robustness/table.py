"""The changes of distances in numbers: the mean and the largest, as fractions of the maximum and in the unit."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui

from bihdist_core import BihdistError, Cancelled
from bihdist_core.progress import Progress

from ...document.document import Document
from ...document.quantities import kind_name
from ...drawing.numbers import number, share
from ...drawing.painters.qt import number_width, paint_number
from ...qt.context import Context
from ...qt.docks.fact_table import FactTable
from ...qt.look.look import LOOK, baseline
from ...session.loaded_mesh import LoadedMesh
from .answers import ChangeNumbers, ChangeQuestion, change_numbers

UNKNOWN = ("…", "…", "…", "…")
NONE = ("–", "–", "–", "–")
GROUPS, SHORT_GROUPS = ("fraction of maximum", "in units"), ("fraction", "in units")


@dataclass(frozen=True, eq=False)
class _Request:
    asked: tuple[tuple[ChangeQuestion, LoadedMesh], ...]  # of panels that show a change


class ChangeTable(FactTable):
    """A row for each distance whose change is shown; `numbers` are those that were found, by the name."""

    HEADS = SHORT_HEADS = ("mean", "largest", "mean", "largest")
    LINE, HEAD = 24.0, 38.0

    def __init__(self, context: Context) -> None:
        super().__init__()
        self._context = context
        self.numbers: dict[str, ChangeNumbers] = {}
        self._of: tuple[ChangeQuestion, ...] = ()
        self.setAccessibleName("Changes of the distances")
        self._background = context.background("changes", _compute_changes, self._take, self._refuse)

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document) -> None:
        """Ask for the numbers of the changes, once panels show them."""
        session = self._context.session
        asked = []
        for panel, question in zip(document.panels, session.questions.values(), strict=True):
            loaded = session.loaded(panel.surface)
            if isinstance(question, ChangeQuestion) and loaded is not None:
                asked.append((panel.id, question, loaded))
        names = _names([question for _, question, _ in asked])
        if names != self._names:
            self.show_facts([(name, *UNKNOWN) for name in names])
        of = tuple(question for _, question, _ in asked)
        if of == self._of or not all(session.is_answered(id) for id, _, _ in asked):
            return
        self._of = of
        self._background.ask(_Request(tuple((question, loaded) for _, question, loaded in asked)))

    def _take(self, request: _Request, found: list[ChangeNumbers | None]) -> None:
        names = _names([question for question, _ in request.asked])
        if names == self._names:
            self.numbers = {name: each for name, each in zip(names, found, strict=True) if each is not None}
            self.show_facts([(name, *_words(each)) for name, each in zip(names, found, strict=True)])

    @property
    def _names(self) -> list[str]:
        return [name for name, *_ in self.facts]

    def _refuse(self, request: _Request, sentence: str) -> None:
        self._take(request, [None] * len(request.asked))
        self.setAccessibleDescription(sentence)

    def text(self) -> str:
        """Return the table with tabs and all digits."""
        lines: list[tuple[str, ...]] = [("distance", "mean fraction", "largest fraction", "mean", "largest", "unit")]
        for name, each in self.numbers.items():
            cells = (each.share_mean, each.share_largest, each.mean, each.largest)
            lines.append((name, *map(repr, cells), each.unit))
        return "\n".join("\t".join(line) for line in lines)

    # ------------------------------------------------------------------ how it looks
    def paint_heads(
        self, painter: QtGui.QPainter, heads: Sequence[str], widths: Sequence[float], rights: Sequence[float]
    ) -> None:
        """Paint heads below those of two columns, each over a line."""
        half, small = self.HEAD / 2 * LOOK.scale, painter.font()
        border = QtGui.QColor(LOOK.theme.border)
        for last, group, short in zip((1, 3), GROUPS, SHORT_GROUPS, strict=True):
            room = rights[last] - rights[last - 1] + widths[last - 1]
            text = group if number_width(small, group) <= room + self.GAP / 2 else short
            middle = rights[last] - room / 2
            paint_number(painter, middle - number_width(small, text) / 2, baseline(painter, half / 2), text)
            painter.fillRect(QtCore.QRectF(rights[last] - room, half, room, 1), border)
        for right, head in zip(rights, heads, strict=True):
            paint_number(painter, right - number_width(small, head), baseline(painter, 1.5 * half), head)
        painter.fillRect(QtCore.QRectF(0, 2 * half, self.width(), 1), border)


def _names(questions: Sequence[ChangeQuestion]) -> list[str]:
    """Return the names of distances, with parameters where only these differ, and numbers where nothing does."""
    kinds = [kind_name(question.spec.distance_type) for question in questions]
    names = [k if kinds.count(k) == 1 else str(q.spec) for k, q in zip(kinds, questions, strict=True)]
    return [n if names.count(n) == 1 else f"{n}, {names[:k].count(n) + 1}" for k, n in enumerate(names)]


def _words(found: ChangeNumbers | None) -> tuple[str, ...]:
    if found is None:
        return NONE
    raw = map(three_digits, (found.mean, found.largest))
    return small_share(found.share_mean), small_share(found.share_largest), *raw


def three_digits(value: float) -> str:
    """Return "0.0490", as there is less room than for four digits, and what is very large or small as elsewhere."""
    return f"{value:#.3g}".rstrip(".") if 1e-3 <= value < 999.5 else number(value)


def small_share(value: float) -> str:
    """Return a fraction such as "2.3 %", with two digits below half a thousandth: "0.012 %"."""
    return share(value) if value >= 5e-4 or value == 0 else f"{100 * value:.2g} %"


def _compute_changes(request: _Request, progress: Progress) -> Iterator[list[ChangeNumbers | None]]:
    found: list[ChangeNumbers | None] = []
    for question, loaded in request.asked:
        try:
            found.append(change_numbers(question, loaded, progress))
        except Cancelled:
            raise
        except (BihdistError, MemoryError):
            found.append(None)  # the panel says why
    yield found
