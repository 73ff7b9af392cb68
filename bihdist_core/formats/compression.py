"""Compressed content: gzip files, unpacked in memory up to a limit, and blocks of LZ4.

Format of the blocks: https://github.com/lz4/lz4/blob/dev/doc/lz4_Block_format.md
"""

import gzip
import io
import zlib

from ..errors import MeshError

MOST_BYTES = 1 << 32
"""So many bytes a file may have when it is unpacked: a small one could fill any memory."""
_STEP = 1 << 24


def unpacked(content: bytes, name: str) -> bytes:
    """Unpack a gzip file.

    MeshError where it is none, is cut off or damaged, or holds more than `MOST_BYTES`.
    """
    parts, held = [], 0
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(content)) as file:
            while part := file.read(_STEP):
                parts.append(part)
                held += len(part)
                if held > MOST_BYTES:
                    raise MeshError(f"{name} unpacks to more than {MOST_BYTES / 2**30:g} GiB; it is not read.")
    except EOFError:
        raise MeshError(f"{name} is cut off: its gzip data do not end.") from None
    except (gzip.BadGzipFile, zlib.error) as error:
        raise MeshError(f"{name} is not a gzip file, or is damaged ({error}).") from None
    return b"".join(parts)


def unpacked_block(block: bytes, size: int) -> bytes:
    """Return the bytes of a block, at most `size` of them; ValueError where it is damaged."""
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
    """Return a length, of which 15 goes on in the next bytes as long as these are 255, and what comes behind it."""
    if length == 15:
        while block[at] == 255:
            length, at = length + 255, at + 1
        length, at = length + block[at], at + 1
    return length, at
