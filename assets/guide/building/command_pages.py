"""The pages of the commands, from their parsers: an index, one for each, and one for the options that most have."""

import argparse
import re
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain, groupby
from operator import attrgetter

from app.main import HEADINGS, parser_of_all

MANY = 10
"""An option that so many commands have is described on the page of shared options."""
SHARED, UNTITLED = "shared-options", ("Arguments", "Options")
KEYWORDS = "---\nmyst:\n  html_meta:\n    keywords: options\n---\n\n"


@dataclass(frozen=True)
class Option:
    """An option or an argument of a command, as its help has it under a title."""

    title: str
    names: tuple[str, ...]
    value: str
    text: str

    @property
    def described(self) -> str:
        """The directive that describes it."""
        names = ", ".join(f"{name} {self.value}".strip() for name in self.names or [""])
        return f":::{{option}} {names}\n{markdown(self.text)}\n:::"

    def link(self, page: str) -> str:
        """An item of a list: a link to the page that describes it, and the first clause of that."""
        shown, clause = f"{self.names[0]} {self.value}".strip(), re.sub(r" \([^)]*\)|[;:] .*", "", self.text)
        return f"- {{option}}`{shown} <bihdist {page} {self.names[0]}>`: {markdown(clause)}"


def command_pages() -> dict[str, str]:
    """Return the text of each page, by its path in the guide."""
    parsers = commands()
    options = {word: options_of(parser) for word, parser in parsers.items()}
    homes = _homes(options)
    pages = {"index": _index(parsers)}
    for word, parser in parsers.items():
        usage = parser.format_usage().removeprefix("usage: ")
        examples = "".join(f"{line.strip()}\n" for line in (parser.epilog or "").splitlines()[1:])
        head = f"{KEYWORDS}# bihdist {word}\n\n{parser.description}\n\n```sh\n{usage}```\n\n```sh\n{examples}```\n\n"
        pages[word] = head + _sections(word, options[word], homes)
    shared = sorted((each for each in homes if homes[each] == SHARED), key=attrgetter("title"), reverse=True)
    head = "# Shared options\n\nOptions that mean the same in most commands.\n\n"
    pages[SHARED] = head + _sections(SHARED, shared, homes)
    return {f"reference/commands/{name}.md": text for name, text in pages.items()}


def commands() -> dict[str, argparse.ArgumentParser]:
    """Return the parser of each command, by its word."""
    (action,) = (each for each in parser_of_all()._actions if isinstance(each, argparse._SubParsersAction))
    return dict(action.choices)


def options_of(parser: argparse.ArgumentParser) -> list[Option]:
    """Return the options of a parser in the order of its help."""
    found, formatter = [], parser._get_formatter()
    for group in parser._action_groups:
        title = "Arguments" if group.title == "positional arguments" else (group.title or "").capitalize()
        for each in group._group_actions:
            if each.dest not in ("help", "command"):
                value = formatter._format_args(each, each.dest.upper()) if each.option_strings else str(each.metavar)
                found.append(Option(title, tuple(each.option_strings), value, formatter._expand_help(each)))
    return found


def markdown(words: str) -> str:
    """Return plain text as Markdown: options as code, and what would be read as more is escaped."""
    words = re.sub(r"(?<![\w`-])--[a-z][a-z-]*(?:=[-\w]+)?", r"`\g<0>`", words)
    pieces = enumerate(words.split("`"))
    return "`".join(piece if odd % 2 else re.sub(r"[\\*_$<|\[\]{}]", r"\\\g<0>", piece) for odd, piece in pieces)


def _homes(options: dict[str, list[Option]]) -> dict[Option, str]:
    """Return the pages of the options that are described on one page only.

    What several commands have under a title of its own is described by `figure`, or by the first that has it.
    """
    holders: dict[Option, list[str]] = {}
    for word, found in options.items():
        for each in found:
            holders.setdefault(each, []).append(word)
    homes = {each: "figure" if "figure" in words else words[0] for each, words in holders.items()}
    homes = {each: home for each, home in homes.items() if each.title not in UNTITLED}
    return homes | {each: SHARED for each, words in holders.items() if each.names and len(words) >= MANY}


def _sections(page: str, options: Iterable[Option], homes: dict[Option, str]) -> str:
    """Describe options under their titles, or link to the pages that do."""
    parts = [f"```{{program}} bihdist {page}\n```"]
    for title, group in groupby(options, attrgetter("title")):
        found = [(each, homes.get(each, page)) for each in group]
        links = [each.link(home) for each, home in found if home != page]
        parts += [f"## {title}", *(each.described for each, home in found if home == page)]
        parts += ["Shared with other commands:", "\n".join(links)] if links else []
    return "\n\n".join(parts) + "\n"


def _index(parsers: dict[str, argparse.ArgumentParser]) -> str:
    groups = {**HEADINGS, "more": [word for word in parsers if word not in chain(*HEADINGS.values())]}
    parts = [
        "# Every command and its options",
        f"What `bihdist COMMAND --help` prints, a page each; [shared options]({SHARED}.md) are those that most "
        "commands have. [The command line by example](../command-line.md) shows what the commands are for.",
    ]
    for title, words in groups.items():
        rows = [f"| [`{word}`]({word}.md) | {parsers[word].description} |" for word in words]
        parts += [f"## {title.capitalize()}", "\n".join(["| Command | What it does |", "| --- | --- |", *rows])]
    parts += ["## Without a command", "```{program} bihdist\n```"]
    parts += [each.described for each in options_of(parser_of_all())]
    tree = "\n".join(f"{word} <{word}>" for word in chain(*groups.values()))
    return "\n\n".join([*parts, f"```{{toctree}}\n:hidden:\n\n{SHARED}\n{tree}\n```\n"])
