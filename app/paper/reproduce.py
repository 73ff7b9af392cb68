"""Run experiments, draw them, and write the page."""

import textwrap
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from bihdist_core import (
    Laplacian,
    OutputError,
    ParameterError,
    Surface,
    read_surface,
)
from bihdist_core.analysis.upright import guess_up
from bihdist_core.distances.answers import Answer, Distances
from bihdist_core.distances.kinds import Spec
from bihdist_core.experiments import EXPERIMENTS, Experiment, Parts, Result, Shapes
from bihdist_core.experiments.verdicts import FAILS, HOLDS, VERDICTS
from bihdist_core.formats.mesh_names import MESH_FORMATS, is_mesh_file, mesh_format, mesh_name
from bihdist_core.progress import Progress, part
from bihdist_core.whole_file import whole_file

from ..figures.draw import Figure, FigurePanel, check_offscreen
from ..figures.size import Size
from ..marks.primitives import PointMark
from ..samples import SAMPLES
from ..session.questions import first_source
from .charts import chart_svg
from .drawing import Picture, Pictures, Written
from .live import LivePage, live_pages
from .page import Named, Section, page
from .pictures import FINER, figure_of, name_of, rows_of

FOLDER_EXPERIMENTS = ("fig1", "claims")
"""What is done for each mesh of a folder: a picture and the numbers."""

PAGE = "index.html"

SHORT = 100
"""Letters of a statement, and of what was measured, in a line."""

SHEET, SHEET_COLUMNS = 40, 5
"""Meshes on a contact sheet, and side by side on it."""


@dataclass(frozen=True)
class Asked:
    """What is being made for a section: pictures by their captions, and pages that compute."""

    pictures: dict[str, Picture] = field(default_factory=dict)
    pages: list[tuple[LivePage, Written]] = field(default_factory=list)


@dataclass(frozen=True)
class Reproduction:
    """page: the path of index.html; not_done: how many parts, or whole experiments and meshes, could not be done."""

    page: Path
    not_done: int


def reproduce(
    out: str,
    only: Sequence[str] = (),
    mesh: str | None = None,
    quick: bool = False,
    progress: Progress | None = None,
    say: Callable[[str], None] = print,
    up: str = "auto",
) -> Reproduction:
    """Write results, pictures and index.html into the folder `out`.

    only: ids of experiments, all if empty.  mesh: the reader's own mesh, or a folder of meshes, instead of the
    bundled ones.  up: the axis that is up; left alone it is y for the bundled meshes, and guessed for those of the
    reader's own.  A part that cannot be done is on the page with the reason.  `say` gets a line for each.
    Raises ParameterError for an unknown id, OutputError if something cannot be written.
    """
    check_offscreen()
    chosen = _chosen(only, mesh)
    folder = Path(out)
    _make(folder)
    if mesh is not None and Path(mesh).is_dir():
        with Pictures() as pictures:
            return _each_mesh(folder, Path(mesh), _of_folder(chosen, only), quick, progress, say, up, pictures)
    missing = Parts()
    if mesh is None:
        up = "y" if up == "auto" else up
        shapes = Shapes.from_folder(SAMPLES)
    else:
        surface = read_surface(mesh)
        up = _up(up, surface, mesh, missing)
        shapes = Shapes(own=surface, up=up)
    with Pictures() as pictures:
        here = f"{folder / PAGE}#"
        sections = _sections(folder, chosen, shapes, quick, progress, say, here, up, pictures)
    for each in missing.not_done:
        say(f"not done: {each}")
        sections.append(Section(Named("up", each.part), None, failure=each.reason))
    about = "the bundled meshes" if mesh is None else Path(mesh).name
    return _written(folder, sections, about, quick, before=mesh is None and not quick)


def _up(up: str, surface: Surface, path: str | Path, parts: Parts) -> str:
    """The axis that is up; y where it cannot be guessed."""
    if up != "auto":
        return up
    return parts.do(f"which way {Path(path).name} is up", guess_up, surface, mesh_format(path)) or "y"


def _chosen(only: Sequence[str], mesh: str | None) -> list[Experiment]:
    unknown = [name for name in only if name not in EXPERIMENTS]
    if unknown:
        raise ParameterError(f"There is no experiment {unknown[0]!r}; choose among {', '.join(EXPERIMENTS)}.")
    chosen = [e for name, e in EXPERIMENTS.items() if not only or name in only]
    if mesh is None:
        return chosen
    possible = [experiment for experiment in chosen if experiment.any_mesh]
    if not possible:
        raise ParameterError(f"{', '.join(only)} makes sense on the bundled meshes only.")
    return possible


