"""Files compressed by gzip, unpacked in memory up to a limit."""

import gzip
import io
import zlib

from ..errors import MeshError

MOST_BYTES = 1 << 32
"""So many bytes a file may have when it is unpacked: a small one could fill any memory."""
_STEP = 1 << 24


def unpacked(content: bytes, name: str) -> bytes:
    """What a gzip file holds; MeshError where it is none, is cut off or damaged, or holds more than `MOST_BYTES`."""
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
