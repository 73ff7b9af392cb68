"""Something that fields follow, on its way: a source, or a point that a tool has marked."""

from .context import Context
from .live_rate import LiveRate


class Dragging:
    """is_on: whether it is held, so that panels that are a moment behind say nothing of it; rate: of fields."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self.is_on = False
        self.rate = LiveRate(context.session, context.status)

    def set_off(self) -> None:
        """It begins to move; nothing while it does.  Isolines keep their steps meanwhile."""
        self.rate.begin()
        self._context.grid.marks.keep_steps(True)

    def rest(self) -> None:
        """It has arrived."""
        self.rate.end()
        self._context.grid.marks.keep_steps(False)
