"""Lines of numbers in a text file, read in bulk; the slower search for the bad word runs only when there is one."""

import re
import warnings
from dataclasses import dataclass
from functools import cached_property
from xml.etree import ElementTree

import numpy as np

from ..arrays import AnyArray, BoolArray, FloatArray, IntArray
from ..errors import MeshError

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_NUMBER = re.compile(rb"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?(nan|inf|infinity)", re.IGNORECASE)
_CORNER = re.compile(rb"[+-]?\d+(/-?\d*){0,2}")


@dataclass(frozen=True)
class NumberLines:
    """`values` (t,) numbers of l lines; line k holds values[first[k]:first[k + 1]] and is line `number[k]` of the file.

    `first` is (l + 1,); line numbers begin at 1.
    """

    values: FloatArray
    first: IntArray
    number: IntArray

    def __len__(self) -> int:
        return len(self.number)

    @property
    def sizes(self) -> IntArray:
        """The number of numbers in each line (l,)."""
        return np.diff(self.first)

    def columns(self, count: int, which: slice | IntArray | BoolArray = slice(None)) -> FloatArray:
        """Return (k, count) the first numbers of each of the lines `which`; these must hold that many."""
        first = self.first[:-1][which]
        if len(first) and np.all(np.diff(first) == count):
            return self.values[first[0] : first[-1] + count].reshape(-1, count)
        rows: FloatArray = self.values[first[:, None] + np.arange(count)]
        return rows


class TextLines:
    """The lines of a text file that hold more than blanks and comments.

    `start`, `end` (l,) positions in `text`; `number` (l,) line numbers in the file, from 1. Windows and old Macintosh
    line ends and a byte order mark are accepted. What matches `continued` are lines to join, all but the last with a
    backslash at the end. MeshError if the bytes are no text.
    """

    def __init__(self, raw: bytes, name: str, comment: bytes = b"", continued: re.Pattern[bytes] | None = None) -> None:
        self.name = name
        self.text = plain_text(raw, name)
        if comment and comment in self.text:
            self.text = re.sub(re.escape(comment) + rb"[^\n]*", b"", self.text)
        if continued and b"\\\n" in self.text:
            # The joined line keeps its line ends behind it, so that later line numbers stay right.
            self.text = continued.sub(lambda m: m[0].replace(b"\\\n", b" ") + b"\n" * m[0].count(b"\n"), self.text)
        byte = np.frombuffer(self.text, np.uint8)
        breaks = np.flatnonzero(byte == 10)
        start, end = np.append(0, breaks + 1), np.append(breaks, len(byte))
        words = _word_starts(byte)
        at = np.append(np.searchsorted(words, start), len(words))
        held = np.flatnonzero(np.diff(at))
        self.start, self.end, self.number = words[at[held]], end[held], held + 1
        self.word_count = np.diff(at)[held]

    def __len__(self) -> int:
        return len(self.start)

    def line(self, k: int) -> str:
        """Return the text of one line, cut short for use in a message."""
        return shown(self.text[self.start[k] : self.end[k]])

    @cached_property
    def keyword(self) -> AnyArray:
        """The first word of each line (l,), cut to 8 characters, as `keyword_code` gives it."""
        byte = np.frombuffer(self.text + b" " * 8, np.uint8)
        code, inside = np.zeros(len(self), np.uint64), np.ones(len(self), bool)
        for k in range(8):
            letter = byte[self.start + k]
            inside &= letter > 32
            code |= np.where(inside, letter, 0).astype(np.uint64) << np.uint64(8 * k)
        return code

    def numbers(self, which: BoolArray, keyword: bytes = b"", slashes: bool = False) -> NumberLines:
        """Return the numbers of the lines in the mask `which` (l,), all of which begin with `keyword` if one is given.

        With `slashes`, what follows a slash inside a word is left out: 7/2/9 is 7.
        MeshError naming the line and the word where something is not a number.
        """
        chosen = np.flatnonzero(which)
        first = np.append(0, np.cumsum(self.word_count[chosen] - bool(keyword)))
        values = parsed(self._joined(chosen, len(keyword)), first[-1], slashes)
        if values is None:
            raise self._not_a_number(chosen, len(keyword), slashes)
        return NumberLines(values, first, self.number[chosen])

    def _joined(self, chosen: IntArray, skip: int) -> bytes:
        """Return the text of some lines without their first `skip` characters."""
        if not len(chosen):
            return b""
        text = np.frombuffer(self.text, np.uint8)
        if skip:
            text = text.copy()
            for k in range(skip):
                text[self.start[chosen] + k] = 32
        breaks = np.flatnonzero(np.diff(chosen) > 1)
        low, high = chosen[np.append(0, breaks + 1)], chosen[np.append(breaks, len(chosen) - 1)]
        view = text.data
        bounds = zip(self.start[low].tolist(), self.end[high].tolist(), strict=True)
        return b"\n".join([view[start:end] for start, end in bounds])

    def _not_a_number(self, chosen: IntArray, skip: int, slashes: bool) -> MeshError:
        pattern, what = (_CORNER, "a corner such as 7, 7/2 or 7/2/9") if slashes else (_NUMBER, "a number")
        for low in range(0, len(chosen), 4096):
            some = chosen[low : low + 4096]
            if parsed(self._joined(some, skip), int((self.word_count[some] - bool(skip)).sum()), slashes) is None:
                for k in some:
                    for word in self.text[self.start[k] + skip : self.end[k]].split():
                        if not pattern.fullmatch(word):
                            return MeshError(f"{self.name}, line {self.number[k]}: {shown(word)} is not {what}.")
        return MeshError(f"{self.name} holds something that is not {what}.")


