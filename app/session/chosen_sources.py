"""The sources that are asked for, on a surface: listed, chosen by a rule (also in the background), or from a file."""

import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from bihdist_core import Distance, Laplacian, Surface
from bihdist_core.analysis.sampling import farthest_points, starts_of
from bihdist_core.analysis.upright import guess_up
from bihdist_core.arrays import BoolArray, IntArray
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import LandmarkWarning, ParameterError
from bihdist_core.file_content import file_text
from bihdist_core.formats.freesurfer import is_label
from bihdist_core.formats.mesh_names import mesh_format, mesh_name
from bihdist_core.formats.pins import Pins, picked_from, pins_format, placed
from bihdist_core.formats.vertex_values import is_vertex_values, read_label_vertices
from bihdist_core.formats.whole_numbers import numbered_lines, read_whole_numbers
from bihdist_core.progress import Progress, part
from bihdist_core.sources.pieces import pieces_of
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import short_words_of, source_from_words

from ..document.document import MeshFile
from ..document.lists import split_list
from ..document.sources import ALL, FARTHEST, FILE, LISTED, Sources
from ..samples import mesh_path
from .loaded_mesh import LoadedMesh
from .questions import first_source
from .repaired_surface import read_repaired

STANDARD_INPUT = "standard input"


@dataclass(frozen=True)
class Chosen:
    """The sources that were chosen on a mesh.

    Attributes
    ----------
    sources
        The sources, at least one, in order.
    pins
        The pins of a file that they are; None for sources from elsewhere.
    path
        The path of that file, "" for none.
    """

    sources: list[Source]
    pins: Pins | None = None
    path: str = ""

    def one(self) -> Source:
        """Return the only one; ParameterError for several."""
        if len(self.sources) > 1:
            raise ParameterError(
                f"This starts from one source, and --sources names {len(self.sources):,}; to measure from "
                "the nearest of several vertices, join them by +: 12+40."
            )
        return self.sources[0]

    def vertices(self, what: str) -> list[int]:
        """Their ids; ParameterError, which speaks of `what` is among vertices, for a source that is no vertex."""
        for each in self.sources:
            if not isinstance(each, int):
                raise ParameterError(f"{what} need vertices, and {short_words_of(each)} is not one.")
        return self.sources  # type: ignore[return-value]


def chosen_sources(
    asked: Sources,
    surface: Surface,
    distance: Callable[[], Distance],
    name: str = "",
    among: BoolArray | None = None,
    highest: Callable[[], int] | None = None,
    progress: Progress | None = None,
) -> Chosen:
    """Return the sources on a surface, at least one.

    Parameters
    ----------
    asked
        The choice of sources.
    surface
        The surface.
    distance
        Makes the distance by which points are farthest; called for these alone.
    name
        The text that stands for {name} in a file's path.
    among
        The vertices that rules choose from, a mask (n,); None for all vertices of faces.
    highest
        Finds the vertex to start from where nothing else is said.
    progress
        Called with the progress of farthest points.

    Raises
    ------
    VertexError, ParameterError
        For a source that is not on the surface.
    """
    highest = highest or (lambda: first_source(surface, guess_up(surface, mesh_format(surface.name))))
    if asked.rule == FILE:
        path = STANDARD_INPUT if asked.file == "-" else asked.file.replace("{name}", name)
        found = _read(path, asked.text, surface)
    elif asked.rule == LISTED:
        found = Chosen([*asked.members] or [highest()])
    elif asked.rule == FARTHEST:
        start = highest() if asked.start is None else starts_of(asked.start, surface)
        found = Chosen([*farthest_points(distance(), start, asked.count, progress, among).tolist()])
    else:
        vertices = np.flatnonzero(surface.component_of_vertex >= 0 if among is None else among)
        if asked.rule != ALL:
            if asked.count > len(vertices):
                what = "vertices" if among is None or among.all() else "vertices that are not masked"
                raise ParameterError(
                    f"{surface.name} has {len(vertices):,} {what}, fewer than the {asked.count:,} of random:"
                    f"{asked.count}."
                )
            vertices = np.sort(np.random.default_rng(asked.seed).choice(vertices, asked.count, replace=False))
        found = Chosen([*vertices.tolist()])
    if asked.rule in (FILE, LISTED):
        surface.check_vertices([each for each in found.sources if isinstance(each, int)])
        for each in found.sources:
            if not isinstance(each, int):
                pieces_of(each, surface)
    return found


def chosen_on(
    asked: Sources, mesh: MeshFile, spec: Spec, areas: str, progress: Progress | None = None, name: str = ""
) -> Chosen:
    """Return the sources on the mesh of a document; a list is not looked at."""
    if asked.rule == LISTED and asked.members:
        return Chosen([*asked.members])
    surface = read_repaired(mesh_path(mesh.path), mesh.repairs)
    found = chosen_sources(
        asked,
        surface,
        lambda: Distances(Laplacian(surface, areas, mesh.repairs.operator)).get(spec, progress),
        name or mesh_name(mesh.path),
        progress=progress,
    )
    if found.pins is not None:
        warn_of(found.path, found.pins.facts)
    return found


def warn_of(path: str, facts: Iterable[str]) -> None:
    """Warn of what is known of the positions in a file of landmarks, where no command says it."""
    for fact in facts:
        warnings.warn(f"{path}: {fact}.", LandmarkWarning, stacklevel=2)


def parts_of(line: str) -> list[str]:
    """Return the words of a line without its remark."""
    return [part for each in line.partition("#")[0].split() if (part := each.strip(","))]


def _source(word: str) -> Source:
    """Read a source from words, or from a vertex id that is written as a float is."""
    with suppress(ValueError):
        if (number := float(word)).is_integer() and 0 <= number < 1e15:
            return int(number)
    return source_from_words(word)


def _read(path: str, text: str, surface: Surface) -> Chosen:
    """Read a file: vertex ids in a .npy or a label, pins, or lines of what a list has, with remarks after #."""
    if is_label(path):
        found: list[Any] = surface.check_vertices(read_label_vertices(path, surface.n_vertices)).tolist()
    elif is_vertex_values(path):
        raise ParameterError(f"{path} has a value for each vertex; sources are the ids of some, as .npy or .txt.")
    elif Path(path).suffix.lower() == ".npy":
        found = surface.check_vertices(read_whole_numbers(path, "list of sources")).tolist()
    else:
        text = text or file_text(path, "sources in")
        if format := pins_format(text):
            pins = placed(picked_from(text, Path(path).name, format), surface)
            return Chosen([*pins.vertices.tolist()], pins, path)
        found = []
        for number, line in numbered_lines(text):
            try:
                found += [_source(word) for part in parts_of(line) for word in split_list(part)]
            except ParameterError as error:
                raise ParameterError(f"{path}, line {number}: {error}") from None
    if not found:
        raise ParameterError(f"{path} names no source.")
    return Chosen(found, path=path)


@dataclass(frozen=True, eq=False)
class SamplesRequest:
    """A request for a number of vertices from a source, each the farthest from those before it by a distance."""

    loaded: LoadedMesh
    areas: str
    spec: Spec
    at: Source
    count: int


def find_samples(request: SamplesRequest, progress: Progress) -> Iterator[IntArray]:
    """Yield the vertices (count,) of a request; VertexError or ParameterError for a source that is not on vertices."""
    starts = starts_of(request.at, request.loaded.surface)
    distance = request.loaded.distances(request.areas).get(request.spec, part(progress, 0, 0.5))
    yield farthest_points(distance, starts, request.count, part(progress, 0.5, 1))
