"""Lists in one word of a command line: commas between what is listed, wherever several are taken."""

import os
import re
import sys

from bihdist_core.errors import ParameterError

_PLACE = re.compile(r"f[0-9]+:[^,+]*")
"""The first half of a place in a face, whose two weights have a comma between them."""
_ENDING = re.compile(r"\.[A-Za-z]\w*\s*$")
"""What names of files end in, and no number does."""


def split_list(text: str) -> list[str]:
    """The words between commas; not between those in brackets, in a place such as f311:0.2,0.5, or in a file's name.

    ParameterError for a comma with nothing beside it.
    """
    pieces, words, start = _outside_brackets(text), list[str](), 0
    # Long lists of numbers are not looked for on the disk.
    ends = [k for k, piece in enumerate(pieces, 1) if _ENDING.search(piece)]
    while start < len(pieces):
        files = (end for end in reversed(ends) if end > start + 1 and os.path.exists(",".join(pieces[start:end])))
        end = next(files, start + 1)
        while end < len(pieces) and _PLACE.fullmatch(",".join(pieces[start:end]).rpartition("+")[2].strip()):
            end += 1
        words.append(",".join(pieces[start:end]).strip())
        start = end
    if not all(words):
        raise ParameterError(f"A comma in {text!r} has nothing beside it; write several as 12,40.")
    return words


def _outside_brackets(text: str) -> list[str]:
    """Split a text at those commas that no bracket holds: diffusion(t=1/4),mine(a=1,b=2)."""
    pieces, depth, start = list[str](), 0, 0
    for k, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if letter == "," and depth <= 0:
            pieces.append(text[start:k])
            start = k + 1
    return [*pieces, text[start:]]


def file_in(text: str) -> str:
    """Return the path in @FILE, "-" for standard input (- and @-), "" for what is no file."""
    return "-" if text in ("-", "@-") else text[1:] if text.startswith("@") else ""


def standard_input(what: str) -> str:
    """Return the text of standard input; ParameterError, which speaks of it as `what`, where it is empty."""
    text = sys.stdin.read()
    if not text.strip():
        raise ParameterError(f"Standard input holds no {what}.")
    return text


def pairs_from_words(text: str) -> list[tuple[int, int]] | str:
    """Pairs of vertex ids from `1:2,3:4`, or from standard input; of `@FILE` the path, which is read with the meshes.

    ParameterError for what is no pair.
    """
    path = file_in(text)
    if path == "-":
        from bihdist_core.formats.vertex_maps import pairs_in
        from bihdist_core.formats.whole_numbers import numbered_lines

        found = pairs_in(numbered_lines(standard_input("pairs")), "standard input")
        return [(i, j) for i, j in found.tolist()]
    return path or [pair_from_words(word) for word in split_list(text)]


def pairs_text(pairs: list[tuple[int, int]] | str) -> str:
    """Write pairs as `pairs_from_words` reads them."""
    return f"@{pairs}" if isinstance(pairs, str) else ",".join(f"{i}:{j}" for i, j in pairs)


def pair_from_words(text: str) -> tuple[int, int]:
    """Return a pair of vertex ids from `1:2`; ParameterError for another text."""
    found = re.fullmatch(r"\s*([0-9]{1,15})\s*:\s*([0-9]{1,15})\s*", text)
    if found is None:
        raise ParameterError(f"{text!r} is not a pair of vertex ids such as 1:2")
    return int(found[1]), int(found[2])
