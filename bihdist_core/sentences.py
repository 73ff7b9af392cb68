"""Messages stay a line that can be read, whatever names and values they repeat."""

import re

LONGEST = 1000
"""Characters of a message."""
LONGEST_WORD = 300
"""Characters of a name or a value in it: a path may be long."""

_BREAKS = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]+")
_LONG_WORDS = re.compile(rf"\S{{{LONGEST_WORD + 1},}}")


def one_line(message: str) -> str:
    """A message without line breaks and other control characters, its long words and itself shortened in the middle."""
    line = _BREAKS.sub(" ", message).strip()
    line = _LONG_WORDS.sub(lambda found: shortened(found[0], LONGEST_WORD), line)
    return shortened(line, LONGEST)


def shortened(text: str, most: int) -> str:
    """A text of at most so many characters, what is in the middle left out."""
    if len(text) <= most:
        return text
    end = (most - 3) // 3
    return f"{text[: most - 3 - end]}...{text[len(text) - end :]}"
