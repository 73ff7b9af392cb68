"""The dock that lists what is on the surface: a row for each thing, with an eye that hides it and a bin."""

from qtpy import QtCore, QtGui, QtWidgets

from ...document.document import Document
from ...document.on_surface import (
    SOURCE,
    SurfaceItem,
    clear_surface,
    hide,
    is_hidden,
    item_counts,
    remove_items,
    surface_items,
)
from ...qt.context import Context
from ...qt.docks.instrument import PAD, Instrument
from ...qt.docks.plain import RowList, fill
from ...qt.look.form import hairline, in_column, in_row, keep_room, push_button, quiet_label
from ...qt.look.icons import pixmap
from ...qt.look.look import LOOK, baseline, paint_elided, paint_rounded, smooth_painter
from ...qt.panels.badges import RIM, SOURCE as SOURCE_COLOUR
from ...qt.panels.flat_button import FlatButton
from ...scene.style import PINS

ROW_HEIGHT_PX = 34
"""Height of a row in logical pixels, as all lengths here."""

INDENT_PX, SYMBOL_PX, SYMBOL_ROOM_PX = 24, 14, 22
"""Indent of the members of a group; size of the picture before a name, and the room that it takes."""

HIDDEN = "What is hidden here is hidden in figures as well."


class SurfaceDock(Instrument):
    """The dock that lists the items on the surface.

    `rows` holds them by the words of their items; members without a word by their names.
    """

    word = "surface"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._list = RowList(self._new_row)
        self.rows: dict[str, ItemRow] = self._list.rows
        self.note = quiet_label(HIDDEN, wraps=True)
        tip = "Remove pins, selections, borders, anchors and other marks; Ctrl+Z brings them back"
        self.clear = push_button("Clear all but the source", lambda: context.session.apply(clear_surface), tip)
        inside, whole = QtWidgets.QWidget(), QtWidgets.QWidget()
        in_column(self._list, None, of=inside, spacing=0, margins=(0, 4, 0, 0))
        fill(whole, inside)
        under = in_column(self.note, (self.clear, 0, QtCore.Qt.AlignmentFlag.AlignLeft), spacing=8)
        under.setContentsMargins(PAD, 8, PAD, PAD)
        in_column((whole, 1), hairline(), under, of=self, spacing=0)

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        items = surface_items(document)
        wanted: dict[str, tuple[SurfaceItem, bool]] = {}
        for item in items:
            if len(item.members) != 1:
                wanted[item.word] = item, False
            for member in item.members:
                wanted[member.word or f"{item.word} {member.name}"] = member, len(item.members) > 1
        self._list.show_rows(wanted)
        for word, (item, is_member) in wanted.items():
            self.rows[word].show_item(item, is_member, bool(item.word) and is_hidden(document, item))
        _, hidden = item_counts(document)
        self.note_changed.emit(f"{hidden} hidden" if hidden else "")
        self.note.setVisible(hidden > 0)
        self.clear.setEnabled(any(item.remove is not None for item in items if item.word != SOURCE))

    def _new_row(self, word: str) -> "ItemRow":
        row = ItemRow(word)
        row.eye.activated.connect(lambda: self._toggle(row))
        row.bin.activated.connect(lambda: self._remove(row))
        return row

    # ------------------------------------------------------------------ edits
    def _toggle(self, row: "ItemRow") -> None:
        self.context.session.show(hide(self.document, row.item, not is_hidden(self.document, row.item)))

    def _remove(self, row: "ItemRow") -> None:
        """Remove a mark, and give the focus to the next row or the last."""
        words, had_keys = list(self.rows), row.bin.hasFocus()
        self.context.session.show(remove_items(self.document, [row.item]))
        after = [word for word in words[words.index(row.word) :] if word in self.rows] or list(self.rows)[-1:]
        if after and had_keys:
            self.rows[after[0]].eye.setFocus(QtCore.Qt.FocusReason.TabFocusReason)


