"""Messages stay a line that can be read, whatever names and values they repeat."""

import re
from collections.abc import Iterable

MOST_CHARACTERS = 1000
"""Characters of a message."""
MOST_WORD_CHARACTERS = 300
"""Characters of a name or a value in it: a path may be long."""

_BREAKS = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]+")
_LONG_WORDS = re.compile(rf"\S{{{MOST_WORD_CHARACTERS + 1},}}")


def one_line(message: str) -> str:
    """Return a message without line breaks and other control characters, its long words and itself shortened in the
    middle."""
    line = _BREAKS.sub(" ", message).strip()
    line = _LONG_WORDS.sub(lambda found: shortened(found[0], MOST_WORD_CHARACTERS), line)
    return shortened(line, MOST_CHARACTERS)


def shortened(text: str, most: int) -> str:
    """Return a text of at most so many characters, what is in the middle left out."""
    if len(text) <= most:
        return text
    end = (most - 3) // 3
    return f"{text[: most - 3 - end]}...{text[len(text) - end :]}"


def with_and(words: Iterable[str]) -> str:
    """Return "pins, anchors and selections"; "" for no words."""
    *others, last = tuple(words) or ("",)
    return f"{', '.join(others)} and {last}" if others else last
