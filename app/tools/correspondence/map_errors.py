"""The section "Error" of the dock of pairs: how far maps are from the truth, and the full map."""

from collections.abc import Iterator
from typing import Any

from qtpy import QtWidgets

from bihdist_core.applications.map_errors import ErrorCurve
from bihdist_core.distances.kinds import Spec
from bihdist_core.formats.vertex_maps import MAP_FORMATS, write_map
from bihdist_core.progress import Progress

from ...document.document import Document
from ...document.file_names import file_name
from ...document.quantities import kind_name
from ...qt.context import Context
from ...qt.docks.dock import PAD
from ...qt.docks.panel_dots import curve_colour
from ...qt.files.saving import save
from ...qt.look.look import LOOK
from ...qt.panels.flat_button import FlatButton
from .error_chart import ErrorChart, ErrorTable, MapCurve
from .judgement import Asked, Judgement, Judging, Map, asked_of, maps_of
from .map_truth import MapTruth
from .maps import MapColours, MapFile, Maps, show_maps, shows_maps
from .pairs import whole_pairs
from .prediction import predict, predicts_in

NO_TRUTH = "Without a truth there is no error. Choose the same ids, or a map's file, where it is known."
NO_MAP = "Errors come with the first pair."


class MapErrors(QtWidgets.QWidget):
    """See the module.  judgement: what is shown, None for nothing."""

    def __init__(self, context: Context) -> None:
        super().__init__()
        self.context = context
        self.judgement: Judgement | None = None
        self.asked: Asked | None = None
        self._answered: tuple[object, ...] = ()  # what the judgement is about
        self._failure = ""  # why there is none
        self._dotted: list[Any] = []  # panels that have a dot of these
        self.truth = MapTruth(self)
        self.chart, self.table = ErrorChart(), ErrorTable()
        self.note = QtWidgets.QLabel(wordWrap=True)
        self.note.setProperty("quiet", True)
        self.full = QtWidgets.QPushButton("Compute full map", autoDefault=False)
        self.full.setToolTip("Where every vertex of A is on B, by each distance, in colours")
        self.full.clicked.connect(self.show_or_leave_maps)
        self.save = FlatButton(self, "save")
        self.save.setToolTip("Save a full map: for each vertex of A one of B")
        self.save.setAccessibleName("Save a full map")
        self.save.setMenu(QtWidgets.QMenu(self.save))
        self.save.menu().aboutToShow.connect(self._fill_maps)
        self.mirror = QtWidgets.QCheckBox("mirror counts")
        self.mirror.setToolTip("The symmetric partner of the right place is as good; where it is, a map's file says")
        self.mirror.clicked.connect(self._count_mirror)
        self._lay_out()
        self._background = context.background("map errors", self._judge)
        self._judging = Judging()
        self._background.answered.connect(self._take)
        self._background.failed.connect(self._refuse)
        LOOK.follow(self, self._show)

    def _lay_out(self) -> None:
        line = QtWidgets.QFrame(objectName="hairline")
        heading = QtWidgets.QLabel("Error")
        heading.setProperty("heading", True)
        top = QtWidgets.QHBoxLayout()
        top.addWidget(heading)
        top.addStretch(1)
        top.addWidget(self.truth.button)
        bottom = QtWidgets.QHBoxLayout()
        bottom.setSpacing(8)
        bottom.addWidget(self.full)
        bottom.addWidget(self.save)
        bottom.addStretch(1)
        bottom.addWidget(self.mirror)
        inside = QtWidgets.QVBoxLayout()
        inside.setContentsMargins(PAD, 8, PAD, PAD)
        inside.setSpacing(8)
        inside.addLayout(top)
        for widget in (self.chart, self.table, self.note):
            inside.addWidget(widget)
        inside.addLayout(bottom)
        whole = QtWidgets.QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addWidget(line)
        whole.addLayout(inside)

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document) -> None:
        """The document is another: are its maps, or is what is right?"""
        loaded = [self.context.session.loaded(mesh.name) for mesh in document.surfaces[:2]]
        there = [each for each in loaded if each is not None]
        self.setVisible(len(there) == 2)
        if len(there) < 2:
            self._ask(None)
            return
        self._ask(asked_of(document, *there))
        self._show()

    def show_answer(self) -> None:
        """A panel has another answer: perhaps a full map."""
        self.save.setVisible(bool(self._full_maps()))

    def show_again(self) -> None:
        """The panels have forgotten what was drawn on them."""
        if self.asked is not None:
            self._put_dots(self._colours())

    def show_closed(self) -> None:
        """Ask for nothing while the dock is closed."""
        self._ask(None)
        self._put_dots({})

    def _ask(self, asked: Asked | None) -> None:
        before, self.asked = self.asked, asked
        if asked is None or before is None or asked.about != before.about:
            if asked is None or before is None or not _is_judged_alike(asked, before):
                self.judgement = None
            self._failure = ""
            self._background.ask(asked)

    def _judge(self, asked: Asked, progress: Progress) -> Iterator[Judgement]:
        yield from self._judging.judge(asked, progress)

    def _take(self, asked: Asked, judgement: Judgement) -> None:
        self.judgement, self._answered, self._failure = judgement, asked.about, ""
        self._show()

    def _refuse(self, asked: Asked, sentence: str) -> None:
        self.judgement, self._failure = None, sentence
        self._show()

    @property
    def is_whole(self) -> bool:
        """Whether errors are shown of all vertices that are wanted, for the pairs that there are now."""
        asked, judged = self.asked, self.judgement
        return asked is not None and judged is not None and judged.is_whole and self._answered == asked.about

    # ------------------------------------------------------------------ what is seen
    @property
    def _document(self) -> Document:
        return self.context.document

    def _show(self) -> None:
        asked, document = self.asked, self._document
        if asked is None:
            return
        word = self.truth.word
        self.truth.show()
        self.mirror.setChecked(document[Maps].truth.mirror)
        self.mirror.setEnabled(word != "none")
        has_maps = bool(document[Maps].maps or (whole_pairs(document) and asked.maps))
        judged = self.judgement if word != "none" and has_maps else None
        curves = [] if judged is None else self._curves(judged)
        self.chart.setVisible(bool(curves))
        self.chart.show_curves(curves)
        failures = [] if judged is None else self._failures(judged)
        self.table.setVisible(bool(curves or failures))
        self.table.show_rows(curves, failures)
        self.note.setText(NO_TRUTH if word == "none" else NO_MAP if not has_maps else self._over(judged))
        has_full = shows_maps(document)
        self.full.setText("Show predictions" if has_full else "Compute full map")
        self.full.setEnabled(bool(has_full or document[Maps].maps or whole_pairs(document)))
        self.show_answer()
        self._put_dots(self._colours())

    def _over(self, judged: Judgement | None) -> str:
        """Over how many vertices, by which distance."""
        if judged is None:
            return self._failure or "Finding errors…"
        if not judged.curves:
            return " ".join(dict.fromkeys(judged.failures.values()))
        known = f"{judged.known:,}" if judged.is_whole else f"{judged.known:,} of {judged.wanted:,}"
        vertices = "vertices" if judged.wanted == judged.vertices else "sampled vertices"
        return f"over {known} {vertices}; {judged.method}"

    def name_of(self, map: Map) -> str:
        """In the table."""
        if isinstance(map, MapFile):
            return map.name
        same = [each for each in maps_of(self._document) if isinstance(each, Spec) and each.word == map.word]
        return kind_name(map.kind) if len(same) < 2 else str(map)

    def _colour_of(self, map: Map) -> str:
        maps = maps_of(self._document)
        return curve_colour(maps.index(map)) if map in maps else LOOK.theme.quiet

    def _curves(self, judged: Judgement) -> list[MapCurve]:
        return [
            MapCurve(self.name_of(map), self._colour_of(map), curve)
            for map, curve in judged.curves.items()
            if map in maps_of(self._document)
        ]

    def _failures(self, judged: Judgement) -> list[tuple[str, str, str]]:
        return [(self.name_of(map), self._colour_of(map), why) for map, why in judged.failures.items()]

    def _colours(self) -> dict[int, str]:
        """Of the dots in the heads of panels: those of their curves."""
        document, found = self._document, {}
        for panel in document.panels:
            shows = panel.shows
            if predicts_in(panel) and panel.surface == document.surfaces[1].name:
                found[panel.id] = self._colour_of(shows.specs[0])
            elif isinstance(shows, MapColours) and shows.by:
                found[panel.id] = self._colour_of(
                    document[Maps].of(shows.by) if isinstance(shows.by, str) else shows.by
                )
        return found

    def _put_dots(self, colours: dict[int, str]) -> None:
        panels = list(self.context.grid.panels)
        for panel in panels:
            if panel.id in colours or panel in self._dotted:
                panel.head.show_dot(colours.get(panel.id, ""))
        self._dotted = [panel for panel in panels if panel.id in colours]

    def named_curves(self) -> dict[str, ErrorCurve]:
        """What the chart shows."""
        return {curve.name: curve.errors for curve in self.chart.curves}

    def _count_mirror(self, counts: bool) -> None:
        self.truth.count_mirror(counts)
        self.mirror.setChecked(self._document[Maps].truth.mirror)

    # ------------------------------------------------------------------ maps
    def show_or_leave_maps(self) -> None:
        """The full map by each distance, or predictions again."""
        document = self._document
        self.context.edit(predict(document) if shows_maps(document) else show_maps(document))

    def _full_maps(self) -> dict[Spec, Any]:
        """Those that are there, (n,) each."""
        session = self.context.session
        found = {}
        for panel in self._document.panels:
            shown = session.shown.get(panel.id)
            is_by_pairs = panel.shows.is_map and panel.shows.specs
            if not is_by_pairs or shown is None or not session.is_answered(panel.id):
                continue
            if shown.answer.leads_to is not None:
                found[panel.shows.specs[0]] = shown.answer.leads_to
        return found

    def _fill_maps(self) -> None:
        menu = self.save.menu()
        menu.clear()
        for spec, found in self._full_maps().items():
            action = menu.addAction(f"Save the map by {self.name_of(spec).lower()}…")
            action.triggered.connect(lambda *_, spec=spec, found=found: self.save_map(spec, found))

    def save_map(self, spec: Spec, found: Any) -> None:
        """Ask for a file, and write a map's vertices (n,)."""
        asked = self.asked
        meshes = [] if asked is None else [each.surface.name for each in (asked.one, asked.two)]
        name = file_name(meshes, "map", str(spec))
        save(self.context, "Save the map", name, MAP_FORMATS, lambda path: write_map(path, found))


def _is_judged_alike(one: Asked, other: Asked) -> bool:
    """Whether what is known of the one is near what is to come of the other: only pairs or maps differ."""
    return (one.about[:3], one.truth) == (other.about[:3], other.truth)
