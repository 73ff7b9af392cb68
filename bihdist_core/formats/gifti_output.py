"""Values at vertices as a GIFTI file (.func.gii, .shape.gii), which Workbench, nibabel and neuromaps read.

Format: https://www.nitrc.org/projects/gifti/, version 1.0.  Values are float32, as Workbench wants them.
"""

import base64
import re
import zlib
from collections.abc import Mapping
from typing import BinaryIO
from xml.sax.saxutils import escape

from ..arrays import AnyArray

_LEFT, _RIGHT = (
    re.compile(rf"(^|[._-])({words})(?=[._-]|$)", re.IGNORECASE) for words in ("lh|l|left|hemi-l", "rh|r|right|hemi-r")
)


def write_gifti_values(file: BinaryIO, surface_name: str, columns: Mapping[str, AnyArray]) -> None:
    """Write an array (n,) for each name; the structure is that of the hemisphere that the surface's name says."""
    hemisphere = "CortexLeft" if _LEFT.search(surface_name) else "CortexRight" if _RIGHT.search(surface_name) else ""
    about = _meta_data({"AnatomicalStructurePrimary": hemisphere} if hemisphere else {})
    arrays = "".join(_array(name, values) for name, values in columns.items())
    file.write(
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<!DOCTYPE GIFTI SYSTEM "http://www.nitrc.org/frs/download.php/115/gifti.dtd">\n'
        f'<GIFTI Version="1.0" NumberOfDataArrays="{len(columns)}">\n{about}<LabelTable/>\n{arrays}</GIFTI>\n'.encode()
    )


def _array(name: str, values: AnyArray) -> str:
    text = base64.b64encode(zlib.compress(values.astype("<f4").tobytes())).decode("ascii")
    return (
        '<DataArray Intent="NIFTI_INTENT_NONE" DataType="NIFTI_TYPE_FLOAT32" ArrayIndexingOrder="RowMajorOrder" '
        f'Dimensionality="1" Dim0="{len(values)}" Encoding="GZipBase64Binary" Endian="LittleEndian" '
        f'ExternalFileName="" ExternalFileOffset="">\n{_meta_data({"Name": name})}<Data>{text}</Data>\n</DataArray>\n'
    )


def _meta_data(texts: Mapping[str, str]) -> str:
    entries = "".join(f"<MD><Name>{escape(k)}</Name><Value>{escape(v)}</Value></MD>" for k, v in texts.items())
    return f"<MetaData>{entries}</MetaData>\n"
