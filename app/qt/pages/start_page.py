"""The page that the window shows while no mesh is open: open a file, recent files and samples."""

from datetime import datetime

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.formats.mesh_names import FREESURFER, MESH_FORMATS

from ..look.controls import lines_of
from ..look.form import in_column, in_row, quiet_label
from ..look.icons import put_icon
from ..look.look import LOOK, paint_rounded, smooth_painter
from ..remembered import recent_files
from .start_places import FIRST_SAMPLES, OpenButton, RecentRow, Tiles

WIDEST = 1120
"""Greatest width of the content, in logical pixels, as all lengths here."""

LOW = 640
"""Height below which the page has a lower drop zone and fewer recent files."""

ROWS, ROWS_IN_LOW = 5, 4
ZONE, ZONE_IN_LOW = 188, 156
MESSAGE_LINES = 3


class StartPage(QtWidgets.QWidget):
    """The start page; `chosen` is emitted with the path of a recent file or a sample."""

    open_wanted = QtCore.Signal()
    chosen = QtCore.Signal(str)
    guide_wanted = QtCore.Signal()

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.message = Refusal()
        self.title = QtWidgets.QLabel("Open a mesh", objectName="title")
        self.zone = DropZone()
        self.zone.open.clicked.connect(lambda: self.open_wanted.emit())
        self.rows = [RecentRow() for _ in range(ROWS)]
        self.nothing = quiet_label("Files you open are listed here.")
        self.tiles = Tiles()
        for place in (*self.rows, *self.tiles.tiles):
            place.clicked.connect(lambda *_, place=place: self.chosen.emit(place.path))
        self.guide = _link("Read the guide")
        self.guide.clicked.connect(lambda: self.guide_wanted.emit())
        self.more = _link("More samples")
        self.more.clicked.connect(self._show_all_samples)
        self._fill()
        LOOK.changed.connect(self.update)
        self.refresh()

    def _show_all_samples(self) -> None:
        self.tiles.show_all()
        self.more.hide()
        self.tiles.tiles[len(FIRST_SAMPLES)].setFocus(QtCore.Qt.FocusReason.OtherFocusReason)

    def refresh(self) -> None:
        """Read the recent files again."""
        files, now = recent_files(), datetime.now().astimezone()
        most = ROWS_IN_LOW if self.height() < LOW else ROWS
        for k, row in enumerate(self.rows):
            row.setVisible(k < min(len(files), most))
            if k < len(files):
                row.show_file(files[k], now)
        self.nothing.setVisible(not files)

    def show_message(self, text: str) -> None:
        """Show above the title why a file could not be opened, "" for nothing."""
        self.message.show_text(text)
        self._under_message.setVisible(bool(text))
        if text:
            self.scroll.verticalScrollBar().setValue(0)

    def set_dropping(self, dropping: bool) -> None:
        """Show whether a file that can be opened is dragged over the window."""
        self.zone.set_dropping(dropping)

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        self.refresh()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        was_low, is_low = event.oldSize().height() < LOW, self.height() < LOW
        self.zone.setFixedHeight(ZONE_IN_LOW if is_low else ZONE)
        if was_low != is_low:
            self.refresh()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        QtGui.QPainter(self).fillRect(event.rect(), QtGui.QColor(LOOK.theme.canvas))

    # ------------------------------------------------------------------ how it is made
    def _fill(self) -> None:
        self._recent, self._samples = QtWidgets.QLabel("Recent"), QtWidgets.QLabel("Samples")
        for heading in (self._recent, self._samples):
            heading.setProperty("heading", True)
        self._recent.setContentsMargins(OpenButton.INSET, 0, 0, 0)
        self.nothing.setContentsMargins(OpenButton.INSET, 4, 0, 0)
        files = in_column(self._recent, 8, self.nothing, *self.rows, None, spacing=0)
        ways = in_row((self.zone, 1), (files, 1), spacing=40)
        samples = in_row(self._samples, None, self.more)
        links = in_row(self.guide, 16, quiet_label("F1: all commands"), None, spacing=8)
        how = quiet_label("Then click the surface: distances from that point appear side by side.")
        self._under_message = QtWidgets.QWidget(visible=False)
        self._under_message.setFixedHeight(20)
        column = QtWidgets.QWidget(maximumWidth=WIDEST)
        title = (self.message, self._under_message, self.title, 4, how)
        in_column(*title, 24, ways, 24, samples, 12, self.tiles, 24, links, of=column, spacing=0)
        sheet = QtWidgets.QWidget()
        middle = QtWidgets.QGridLayout(sheet)
        middle.setContentsMargins(24, 12, 24, 12)
        middle.addWidget(column, 1, 1)
        for before_and_after in (0, 2):
            middle.setRowStretch(before_and_after, 1)
            middle.setColumnStretch(before_and_after, 1)
        middle.setColumnStretch(1, 1000)  # all the width there is, up to its widest
        self.scroll = QtWidgets.QScrollArea(widgetResizable=True, frameShape=QtWidgets.QFrame.Shape.NoFrame)
        self.scroll.setFocusPolicy(QtCore.Qt.FocusPolicy.NoFocus)
        self.scroll.setWidget(sheet)
        # The page paints the ground.
        for widget in (self.scroll.viewport(), sheet):
            widget.setAutoFillBackground(False)
        in_column(self.scroll, of=self)


