"""Blocks of a page that run: ```{shell}, ```{python} and ```{file}, in order, in one folder.

    from assets.guide.building.blocks import run_page
    outcomes = run_page(page, folder)        # one for each block; BlockError where one fails

What a block prints and the pictures it saves are its outcome.  Sphinx shows it, the tests only want it to be there.
"""

import ast
import io
import os
import re
import shlex
import textwrap
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path

PICTURES = (".png", ".svg", ".gif", ".webp", ".jpg")
OPENING = re.compile(r"^(?P<indent>[ \t]*)(?P<fence>`{3,})\{(?P<kind>shell|python|file)\}[ \t]*(?P<argument>.*)$")
PROGRESS = re.compile(r"^bihdist: +\d+%.*\n?", re.MULTILINE)
"""What commands say of how far they are, on machines where they take long."""
OPTION = re.compile(r"^:(?P<name>[\w-]+):[ \t]*(?P<value>.*)$")


class BlockError(Exception):
    """A block that failed, as the page, its line, and what happened."""


@dataclass(frozen=True)
class Block:
    """A fenced block that runs: `kind` is shell, python or file, `argument` what stands behind it."""

    kind: str
    text: str
    line: int  # of its fence, from 1
    argument: str = ""
    options: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Outcome:
    """What a block printed, and the pictures it saved, as names in the folder of its page."""

    printed: str
    pictures: tuple[str, ...]


def blocks_of(text: str) -> list[Block]:
    """The blocks of a page that run, in order; those in lists and in cards, too."""
    found, lines = [], iter(enumerate(text.splitlines(), 1))
    for line, words in lines:
        opening = OPENING.match(words)
        if opening is None:
            continue
        body: list[str] = []
        for _, inner in lines:
            if inner.strip() == opening["fence"]:
                break
            body.append(inner)
        body = textwrap.dedent("\n".join(body)).split("\n")
        options = {}
        while body and (option := OPTION.match(body[0])):
            options[option["name"]] = option["value"].strip()
            body.pop(0)
        content = "\n".join(body).strip("\n")
        found.append(Block(opening["kind"], content, line, opening["argument"].strip(), options))
    return found


def imported_modules(page: Path) -> set[str]:
    """Return the top-level modules that a page's Python blocks, or a Python example, import."""
    text = page.read_text(encoding="utf-8")
    code = [text] if page.suffix == ".py" else [block.text for block in blocks_of(text) if block.kind == "python"]
    nodes = [node for each in code for node in ast.walk(ast.parse(each))]
    names = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    names += [node.module or "" for node in nodes if isinstance(node, ast.ImportFrom) and not node.level]
    return {name.partition(".")[0] for name in names}


def run_page(page: Path, folder: Path) -> list[Outcome]:
    """Run all blocks of a page in a folder, Python with one namespace; BlockError for the first that fails."""
    names: dict[str, object] = {"__name__": "guide_page"}
    outcomes = []
    with _inside(folder):
        for block in blocks_of(page.read_text(encoding="utf-8")):
            try:
                outcomes.append(_RUN[block.kind](block, names))
            except _Failed as failure:
                raise BlockError(f"{page}:{block.line}: {failure}") from failure.__cause__
    return outcomes


class _Failed(Exception):
    """What a block did wrong, before its page is known."""


def commands_of(text: str) -> list[str]:
    """The lines of a shell block, joined where a backslash ends them, without comments."""
    lines = re.sub(r"\\\n[ \t]*", "", text).splitlines()
    return [line.strip() for line in lines if line.strip() and not line.lstrip().startswith("#")]


def _run_shell(block: Block, names: dict[str, object]) -> Outcome:
    printed, pictures = io.StringIO(), []
    wanted = int(block.options.get("status", 0))
    for line in commands_of(block.text):
        words = shlex.split(line, comments=True)
        if words[0] != "bihdist" or words[1:2] == ["view"]:
            raise _Failed(f"{line}: only commands that need no window run here; show others in a plain block (```sh)")
        with redirect_stdout(printed), redirect_stderr(printed):
            status = _status_of(words[1:])
        if status != wanted:
            raise _Failed(f"{line}: exit status {status} instead of {wanted}\n{printed.getvalue()}")
        pictures += _pictures_named(words)
    return Outcome(PROGRESS.sub("", printed.getvalue()), tuple(dict.fromkeys(pictures)))


def _status_of(arguments: list[str]) -> int:
    from app.main import main

    try:
        return main(arguments)
    except SystemExit as end:
        return int(end.code or 0)


def _pictures_named(words: list[str]) -> Iterator[str]:
    """Values of the options `-o` and `--output` that are pictures and were written."""
    for before, word in zip(words, [*words[1:], ""], strict=True):
        name = word if before in ("-o", "--output") else before.partition("--output=")[2]
        if name.lower().endswith(PICTURES) and Path(name).is_file():
            yield name


def _run_python(block: Block, names: dict[str, object]) -> Outcome:
    os.environ["MPLBACKEND"] = "Agg"  # pictures are saved; there is no window
    before, printed = _pictures_here(), io.StringIO()
    try:
        code = compile("\n" * block.line + block.text, "the page", "exec")  # lines are counted as in the page
        with redirect_stdout(printed):
            exec(code, names)
    except Exception as error:
        told = "".join(traceback.format_exception_only(error)).strip()
        lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == "the page"]
        raise _Failed(f"{f'line {lines[-1]}: ' if lines else ''}{told}\n{printed.getvalue()}") from error
    pictures = [name for name, time in _pictures_here().items() if before.get(name) != time]
    return Outcome(printed.getvalue(), tuple(pictures))


def _pictures_here() -> dict[str, int]:
    """Pictures in the current folder, as they were made, with their times."""
    files = [path for path in Path().iterdir() if path.suffix.lower() in PICTURES]
    times = {path.name: path.stat().st_mtime_ns for path in files}
    return dict(sorted(times.items(), key=lambda item: item[1]))


def _write_file(block: Block, names: dict[str, object]) -> Outcome:
    if not block.argument or Path(block.argument).name != block.argument:
        raise _Failed(f"a block {{file}} needs the name of a file in its folder, not {block.argument!r}")
    Path(block.argument).write_text(f"{block.text}\n", encoding="utf-8")
    return Outcome("", ())


_RUN = {"shell": _run_shell, "python": _run_python, "file": _write_file}


@contextmanager
def _inside(folder: Path) -> Iterator[None]:
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