class ItemRow(QtWidgets.QWidget):
    """A thing on the surface: its picture, its name, what else there is to say, an eye and a bin."""

    def __init__(self, word: str) -> None:
        super().__init__()
        self.word = word
        self.item = SurfaceItem("", "", "", "")
        self._is_member = self._is_hidden = False
        self.eye, self.bin = FlatButton(self, "eye"), FlatButton(self, "delete")
        for button in (self.eye, self.bin):
            keep_room(button)
        in_row(None, self.eye, self.bin, of=self, spacing=0, margins=(0, 0, 6, 0))
        self.setFixedHeight(round(ROW_HEIGHT_PX * LOOK.scale))

    def show_item(self, item: SurfaceItem, is_member: bool, is_hidden: bool) -> None:
        """Show an item; with `is_member`, it belongs to the group above."""
        self.item, self._is_member, self._is_hidden = item, is_member, is_hidden
        words = " ".join(filter(None, (item.name, item.detail)))
        self.setAccessibleName(f"{words}, hidden" if is_hidden else words)
        self.setToolTip(words)
        self.eye.icon_name = "eye-off" if is_hidden else "eye"
        show_or_hide = "Show" if is_hidden else "Hide"
        for button, text in ((self.eye, f"{show_or_hide} {words}"), (self.bin, f"Remove {words}")):
            button.setToolTip(text)
            button.setAccessibleName(text)
            button.update()
        self.eye.setVisible(bool(item.word))
        self.bin.setVisible(item.remove is not None)
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme = smooth_painter(self), LOOK.theme
        left, middle = PAD + (INDENT_PX if self._is_member else 0), self.height() / 2
        box = QtCore.QRectF(left, middle - SYMBOL_PX / 2, SYMBOL_PX, SYMBOL_PX)
        painter.setOpacity(0.4 if self._is_hidden else 1.0)
        _paint_symbol(painter, box, self.item, self.devicePixelRatioF())
        painter.setOpacity(1.0)
        painter.setFont(LOOK.font())
        x, y = float(left + SYMBOL_ROOM_PX), round(baseline(painter, middle))
        for text, colour in ((self.item.name, theme.text), (self.item.detail, theme.quiet)):
            painter.setPen(QtGui.QColor(theme.disabled if self._is_hidden else colour))
            x = paint_elided(painter, x, y, text, self.eye.x() - 4.0 - x) + 8


def _paint_symbol(painter: QtGui.QPainter, box: QtCore.QRectF, item: SurfaceItem, ratio: float) -> None:
    """Paint the picture of a kind of mark, in its colour where it has one."""
    theme = LOOK.theme
    colour = QtGui.QColor(theme.text if item.colour is None else PINS[item.colour])
    painter.setPen(QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(colour)
    if item.symbol in ("disc", "dot", "ring"):
        fill, rim = {"disc": (SOURCE_COLOUR, RIM), "dot": (colour.name(), ""), "ring": ("", colour.name())}[item.symbol]
        inner = box.adjusted(1, 1, -1, -1)
        paint_rounded(painter, inner, inner.width() / 2, fill, rim, 1.5)
    elif item.symbol == "pin":
        painter.drawPixmap(box.topLeft() - QtCore.QPointF(1, 1), pixmap("pin", colour.name(), ratio, SYMBOL_PX + 2))
    elif item.symbol == "hatching":
        painter.fillRect(box.adjusted(0.5, 0.5, -0.5, -0.5), QtGui.QBrush(colour, QtCore.Qt.BrushStyle.BDiagPattern))
        paint_rounded(painter, box.adjusted(0.5, 0.5, -0.5, -0.5), 0, line=colour.name())
    elif item.symbol == "line":
        painter.fillRect(QtCore.QRectF(box.left(), box.center().y() - 1.25, box.width(), 2.5), colour)
    elif item.symbol == "triangle":
        corners = (box.bottomLeft(), QtCore.QPointF(box.center().x(), box.top()), box.bottomRight())
        painter.drawPolygon(QtGui.QPolygonF([QtCore.QPointF(p.x(), p.y() - 1) for p in corners]))
