"""The command line.  `bihdist MESH` opens the viewer; all commands but `view` need no window.

What is heavy (numpy, VTK, Qt) is imported by the command that needs it, when it runs.
"""

import argparse
import os
import re
import sys
from collections.abc import Iterator, Sequence
from typing import Any

from bihdist_core.formats.mesh_names import MESH_FORMATS

from .commands import batch, desktop, field, figure, guide, info, isolines, movie, page, pairs, paper, view
from .commands.mesh import check_mesh
from .commands.parser import Parser
from .commands.result import as_json
from .commands.terminal import add_telling, standard_output, tell_failure, telling, warn
from .commands.termination import status_of, termination_raised, words_of
from .document.tools import tools
from .version import disagreement, version

COMMANDS = {
    **{module.__name__.rpartition(".")[2]: module for module in (view, field, pairs, isolines)},
    **{word: tool.load(module) for tool in tools() for word, module in tool.commands.items()},
    **{
        module.__name__.rpartition(".")[2]: module
        for module in (batch, figure, movie, page, info, paper, desktop, guide)
    },
}
"""By word: each has its `WORDS` (what it does), `add_options(parser)` and `run(options)`, which returns a `Result`;
TEXT: the format in which it writes to standard output, for `-o -`."""

DRAWING = {"matplotlib", "PIL", "pyvista", "pyvistaqt", "qtpy", "vtkmodules"}
"""What is not there where the program was installed for batches alone."""

FILES = re.compile(r"FILE|OUT|DIR|MAP|\.json|\.png")
"""Options whose values have such words are completed by names of files, as all that has no option."""

NEGATIVE = re.compile(r"-[xyz]|-[\d.][-+.\deE]*,[-+.,\deE]*")
"""The value of an option, though it begins like one: `--up -z`, `--camera -1,0,…`.  argparse knows single numbers."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status: 0, 1 for a figure with a failed panel or a page
    with a part that could not be done, 2 for what the user can mend, 130 when interrupted, 143 by SIGTERM."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    from bihdist_core.errors import BihdistError

    options: argparse.Namespace | None = None
    try:
        # Before anything has begun, SIGTERM needs no answer but the system's.
        options = parser_of_all().parse_args(_with_values(_with_command(arguments)))
        with termination_raised():
            return _run(options)
    except BihdistError as error:
        return _failed(options, str(error), 2)
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in DRAWING:
            raise
        return _failed(options, f"this draws, and {error.name} is not installed: `pip install bihdist` brings it.", 2)
    except MemoryError:
        return _failed(options, "there is not enough memory for this.", 2)
    except BrokenPipeError:
        # Whoever read the output has seen enough; Python would complain again when it closes the pipe.
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
    """options: nothing while they are not known."""
    tell_failure(sentence)
    if options is not None and options.json:
        print(as_json(options.command, status, {"error": sentence}))
    return status


def _with_command(arguments: list[str]) -> list[str]:
    """The arguments with `view` where no command is named; MeshError for a first word that means nothing."""
    if arguments and (arguments[0] in COMMANDS or arguments[0].startswith("-")):
        return arguments
    if arguments:
        # Before the options, which may be those of the command that was meant.
        check_mesh(arguments[0], COMMANDS)
    return ["view", *arguments]


def _with_values(arguments: list[str]) -> list[str]:
    """The arguments with negative values joined to their options by `=`, without which argparse refuses them."""
    joined: list[str] = []
    for word in arguments:
        last = joined[-1] if joined else ""
        if NEGATIVE.fullmatch(word) and len(last) > 2 and last.startswith("--") and "=" not in last:
            joined[-1] = f"{last}={word}"
        else:
            joined.append(word)
    return joined


def parser_of_all() -> argparse.ArgumentParser:
    """The parser of the whole command line, with one for each command in it."""
    parser = Parser(
        prog="bihdist",
        description="Biharmonic distance on triangle meshes, beside geodesic and diffusion distances.",
        epilog="`bihdist MESH` is short for `bihdist view MESH`. A mesh is the name of a sample, or a file: "
        f"{', '.join(MESH_FORMATS)}, each also with .gz, or FreeSurfer's such as lh.pial.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    shells = ("bash", "zsh", "tcsh")
    parser.add_argument("--completion", action=_Completion, choices=shells, help="print a shell's completion and exit")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for word, module in COMMANDS.items():
        words = module.WORDS
        command = commands.add_parser(word, help=words, description=f"{words[0].upper()}{words[1:]}.")
        module.add_options(command)
        add_telling(command)
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
    """Those of all commands."""
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
