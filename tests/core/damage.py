"""Files with damage as it comes: cut off, bytes and digits changed, pieces lost, doubled, exchanged or made longer."""

import json
import random
from collections.abc import Iterator
from typing import Any

DIGITS = b"0123456789"
BYTES = b'0123456789 -./\n\r"<>=AZfv\xff\x00\x80'
EXTREMES = (
    b"-1",
    b"0",
    b"1e999",
    b"-1e300",
    b"nan",
    b"inf",
    b"4294967295",
    b"9223372036854775807",
    b"99999999999999999999",
)


def damaged(content: bytes, rng: random.Random) -> bytes:
    """The content, which is not empty, after one damage."""
    there = bytearray(content)
    begin = rng.randrange(len(there))
    end = min(len(there), begin + rng.choice((1, 4, 20, 200)))
    kind = rng.random()
    if kind < 0.25:
        del there[begin:]
    elif kind < 0.45:
        for _ in range(rng.randint(1, 4)):
            there[rng.randrange(len(there))] = rng.choice(BYTES)
    elif kind < 0.65:
        # Other numbers of as many digits, with which most files are still files.
        digits = [k for k, byte in enumerate(there) if byte in DIGITS]
        for k in rng.choices(digits, k=rng.randint(1, 9)) if digits else ():
            there[k] = rng.choice(DIGITS)
    elif kind < 0.75:
        there[begin:begin] = b"9" * rng.randint(1, 14)
    elif kind < 0.8:
        del there[begin:end]
    elif kind < 0.85:
        there[begin:begin] = there[begin:end]
    elif kind < 0.9:
        to = rng.randrange(len(there))
        there[to : to + end - begin] = there[begin:end]
    elif kind < 0.95:
        # As a whole number of a binary file, in either order of its bytes.
        number = rng.choice((0, 1, 2**31 - 1, 2**31, 2**32 - 1, 2**16, 255))
        there[begin : begin + 4] = number.to_bytes(4, rng.choice(("little", "big")))
    else:
        words = content.split(b" ")
        words[rng.randrange(len(words))] = rng.choice(EXTREMES)
        there = bytearray(b" ".join(words))
    return bytes(there)


VALUES = (
    -1, 0, 1, 100, 10**6, 2**31, 2**63, 10**30, 10**400, 1.5, 1e300, float("nan"), float("inf"), True, None, "", "x",
    "x" * 3000, "a\nb", [], {}, [[[]]], [0, 1, 2], "../../etc/passwd", "CON", "\0",
)  # fmt: skip


def damaged_json(text: str, rng: random.Random) -> str:
    """A JSON text with another value, one less, one twice, one in a list of its own, or one of a strange name."""
    data = json.loads(text)
    for _ in range(rng.choice((1, 1, 2))):
        *way, last = rng.choice([*_places(data)])
        there = data
        for step in way:
            there = there[step]
        kind = rng.randrange(6)
        if kind < 3:
            there[last] = rng.choice(VALUES)
        elif kind == 3:
            del there[last]
        elif kind == 4:
            there[last] = [there[last]]
        elif isinstance(there, list):
            there.insert(last, there[last])
        else:
            there[rng.choice(("x", "", "name", "a\nb"))] = there[last]
        if not [*_places(data)]:
            break
    return json.dumps(data)


def _places(data: Any, way: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The steps to all values within a value."""
    steps = data if isinstance(data, dict) else range(len(data)) if isinstance(data, list) else ()
    for step in steps:
        yield (*way, step)
        yield from _places(data[step], (*way, step))
