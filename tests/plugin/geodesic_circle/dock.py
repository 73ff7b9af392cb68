"""Radius, length and area of the circle, panel by panel."""

from bihdist.document.document import Document
from bihdist.qt.context import Context
from bihdist.qt.docks.instrument import PAD, Instrument
from bihdist.qt.docks.plain import fill
from qtpy import QtCore, QtWidgets

from .measures import measured, vertex_in


class CircleDock(Instrument):
    word = "circle"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.label = QtWidgets.QLabel(objectName="circle measures")
        self.label.setMargin(PAD)
        self.label.setAlignment(QtCore.Qt.AlignmentFlag.AlignTop)
        fill(self, self.label)

    def show_document(self, document: Document, before: Document | None) -> None:
        self.show_answer(-1)

    def show_answer(self, panel: int) -> None:
        session, lines = self.context.session, []
        for shown in session.document.panels:
            found, vertex = session.shown.get(shown.id), vertex_in(session.document, shown)
            if vertex is not None and found is not None and found.answer.field is not None:
                circle = measured(session.mesh(shown.id).surface, found.answer.field, vertex)
                lines.append(f"radius {circle.radius:.4g}, length {circle.length:.4g}, area {circle.area:.4g}")
        self.label.setText("\n".join(lines) or "Click on a panel of geodesic distance.")
