"""How command lines are read: options by their whole names, and a hint where one is misspelt."""

import argparse
from collections.abc import Sequence
from difflib import get_close_matches
from typing import Any, NoReturn

from bihdist_core.sentences import one_line


class Parser(argparse.ArgumentParser):
    """Takes no abbreviations, and no option twice; one that it does not know ends in its own usage, with the nearest
    one it knows.

    What argparse would say first, that something else is missing, is often a consequence of the misspelt option.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **{**kwargs, "allow_abbrev": False})

    def error(self, message: str) -> NoReturn:
        super().error(one_line(message))

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """As argparse does, but nothing is left over."""
        seen = set[argparse.Action]()
        for word in _up_to_command(args or (), self._subparsers is not None):
            if self._is_unknown(word):
                self._refuse(word)
            action = self._option_string_actions.get(word.partition("=")[0])
            if action in seen:
                self.error(f"{word.partition('=')[0]} is there twice; where it takes several, commas are between them")
            seen |= {action} if action else set()
        found, left = super().parse_known_args(args, namespace)
        if left:
            self.error(f"unrecognized arguments: {' '.join(left)}")
        return found, left

    def _is_unknown(self, word: str) -> bool:
        """Whether a word is an option, and none of these; what argparse takes for a value is none."""
        name = word.partition("=")[0]
        if word[:1] != "-" or word == "-" or " " in name or self._negative_number_matcher.match(word):
            return False
        return not (name in self._option_string_actions or (word[1] != "-" and word[:2] in self._option_string_actions))

    def _refuse(self, word: str) -> NoReturn:
        name = word.partition("=")[0]
        begun = [each for each in self._option_string_actions if each.startswith(name)]
        near = begun[:1] or get_close_matches(name, self._option_string_actions, 1)
        self.error(f"there is no option {name}{f'; did you mean {near[0]}?' if near else ''}")


def _up_to_command(words: Sequence[str], has_commands: bool) -> list[str]:
    """The words that are a parser's own: those before its command, and before what is no option by `--`."""
    own: list[str] = []
    for word in words:
        if word == "--" or (has_commands and not word.startswith("-")):
            break
        own.append(word)
    return own
