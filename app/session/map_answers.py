"""Maps between the two surfaces of a document: in files or from its pairs, and the colours that say where they lead."""

from typing import TYPE_CHECKING

import numpy as np

from bihdist_core import BihdistError, Cancelled, ParameterError, Surface, VertexError
from bihdist_core.applications.carrying import carried_back, position_colours
from bihdist_core.applications.correspondence import NOWHERE
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, failed
from bihdist_core.formats.vertex_maps import read_map
from bihdist_core.progress import Progress, part

from ..document.file import checksum
from ..document.map_colours import SAME_IDS, MapFile
from .prediction_answers import NO_OTHER, correspondence
from .questions import MapQuestion, PositionQuestion

if TYPE_CHECKING:
    from .loaded_mesh import LoadedMesh

NO_PAIRS = "There is no pair yet, and pairs make the map."
"""What a panel of a map says where there can be none."""


def positions(question: PositionQuestion, loaded: "LoadedMesh") -> Answer:
    """A surface in colours by position."""
    colours = position_colours(loaded.surface)
    colours.flags.writeable = False
    return Answer(label=str(question), colours=colours, error_estimate=ErrorEstimate())


def mapped(question: MapQuestion, loaded: "LoadedMesh", progress: Progress | None) -> Answer:
    """Each vertex in the colour of the one that it is mapped to."""
    other = loaded.standing_beside(question.other)
    if other is None:
        return Answer(label=str(question), failure=NO_OTHER)
    try:
        if isinstance(question.by, MapFile):
            found, label = map_in(question.by, loaded.surface, other.surface), f"map {question.by.name}"
        elif not question.pairs:
            return Answer(label=str(question), failure=NO_PAIRS)
        else:
            known = correspondence(question.areas, question.by, question.pairs, loaded, other, part(progress, 0, 0.5))
            found, label = known.map(progress=part(progress, 0.5, 1)), f"map by {known.distance_m.label}"
        colours = carried_back(position_colours(other.surface), found)
    except (Cancelled, VertexError):
        raise
    except (BihdistError, MemoryError) as error:
        return failed(str(question), error)
    found.flags.writeable = colours.flags.writeable = False
    return Answer(
        label=label, colours=colours, leads_to=found, error_estimate=ErrorEstimate(), remark=_said(found, other.surface)
    )


def _said(found: np.ndarray, onto: Surface) -> str:
    """How much of the other surface is reached, and how many vertices are mapped nowhere."""
    reached, count = len(np.unique(found[found != NOWHERE])), len(onto.vertices)
    said = f"{reached:,} of {count:,} vertices of {onto.name} are reached"
    lost = int((found == NOWHERE).sum())
    return f"{said}, {lost:,} are mapped nowhere (grey)" if lost else said


def colours_words(answer: Answer | None) -> tuple[str, ...]:
    """What the colours of an answer say, and the same shorter; () of one that has none."""
    if answer is None or answer.colours is None:
        return ()
    if answer.leads_to is None:
        return "red, green and blue from x, y and z", "coloured by position", ""
    reached = len(np.unique(answer.leads_to[answer.leads_to != NOWHERE]))
    return answer.remark, f"{reached:,} vertices are reached", ""


def map_file(path: str, one: Surface, two: Surface) -> MapFile:
    """What a document calls a map in a file, from one surface to another; ParameterError for what is none."""
    if path != SAME_IDS:
        read_map(path, one, two)
    return MapFile(path, "" if path == SAME_IDS else checksum(path))


def map_in(map: MapFile, one: Surface, two: Surface) -> np.ndarray:
    """(n,) the map; ParameterError if the file is not what it was, or no map between these surfaces."""
    if map.sha256 and checksum(map.path) != map.sha256:
        raise ParameterError(f"The map {map.path} is not what it was when it was chosen (its checksum differs).")
    return read_map(map.path, one, two)
