"""`bihdist view`: the window."""

import argparse
import signal
import threading

from bihdist_core.errors import ParameterError

from ..document.document import Document, MeshFile, comparison, usual_specs
from ..document.option import Row
from ..document.page import Recipe
from ..document.second_mesh_edits import open_second_mesh
from ..figures.look_options import COLOURS, OPACITY
from ..figures.options import VERTEX_AREAS, tool_rows, with_rows
from ..figures.repair_options import MERGE, REPAIRS
from ..figures.view_options import CLIP, UP, up_meaning
from .mesh import found_mesh, one_source, sources_of_document, sources_of_two
from .options import (
    PANELS,
    add_distance,
    add_rows,
    add_sources,
    fields_of,
    given,
    given_parameters,
    quantities,
    repairs_of,
)
from .terminal import Result

WORDS = "open the viewer"
EXAMPLES = (
    "bihdist hand",
    "bihdist view beast --sources 12 --distance biharmonic,geodesic",
    "bihdist view figure figure_pose2",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `view` to its parser."""
    what = "mesh file, the name of a sample, or a session or recipe (default: choose in the window)"
    parser.add_argument("mesh", metavar="MESH", nargs="?", help=what)
    parser.add_argument("beside", metavar="BESIDE", nargs="?", help="a second mesh, shown next to the first")
    add_sources(parser, "the source where distances start, or with two meshes one of each")
    parser.add_argument("--screenshot", metavar="OUT.png", help="save the window's picture once complete, and exit")
    parser.add_argument("--save-session", metavar="OUT.json", help="save the session once the window is complete")
    add_distance(parser, PANELS, is_field=True)
    parser.add_argument(
        "--theme", choices=("light", "dark", "desktop"), default="", help="the window's theme, this time only"
    )
    viewup = up_meaning("as it was chosen for this mesh before, or guessed")
    add_rows(
        parser, *_rows(), viewup=viewup, merge=f"{MERGE}; File > Repair mesh > Save vertex id table… writes the new ids"
    )


def _rows() -> list[Row]:
    """Return the options of figures that are tools', as far as they are not about the page, and some more."""
    of_pages = [row for row in tool_rows() if row.is_late or any(part.startswith("Page.") for part in row.parts)]
    return [VERTEX_AREAS, REPAIRS, *COLOURS, UP, CLIP, OPACITY, *(row for row in tool_rows() if row not in of_pages)]


def run(options: argparse.Namespace) -> Result:
    """Open the window, until it is closed."""
    if threading.current_thread() is threading.main_thread():
        # SIGTERM ends a window at once.  Qt's loop would not let Python see it, and what it raises while modules are
        # loaded may be caught by any of them.  Ctrl-C is noted by the window.
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        signal.signal(signal.SIGINT, signal.default_int_handler)

    # Not in the window, where a script would wait for ever.
    is_choice = options.mesh is None and not (options.screenshot or options.save_session)
    path = "" if is_choice else found_mesh(options.mesh or "figure")
    from bihdist_core.file_output import check_outputs

    check_outputs((options.screenshot, (".png",)), (options.save_session, (".json",)))
    shown: Document | str = path
    if path.lower().endswith(".json"):
        _refuse_options(options)
        if options.beside is not None:
            raise ParameterError(f"A session names its meshes itself; leave out {options.beside}.")
    else:
        chosen = quantities(options, options.distance or [spec.word for spec in usual_specs(path)])
        sources = sources_of_document(options.sources, path, chosen, options.areas, repairs_of(options, path))
        second = None
        if options.beside is not None:
            sources, second = sources_of_two(options.sources, sources, options.beside)
        shown = comparison(path, tuple(chosen), (one_source(sources),), fields=fields_of(options))
        shown = with_rows(Recipe(shown), given(options, *_rows()), _rows()).document
        if options.beside is not None:
            shown = open_second_mesh(shown, MeshFile("", found_mesh(options.beside)), second)
        shown = with_rows(Recipe(shown), given(options, REPAIRS), (REPAIRS,)).document
    from ..session.array_store import ArrayStore

    read = ArrayStore.read(Recipe(shown)) if options.fields and isinstance(shown, Document) else None
    if is_choice and (options.sources is not None or options.fields):
        raise ParameterError("Sources and fields need a mesh; name one.")
    from ..qt.screen import check_screen

    # Before anything imports Qt.
    check_screen()
    from ..qt.start import run_viewer

    status = run_viewer(shown, is_choice, options.screenshot, options.save_session, options.theme, read)
    files = (options.screenshot, options.save_session)
    facts = {
        "meshes": [{"mesh": mesh} for mesh in (options.mesh, options.beside) if mesh],
        "outputs": [file for file in files if file],
    }
    # All is saved and closed.  Left to the interpreter, Qt's and VTK's objects are taken down in an order that nobody
    # decides, which now and then, on a busy machine, ends in a crash.
    return Result(facts, status, ends_process=True)


def _refuse_options(options: argparse.Namespace) -> None:
    """Raise ParameterError for options that a session file contains."""
    named = {"--sources": options.sources, "--distance": options.distance, "--field": options.fields}
    named |= {f"--{name}": value for name, value in given_parameters(options).items()}
    values = given(options, *_rows())
    named |= {option.word: values.get(option.name) for row in _rows() for option in row.options}
    for word, value in named.items():
        if value is not None:
            raise ParameterError(f"A session says {word[2:]} itself; leave out {word}.")
