"""Choices of isolines."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from qtpy import QtWidgets

from bihdist_core import ParameterError
from bihdist_core.scalars import with_decimal_point

from ..document.edits import pass_through, pass_through_none
from ..document.looks import MOST_ISOLINES
from ..scene.levels import levels, too_many
from .context import Context

IN_UNIT = "in each panel's unit (0.05 for 5 % of a difference)"


class IsolineChoices:
    """Edits of the document's isolines."""

    def __init__(self, context: Context) -> None:
        self._context = context

    def steps(self, count: int) -> None:
        """Choose about how many isolines there are, at round values, or the number of equal steps."""
        self._change("isolines", count=count, spacing=None, values=())

    def ask_steps(self) -> None:
        """Ask for the number of isolines."""
        now = self._context.document.isolines.count
        count, chosen = QtWidgets.QInputDialog.getInt(
            self._context.widget, "Isolines", "About how many in each panel:", now, 0, MOST_ISOLINES
        )
        if chosen:
            self.steps(count)
        self._context.choice_changed.emit()

    def ask_spacing(self) -> None:
        """Ask for the step from one isoline to the next."""
        now = self._context.document.isolines.spacing
        question = f"From one isoline to the next, {IN_UNIT}:"
        self._ask(question, "" if now is None else f"{now:.6g}", self.spacing)

    def spacing(self, text: str) -> None:
        """Choose a typed spacing; ParameterError if it makes more lines than can be drawn."""
        session = self._context.session
        wanted = replace(session.document.isolines, spacing=_number(text), values=())
        for shown in session.shown.values():
            answer = shown.answer
            own = answer.maximum / answer.scale
            if reason := too_many(levels(wanted, own, own, answer.is_signed), wanted, own):
                raise ParameterError(reason)
        self._change("", spacing=wanted.spacing, values=())

    def ask_values(self) -> None:
        """Ask for the values of the isolines."""
        now = self._context.document.isolines.values
        question = f"Isolines at these values, {IN_UNIT}, with spaces between them:"
        self._ask(question, " ".join(f"{value:.6g}" for value in now), self.values)

    def values(self, text: str) -> None:
        """Choose typed values."""
        words = text.replace(";", " ").replace(", ", " ").split()
        if len(words) == 1 and words[0].count(",") > 1:
            words = words[0].split(",")
        values = tuple(map(_number, words))
        if not values:
            raise ParameterError("Isolines at values need one value at least, such as 0.5.")
        self._change("", spacing=None, values=values)

    # ------------------------------------------------------------------ through points
    def pass_through(self, panel: int, vertex: int) -> None:
        """Add an isoline through a vertex of a panel's surface, in all panels of that surface."""
        session = self._context.session
        surface = session.document.panel(panel).surface
        session.show(pass_through(session.document, (vertex,), surface))

    def pass_through_none(self) -> None:
        """Remove the isolines through chosen points."""
        session = self._context.session
        session.show(pass_through_none(session.document))

    # ------------------------------------------------------------------
    def _change(self, key: str, **changes: Any) -> None:
        session = self._context.session
        isolines = replace(session.document.isolines, **changes)
        session.show(replace(session.document, isolines=isolines), key=key)
        self._context.choice_changed.emit()

    def _ask(self, question: str, now: str, take: Callable[[str], None]) -> None:
        """Ask for a text until it can be read, or the user cancels."""
        dialog = QtWidgets.QInputDialog(self._context.widget)
        dialog.setWindowTitle("Isolines")
        dialog.setTextValue(now)
        dialog.setLabelText(question)
        while dialog.exec():
            try:
                take(dialog.textValue())
                break
            except ParameterError as error:
                dialog.setLabelText(f"{question}\n{error}")
        self._context.choice_changed.emit()
        dialog.deleteLater()


def _number(text: str) -> float:
    try:
        return float(with_decimal_point(text))
    except ValueError:
        raise ParameterError(f"{text.strip()[:20] or 'Nothing'!r} is not a number.") from None
