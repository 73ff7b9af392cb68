"""What the panels of a window show and should not, once all has come to rest."""

import os
from pathlib import Path

import numpy as np

from tests.qt.parts import parts

from .hands import Hands

SLACK = 0.002
"""Share of pixels that may differ from those of a window that was never touched: its numbers come in another order."""

FAINT = 16
"""Of 255: where a field has been computed anew, the edges of lines may be rounded differently by so much."""

KEPT = Path(os.environ["BIHDIST_KEPT"]) if os.environ.get("BIHDIST_KEPT") else None
"""Where the pictures that were compared are left."""


def faults(hands: Hands) -> list[str]:
    """In words; what was stopped is asked again before."""
    if parts(hands.window).choices.is_full_screen:
        parts(hands.window).choices.toggle_full_screen()
    hands.window.actions_by_word["live"].setChecked(False)
    parts(hands.window).gestures.set_live(False)
    hands.shut()
    hands.tool("mousemove", hands.screen.width() - 2, hands.screen.height() - 2)
    hands.window.session.show(hands.window.session.document)  # what was stopped is asked again
    if not hands.settle():
        return [f"never complete: {hands.window.session.progress}, {hands.done[-10:]}"]
    found = _untrue(hands)
    for word in hands.window.session.document.docks:  # a new window has them elsewhere, and its panels other sizes
        parts(hands.window).docks.close(word)
    hands.settle()
    return [*found, *_stale(hands)]


def _untrue(hands: Hands) -> list[str]:
    from app.document.quantities import quantity_name
    from app.qt.look.canvas import canvas_style
    from app.qt.look.look import LOOK
    from app.session.bar_ends import bar_end
    from app.session.questions import questions, source_at, vertex_at
    from bihdist_core.sources.words import words_of

    window, found = hands.window, []
    session, document = window.session, window.session.document
    asked = questions(document)
    if [panel.id for panel in window.grid.panels] != [panel.id for panel in document.panels]:
        found.append("other panels than the document's")
    for panel in document.panels:
        widget, shown = window.grid.panel(panel.id), session.shown[panel.id]
        answer, reading = widget.answer, widget.bar._reading
        top = bar_end(document, session.shown, panel.id, session.loaded) or answer.maximum
        facts = {
            "answer": answer is shown.answer and shown.question == asked[panel.id] and not shown.is_preview,
            "head": widget.head.shows == panel.shows
            and widget.head.name.accessibleName()
            == f"Shown here: {_plain(panel, session) or quantity_name(panel.shows)}",
            "style": widget.view.scene.style == canvas_style(window.context.page.style, LOOK.theme, document.colours),
            "source": widget.marks.source == _start(panel, document, session, vertex_at),
            "not dimmed": not widget.view._is_dimmed and widget.waiting.isHidden(),
            "maximum": answer.field is None or (reading.maximum == answer.maximum and reading.high == top),
            "unit": answer.field is None or reading.unit in (answer.unit, "misfit of the best"),
            "isolines": answer.field is None or len(reading.lines) == len(widget.view.scene.field_actor.levels.values),
        }
        found += [f"panel {panel.id} {panel.shows}: {fact}" for fact, holds in facts.items() if not holds]
    starting = [name for panel in document.panels for name in panel.shows.points]
    points = [document.point(name) for name in starting[:1]]
    known = "".join(words_of(source_at(point.at, session.loaded(point.surface).surface)) for point in points)
    if parts(window).typed_source.box.text() != known:
        found.append(f"the box says {parts(window).typed_source.box.text()!r}, the document {known}")
    names = ", ".join(dict.fromkeys(session.loaded(mesh.name).surface.name for mesh in document.surfaces))
    path = parts(window).session_file.path
    title = f"{Path(path).name}[*] - {names}" if path else f"{names}[*]"
    if window.windowTitle() != f"{title} - Biharmonic distance":
        found.append(f"title {window.windowTitle()}")
    if window.status.counts.text.removeprefix("A").split()[0].replace(",", "") != str(
        len(session.mesh().surface.vertices)
    ):
        found.append(f"counts {window.status.counts.text}")
    if window.status.vertex.text:
        found.append(f"still pointed at {window.status.vertex.text}")
    return found


def _stale(hands: Hands) -> list[str]:
    """Pictures that are others when all is drawn again, shown again, or shown in a new window."""
    window, found = hands.window, []
    before = _pictures(window)
    window.grid.redraw()
    found += _differing("drawn again", before, _pictures(window))
    parts(window).changes.show_all_again()
    hands.spin(0.3)
    found += _differing("shown again", before, _pictures(window))
    other = hands.new_window(type(window), window.session.document)
    other.context.page = window.context.page
    other.context.style_changed.emit()
    other.resize(window.size())
    other.show_document(window.session.document)
    hands.until(lambda: other.session.is_complete)
    hands.spin(0.5)
    found += _differing("in a new window", before, _pictures(other), SLACK)
    if KEPT:
        from PIL import Image

        for name, pictures in (("old", before), ("new", _pictures(other))):
            for k, picture in enumerate(pictures):
                Image.fromarray(picture).save(KEPT / f"{name}{k}.png")
        window.grab().save(str(KEPT / "window.png"))
        other.grab().save(str(KEPT / "other.png"))
    other.close()
    return found


def _pictures(window: object) -> list[np.ndarray]:
    return [panel.view.shot() for panel in window.grid.panels]


def _start(panel, document, session, vertex_at) -> int | None:
    names = panel.shows.points
    return vertex_at(document.point(names[0]).at, session.loaded(panel.surface).surface) if names else None


def _plain(panel, session) -> str:
    """The name of its surface, where a panel is the only one of it that predicts, and there is nothing to predict."""
    from app.tools.correspondence.quantity import predicts_in

    answer = session.shown[panel.id].answer
    alone = [other for other in session.document.panels_of(panel.surface) if predicts_in(other)] == [panel]
    return session.loaded(panel.surface).surface.name if alone and answer.field is None and not answer.failure else ""


def _differing(when: str, before: list, after: list, slack: float = 0.0) -> list[str]:
    if [picture.shape for picture in before] != [picture.shape for picture in after]:
        return [f"{when}: sizes {[p.shape for p in before]}, {[p.shape for p in after]}"]
    faint = FAINT if slack else 0
    parts = [float((np.abs(a.astype(int) - b).max(axis=2) > faint).mean()) for a, b in zip(before, after, strict=True)]
    return [f"{when}: panel at {k} differs in {part:.4%}" for k, part in enumerate(parts) if part > slack]
