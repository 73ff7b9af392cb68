"""Edits between panels of distances and panels that predict where a point of one surface is on the other."""

from dataclasses import replace

from bihdist_core.distances.kinds import Spec

from ...document import edits
from ...document.document import Document, Panel
from .pairs import sides
from .quantity import Prediction


def predict(document: Document) -> Document:
    """The first surface in one panel, the second in a panel for each distance that was shown, which predicts by it.

    ParameterError where there are not two surfaces.
    """
    first, second = sides(document)
    found = [spec for panel in document.panels for spec in panel.shows.specs]
    specs = list(dict.fromkeys(found))[: edits.MOST_ADDED - 1] or [Spec.of("biharmonic")]
    wanted = [(first, specs[0]), *((second, spec) for spec in specs)]
    ids = {name: [panel.id for panel in document.panels_of(name)] for name in (first, second)}
    panels, next_id = [], document.next_id
    for surface, spec in wanted:
        if ids[surface]:
            id = ids[surface].pop(0)
        else:
            id, next_id = next_id, next_id + 1
        panels.append(Panel(id, Prediction(spec), surface))
    return replace(document, panels=tuple(panels), next_id=next_id, range="own")


def predicts(document: Document) -> bool:
    """Whether a panel shows a prediction."""
    return any(predicts_in(panel) for panel in document.panels)


def predicts_in(panel: Panel) -> bool:
    """Whether this one does."""
    return isinstance(panel.shows, Prediction)


def show_distances(document: Document) -> Document:
    """Every panel of a prediction shows its distance, from where others start."""
    return edits.show_distances(document, predicts_in)
