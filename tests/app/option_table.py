"""Which options which commands have, as a table: `python -m tests.app.option_table` writes it into CONTRIBUTING.md."""

import argparse
from pathlib import Path

from app.main import parser_of_all

BEGINS, ENDS = "<!-- options: from the parsers -->\n", "<!-- end of options -->\n"
CONTRIBUTING = Path(__file__).parents[2] / "CONTRIBUTING.md"


def commands() -> dict[str, argparse.ArgumentParser]:
    """The parser of each command, by its word."""
    (action,) = (each for each in parser_of_all()._actions if isinstance(each, argparse._SubParsersAction))
    return dict(action.choices)


def options_of(parser: argparse.ArgumentParser) -> list[str]:
    """The options of a parser by their long names, in its order."""
    actions = [each for each in parser._actions if each.option_strings and each.dest != "help"]
    return [next(name for name in each.option_strings if name.startswith("--")) for each in actions]


def option_table() -> str:
    """A row for each option that several commands have, and a list of the others; figure, movie and page are one."""
    known = {word: options_of(parser) for word, parser in commands().items()}
    holders: dict[str, list[str]] = {}
    for word, names in known.items():
        for name in names:
            holders.setdefault(name, []).append(word)
    shared = [name for name, words in holders.items() if {*words} - {"figure", "movie", "page"} and len(words) > 1]
    shared.sort(key=lambda name: (-len(holders[name]), name))
    lines = [f"| | {' | '.join(known)} |", f"| --- |{' :-: |' * len(known)}"]
    lines += [f"| `{name}` | {' | '.join('•' if w in holders[name] else ' ' for w in known)} |" for name in shared]
    lines += ["", "Options that only one has:", ""]
    own: dict[str, list[str]] = {}
    for name, words in holders.items():
        if name not in shared:
            own.setdefault(", ".join(words), []).append(name)
    lines += [f"- {words}: {', '.join(f'`{name}`' for name in names)}" for words, names in own.items()]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write the table where it stands."""
    text = CONTRIBUTING.read_text(encoding="utf-8")
    before, _, rest = text.partition(BEGINS)
    CONTRIBUTING.write_text(f"{before}{BEGINS}{option_table()}{ENDS}{rest.partition(ENDS)[2]}", encoding="utf-8")


if __name__ == "__main__":
    main()