def plain_text(raw: bytes, name: str) -> bytes:
    """Return the bytes with line feeds as line ends and no byte order mark; MeshError where they are no text."""
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise MeshError(f"{name} is UTF-16 text; save it as plain ASCII or UTF-8.")
    if b"\0" in raw:
        raise MeshError(f"{name} is not a text file: byte {raw.index(0)} is zero.")
    raw = raw.removeprefix(BYTE_ORDER_MARK)
    return raw.replace(b"\r\n", b"\n").replace(b"\r", b"\n") if b"\r" in raw else raw


def keyword_code(word: bytes) -> int:
    """Return a word, cut to 8 characters, as the number that `TextLines.keyword` holds for it."""
    return int.from_bytes(word[:8], "little")


def shown(words: bytes) -> str:
    """Quote bytes of a file for a message, cut short."""
    text = words.decode("utf-8", "replace").strip()
    return repr(text if len(text) <= 40 else text[:37] + "...")


def parsed_numbers(text: bytes, name: str, what: str) -> FloatArray:
    """Return (t,) the numbers of a text without line structure; MeshError that says `what` they should have been."""
    values = parsed(text, len(_word_starts(np.frombuffer(text, np.uint8))))
    if values is None:
        bad = next((word for word in text.split() if not _NUMBER.fullmatch(word)), b"?")
        raise MeshError(f"{name}: {shown(bad)} stands among the {what} but is not a number.")
    return values


def _word_starts(byte: AnyArray) -> IntArray:
    dark = byte > 32
    dark[1:] &= byte[:-1] <= 32
    return np.flatnonzero(dark)


def parsed(text: bytes, words: int, slashes: bool = False) -> FloatArray | None:
    """Return (words,) the numbers of a text; None unless each word is exactly one number."""
    if not words:
        return np.empty(0)
    if slashes and b"/" in text:
        cut = _without_slashes(text)
        if cut is None:
            return None
        text = cut
    # NumPy stops at a word that is no number (with a warning, in future an error) and reads '1-2' as two numbers:
    # so the text is clean exactly when nothing was said and the counts agree.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            values = np.fromstring(text, sep=" ")
        except (DeprecationWarning, ValueError):
            return None
    return values if len(values) == words else None


def _without_slashes(text: bytes) -> bytes | None:
    """Return the text with blanks in place of each first slash of a word and what follows it there.

    None if that is no id.
    """
    byte = np.frombuffer(text, np.uint8)
    slash, blank = byte == ord("/"), byte <= 32
    # From each slash or blank to the next of them, characters are hidden if it was a slash.
    turn = np.flatnonzero(slash | blank)
    hidden = np.zeros(len(byte), bool)
    hidden[turn[0] :] = np.repeat(slash[turn], np.diff(np.append(turn, len(byte))))
    allowed = np.zeros(256, bool)
    allowed[list(b"0123456789-/")] = True
    if slash[0] or (slash[1:] & blank[:-1]).any() or not (allowed[byte] | ~hidden).all():
        return None
    return np.where(hidden, np.uint8(32), byte).tobytes()


def xml_root(content: bytes, name: str, what: str, tag: str) -> ElementTree.Element:
    """Parse an XML file; MeshError where it is not `what`, such as "a GIFTI file", with a root element of this tag."""
    try:
        root = ElementTree.fromstring(content)
    except (ElementTree.ParseError, LookupError, ValueError) as error:
        raise MeshError(f"{name} is not {what}, or is cut off or damaged ({error}).") from None
    if root.tag != tag:
        raise MeshError(f"{name} is not {what}: its root element is {root.tag[:40]!r}, not {tag!r}.")
    return root