def _of_folder(chosen: Sequence[Experiment], only: Sequence[str]) -> list[Experiment]:
    """Of those chosen what is done for each mesh of a folder."""
    return [experiment for experiment in chosen if only or experiment.id in FOLDER_EXPERIMENTS]


def _sections(
    folder: Path,
    chosen: Sequence[Experiment],
    shapes: Shapes,
    quick: bool,
    progress: Progress | None,
    say: Callable[[str], None],
    read_more: str,
    up: str,
    pictures: Pictures,
) -> list[Section]:
    """In the order chosen; read_more: where the page has what is said of an experiment, to be followed by its id."""
    done: dict[str, tuple[Section, Asked]] = {}
    # What is timed comes first: no pictures are being drawn then.
    for k, experiment in enumerate(sorted(chosen, key=lambda each: not each.is_timed)):
        mine = part(progress, k / len(chosen), (k + 1) / len(chosen))
        section, asked = _section(folder, experiment, shapes, quick, mine, up, pictures)
        done[experiment.id] = section, asked
        if section.result is None:
            say(f"{experiment.id}: not done: {section.failure}")
        else:
            say(f"{experiment.id}: {_judged(section.result)}, {section.result.seconds:.1f} s")
            for warning in dict.fromkeys(claim.warning for claim in section.result.claims if claim.warning):
                say(f"  warning: {warning}")
            for missing in section.not_done:
                say(f"  not done: {missing}")
            for line in _not_held(section.result, f"{read_more}{experiment.id}"):
                say(line)
    return [_with_pictures(*done[experiment.id], say) for experiment in chosen]


def _with_pictures(section: Section, asked: Asked, say: Callable[[str], None]) -> Section:
    """A section when its pictures are drawn, and its pages that compute are written."""
    parts = Parts()
    found = [(row, parts.do(f"the picture {row}".strip(), picture)) for row, picture in asked.pictures.items()]
    written = [(page, parts.do(f"the live page {page.file}", size)) for page, size in asked.pages]
    for missing in parts.not_done:
        say(f"{section.experiment.id}: not done: {missing}")
    result = section.result and replace(section.result, not_done=(*section.result.not_done, *parts.not_done))
    pictures = tuple((row, each) for row, each in found if each)
    live = tuple((page, size) for page, size in written if size)
    return replace(section, result=result, pictures=pictures, live=live)


def _judged(result: Result) -> str:
    """How many of the statements have each verdict."""
    counts = [(verdict, sum(claim.verdict == verdict for claim in result.claims)) for verdict in (*VERDICTS, None)]
    return ", ".join(f"{count} {_many(verdict, count)}" for verdict, count in counts if count) or "no statements"


def _many(verdict: str | None, count: int) -> str:
    several = {HOLDS: "hold", FAILS: "do not hold"}
    return "not judged" if verdict is None else several.get(verdict, verdict) if count > 1 else verdict


def _not_held(result: Result, where: str) -> list[str]:
    """A line for each statement that does not hold, or only partly, and where to read more."""
    lines = []
    for claim in result.claims:
        if claim.verdict != HOLDS:
            text, measured = (textwrap.shorten(words, SHORT, placeholder="…") for words in (claim.text, claim.measured))
            lines.append(f"  {claim.verdict or 'not judged'}: {text.rstrip('.')} ({measured.rstrip('.')})")
    return [*lines, f"  more in {where}"] if lines else []


def _section(
    folder: Path,
    experiment: Experiment,
    shapes: Shapes,
    quick: bool,
    progress: Progress,
    up: str,
    pictures: Pictures,
) -> tuple[Section, Asked]:
    """An experiment's section, and its pictures and pages, which are being made."""
    parts = Parts()
    result = parts.do(experiment.title, experiment.compute, shapes, quick, part(progress, 0, 0.9))
    if result is None:
        return Section(experiment, None, failure=parts.not_done[0].reason), Asked()
    result.save(folder)
    asked, charts = Asked(), []
    for row, panels in rows_of(result).items():
        figure = parts.do(f"the picture {row}".strip(), figure_of, result, panels, up)
        if figure is not None:
            asked.pictures[row] = pictures.draw(folder, name_of(result, row), figure)
        live = parts.do(f"live pages {row}".strip(), live_pages, result, row, panels, up)
        asked.pages.extend((each, pictures.write(folder, each)) for each in live or ())
    for chart in result.charts:
        svg = parts.do(f"the chart {chart.heading}", chart_svg, chart)
        charts += [] if svg is None else [svg]
    result = replace(result, not_done=(*result.not_done, *parts.not_done))
    return Section(experiment, result, charts=tuple(charts)), asked


