"""VTP files, VTK's XML for points, lines and polygons, as other programs write them: binary, appended, 64 bits."""

from collections.abc import Mapping, Sequence
from typing import BinaryIO
from xml.sax.saxutils import quoteattr

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray

NOTHING: Mapping[str, AnyArray] = {}


def write_poly_data(
    file: BinaryIO,
    points: FloatArray,
    lines: Sequence[IntArray] | IntArray = (),
    polygons: Sequence[IntArray] | IntArray = (),
    point_data: Mapping[str, FloatArray] = NOTHING,
    cell_data: Mapping[str, AnyArray] = NOTHING,
) -> None:
    """Points (n, 3), and lines and polygons as the ids (k,) of their corners, or (m, k) where all have as many.

    point_data, cell_data: arrays by name, with a value for each point or cell.
    """
    blocks: list[bytes] = []
    offset = 0

    def array(name: str, values: AnyArray, components: int = 1) -> str:
        nonlocal offset
        kind = "Float64" if values.dtype.kind == "f" else "Int64"
        content = values.astype("<f8" if kind == "Float64" else "<i8").tobytes()
        tag = f'<DataArray type="{kind}" Name={quoteattr(name)}'
        tag += f' NumberOfComponents="{components}"' if components > 1 else ""
        tag += f' format="appended" offset="{offset}"/>\n'
        blocks.extend([len(content).to_bytes(8, "little"), content])
        offset += 8 + len(content)
        return tag

    def section(name: str, tags: str) -> str:
        return f"<{name}>\n{tags}</{name}>\n" if tags else ""

    parts = [
        section("PointData", "".join(array(name, values) for name, values in point_data.items())),
        section("CellData", "".join(array(name, values) for name, values in cell_data.items())),
        section("Points", array("Points", points, components=3)),
    ]
    for name, cells in (("Lines", lines), ("Polys", polygons)):
        if len(cells):
            corners, ends = _flat(cells)
            parts.append(section(name, array("connectivity", corners) + array("offsets", ends)))
    file.write(
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<PolyData>\n'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="{len(lines)}" NumberOfStrips="0" '
        f'NumberOfPolys="{len(polygons)}">\n{"".join(parts)}</Piece>\n</PolyData>\n'
        '<AppendedData encoding="raw">\n_'.encode()
    )
    for block in blocks:
        file.write(block)
    file.write(b"\n</AppendedData>\n</VTKFile>\n")


def _flat(cells: Sequence[IntArray] | IntArray) -> tuple[IntArray, IntArray]:
    """The corners of all cells in a row, and where each cell ends."""
    if isinstance(cells, np.ndarray):
        return cells.ravel(), cells.shape[1] * np.arange(1, len(cells) + 1)
    return np.concatenate(cells), np.cumsum([len(cell) for cell in cells])
