"""Every command's options, from the parsers."""

import argparse

from app.main import parser_of_all

INTRODUCTION = """# Options of all commands

What `bihdist COMMAND --help` prints. [The command line](command-line.md) tells what the commands are for, by example.

"""


def option_pages() -> dict[str, str]:
    """The text of the page, by its path in the guide."""
    (commands,) = (each for each in parser_of_all()._actions if isinstance(each, argparse._SubParsersAction))
    parts = [_command(word, parser) for word, parser in commands.choices.items()]
    return {"reference/options.md": INTRODUCTION + "\n".join(parts)}


def _command(word: str, parser: argparse.ArgumentParser) -> str:
    usage = " ".join(name for action in parser._actions if (name := _positional(action)))
    line = " ".join(f"bihdist {word} {usage} [OPTION …]".split())
    text = f"## {word}\n\n{parser.description}\n\n```text\n{line}\n```\n\n"
    rows = [_row(parser, action) for action in parser._actions if action.dest != "help"]
    return text + "\n".join(rows)


def _positional(action: argparse.Action) -> str:
    if action.option_strings:
        return ""
    name = action.metavar if isinstance(action.metavar, str) else action.dest
    return {"?": f"[{name}]", "*": f"[{name} …]", "+": f"{name} …"}.get(str(action.nargs), name)


def _row(parser: argparse.ArgumentParser, action: argparse.Action) -> str:
    """One option as an entry of a definition list."""
    value = "" if action.nargs == 0 else _value(action)
    names = [f"`{name}{f' {value}' if value else ''}`" for name in action.option_strings] or [
        f"`{_positional(action)}`"
    ]
    formatter = parser._get_formatter()
    words = formatter._expand_help(action) if action.help else ""
    return f"{', '.join(names)}\n: {markdown(words)}\n"


def _value(action: argparse.Action) -> str:
    if action.metavar:
        return action.metavar if isinstance(action.metavar, str) else " ".join(action.metavar)
    return "{" + ",".join(map(str, action.choices)) + "}" if action.choices else action.dest.upper()


def markdown(words: str) -> str:
    """Help is plain text: what Markdown would read otherwise is escaped."""
    for character in "\\*_$<|[]{}":
        words = words.replace(character, f"\\{character}")
    return words
