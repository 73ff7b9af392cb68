"""Run experiments, draw them in a process beside the next one, and write the page."""

import io
import textwrap
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import TracebackType
from typing import Any

from bihdist_core import BihdistError, Laplacian, OutputError, ParameterError, Surface, read_surface
from bihdist_core.analysis.upright import guess_up
from bihdist_core.distances.answers import Answer, Distances
from bihdist_core.distances.distance_types import Spec
from bihdist_core.experiments import EXPERIMENTS, Experiment, Parts, Result, Shapes
from bihdist_core.experiments.verdicts import FAILS, HOLDS, VERDICTS
from bihdist_core.file_output import atomic_write
from bihdist_core.formats.mesh_names import MESH_FORMATS, is_mesh_file, mesh_format, mesh_name
from bihdist_core.progress import Progress, part, steps

from ..figures.draw import Figure, FigurePanel, check_offscreen, draw_figure
from ..figures.shots import RenderCache
from ..figures.size import Size
from ..figures.worker import GONE, Worker
from ..marks.primitives import PointMark
from ..samples import SAMPLES
from ..session.questions import first_source
from .charts import chart_svg
from .live import LivePage, live_pages, write_live
from .page import Named, Section, page
from .pictures import FINER, figure_of, name_of, rows_of
from .verdicts import QUICK

Picture = Callable[[], bytes]
"""Waits for a picture, and gives its PNG; raises BihdistError if it could not be drawn, OutputError if not written."""

Written = Callable[[], int]
"""Waits for a page that computes, and gives its size in bytes; raises as `Picture` does."""


class Pictures:
    """A context: within it pictures are drawn, and pages written, one after another."""

    def __enter__(self) -> "Pictures":
        self._worker: Worker | None = None
        self._turn = ThreadPoolExecutor(1, thread_name_prefix="pictures")
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._turn.shutdown(wait=False, cancel_futures=True)
        if self._worker is not None:
            self._worker.close()

    def draw(self, folder: Path, name: str, figure: Figure) -> Picture:
        """Start to draw a figure as NAME.png."""

        def drawn() -> bytes:
            content: bytes = self._ask(png, figure)
            with atomic_write(folder / f"{name}.png") as temporary:
                temporary.write_bytes(content)
            return content

        return self._turn.submit(drawn).result

    def write(self, folder: Path, page: LivePage) -> Written:
        """Start to write a page that computes into a folder."""
        return self._turn.submit(self._ask, write_live, page, folder / page.file).result

    def _ask(self, function: Callable[..., Any], *arguments: object) -> Any:
        """Run a function in the process that draws, which starts with the first picture, and again after it has
        ended."""
        if self._worker is None:
            self._worker = Worker(threads=1)
        try:
            return self._worker.ask(function, *arguments)
        except BihdistError as error:
            if str(error) == GONE:
                self._worker.close()
                self._worker = None
            raise


def png(figure: Figure) -> bytes:
    """Return a figure as a PNG file."""
    from PIL import Image

    buffer = io.BytesIO()
    # It has more pixels than the page shows of it: with still finer ones it takes half as long again.
    with RenderCache(finer=1) as render_cache:
        pixels = draw_figure(figure, render_cache=render_cache)
    Image.fromarray(pixels).save(buffer, "PNG")  # optimized it is 2 % smaller, in five times as long
    return buffer.getvalue()


FOLDER_EXPERIMENTS = ("fig1", "claims")
"""The experiments that are run on each mesh of a folder, unless others are named: a picture and the numbers."""

PAGE = "index.html"

LONGEST_TEXT = 100
"""Characters of a statement, and of a measurement, in a line."""

MESHES_PER_SHEET, SHEET_COLUMNS = 40, 5


@dataclass(frozen=True)
class Run:
    """The options that every section of a reproduction shares; `say` gets a line for each experiment."""

    folder: Path
    experiments: Sequence[Experiment]
    quick: bool
    up: str
    progress: Progress | None
    say: Callable[[str], None]
    pictures: Pictures

    @property
    def page(self) -> Path:
        """The path of the page."""
        return self.folder / PAGE


@dataclass(frozen=True)
class Subject:
    """The shapes of some sections, the axis that is up, and where their files go."""

    shapes: Shapes
    up: str
    folder: Path


@dataclass(frozen=True)
class SectionDrawings:
    """The pictures by their captions, and the pages that compute, that are being made for a section."""

    pictures: dict[str, Picture] = field(default_factory=dict)
    pages: list[tuple[LivePage, Written]] = field(default_factory=list)


