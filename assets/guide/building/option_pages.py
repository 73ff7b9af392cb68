"""Every command's options, and which commands share one, from the parsers."""

import argparse

from app.main import parser_of_all

SHARED = """## Options that several commands have

"""
INTRODUCTION = """# Every command and its options

What `bihdist COMMAND --help` prints. [The command line](command-line.md) tells what the commands are for, by example.

"""


def option_pages() -> dict[str, str]:
    """Return the text of the page, by its path in the guide."""
    parts = [_command(word, parser) for word, parser in commands().items()]
    return {"reference/options.md": INTRODUCTION + "\n".join([*parts, SHARED + option_table()])}


def commands() -> dict[str, argparse.ArgumentParser]:
    """Return the parser of each command, by its word."""
    (action,) = (each for each in parser_of_all()._actions if isinstance(each, argparse._SubParsersAction))
    return dict(action.choices)


def options_of(parser: argparse.ArgumentParser) -> list[str]:
    """Return the options of a parser by their long names, in its order."""
    actions = [each for each in parser._actions if each.option_strings and each.dest != "help"]
    return [next(name for name in each.option_strings if name.startswith("--")) for each in actions]


def option_table() -> str:
    """Return a table of the options that several commands have, a row each."""
    options = {word: options_of(parser) for word, parser in commands().items()}
    holders: dict[str, list[str]] = {}
    for word, names in options.items():
        for name in names:
            holders.setdefault(name, []).append(word)
    shared = sorted((name for name, words in holders.items() if len(words) > 1), key=lambda name: -len(holders[name]))
    rows = [f"| `{name}` | {' | '.join('•' if w in holders[name] else ' ' for w in options)} |" for name in shared]
    return "\n".join([f"| | {' | '.join(options)} |", f"| --- |{' :-: |' * len(options)}", *rows, ""])


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
