"""The pages of the commands, from their parsers: an index, one for each, and one for the options that most have."""

import argparse
import re
from dataclasses import dataclass
from itertools import chain

from app.main import HEADINGS, parser_of_all

MANY = 10
"""An option that so many commands have is described on the page of shared options."""
SHARED, UNTITLED = "shared-options", ("Arguments", "Options")


@dataclass(frozen=True)
class Option:
    """An option or an argument of a command, as its help has it."""

    names: tuple[str, ...]
    value: str
    text: str

    @property
    def described(self) -> str:
        """The directive that describes it."""
        names = ", ".join(f"{name} {self.value}".strip() for name in self.names or [""])
        return f":::{{option}} {names}\n{markdown(self.text)}\n:::"

    def link(self, program: str) -> str:
        """An item of a list: a link to where it is described, and the first clause of that."""
        shown, clause = f"{self.names[0]} {self.value}".strip(), re.sub(r" \([^)]*\)|[;:] .*", "", self.text)
        return f"- {{option}}`{shown} <bihdist {program} {self.names[0]}>`: {markdown(clause)}"


Groups = dict[str, list[Option]]
"""The options of a command, by the headings of its help."""


def command_pages() -> dict[str, str]:
    """Return the text of each page, by its path in the guide."""
    parsers = commands()
    groups = {word: groups_of(parser) for word, parser in parsers.items()}
    homes = _homes(groups)
    pages = {word: _page(word, parsers[word], groups[word], homes) for word in parsers}
    pages |= {SHARED: _shared_page(groups, homes), "index": _index(parsers)}
    return {f"reference/commands/{name}.md": text for name, text in pages.items()}


def commands() -> dict[str, argparse.ArgumentParser]:
    """Return the parser of each command, by its word."""
    (action,) = (each for each in parser_of_all()._actions if isinstance(each, argparse._SubParsersAction))
    return dict(action.choices)


def groups_of(parser: argparse.ArgumentParser) -> Groups:
    """Return the options of a parser, by the headings of its help."""
    groups, formatter = Groups(), parser._get_formatter()
    for group in parser._action_groups:
        title = "Arguments" if group.title == "positional arguments" else (group.title or "").capitalize()
        for each in group._group_actions:
            if each.dest not in ("help", "command"):
                value = formatter._format_args(each, each.dest.upper()) if each.option_strings else str(each.metavar)
                text = formatter._expand_help(each)
                groups.setdefault(title, []).append(Option(tuple(each.option_strings), value, text))
    return groups


def markdown(words: str) -> str:
    """Return plain text as Markdown: options as code, and what would be read as more is escaped."""
    words = re.sub(r"(?<![\w`-])--[a-z][a-z-]*(?:=[-\w]+)?", r"`\g<0>`", words)
    pieces = enumerate(words.split("`"))
    return "`".join(piece if odd % 2 else re.sub(r"[\\*_$<|\[\]{}]", r"\\\g<0>", piece) for odd, piece in pieces)


def _homes(groups: dict[str, Groups]) -> dict[Option, str]:
    """Return the pages of the options that are described on one page only.

    What several commands have under a heading of its own is described by `figure`, or by the first that has it.
    """
    holders: dict[Option, list[str]] = {}
    titled = set()
    for word, found in groups.items():
        for title, options in found.items():
            titled |= {*options} if title not in UNTITLED else set()
            for option in options:
                holders.setdefault(option, []).append(word)
    homes = {each: "figure" if "figure" in words else words[0] for each, words in holders.items() if each in titled}
    return homes | {each: SHARED for each, words in holders.items() if each.names and len(words) >= MANY}


# ---------------------------------------------------------------------- pages
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
    own = [each.described for each in groups_of(parser_of_all())["Options"]]
    tree = "\n".join(f"{word} <{word}>" for word in chain(*groups.values()))
    parts += ["## Without a command", "```{program} bihdist\n```", *own]
    return "\n\n".join([*parts, f"```{{toctree}}\n:hidden:\n\n{SHARED}\n{tree}\n```\n"])


def _page(word: str, parser: argparse.ArgumentParser, groups: Groups, homes: dict[Option, str]) -> str:
    usage = parser.format_usage().removeprefix("usage: ")
    examples = "".join(f"{line.strip()}\n" for line in (parser.epilog or "").splitlines()[1:])
    parts = [f"# bihdist {word}", parser.description or "", f"```sh\n{usage}```", f"```sh\n{examples}```"]
    parts += [f"```{{program}} bihdist {word}\n```"]
    for title, options in groups.items():
        parts += [f"## {title}", *(each.described for each in options if homes.get(each, word) == word)]
        links = [each.link(home) for each in options if (home := homes.get(each, word)) != word]
        parts += ["Shared with other commands:", "\n".join(links)] if links else []
    return "\n\n".join(parts) + "\n"


def _shared_page(groups: dict[str, Groups], homes: dict[Option, str]) -> str:
    parts = [
        "# Shared options",
        "Options that mean the same in most commands.",
        f"```{{program}} bihdist {SHARED}\n```",
    ]
    for title in dict.fromkeys(chain(*groups.values())):
        options = dict.fromkeys(chain(*(found.get(title, ()) for found in groups.values())))
        shown = [each.described for each in options if homes.get(each) == SHARED]
        parts += [f"## {title}", *shown] if shown else []
    return "\n\n".join(parts) + "\n"
