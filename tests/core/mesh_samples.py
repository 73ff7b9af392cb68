"""One small mesh in every format this library reads, written by hand or by VTK."""

import base64
import gzip
import io
import json
import struct
import zlib

import numpy as np
import pytest
from scipy.io import savemat

from bihdist_core.errors import MeshError

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.25], [0, 1, 0], [-0.5, 1e-3, 1.5]])
FACES = np.array([[0, 1, 2], [0, 2, 3], [3, 4, 0]])
QUAD_AND_TRIANGLE = [[0, 1, 2, 3], [3, 4, 0]]


def rows(array):
    return "".join(" ".join(repr(x) for x in row) + "\n" for row in np.asarray(array).tolist())


def off(vertices=VERTICES, polygons=FACES, header="OFF", line_end="\n"):
    faces = "".join(f"{len(p)} {' '.join(map(str, p))}\n" for p in polygons)
    return f"{header}\n{len(vertices)} {len(polygons)} 0\n{rows(vertices)}{faces}".replace("\n", line_end)


def off_binary(vertices=VERTICES, polygons=FACES, header="OFF", colours=()):
    """colours: of each face, so many floats."""
    body = struct.pack(">3i", len(vertices), len(polygons), 0) + np.asarray(vertices, ">f4").tobytes()
    for p in polygons:
        body += struct.pack(f">{len(p) + 2}i{len(colours)}f", len(p), *p, len(colours), *colours)
    return f"{header} BINARY\n".encode() + body


def gltf_parts(vertices=VERTICES, faces=FACES, index_type="<u2"):
    """The JSON of a glTF file as a dict, and its buffer; one mesh at one node."""
    ids = np.asarray(faces, index_type).tobytes()
    buffer = ids + b"\0" * (-len(ids) % 4) + np.asarray(vertices, "<f4").tobytes()
    begin = len(buffer) - 12 * len(vertices)
    component = {"<u1": 5121, "<u2": 5123, "<u4": 5125}[index_type]
    data = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": component, "count": 3 * len(faces), "type": "SCALAR"},
            {"bufferView": 1, "componentType": 5126, "count": len(vertices), "type": "VEC3"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": len(ids)},
            {"buffer": 0, "byteOffset": begin, "byteLength": 12 * len(vertices)},
        ],
        "buffers": [{"byteLength": len(buffer)}],
    }
    return data, buffer


def gltf(data, buffer):
    """A .gltf file with the buffer inside."""
    uri = "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()
    return json.dumps({**data, "buffers": [{"byteLength": len(buffer), "uri": uri}]}).encode()


def glb(data, buffer):
    text, buffer = json.dumps(data).encode(), buffer + b"\0" * (-len(buffer) % 4)
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I", len(text)) + b"JSON" + text + struct.pack("<I", len(buffer)) + b"BIN\0" + buffer
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def gifti_array(intent, values, encoding="GZipBase64Binary", order="<"):
    values = np.asarray(values)
    kind = {"f8": "FLOAT64", "f4": "FLOAT32", "i4": "INT32", "i8": "INT64"}[values.dtype.str[1:]]
    content = values.astype(values.dtype.newbyteorder(order)).tobytes()
    if encoding == "ASCII":
        text = " ".join(map(repr, values.ravel().tolist()))
    else:
        text = base64.b64encode(zlib.compress(content) if encoding.startswith("GZip") else content).decode()
    shape = " ".join(f'Dim{k}="{size}"' for k, size in enumerate(values.shape))
    return (
        f'<DataArray Intent="NIFTI_INTENT_{intent}" DataType="NIFTI_TYPE_{kind}" ArrayIndexingOrder="RowMajorOrder" '
        f'Dimensionality="{values.ndim}" {shape} Encoding="{encoding}" '
        f'Endian="{"LittleEndian" if order == "<" else "BigEndian"}" ExternalFileName="" ExternalFileOffset="">\n'
        f"<MetaData/><Data>{text}</Data></DataArray>\n"
    )


def gifti(*arrays):
    """A GIFTI file of arrays that `gifti_array` has written."""
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<!DOCTYPE GIFTI SYSTEM "http://www.nitrc.org/frs/download.php/115/gifti.dtd">\n'
        f'<GIFTI Version="1.0" NumberOfDataArrays="{len(arrays)}">\n<LabelTable/>\n{"".join(arrays)}</GIFTI>\n'
    ).encode()


def gifti_surface(vertices=VERTICES, faces=FACES, **options):
    points, triangles = np.asarray(vertices, float), np.asarray(faces, "i4")
    return gifti(gifti_array("POINTSET", points, **options), gifti_array("TRIANGLE", triangles, **options))


def freesurfer(vertices=VERTICES, faces=FACES, stamp=b"created by hand\n\n"):
    counts = struct.pack(">2i", len(vertices), len(faces))
    arrays = np.asarray(vertices, ">f4").tobytes() + np.asarray(faces, ">i4").tobytes()
    return b"\xff\xff\xfe" + stamp + counts + arrays


def freesurfer_text(vertices=VERTICES, faces=FACES, marks=None):
    """marks: of each triangle, other than 0 where it is cut out."""
    marked = np.column_stack([faces, np.zeros(len(faces), int) if marks is None else marks])
    text = "".join(f"{line}  0\n" for line in rows(vertices).splitlines()) + rows(marked)
    return f"#!ascii version of lh.pial\n{len(vertices)} {len(faces)}\n{text}"