@dataclass(frozen=True)
class Reproduction:
    """The path of index.html, and how many parts, experiments or meshes could not be done."""

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

    `only` lists ids of experiments, all if empty. `mesh` is the reader's own mesh, or a folder of meshes, instead of
    the bundled ones. `up` is the axis that is up; left alone it is y for the bundled meshes, and guessed for the
    reader's own. A part that cannot be done is on the page with the reason, and `say` gets a line for it.
    Raises ParameterError for an unknown id, OutputError if something cannot be written.
    """
    check_offscreen()
    experiments = chosen(only, mesh)
    folder = Path(out)
    _make(folder)
    with Pictures() as pictures:
        if mesh is not None and Path(mesh).is_dir():
            experiments = [each for each in experiments if only or each.id in FOLDER_EXPERIMENTS]
            return _each_mesh(Run(folder, experiments, quick, up, progress, say, pictures), Path(mesh))
        missing = Parts()
        if mesh is None:
            up = "y" if up == "auto" else up
            shapes = Shapes.from_folder(SAMPLES)
        else:
            surface = read_surface(mesh)
            up = _up(up, surface, mesh, missing)
            shapes = Shapes(own=surface, up=up)
        run = Run(folder, experiments, quick, up, progress, say, pictures)
        sections = _sections(run, Subject(shapes, up, folder), progress)
    for each in missing.not_done:
        say(f"not done: {each}")
        sections.append(Section(Named("up", each.part), None, failure=each.reason))
    about = "the bundled meshes" if mesh is None else Path(mesh).name
    return _written(run, sections, about)


def _up(up: str, surface: Surface, path: str | Path, parts: Parts) -> str:
    """Return the axis that is up, y where it cannot be guessed."""
    if up != "auto":
        return up
    return parts.do(f"which way {Path(path).name} is up", guess_up, surface, mesh_format(path)) or "y"


def chosen(only: Sequence[str], mesh: str | None) -> list[Experiment]:
    """Return the experiments of ids, all that there are for the mesh if there is none; ParameterError for others."""
    unknown = [name for name in only if name not in EXPERIMENTS]
    if unknown:
        raise ParameterError(f"There is no experiment {unknown[0]!r}; choose among {', '.join(EXPERIMENTS)}.")
    named = [e for name, e in EXPERIMENTS.items() if not only or name in only]
    if mesh is None:
        return named
    possible = [experiment for experiment in named if experiment.any_mesh]
    if not possible:
        raise ParameterError(f"{', '.join(only)} makes sense on the bundled meshes only.")
    return possible


def _sections(run: Run, subject: Subject, progress: Progress | None) -> list[Section]:
    """Run the experiments on a subject; return their sections in the order in which they were chosen."""
    done: dict[str, tuple[Section, SectionDrawings]] = {}
    # Experiments that are timed run first, while no pictures are being drawn.
    for step, experiment in steps(progress, sorted(run.experiments, key=lambda each: not each.is_timed)):
        section, drawings = _section(run, subject, experiment, step)
        done[experiment.id] = section, drawings
        if section.result is None:
            run.say(f"{experiment.id}: not done: {section.failure}")
        else:
            run.say(f"{experiment.id}: {_counted_verdicts(section.result)}, {section.result.seconds:.1f} s")
            for warning in dict.fromkeys(claim.warning for claim in section.result.claims if claim.warning):
                run.say(f"  warning: {warning}")
            for missing in section.not_done:
                run.say(f"  not done: {missing}")
            for line in _not_held(section.result):
                run.say(line)
    return [_with_pictures(*done[experiment.id], run.say) for experiment in run.experiments]


def _with_pictures(section: Section, drawings: SectionDrawings, say: Callable[[str], None]) -> Section:
    """Wait for the pictures of a section and its pages that compute, and return it with them."""
    parts = Parts()
    found = [(row, parts.do(f"the picture {row}".strip(), picture)) for row, picture in drawings.pictures.items()]
    written = [(page, parts.do(f"the live page {page.file}", size)) for page, size in drawings.pages]
    for missing in parts.not_done:
        say(f"{section.experiment.id}: not done: {missing}")
    result = section.result and replace(section.result, not_done=(*section.result.not_done, *parts.not_done))
    pictures = tuple((row, each) for row, each in found if each)
    live = tuple((page, size) for page, size in written if size)
    return replace(section, result=result, pictures=pictures, live=live)


def _counted_verdicts(result: Result) -> str:
    """Count the statements by verdict."""
    plurals: dict[str, str] = {HOLDS: "hold", FAILS: "do not hold"}
    words = []
    for verdict in (*VERDICTS, None):
        count = sum(claim.verdict == verdict for claim in result.claims)
        if count:
            word = verdict or "not judged"
            words.append(f"{count} {plurals.get(word, word) if count > 1 else word}")
    return ", ".join(words) or "no statements"


def _not_held(result: Result) -> list[str]:
    """Return a line for each statement that does not hold, or only partly."""
    lines = []
    for claim in result.claims:
        if claim.verdict != HOLDS:
            text, measured = (
                textwrap.shorten(words, LONGEST_TEXT, placeholder="…") for words in (claim.text, claim.measured)
            )
            lines.append(f"  {claim.verdict_words}: {text.rstrip('.')} ({measured.rstrip('.')})")
    return lines


def _section(run: Run, subject: Subject, experiment: Experiment, progress: Progress) -> tuple[Section, SectionDrawings]:
    """Run an experiment; return its section, with its drawings on their way."""
    parts = Parts()
    result = parts.do(experiment.title, experiment.compute, subject.shapes, run.quick, part(progress, 0, 0.9))
    if result is None:
        return Section(experiment, None, failure=parts.not_done[0].reason), SectionDrawings()
    result.save(subject.folder)
    drawings, charts = SectionDrawings(), []
    for row, panels in rows_of(result).items():
        figure = parts.do(f"the picture {row}".strip(), figure_of, result, panels, subject.up)
        if figure is not None:
            drawings.pictures[row] = run.pictures.draw(subject.folder, name_of(result, row), figure)
        live = parts.do(f"live pages {row}".strip(), live_pages, result, row, panels, subject.up)
        drawings.pages.extend((each, run.pictures.write(subject.folder, each)) for each in live or ())
    for chart in result.charts:
        svg = parts.do(f"the chart {chart.heading}", chart_svg, chart)
        charts += [] if svg is None else [svg]
    result = replace(result, not_done=(*result.not_done, *parts.not_done))
    return Section(experiment, result, charts=tuple(charts)), drawings


def _each_mesh(run: Run, meshes: Path) -> Reproduction:
    """Run the experiments on each mesh of a folder; one that fails is named and the others go on."""
    paths = sorted(path for path in meshes.iterdir() if is_mesh_file(path))
    if not paths:
        raise ParameterError(f"There is no mesh in {meshes}; meshes are {', '.join(MESH_FORMATS)} files.")
    names = Counter(map(mesh_name, paths))
    sections: list[Section] = []
    surfaces: list[tuple[Surface, str]] = []
    missing = Parts()
    for step, path in steps(run.progress, paths):
        run.say(path.name)
        name = mesh_name(path)
        name = name if names[name] == 1 else path.name.replace(".", "-")
        parts = Parts()
        surface = parts.do(path.name, read_surface, path)
        if surface is None:
            reason = parts.not_done[0].reason
            run.say(f"not done: {reason}")
            sections.append(Section(_named(run.experiments[0], name, path), None, failure=reason))
            continue
        up = _up(run.up, surface, path, missing)
        subject = Subject(Shapes(own=surface, up=up), up, run.folder / name)
        _make(subject.folder)
        for section in _sections(run, subject, step):
            live = tuple((replace(each, file=f"{name}/{each.file}"), size) for each, size in section.live)
            sections.append(replace(section, experiment=_named(section.experiment, name, path), live=live))
        surfaces.append((surface, up))
    if surfaces:
        sections.insert(0, _contact_sheets(run, surfaces, missing))
        for each in missing.not_done:
            run.say(f"not done: {each}")
    return _written(run, sections, f"{len(paths)} meshes of {meshes.name}")


def _named(experiment: Experiment | Named, name: str, path: Path) -> Named:
    return Named(f"{name}-{experiment.id}", f"{path.name}: {experiment.title}")


def _contact_sheets(run: Run, surfaces: Sequence[tuple[Surface, str]], parts: Parts) -> Section:
    """Draw the biharmonic distance on every mesh from its highest vertex, many to a picture.

    Each mesh comes with the axis that is up; failures are added to `parts`.
    """
    sheets = []
    for start in range(0, len(surfaces), MESHES_PER_SHEET):
        panels = [_on_sheet(surface, up, parts) for surface, up in surfaces[start : start + MESHES_PER_SHEET]]
        columns = min(SHEET_COLUMNS, len(panels))
        sheet = Figure(tuple(panels), columns=columns, size=Size(FINER * 230 * columns, dpi=FINER * 96))
        number = start // MESHES_PER_SHEET + 1
        picture = parts.do(f"contact sheet {number}", run.pictures.draw(run.folder, f"contact-sheet-{number}", sheet))
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


def _written(run: Run, sections: Sequence[Section], about: str) -> Reproduction:
    introduction = (
        "The figures and tables of Lipman, Rustamov and Funkhouser, Biharmonic Distance (ACM Transactions on Graphics "
        f"29(3), 2010), recomputed on {about}, with a verdict on each of the paper's statements. The data of every "
        "picture is next to this page, as .npz and .csv files. A mark with a dashed outline is on the far side of the "
        "shape."
    )
    if run.quick:
        introduction += " This is the quick version, with smaller meshes and fewer sources."
    with atomic_write(run.page) as temporary:
        text = page("Biharmonic Distance, reproduced", introduction, sections, QUICK if run.quick else "")
        temporary.write_text(text, encoding="utf-8")
    return Reproduction(run.page, sum(len(section.not_done) for section in sections))


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"The folder {folder} cannot be made: {error.strerror or error}.") from None
