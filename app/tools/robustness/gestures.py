"""Esc lays down the brush that cuts faces out of the mesh."""

from ...qt.docks.brushing import Brushing
from ...qt.gesture import Gesture


class CutGestures(Gesture):
    """Clicks and drags stay with the other tools; only Esc is taken, while the brush cuts."""

    def cancel(self) -> bool:
        brushing = self.context[Brushing]
        if not brushing.cuts:
            return False
        brushing.switch(False)
        return True
