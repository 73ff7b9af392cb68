"""The command line. `bihdist MESH` opens the viewer; only the command `view` needs a window.

Each command imports NumPy, VTK or Qt when it runs, and only if it needs them.
"""

import argparse
import os
import re
import sys
from collections.abc import Iterator, Sequence
from typing import Any

from bihdist_core.formats.mesh_names import MESH_FORMATS

from .commands import batch, desktop, field, figure, graph, guide, info, isolines, movie, page, pairs, paper, view
from .commands.mesh import check_mesh
from .commands.parser import Parser
from .commands.terminal import add_telling, as_json, standard_output, tell_failure, telling, warn
from .commands.termination import status_of, termination_raised, words_of
from .document.tools import tools
from .version import disagreement, version

COMMANDS = {
    **{module.__name__.rpartition(".")[2]: module for module in (view, field, pairs, isolines, graph)},
    **{word: tool.load(module) for tool in tools() for word, module in tool.commands.items()},
    **{
        module.__name__.rpartition(".")[2]: module
        for module in (batch, figure, movie, page, info, paper, desktop, guide)
    },
}
"""The commands by name. Each module has its description `WORDS`, its `EXAMPLES`, `add_options(parser)`, `run(options)`,
which returns a `Result`, and `TEXT`, its format on standard output, if it takes `-o -`."""

HEADINGS = {
    "look": ("view", "figure", "movie", "page"),
    "numbers": (
        "field",
        "pairs",
        "isolines",
        "profile",
        "statistics",
        "samples",
        "regions",
        "interpolate",
        "graph",
        "info",
    ),
    "compare": ("correspond", "evaluate", "perturb"),
    "many meshes": ("batch",),
}
"""The commands under the headings of `bihdist --help`; others come after them."""

NOT_FOR_BATCHES = {
    *("matplotlib", "PIL", "pyvista", "pyvistaqt", "qtpy", "vtkmodules"),
    *("markdown_it", "mdit_py_plugins", "platformdirs"),
}
"""Modules that are missing where only the dependencies of batches are installed."""

FILES = re.compile(r"FILE|OUT|DIR|MAP|\.json|\.png")
"""Shells complete the values of options with such metavars by file names, as they do positional arguments."""

NEGATIVE = re.compile(r"-[xyz]|-[\d.][-+.\deE]*,[-+.,\deE]*")
"""Values that look like options: `--viewup -z`, `--camera -1,0,…`. argparse recognizes single numbers only."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    0 is success, 1 a figure with a failed panel or a data set with a failed part, 2 an error that the user can correct,
    130 an interruption, and 143 SIGTERM.
    """
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    from bihdist_core.errors import BihdistError

    options: argparse.Namespace | None = None
    try:
        # Until a command runs, SIGTERM keeps its default action.
        options = parser_of_all().parse_args(_with_values(_with_command(arguments)))
        with termination_raised():
            return _run(options)
    except BihdistError as error:
        return _failed(options, str(error), 2)
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in NOT_FOR_BATCHES:
            raise
        return _failed(options, f"this needs {error.name}, which is not installed: `pip install bihdist` brings it.", 2)
    except MemoryError:
        return _failed(options, "there is not enough memory for this.", 2)
    except BrokenPipeError:
        # The reader has closed the pipe; Python would report that again when it flushes.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt as error:
        return _failed(options, f"{words_of(error)}.", status_of(error))


def _run(options: argparse.Namespace) -> int:
    module = COMMANDS[options.command]
    with telling(options.quiet) as notes, standard_output(options, getattr(module, "TEXT", "")):
        if words := disagreement():
            warn(words)
        result = module.run(options)
    if options.json:
        print(as_json(options.command, result.status, {**result.facts, "notes": notes}))
    sys.stdout.flush()
    sys.stderr.flush()
    if result.ends_process:
        os._exit(result.status)
    return int(result.status)


def _failed(options: argparse.Namespace | None, sentence: str, status: int) -> int:
    """Report an error, also as JSON if that was asked for, and return the status."""
    tell_failure(sentence)
    if options is not None and options.json:
        print(as_json(options.command, status, {"error": sentence}))
    return status


def _with_command(arguments: list[str]) -> list[str]:
    """Return the arguments with the command `view` if they name none; raise MeshError if the first is not a mesh.

    `version`, `help` and `help COMMAND` become the options of these names.
    """
    if arguments[:1] == ["version"]:
        return ["--version"]
    if arguments[:1] == ["help"]:
        return _with_command([*arguments[1:2], "--help"])
    if arguments and (arguments[0] in COMMANDS or arguments[0].startswith("-")):
        return arguments
    if arguments:
        # Checked before the options, which may be those of a misspelt command.
        check_mesh(arguments[0], COMMANDS)
    return ["view", *arguments]


def _with_values(arguments: list[str]) -> list[str]:
    """Return the arguments with negative values joined to their options by `=`, as argparse requires."""
    joined: list[str] = []
    for word in arguments:
        last = joined[-1] if joined else ""
        if NEGATIVE.fullmatch(word) and len(last) > 2 and last.startswith("--") and "=" not in last:
            joined[-1] = f"{last}={word}"
        else:
            joined.append(word)
    return joined


def parser_of_all() -> argparse.ArgumentParser:
    """Return the parser of the command line, with a subparser for each command."""
    parser = Parser(
        prog="bihdist",
        headings=HEADINGS,
        description="Biharmonic distance on triangle meshes, side by side with geodesic and diffusion distances.",
        epilog="`bihdist MESH` is short for `bihdist view MESH`. A mesh is the name of a sample, or a file: "
        f"{', '.join(MESH_FORMATS)}, each also with .gz, or FreeSurfer's such as lh.pial.",
    )
    parser.add_argument("-V", "--version", action=_Version, nargs=0, help="print the version and exit")
    parser.add_argument("--cite", action=_Cite, nargs=0, help="print BibTeX entries for the paper and the program")
    shells = ("bash", "zsh")
    parser.add_argument("--completion", action=_Completion, choices=shells, help="print a shell's completion and exit")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for word, module in COMMANDS.items():
        words, examples = module.WORDS, "\n".join(f"  {line}" for line in getattr(module, "EXAMPLES", ()))
        command = commands.add_parser(
            word,
            help=words,
            description=f"{words[0].upper()}{words[1:]}.",
            epilog=examples and f"examples:\n{examples}",
        )
        module.add_options(command)
        add_telling(command)
        command.shorten_usage()
    return parser


class _Completion(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, _: object, shell: Any, *__: object) -> None:
        import shtab

        for action in _actions(parser):
            metavar = action.metavar if isinstance(action.metavar, str) else ""
            names_file = not action.option_strings or FILES.search(metavar)
            if names_file and not action.choices:
                action.complete = shtab.FILE  # type: ignore[attr-defined]
        print(shtab.complete(parser, shell))
        parser.exit()


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Yield the actions of a parser and of its subparsers."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for each in action.choices.values():
                yield from _actions(each)
        else:
            yield action


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        print(f"bihdist {version()}")
        parser.exit()


class _Cite(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from .citation import bibtex

        print(bibtex())
        parser.exit()
