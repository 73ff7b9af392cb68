"""`bihdist field`: distances of all vertices, into a file; and the field that other commands compute."""

import argparse
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bihdist_core.counts import counted
from bihdist_core.errors import ParameterError
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.document import Document, FieldArray
from ..document.file_names import distinct, field_name
from ..document.page import Recipe
from ..document.quantities import OwnField, Quantity, VertexSignature
from ..document.repairs import NAME
from ..figures.look_options import COLOURS
from ..figures.options import with_rows
from .figure import tell_other_colours
from .mesh import add_meshes, check_array_output, first_spec, into_each, name_output, read_laplacian, sources_on
from .options import add_areas, add_distance, add_output, add_rows, add_sources, given, positive, quantities
from .terminal import Facts, Result, accuracy_facts, progress_line, tell_accuracy

if TYPE_CHECKING:
    from bihdist_core import Laplacian, Surface
    from bihdist_core.arrays import ByteArray, FloatArray
    from bihdist_core.distances.answers import Answer


@dataclass(frozen=True, eq=False)
class CommandField:
    """A quantity from the sources of a command: its answer, whose field is (n,) from one source or (n, k) from k, and
    how accurate it is, as it is printed behind a label."""

    laplacian: "Laplacian"
    sources: list[Source]
    shows: Quantity
    answer: "Answer"
    accuracy: str

    @property
    def facts(self) -> Facts:
        """The facts about the field, without its values."""
        about = {"distance": str(self.shows), "label": self.answer.label, "unit": self.answer.unit}
        return {**about, **accuracy_facts(self.answer.accuracy)}

    @property
    def word(self) -> str:
        """The name of the field in letters, digits and `_`."""
        return field_name(self.shows, ()).removesuffix("_percent")

    @property
    def surface(self) -> "Surface":
        """The surface of the field."""
        return self.laplacian.surface

    @property
    def field(self) -> "FloatArray":
        """The values, NaN where there is none."""
        assert self.answer.field is not None
        return self.answer.field


def field_of(
    options: argparse.Namespace,
    words: str | None,
    progress: Progress | None,
    before: CommandField | None = None,
    several: bool = False,
) -> CommandField:
    """Return the field that `words` name, from the sources and with the parameters of the options; None stands for the
    first field of the options, else for the biharmonic distance.

    `before` is another field of the same mesh from the same sources.  Raises ParameterError for several sources unless
    `several` allows them.
    """
    from bihdist_core.distances.answers import Answer, Distances, difference_of
    from bihdist_core.sources.pieces import pieces_of

    from ..session.questions import signature_answer

    fields = {field.name: field for field in options.fields or ()}
    (chosen,) = quantities(options, [words or next(iter(fields), "biharmonic")])
    laplacian = before.laplacian if before else read_laplacian(options)
    distances = Distances(laplacian)
    if before:
        sources = before.sources
    else:
        found = sources_on(options, laplacian.surface, lambda: distances.get(first_spec([chosen]), progress), progress)
        sources = found.sources if several and chosen.points else [found.one()] if chosen.points else found.sources[:1]
    pieces = [pieces_of(each, laplacian.surface) for each in sources]
    answers, accuracies = [], []
    for each in chosen.parts:
        if isinstance(each, OwnField):
            answer = _given(fields[each.name], laplacian.surface)
            answers.append(_repeated(answer, sources) if several else answer)
            continue
        if isinstance(each, VertexSignature):
            answer = signature_answer(each.spec, laplacian, progress)
            accuracies.append(f", {answer.accuracy.text}" if answer.accuracy.text else "")
            answers.append(_repeated(answer, sources) if several else answer)
            continue
        (spec,) = each.specs
        distance = distances.get(spec, progress)
        field = distance.from_sources(sources, progress) if several else distance.from_source(sources[0], progress)
        estimate = distance.error_estimate(pieces=pieces)
        label = " or ".join(dict.fromkeys(distance.label_from(each) for each in pieces))
        answers.append(Answer(label=label, unit=distance.unit, field=field, error_estimate=estimate, is_distance=True))
        accuracies.append(tell_accuracy(distance, estimate))
    answer = answers[0]
    if chosen.is_difference:
        answer = difference_of(answers[0], answers[1], raw=not chosen.in_percent)
    if answer.failure:
        raise ParameterError(answer.failure)
    check_values(answer)
    return CommandField(laplacian, sources, chosen, answer, "".join(dict.fromkeys(accuracies)))