def mni(vertices=VERTICES, polygons=FACES, colours=0, order="", colour_size=4):
    """A text, or bytes of an order; colours: 0 for one, 1 for one of each polygon, 2 for one of each vertex."""
    n_colours = (1, len(polygons), len(vertices))[colours]
    normals, ends = np.tile([0.0, 0.0, 1.0], (len(vertices), 1)), np.cumsum([len(p) for p in polygons]).tolist()
    corners = [int(v) for p in polygons for v in p]
    if order:
        content = b"p" + np.array([0.3, 0.3, 0.4, 10, 1], f"{order}f4").tobytes()
        content += struct.pack(f"{order}i", len(vertices)) + np.asarray([vertices, normals], f"{order}f4").tobytes()
        content += struct.pack(f"{order}2i", len(polygons), colours) + b"\xff" * colour_size * n_colours
        return content + np.array([*ends, *corners], f"{order}i4").tobytes()
    places = "".join(f" {line}\n" for line in rows(vertices).splitlines())
    text = f"P 0.3 0.3 0.4 10 1 {len(vertices)}\n{places}\n{rows(normals)}\n {len(polygons)}\n {colours} "
    return text + "1 1 1 1\n" * n_colours + f"\n {' '.join(map(str, ends))}\n\n {' '.join(map(str, corners))}\n"


def mat(vertices=VERTICES, faces=FACES, names=("X", "Y", "Z", "TRIV"), struct="surface", packed=True):
    """A MAT file of a struct, or of variables."""
    columns = list(np.asarray(vertices, float).T[:, :, None]) if len(names) == 4 else [np.asarray(vertices, float)]
    arrays = dict(zip(names, [*columns, np.asarray(faces, float) + 1], strict=True))
    file = io.BytesIO()
    savemat(file, {struct: arrays} if struct else arrays, do_compression=packed)
    return file.getvalue()


def npz(vertices=VERTICES, faces=FACES, save=np.savez_compressed, **others):
    file = io.BytesIO()
    save(file, vertices=vertices, faces=faces, **others)
    return file.getvalue()


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
    pytest.importorskip("vtkmodules", reason="VTK is not installed")
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


def grid_written_by_vtk(path, cells, version=42, vertices=VERTICES):
    """An unstructured grid of triangles (of 3 corners) and tetrahedra (of 4), written by VTK."""
    pytest.importorskip("vtkmodules", reason="VTK is not installed")
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkUnstructuredGrid
    from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    points, grid = vtkPoints(), vtkUnstructuredGrid()
    points.SetData(numpy_to_vtk(np.asarray(vertices, float), deep=True))
    grid.SetPoints(points)
    for cell in cells:
        grid.InsertNextCell(VTK_TRIANGLE if len(cell) == 3 else VTK_TETRA, len(cell), cell)
    if path.suffix == ".vtk":
        writer = vtkUnstructuredGridWriter()
        writer.SetFileVersion(version)
    else:
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetCompressorTypeToLZ4()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    assert writer.Write() == 1
    return path


def message_of(call, content, name):
    """What a reader says of content that it refuses, "" if it reads it."""
    try:
        call(content, name)
    except MeshError as error:
        return str(error)
    return ""


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
    "packed.off.gz": gzip.compress(off().encode()),
    "PACKED.PLY.GZ": gzip.compress(ply("binary_big_endian")),
    "wrapped.off": off().replace("1.0 1.0", "1.0\n1.0").replace("3 3 4", "3 3\n\n4 # c\n"),
    "wrapped.ply": ply("ascii").replace(b"1.0 1.0", b"1.0\n1.0").replace(b"3 3 4", b"3 3\n4"),
    "tosca.mat": mat(),
    "a.npz": npz(),
    "a.surf.gii": gifti_surface(),
    "text.gii": gifti_surface(encoding="ASCII"),
    "lh.white.asc": freesurfer_text(),
    "mni.obj": mni(),
    "coloured.obj.gz": gzip.compress(mni(colours=2).encode()),
    "big.gii.gz": gzip.compress(gifti_surface(encoding="Base64Binary", order=">")),
}
SINGLE = {
    "binary.off": off_binary(),
    "coloured.off": off_binary(np.hstack([VERTICES, np.full((5, 4), 0.5)]), header="COFF", colours=(0.5, 0.25, 1)),
    "a.gltf": gltf(*gltf_parts()),
    "bytes.gltf": gltf(*gltf_parts(index_type="<u1")),
    "a.glb": glb(*gltf_parts(index_type="<u4")),
    "a.glb.gz": gzip.compress(glb(*gltf_parts())),
    "lh.pial": freesurfer(),
    "inner_skull.surf": freesurfer(stamp=b"created by hand\n"),
    "little.obj": mni(order="<"),
    "big.obj": mni(order=">", colours=1, colour_size=8),
    "sub-01_rh.white.gz": gzip.compress(freesurfer()),
}
"""Those that hold single precision."""


def samples_of_all_formats(folder):
    """The bytes of the mesh in every format and encoding, by the names of files; folder: for what VTK writes."""
    samples = {name: content if isinstance(content, bytes) else content.encode() for name, content in SAMPLES.items()}
    samples |= SINGLE | {"text.stl": stl_text().encode(), "binary.stl": stl_binary()}
    samples |= {"mixed.ply": ply("binary_little_endian", QUAD_AND_TRIANGLE, with_colour=True)}
    for compressor in ("zlib", "lz4"):
        samples[f"{compressor}.vtp"] = written_by_vtk(folder / "a.vtp", compressor=compressor).read_bytes()
    samples["grid.vtu"] = grid_written_by_vtk(folder / "a.vtu", FACES.tolist()).read_bytes()
    for mode in ("ascii", "binary", "appended base64"):
        samples[f"{mode.replace(' ', '_')}.vtp"] = written_by_vtk(folder / "a.vtp", mode=mode).read_bytes()
    samples["new.vtk"] = written_by_vtk(folder / "a.vtk", QUAD_AND_TRIANGLE, "binary", 51).read_bytes()
    return samples
