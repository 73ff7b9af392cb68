"""The project's docstrings as reStructuredText.

They are prose with arguments and attributes as `name: meaning`, `Raises …`, lists of file formats, and examples.
"""

import dataclasses
import inspect
import re
from collections.abc import Callable
from typing import Any

NAMES = r"[a-z_]\w*(?:, [a-z_]\w*)*"
FACT = re.compile(
    rf"(?:^|(?<=[.;)\"]) +)(?:(?P<names>{NAMES})(?: (?P<shape>\([^)]*\)))?: +|(?P<what>Raises|Returns) )(?=\S)"
)
OTHERS = re.compile(r"(?<=\.)  (?!Its|They|These|Each|It|With|Without|None)(?=[A-Z])")
"""Where two spaces divide sentences, what follows is about something else."""
ITEM = ("- ", ".")  # of a list, or of a list of file formats
CODE = re.compile(r"`([^`]+)`")


def as_rst(lines: list[str], is_argument: Callable[[str], bool]) -> list[str]:
    """A docstring's lines as autodoc takes them; arguments become fields, to which it adds their types."""
    made: list[str] = []
    for paragraph in re.split(r"\n(?:[ \t]*\n)+", "\n".join(lines).strip("\n")):
        if paragraph.lstrip().startswith(">>>"):
            made += [*paragraph.split("\n"), ""]
            continue
        for part in _parts(paragraph):
            if part.startswith(ITEM):
                made += [f"- {_text(part.removeprefix('- '))}"]
            else:
                made += ["", *_prose(part, is_argument)]
        made += [""]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(made)).strip("\n").split("\n")


def _parts(paragraph: str) -> list[str]:
    """Prose and items of lists, each in one line; items go on in lines that are indented."""
    parts: list[str] = []
    for line in paragraph.split("\n"):
        goes_on = parts and not line.startswith(ITEM) and (line.startswith(" ") or not parts[-1].startswith(ITEM))
        if goes_on:
            parts[-1] += f" {line.strip()}"
        else:
            parts.append(line.strip())
    return parts


def _prose(text: str, is_argument: Callable[[str], bool]) -> list[str]:
    """A paragraph, with its facts as a list under it."""
    facts = list(FACT.finditer(text))
    before = text[: facts[0].start()] if facts else text
    made, after, last = [_text(re.sub(r"[;:,]$", ".", before.strip())), ""], list[str](), list[str]()
    ends = [*(fact.start() for fact in facts[1:]), len(text)][: len(facts)]
    for fact, end in zip(facts, ends, strict=True):
        meaning, *others = OTHERS.split(text[fact.end() : end].strip())
        after += others
        meaning = _text(" ".join(filter(None, (fact["shape"], meaning))))
        if fact["what"]:
            last += [f":{fact['what']}: {meaning}"]
        elif is_argument(fact["names"]):
            made += [f":param {fact['names']}: {meaning}"]
        else:
            made += ["", f"{', '.join(f'``{name}``' for name in fact['names'].split(', '))}", f"    {meaning}", ""]
    return [*made, "", *(line for other in after for line in (_text(other), "")), *last]


def _text(text: str) -> str:
    """Words in which nothing means anything to reStructuredText; names between backticks are links."""
    return "".join(_code(piece) if odd % 2 else _escaped(piece) for odd, piece in enumerate(CODE.split(text)))


def _code(words: str) -> str:
    return f":py:obj:`{words}`" if re.fullmatch(r"[A-Za-z_][\w.]*", words) else f"``{words}``"


def _escaped(text: str) -> str:
    return re.sub(r"([\\*|]|_(?=\W|$))", r"\\\1", text)


def _process(app: Any, what: str, name: str, found: Any, options: Any, lines: list[str]) -> None:
    names: set[str] = set()
    if what in ("class", "function", "method") and not dataclasses.is_dataclass(found):
        names = set(inspect.signature(found).parameters)
    lines[:] = as_rst(lines, lambda words: {*words.split(", ")} <= names)


def setup(app: Any) -> dict[str, bool]:
    """Let autodoc read all docstrings in this way."""
    app.connect("autodoc-process-docstring", _process)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
