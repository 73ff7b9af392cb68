"""The parsing of command lines: options by their whole names, with a hint where one is misspelt."""

import argparse
from collections.abc import Mapping, Sequence
from itertools import takewhile
from typing import Any, NoReturn

from bihdist_core.sentences import one_line

from ..document.synonyms import known_option, option_hint

NO_HEADINGS: Mapping[str, Sequence[str]] = {}


class _Help(argparse.HelpFormatter):
    """Keeps the lines of examples."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return text if "\n" in text else super()._fill_text(text, width, indent)


class Parser(argparse.ArgumentParser):
    """Takes no abbreviations, and no option twice; one that it does not know ends in a sentence with the nearest that
    it knows.

    What argparse would say first, that something else is missing, is often a consequence of the misspelt option.

    Parameters
    ----------
    headings : mapping
        The headings of the help, and the commands under each.
    """

    def __init__(self, *args: Any, headings: Mapping[str, Sequence[str]] = NO_HEADINGS, **kwargs: Any) -> None:
        super().__init__(*args, **{**kwargs, "allow_abbrev": False, "formatter_class": _Help})
        self._headings = headings

    def shorten_usage(self) -> None:
        """Let the usage name what is required only; the help lists all options below it."""
        formatter = self._get_formatter()
        required = [each for each in self._actions if each.required or not each.option_strings]
        formatter.add_usage(None, required, [], "")
        self.usage = f"{one_line(formatter.format_help())} [options]"

    def format_help(self) -> str:
        """Return the help, with commands under their headings."""
        if self._subparsers is None:
            return super().format_help()
        formatter = self._get_formatter()
        formatter.add_usage(self.usage, self._actions, self._mutually_exclusive_groups)
        formatter.add_text(self.description)
        commands: Any = self._subparsers._group_actions[0]
        left = {each.dest: each for each in commands._get_subactions()}
        sections = [(title, [left.pop(word) for word in words]) for title, words in self._headings.items()]
        for title, actions in (*sections, ("more", list(left.values())), ("options", self._optionals._group_actions)):
            formatter.start_section(title)
            formatter.add_arguments(actions)
            formatter.end_section()
        formatter.add_text(self.epilog)
        return formatter.format_help()

    def error(self, message: str) -> NoReturn:
        sentence = one_line(message).removeprefix("argument ")
        end = "" if sentence.endswith((".", "?")) else "."
        self.exit(2, f"bihdist: {sentence}{end} See `{self.prog} --help`.\n")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse all arguments as argparse does, so that nothing is left over."""
        args = list(args or ())
        own = _up_to_command(args, self._subparsers is not None)
        own = [self._by_known_name(word) for word in own]
        args[: len(own)] = own
        seen = set[argparse.Action]()
        for word in own:
            if self._is_unknown(word):
                self._refuse(word)
            action = self._option_string_actions.get(word.partition("=")[0])
            if action in seen:
                self.error(f"{word.partition('=')[0]} is given twice; separate several values by commas")
            seen |= {action} if action else set()
        found, left = super().parse_known_args(args, namespace)
        if left:
            self.error(self._about_leftover(left, own))
        return found, left

    def _long_names(self) -> list[str]:
        """Return the long options, without their dashes."""
        return [each[2:] for each in self._option_string_actions if each.startswith("--")]

    def _by_known_name(self, word: str) -> str:
        """Return the word, with the name that this parser knows for another name of an option."""
        if not word.startswith("--"):
            return word
        name, equals, value = word[2:].partition("=")
        return f"--{known_option(name, self._long_names())}{equals}{value}"

    def _is_unknown(self, word: str) -> bool:
        """Return whether a word is an unknown option; what argparse takes for a value is not."""
        name = word.partition("=")[0]
        if word[:1] != "-" or word == "-" or " " in name or self._negative_number_matcher.match(word):
            return False
        return not (name in self._option_string_actions or (word[1] != "-" and word[:2] in self._option_string_actions))

    def _refuse(self, word: str) -> NoReturn:
        name = word.partition("=")[0]
        hint = option_hint(name.lstrip("-"), self._long_names()) if name.startswith("--") else ""
        self.error(f"there is no option {name}{f'; did you mean --{hint}?' if hint else ''}")

    def _about_leftover(self, left: Sequence[str], words: Sequence[str]) -> str:
        """Return a message on words that nothing takes, often as commas are missing between the values of an option."""
        parts = [part for word in words for part in (word.split("=", 1) if word.startswith("--") else [word])]
        for option, value, k in zip(parts, parts[1:], range(2, len(parts)), strict=False):
            action = self._option_string_actions.get(option)
            if action is None or action.nargs is not None or parts[k] != left[0]:
                continue
            values = [value, *takewhile(left.__contains__, parts[k:])]
            if "-" in values:
                return f"{option} takes one word; write {option} '{' '.join(values)}'"
            if action.metavar == "SOURCES" or "," in str(action.metavar):
                return f"{option} takes several with commas between them; write {option} {','.join(values)}"
            return f"{option} takes one value, and {' '.join(values[1:])} is left over"
        return f"unrecognized arguments: {' '.join(left)}"


def _up_to_command(words: Sequence[str], has_commands: bool) -> list[str]:
    """Return the words of a parser itself: those before its command, and before words after `--`."""
    return list(takewhile(lambda word: word != "--" and not (has_commands and not word.startswith("-")), words))