def _link(text: str) -> QtWidgets.QPushButton:
    return QtWidgets.QPushButton(text, objectName="link", cursor=QtCore.Qt.CursorShape.PointingHandCursor)


class Refusal(QtWidgets.QLabel):
    """The reason why a file could not be opened, on a few lines; the whole text is in the tooltip."""

    def __init__(self) -> None:
        super().__init__(visible=False)
        self.whole = ""
        self.setProperty("refusal", True)
        self.setTextFormat(QtCore.Qt.TextFormat.PlainText)
        self.setTextInteractionFlags(QtCore.Qt.TextInteractionFlag.TextSelectableByMouse)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed)

    def show_text(self, text: str) -> None:
        """Show a sentence, shortened to what there is room for; "" hides it."""
        self.whole = text
        self.setToolTip(text)
        self.setVisible(bool(text))
        self._elide()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._elide()

    def _elide(self) -> None:
        self.setText("\n".join(lines_of(self.whole, self.font(), self.contentsRect().width(), MESSAGE_LINES)))


class DropZone(QtWidgets.QWidget):
    """The area for drops, with the button that opens a file."""

    def __init__(self) -> None:
        super().__init__()
        self.is_dropping = False
        self.word = quiet_label("")
        self.open = QtWidgets.QPushButton("Open…", objectName="fill")
        put_icon(self.open, "open", colour_of="on_fill")
        self.open.setIconSize(QtCore.QSize(20, 20))
        formats = ", ".join(extension.strip(".").upper() for extension in MESH_FORMATS)
        known = quiet_label(f"{formats}, {FREESURFER}, or a saved session")
        known.setWordWrap(True)
        for label in (self.word, known):
            label.setAlignment(QtCore.Qt.AlignmentFlag.AlignCenter)
        opener = self.open, 0, QtCore.Qt.AlignmentFlag.AlignHCenter
        in_column(None, self.word, opener, known, None, of=self, spacing=12, margins=(16, 8, 16, 8))
        self.set_dropping(False)
        LOOK.changed.connect(self.update)

    def set_dropping(self, dropping: bool) -> None:
        """Show whether a file is dragged over the window."""
        self.is_dropping = dropping
        self.word.setText("Release to open" if dropping else "Drop a file here")
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter, box = LOOK.theme, smooth_painter(self), QtCore.QRectF(self.rect())
        if self.is_dropping:
            paint_rounded(painter, box.adjusted(1, 1, -1, -1), 8, theme.selection, theme.accent, 2)
        else:
            pen = QtGui.QPen(QtGui.QColor(theme.strong), 1)
            pen.setDashPattern([3, 3])
            painter.setPen(pen)
            painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 8, 8)