def _each_mesh(
    folder: Path,
    meshes: Path,
    chosen: Sequence[Experiment],
    quick: bool,
    progress: Progress | None,
    say: Callable[[str], None],
    up: str,
    pictures: Pictures,
) -> Reproduction:
    """The claims and a picture of each mesh of a folder; one that fails is named and the others go on."""
    paths = sorted(path for path in meshes.iterdir() if is_mesh_file(path))
    if not paths:
        raise ParameterError(f"{meshes} holds no meshes ({', '.join(MESH_FORMATS)}).")
    names = Counter(map(mesh_name, paths))
    sections: list[Section] = []
    surfaces: list[tuple[Surface, str]] = []
    missing = Parts()
    for k, path in enumerate(paths):
        say(path.name)
        mine = part(progress, k / len(paths), (k + 1) / len(paths))
        name = mesh_name(path)
        name = name if names[name] == 1 else path.name.replace(".", "-")
        parts = Parts()
        surface = parts.do(path.name, read_surface, path)
        if surface is None:
            reason = parts.not_done[0].reason
            say(f"not done: {reason}")
            sections.append(Section(_named(chosen[0], name, path), None, failure=reason))
            continue
        its_up = _up(up, surface, path, missing)
        shapes = Shapes(own=surface, up=its_up)
        place = folder / name
        _make(place)
        here = f"{folder / PAGE}#{name}-"
        for section in _sections(place, chosen, shapes, quick, mine, say, here, its_up, pictures):
            live = tuple((replace(each, file=f"{name}/{each.file}"), size) for each, size in section.live)
            sections.append(replace(section, experiment=_named(section.experiment, name, path), live=live))
        surfaces.append((surface, its_up))
    if surfaces:
        sections.insert(0, _contact_sheets(folder, surfaces, missing, pictures))
        for each in missing.not_done:
            say(f"not done: {each}")
    return _written(folder, sections, f"{len(paths)} meshes of {meshes.name}", quick)


def _named(experiment: Experiment | Named, name: str, path: Path) -> Named:
    return Named(f"{name}-{experiment.id}", f"{path.name}: {experiment.title}")


def _contact_sheets(folder: Path, surfaces: Sequence[tuple[Surface, str]], parts: Parts, pictures: Pictures) -> Section:
    """Biharmonic distance on every mesh, which has its axis up, from its highest vertex, many to a picture.

    parts: what could not be done before; it gets what cannot be done here.
    """
    sheets = []
    for start in range(0, len(surfaces), SHEET):
        panels = [_on_sheet(surface, up, parts) for surface, up in surfaces[start : start + SHEET]]
        columns = min(SHEET_COLUMNS, len(panels))
        sheet = Figure(tuple(panels), columns=columns, size=Size(FINER * 230 * columns, dpi=FINER * 96))
        number = start // SHEET + 1
        picture = parts.do(f"contact sheet {number}", pictures.draw(folder, f"contact-sheet-{number}", sheet))
        sheets += [("", picture)] if picture else []
    named = Named("all", "All meshes", "Biharmonic distance from each mesh's highest vertex.")
    return Section(named, None, tuple(sheets), missing=tuple(parts.not_done))


def _on_sheet(surface: Surface, up: str, parts: Parts) -> FigurePanel:
    name = f"{surface.name} on the contact sheet"
    source = parts.do(name, first_source, surface, up)
    answer = None if source is None else parts.do(name, _biharmonic, surface, source)
    if source is None or answer is None:
        return FigurePanel(surface, None, surface.name, failure=parts.why(name), up=up)
    if answer.failure:
        parts.note(name, answer.failure)
    return FigurePanel(surface, answer.field, surface.name, marks=(PointMark(source),), failure=answer.failure, up=up)


def _biharmonic(surface: Surface, source: int) -> Answer:
    return Distances(Laplacian(surface)).answer(Spec.of("biharmonic"), source)


def _written(folder: Path, sections: Sequence[Section], about: str, quick: bool, before: bool = False) -> Reproduction:
    introduction = (
        "The figures and tables of Lipman, Rustamov and Funkhouser, Biharmonic Distance (ACM Transactions on Graphics "
        f"29(3), 2010), computed anew on {about}. Numbers stand as measured, also where a statement does not hold. "
        "The data of every picture is beside this page, as .npz and .csv files. A mark with a dashed outline is on the "
        "far side of the shape."
    )
    if quick:
        introduction += " This is the quick version, with smaller meshes and fewer samples."
    path = folder / PAGE
    with whole_file(path) as temporary:
        text = page("Biharmonic Distance, reproduced", introduction, sections, quick, before)
        temporary.write_text(text, encoding="utf-8")
    return Reproduction(path, sum(len(section.not_done) for section in sections))


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"The folder {folder} cannot be made: {error.strerror or error}.") from None