def _repeated(answer: "Answer", sources: list[Source]) -> "Answer":
    """Return an answer that is the same from every source, as (n, k)."""
    import numpy as np

    field = answer.field
    return answer if field is None else replace(answer, field=np.repeat(field[:, None], len(sources), axis=1))


def check_values(*answers: "Answer") -> None:
    """Raise ParameterError for an answer that is shown in colours, and has no values."""
    for answer in answers:
        if answer.colours is not None:
            raise ParameterError(f"{answer.label} has labels, and no values.")


def _given(field: FieldArray, surface: "Surface") -> "Answer":
    """Return a field of the options; ParameterError unless it has a value for each vertex of the surface."""
    from ..session.array_store import ArrayStore

    store = ArrayStore()
    return store.answer(store.add_file(field), surface)


COLOURS_OF_VERTICES = COLOURS[:2]
"""Without bands, which are made of triangles and not of vertices."""

WORDS = "compute distances of all vertices from one or more sources, or a signature of each"
EXAMPLES = (
    "bihdist field hand --sources 12 -o hand.npy",
    "bihdist field hand --sources 12,40 --distance 'diffusion(t=1/4)' -o hand.csv",
    "bihdist field hand --sources 12 --cmap safe -o hand.ply",
)
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `field` to its parser."""
    add_meshes(parser)
    add_sources(parser, "where distances start, a field each")
    files = "a .npy, .csv, .vtp, .vtu, .func.gii or .shape.gii file, or with colours .ply, .obj or .glb"
    add_output(parser, f"{files}; {NAME} is that of each mesh", usual="-field.npy")
    add_distance(parser, is_field=True)
    add_areas(parser)
    add_rows(parser, *COLOURS_OF_VERTICES)
    parser.add_argument(
        "--clim",
        type=positive,
        metavar="END",
        help="the value at which the colours end, for a difference a fraction (default: the maximum)",
    )


def run(options: argparse.Namespace) -> Result:
    """Write the distances of all vertices from each source; the exit status is 1 if a mesh failed."""
    name_output(options)
    return into_each(options, _one)


def _one(options: argparse.Namespace) -> Facts:
    from bihdist_core.distances.difference import PERCENTAGE_POINTS
    from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
    from bihdist_core.formats.surface_output import COLOURED_FORMATS, write_coloured

    extension = check_array_output(options.output, tuple(dict.fromkeys((*FIELD_FORMATS, *COLOURED_FORMATS))), "fields")
    asked = [
        f"--{name}" for name in ("cmap", "flip-scalars", "clim") if getattr(options, name.replace("-", "_")) is not None
    ]
    if asked and extension not in COLOURED_FORMATS:
        raise ParameterError(f"{asked[0]} goes with {', '.join(COLOURED_FORMATS)}; {extension} has no colours.")
    with progress_line() as progress:
        it = field_of(options, options.distance, progress, several=True)
    label = f"{it.answer.label}, {it.answer.unit}" if it.answer.unit == PERCENTAGE_POINTS else it.answer.label
    names = distinct([field_name(it.shows, [each] if it.shows.points else []) for each in it.sources])
    fields = dict(zip(names, it.field.T, strict=True))
    size = counted(it.field.shape[0], *it.surface.nouns)
    size += f", {counted(it.field.shape[1], 'source')}" if it.shows.points else ""
    if extension in COLOURED_FORMATS and (len(fields) == 1 or asked or extension not in FIELD_FORMATS):
        if len(fields) > 1:
            raise ParameterError(
                f"The colours of vertices show one field, and --sources names {len(fields)}; name one, or write .vtp."
            )
        top = it.answer.maximum if options.clim is None else options.clim * it.answer.scale
        write_coloured(options.output, it.surface, _colours(options, it, top), fields)
        size += f", colours from {-top if it.answer.is_signed else 0:.4g} to {top:.4g}"
    else:
        write_fields(options.output, it.surface, fields)
    print(f"{options.output}: {label}, {size}{it.accuracy}")
    return {**it.facts, "shape": list(it.field.shape), "columns": names}


def _colours(options: argparse.Namespace, it: CommandField, top: float) -> "ByteArray":
    """Return the colours (n, 3) of the only field, as a panel with the colour map of the options shows them."""
    from ..scene.style import style_of

    values = given(options, *COLOURS_OF_VERTICES)
    tell_other_colours(values)
    colours = with_rows(Recipe(Document()), values, COLOURS_OF_VERTICES).document.colours
    return style_of("paper", colours).vertex_colours(it.field[:, 0], top, it.answer.is_signed)
