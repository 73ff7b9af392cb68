"""The menu of isolines: where they are, and how they look."""

from qtpy import QtWidgets

from ...document.looks import Isolines
from ...document.settings import switches_in
from ...drawing.numbers import tick
from ..choices import IsolineChoices
from ..context import Context

ISOLINES = (0, 10, 20, 30, 50)


class IsolineMenu(QtWidgets.QMenu):
    """Entries for numbers of lines have them, as words, as data."""

    def __init__(self, context: Context) -> None:
        super().__init__("&Isolines", context.widget)
        choices = context[IsolineChoices]
        self.setToolTipsVisible(True)
        self._where = QtWidgets.QActionGroup(self)
        for count in ISOLINES:
            action = self._entry(f"About {count}" if count else "None", str(count))
            action.triggered.connect(lambda *_, count=count: choices.steps(count))
        self.addSeparator()
        self._other = self._entry("Another number…", "other")
        self._other.triggered.connect(choices.ask_steps)
        self._spacing = self._entry("Spacing…", "spacing")
        self._spacing.setToolTip("Put isolines at multiples of a number, in all panels of a unit")
        self._spacing.triggered.connect(choices.ask_spacing)
        self._values = self._entry("Values…", "values")
        self._values.setToolTip("Put isolines at given values")
        self._values.triggered.connect(choices.ask_values)
        self.addSeparator()
        self.addActions([context.actions[word] for word in switches_in("isolines")])
        self.addSeparator()
        self.through = self.addAction("Remove isolines through points", choices.pass_through_none)
        self.through.setToolTip("Add one through a point by a right click on the surface")

    def show_choice(self, isolines: Isolines) -> None:
        """Tick what is chosen."""
        word = str(isolines.count)
        if isolines.spacing is not None:
            word = "spacing"
        elif isolines.values:
            word = "values"
        elif isolines.count not in ISOLINES:
            word = "other"
        for action in self._where.actions():
            action.setChecked(action.data() == word)
        self._other.setText(f"Another number ({isolines.count})…" if word == "other" else "Another number…")
        self._spacing.setText(f"Spacing ({tick(isolines.spacing)})…" if isolines.spacing is not None else "Spacing…")
        self._values.setText(f"Values ({len(isolines.values)})…" if word == "values" else "Values…")
        self.through.setEnabled(bool(isolines.through))

    def _entry(self, text: str, word: str) -> QtWidgets.QAction:
        action = self.addAction(text)
        action.setData(word)
        action.setCheckable(True)
        self._where.addAction(action)
        return action


def isolines_in_words(isolines: Isolines) -> str:
    """For the button: "20", "20 equal", "None", "0.05 apart", "3 values"."""
    if isolines.spacing is not None:
        return f"{tick(isolines.spacing)} apart"
    if isolines.values:
        return "1 value" if len(isolines.values) == 1 else f"{len(isolines.values)} values"
    return f"{isolines.count}{'' if isolines.round else ' equal'}" if isolines.count else "None"
