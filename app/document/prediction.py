"""Edits between panels of distances and panels that predict where a point of one surface is on the other."""

from collections.abc import Callable
from dataclasses import replace

from bihdist_core.distances.kinds import Spec

from .document import Document, Panel, free_names
from .edits import MOST_ADDED, put_point, source_name
from .pairs import sides
from .quantities import DistanceFrom, quantity

PREDICTION = "prediction by "
"""What the words of a prediction begin with."""


def predict(document: Document) -> Document:
    """The first surface in one panel, the second in a panel for each distance that was shown, which predicts by it.

    ParameterError where there are not two surfaces.
    """
    first, second = sides(document)
    found = [spec for panel in document.panels for spec in panel.shows.specs]
    specs = list(dict.fromkeys(found))[: MOST_ADDED - 1] or [Spec.of("biharmonic")]
    wanted = [(first, specs[0]), *((second, spec) for spec in specs)]
    ids = {name: [panel.id for panel in document.panels_of(name)] for name in (first, second)}
    panels, next_id = [], document.next_id
    for surface, spec in wanted:
        if ids[surface]:
            id = ids[surface].pop(0)
        else:
            id, next_id = next_id, next_id + 1
        panels.append(Panel(id, quantity(f"{PREDICTION}{spec.in_full}"), surface))
    return replace(document, panels=tuple(panels), next_id=next_id, range="own")


def predicts(document: Document) -> bool:
    """Whether a panel shows a prediction."""
    return any(predicts_in(panel) for panel in document.panels)


def predicts_in(panel: Panel) -> bool:
    """Whether this one does."""
    return panel.shows.is_prediction


def show_distances(document: Document, is_meant: Callable[[Panel], bool] = predicts_in) -> Document:
    """Every panel of a prediction, or of what is meant, shows its distance from where others start."""
    for panel in document.panels:
        if not is_meant(panel):
            continue
        (spec,), name = panel.shows.specs, source_name(document, panel.id)
        if not name:
            here = [p.name for p in document.points if p.name.startswith("source") and p.surface == panel.surface]
            name = (here or free_names("source", 1, [point.name for point in document.points]))[0]
        if all(point.name != name for point in document.points):
            document = put_point(document, name, None, panel.surface)
        shown = replace(panel, shows=DistanceFrom(spec, name), maximum=None)
        document = replace(document, panels=tuple(shown if p.id == panel.id else p for p in document.panels))
    return document
