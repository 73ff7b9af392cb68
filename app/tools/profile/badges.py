"""The points that the profile goes through, as small discs side by side and as buttons."""

from qtpy import QtCore, QtGui, QtWidgets

from ...document.document import Document
from ...document.shared_parts.pins import Pins
from ...qt.look.look import LOOK, smooth_painter
from ...qt.panels.badges import SOURCE, Badge, paint_badge
from ...qt.panels.flat_button import FlatButton
from ...scene.style import PINS


def badge_of(document: Document, point: str) -> Badge:
    """Return the badge of a point: a pin by its number, another point as a source."""
    number = document[Pins].number(point)
    if not number:
        return Badge("", SOURCE, point)
    pin = document[Pins].pins[number - 1]
    return Badge(str(number), PINS[pin.colour], f"pin {number} {pin.name}".strip())


class BadgeRow(QtWidgets.QWidget):
    """Badges side by side, MOST at most, then how many there are besides."""

    MOST, STEP = 4, 20

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._badges: tuple[Badge, ...] = ()
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Fixed, QtWidgets.QSizePolicy.Policy.Preferred)
        LOOK.follow(self, self.update)

    def show_badges(self, badges: tuple[Badge, ...]) -> None:
        """Show these badges in a row; the row is hidden without any."""
        self._badges = badges
        self.setVisible(bool(badges))
        self.setToolTip(", ".join(badge.name for badge in badges))
        self.updateGeometry()
        self.update()

    @property
    def _more(self) -> str:
        return f"+ {len(self._badges) - self.MOST}" if len(self._badges) > self.MOST else ""

    def sizeHint(self) -> QtCore.QSize:
        more = QtGui.QFontMetrics(LOOK.font(12)).horizontalAdvance(self._more) + 4 if self._more else 0
        return QtCore.QSize(self.STEP * min(len(self._badges), self.MOST) + more, 26)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, middle = smooth_painter(self), self.height() / 2
        for k, badge in enumerate(self._badges[: self.MOST]):
            paint_badge(painter, QtCore.QPointF((k + 0.5) * self.STEP, middle), badge)
        painter.setFont(LOOK.font(12))
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        rest = QtCore.QRectF(self.STEP * self.MOST, 0, self.width(), self.height())
        painter.drawText(rest, int(QtCore.Qt.AlignmentFlag.AlignVCenter), self._more)


class BadgeButton(FlatButton):
    """A badge that opens a menu."""

    def __init__(self, parent: QtWidgets.QWidget, name: str) -> None:
        super().__init__(parent, has_arrow=False)
        self._name = name
        self._badge: Badge | None = Badge("", SOURCE)
        self.setMenu(QtWidgets.QMenu(self))

    def show_badge(self, badge: Badge | None) -> None:
        """Show the badge that is chosen, None for none."""
        self._badge = badge
        self.setText("" if badge is not None else "choose")
        description = f"{self._name}: {badge.name if badge is not None else 'none yet'}"
        self.setToolTip(description)
        self.setAccessibleName(description)
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QtCore.QSize:
        return super().sizeHint() if self._badge is None else QtCore.QSize(26, super().sizeHint().height())

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        if self._badge is not None:
            paint_badge(smooth_painter(self), QtCore.QRectF(self.rect()).center(), self._badge)
