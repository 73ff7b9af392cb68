"""Lists of rows in docks, one widget for each thing of the document."""

from collections.abc import Callable, Hashable, Iterable
from typing import Any

from qtpy import QtWidgets


class RowList(QtWidgets.QVBoxLayout):
    """Rows one below the other; `rows` has them in their order, by the words or ids that they are made for."""

    def __init__(self, make: Callable[[Any], QtWidgets.QWidget], spacing: int = 0) -> None:
        super().__init__()
        self.setSpacing(spacing)
        self._make = make
        self.rows: dict[Any, Any] = {}

    def show_rows(self, words: Iterable[Hashable]) -> None:
        """Show a row for each of these words, in this order: rows of others go, and new ones are made."""
        before = dict(self.rows)
        self.rows.clear()
        for place, word in enumerate(words):
            row = self.rows[word] = before.pop(word, None) or self._make(word)
            if self.indexOf(row) != place:
                self.removeWidget(row)
                self.insertWidget(place, row)
        for gone in before.values():
            gone.hide()
            gone.deleteLater()

    def beside(self, word: str, by: int) -> str:
        """Return the word of the row so many below, "" for none."""
        words = list(self.rows)
        place = words.index(word) + by
        return words[place] if 0 <= place < len(words) else ""

    def after_removal(self, word: str) -> str:
        """Return the word of the row that takes the focus as this one is removed: the next, or the last."""
        return self.beside(word, 1) or self.beside(word, -1)
