"""Blocks compressed by LZ4.

Format: https://github.com/lz4/lz4/blob/dev/doc/lz4_Block_format.md
"""


def unpacked_block(block: bytes, size: int) -> bytes:
    """The bytes of a block, at most `size` of them; ValueError where it is damaged."""
    out, at, end = bytearray(), 0, len(block)
    try:
        while True:
            token, at = block[at], at + 1
            literals, at = _length(block, at, token >> 4)
            if at + literals > end or len(out) + literals > size:
                raise ValueError("literals beyond the end")
            out += block[at : at + literals]
            at += literals
            if at == end:  # the last sequence has nothing to repeat
                return bytes(out)
            offset, at = block[at] | block[at + 1] << 8, at + 2
            repeated, at = _length(block, at, token & 15)
            repeated += 4
            start = len(out) - offset
            if start < 0 or not offset or len(out) + repeated > size:
                raise ValueError("a repetition of what is not there")
            if offset >= repeated:
                out += out[start : start + repeated]
            else:  # what is being written is repeated, too
                out += (out[start:] * (repeated // offset + 1))[:repeated]
    except IndexError:
        raise ValueError("it ends within a sequence") from None


def _length(block: bytes, at: int, length: int) -> tuple[int, int]:
    """A length, of which 15 goes on in the next bytes as long as these are 255, and what comes behind it."""
    if length == 15:
        while block[at] == 255:
            length, at = length + 255, at + 1
        length, at = length + block[at], at + 1
    return length, at
