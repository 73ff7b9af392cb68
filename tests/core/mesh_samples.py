"""One small mesh in every format this library reads, written by hand or by VTK."""

import struct

import numpy as np

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.25], [0, 1, 0], [-0.5, 1e-3, 1.5]])
FACES = np.array([[0, 1, 2], [0, 2, 3], [3, 4, 0]])
QUAD_AND_TRIANGLE = [[0, 1, 2, 3], [3, 4, 0]]


def rows(array):
    return "".join(" ".join(repr(x) for x in row) + "\n" for row in np.asarray(array).tolist())


def off(vertices=VERTICES, polygons=FACES, header="OFF", line_end="\n"):
    faces = "".join(f"{len(p)} {' '.join(map(str, p))}\n" for p in polygons)
    return f"{header}\n{len(vertices)} {len(polygons)} 0\n{rows(vertices)}{faces}".replace("\n", line_end)


def obj(vertices=VERTICES, polygons=FACES):
    return "".join(f"v {line}\n" for line in rows(vertices).splitlines()) + "".join(
        f"f {' '.join(str(v + 1) for v in p)}\n" for p in polygons
    )


def ply(form, polygons=FACES, vertices=VERTICES, with_colour=False):
    header = f"ply\nformat {form} 1.0\ncomment made by hand\nelement vertex {len(vertices)}\n"
    header += "property double x\nproperty double y\nproperty double z\n"
    header += "property uchar red\n" if with_colour else ""
    header += f"element face {len(polygons)}\nproperty list uchar int vertex_indices\n"
    header += "property list uchar float texcoord\n" if with_colour else ""
    header += "end_header\n"
    colour, texture = ([7], [0.5, 0.25]) if with_colour else ([], None)
    if form == "ascii":
        body = "".join(" ".join(map(repr, [*row, *colour])) + "\n" for row in np.asarray(vertices).tolist())
        for p in polygons:
            body += " ".join(map(str, [len(p), *p, *([2, *texture] if texture else [])])) + "\n"
        return (header + body).encode()
    order = "<" if "little" in form else ">"
    body = b"".join(struct.pack(f"{order}3d{len(colour)}B", *row, *colour) for row in vertices)
    for p in polygons:
        body += struct.pack(f"{order}B{len(p)}i", len(p), *p)
        body += struct.pack(f"{order}B2f", 2, *texture) if texture else b""
    return header.encode() + body


def stl_text(vertices=VERTICES, faces=FACES):
    facets = "".join(
        f"facet normal 0 0 1\n outer loop\n{''.join('  vertex ' + line + chr(10) for line in rows(x).splitlines())}"
        " endloop\nendfacet\n"
        for x in vertices[faces]
    )
    return f"solid a name\n{facets}endsolid a name\n"


def stl_binary(vertices=VERTICES, faces=FACES, announced=None):
    head = b"solid, although binary".ljust(80) + struct.pack("<I", len(faces) if announced is None else announced)
    return head + b"".join(struct.pack("<12fH", 0, 0, 1, *x.ravel(), 0) for x in vertices[faces])


def vtk_old(vertices=VERTICES, polygons=FACES, binary=False):
    flat = [n for p in polygons for n in (len(p), *p)]
    head = f"# vtk DataFile Version 3.0\ntitle\n{'BINARY' if binary else 'ASCII'}\nDATASET POLYDATA\n"
    lines = [f"POINTS {len(vertices)} double\n", f"POLYGONS {len(polygons)} {len(flat)}\n", "POINT_DATA 5\n"]
    if binary:
        parts = [np.asarray(vertices, ">f8").tobytes() + b"\n", np.array(flat, ">i4").tobytes() + b"\n", b""]
    else:
        parts = [rows(vertices).encode(), (" ".join(map(str, flat)) + "\n").encode(), b""]
    return head.encode() + b"".join(line.encode() + part for line, part in zip(lines, parts, strict=True))


def written_by_vtk(path, polygons=FACES, mode="appended", version=None, vertices=VERTICES, compressor=True):
    """The mesh written by VTK itself."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOLegacy import vtkPolyDataWriter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    points, cells, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.asarray(vertices, float), deep=True))
    for polygon in polygons:
        cells.InsertNextCell(len(polygon), [int(v) for v in polygon])
    surface.SetPoints(points)
    surface.SetPolys(cells)
    height = numpy_to_vtk(np.asarray(vertices)[:, 2].copy(), deep=True)
    height.SetName("height of it")
    surface.GetPointData().SetScalars(height)
    if path.suffix == ".vtk":
        writer = vtkPolyDataWriter()
        (writer.SetFileTypeToBinary if mode == "binary" else writer.SetFileTypeToASCII)()
        writer.SetFileVersion(version)
    else:
        writer = vtkXMLPolyDataWriter()
        modes = {"ascii": "SetDataModeToAscii", "binary": "SetDataModeToBinary"}
        getattr(writer, modes.get(mode, "SetDataModeToAppended"))()
        writer.SetEncodeAppendedData(mode == "appended base64")
        if not compressor:
            writer.SetCompressorTypeToNone()
        elif compressor == "lzma":
            writer.SetCompressorTypeToLZMA()
        elif compressor == "lz4":
            writer.SetCompressorTypeToLZ4()
        if mode == "big":
            writer.SetByteOrderToBigEndian()
    writer.SetInputData(surface)
    writer.SetFileName(str(path))
    assert writer.Write() == 1
    return path


def assert_same(surface, vertices=VERTICES, faces=FACES):
    np.testing.assert_array_equal(surface.vertices, vertices)
    np.testing.assert_array_equal(surface.faces, faces)


SAMPLES = {
    "a.off": off(),
    "crlf.off": off(line_end="\r\n"),
    "mac.off": off(line_end="\r"),
    "bom.off": b"\xef\xbb\xbf" + off().encode(),
    "a.obj": obj(),
    "windows.obj": b"\xef\xbb\xbf" + obj().replace("\n", "\r\n").encode(),
    "ascii.ply": ply("ascii"),
    "little.ply": ply("binary_little_endian"),
    "big.ply": ply("binary_big_endian"),
    "text.vtk": vtk_old(),
    "binary.vtk": vtk_old(binary=True),
}
