"""Blocks of LZ4: written by VTK, and damaged."""

import random
from contextlib import suppress

import pytest

from bihdist_core.formats.compression import unpacked_block


def packed(*sequences):
    """A block of sequences: literals, how far back, how many; the last of literals alone."""

    def length(count):
        return b"" if count < 15 else b"\xff" * ((count - 15) // 255) + bytes([(count - 15) % 255])

    block = b""
    for literals, *repeated in sequences:
        more = repeated[1] - 4 if repeated else 0
        block += bytes([min(len(literals), 15) << 4 | min(more, 15)]) + length(len(literals)) + literals
        block += repeated[0].to_bytes(2, "little") + length(more) if repeated else b""
    return block


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        (packed((b"",)), b""),
        (packed((b"hello",)), b"hello"),
        (packed((bytes(range(200)) * 3,)), bytes(range(200)) * 3),
        (packed((b"abcdefgh", 8, 4), (b"xyzzy",)), b"abcdefghabcdxyzzy"),
        (packed((b"a", 1, 600), (b"bcdef",)), b"a" * 601 + b"bcdef"),
        (packed((b"abc", 3, 7), (b"12345",)), b"abcabcabca12345"),
        (packed((b"x" * 15, 15, 19), (b"12345",)), b"x" * 34 + b"12345"),
    ],
)
def test_literals_and_repetitions(block, expected):
    assert unpacked_block(block, len(expected)) == expected
    if expected:
        with pytest.raises(ValueError, match=r"literals beyond the end|what is not there"):
            unpacked_block(block, len(expected) - 1)


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        (b"", "ends within a sequence"),
        (packed((b"hello",))[:-1], "literals beyond the end"),
        (packed((b"abcdefgh", 9, 4), (b"xyzzy",)), "what is not there"),
        (packed((b"abcdefgh", 0, 4), (b"xyzzy",)), "what is not there"),
        (packed((b"abcdefgh", 8, 4)), "ends within a sequence"),
        (b"\xf0\xff\xff", "ends within a sequence"),
    ],
)
def test_damaged_blocks(block, expected):
    with pytest.raises(ValueError, match=expected):
        unpacked_block(block, 100)


def test_any_bytes_are_unpacked_or_refused():
    rng = random.Random(0)
    for _ in range(3000):
        with suppress(ValueError):
            assert len(unpacked_block(rng.randbytes(rng.randrange(60)), 1000)) <= 1000
