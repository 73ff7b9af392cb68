"""Fields and tables written to files: they read back exactly, in this library, in NumPy and in VTK."""

import csv

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy

from bihdist_core.errors import OutputError, ParameterError
from bihdist_core.file_output import check_output
from bihdist_core.formats.field_output import ARRAY_FORMATS, FIELD_FORMATS, ply_names, write_array, write_fields
from bihdist_core.formats.mesh_io import read_surface
from bihdist_core.formats.vertex_values import read_vertex_values
from bihdist_core.surface import Surface

RNG = np.random.default_rng(3)
SURFACE = Surface(RNG.normal(size=(6, 3)), [[0, 1, 2], [2, 1, 3], [3, 4, 0]], name="six")
FIELDS = {"biharmonic, exact": np.append(RNG.normal(size=5), np.nan), "steps": np.arange(6)}


def test_csv_reads_back_exactly(tmp_path):
    write_fields(tmp_path / "a.csv", SURFACE, FIELDS)
    with (tmp_path / "a.csv").open(newline="") as file:
        head, *lines = csv.reader(file)
    assert head == ["vertex", "biharmonic, exact", "steps"]
    assert [line[0] for line in lines] == list("012345")
    assert lines[5][1] == "nan"
    read = np.loadtxt(tmp_path / "a.csv", delimiter=",", skiprows=1)
    np.testing.assert_array_equal(read[:, 1:], np.stack(list(FIELDS.values()), axis=1))


def test_npy_holds_one_column_a_field(tmp_path):
    write_fields(tmp_path / "a.npy", SURFACE, FIELDS)
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), np.stack(list(FIELDS.values()), axis=1))
    write_fields(tmp_path / "a.npy", SURFACE, {"steps": FIELDS["steps"]})
    assert np.load(tmp_path / "a.npy").shape == (6,)


@pytest.mark.parametrize("extension", [".ply", ".vtp"])
def test_the_surface_reads_back_with_all_its_vertices(tmp_path, extension):
    write_fields(tmp_path / f"a{extension}", SURFACE, FIELDS)
    read = read_surface(tmp_path / f"a{extension}")
    np.testing.assert_array_equal(read.vertices, SURFACE.vertices)
    np.testing.assert_array_equal(read.faces, SURFACE.faces)


def test_vtp_is_read_by_vtk(tmp_path):
    pytest.importorskip("vtkmodules", reason="VTK is not installed")
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    fields = {'<a> & "b"': FIELDS["steps"], **FIELDS}
    write_fields(tmp_path / "a.vtp", SURFACE, fields)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "a.vtp"))
    reader.Update()
    read = reader.GetOutput()
    np.testing.assert_array_equal(vtk_to_numpy(read.GetPoints().GetData()), SURFACE.vertices)
    np.testing.assert_array_equal(vtk_to_numpy(read.GetPolys().GetConnectivityArray()), SURFACE.faces.ravel())
    for name, values in fields.items():
        np.testing.assert_array_equal(vtk_to_numpy(read.GetPointData().GetArray(name)), values)


def test_ply_is_read_by_vtk_and_holds_the_fields(tmp_path):
    pytest.importorskip("vtkmodules", reason="VTK is not installed")
    from vtkmodules.vtkIOPLY import vtkPLYReader

    write_fields(tmp_path / "a.ply", SURFACE, FIELDS)
    reader = vtkPLYReader()
    reader.SetFileName(str(tmp_path / "a.ply"))
    reader.Update()
    read = reader.GetOutput()
    # VTK reads PLY in single precision and leaves unknown properties out.
    np.testing.assert_allclose(vtk_to_numpy(read.GetPoints().GetData()), SURFACE.vertices, rtol=1e-6)
    assert read.GetNumberOfPolys() == 3
    header, body = (tmp_path / "a.ply").read_bytes().split(b"end_header\n")
    assert b"property double z\nproperty double biharmonic_exact\nproperty double steps\n" in header
    table = np.frombuffer(body, "<f8", 6 * 5).reshape(6, 5)
    np.testing.assert_array_equal(table[:, 3:], np.stack(list(FIELDS.values()), axis=1))


def test_ply_names_are_plain_and_different():
    assert ply_names(["x", "a b", "a-b", "1/λ", "λ", "a_b_2"]) == ["x_2", "a_b", "a_b_2", "1", "field", "a_b_2_2"]


def test_a_single_array_as_table(tmp_path):
    matrix = RNG.normal(size=(4, 4))
    write_array(tmp_path / "a.npy", matrix)
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), matrix)
    write_array(tmp_path / "a.csv", matrix)
    np.testing.assert_array_equal(np.loadtxt(tmp_path / "a.csv", delimiter=","), matrix)
    write_array(tmp_path / "b.csv", np.arange(3), ["id"])
    assert (tmp_path / "b.csv").read_text() == "id\n0\n1\n2\n"


def test_pairs_keep_whole_ids(tmp_path):
    write_array(tmp_path / "a.csv", [[0, 7, 0.1], [2, 1, np.nan]], ["i", "j", "distance"])
    assert (tmp_path / "a.csv").read_text() == "i,j,distance\n0,7,0.1\n2,1,nan\n"


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({}, "no fields"),
        ({"d": np.zeros(5)}, r"'d' has shape \(5,\)"),
        ({"d": np.zeros((6, 1))}, r"shape \(6, 1\)"),
        ({"d": np.zeros(6, complex)}, "type complex128"),
        ({"d": ["a"] * 6}, "real number"),
    ],
)
def test_fields_that_do_not_fit_leave_no_file(tmp_path, fields, expected):
    with pytest.raises(ParameterError, match=expected):
        write_fields(tmp_path / "a.csv", SURFACE, fields)
    assert not list(tmp_path.iterdir())


def test_tables_that_do_not_fit(tmp_path):
    with pytest.raises(ParameterError, match="one or two axes"):
        write_array(tmp_path / "a.npy", np.zeros((2, 2, 2)))
    with pytest.raises(ParameterError, match="2 column names were given for 3 columns"):
        write_array(tmp_path / "a.csv", np.zeros((2, 3)), ["i", "j"])


def test_the_extension_is_checked_before_work(tmp_path):
    assert check_output(tmp_path / "A.CSV", FIELD_FORMATS) == ".csv"
    with pytest.raises(OutputError, match=r"extension '\.png'; this can be written as \.npy, \.csv, \.ply, \.vtp"):
        check_output(tmp_path / "a.png", FIELD_FORMATS)
    with pytest.raises(OutputError, match="no extension"):
        write_array(tmp_path / "a", np.zeros(2))
    with pytest.raises(OutputError, match="no folder"):
        check_output(tmp_path / "none" / "a.npy", ARRAY_FORMATS)


@pytest.mark.parametrize("name", ["lh.pial.func.gii", "A.SHAPE.GII"])
def test_gifti_is_read_by_us_and_by_nibabel(tmp_path, name):
    nibabel = pytest.importorskip("nibabel")
    write_fields(tmp_path / name, SURFACE, {"steps": FIELDS["steps"]})
    np.testing.assert_array_equal(read_vertex_values(tmp_path / name), np.arange(6, dtype="f4"))
    write_fields(
        tmp_path / name,
        Surface(SURFACE.vertices, SURFACE.faces, name="sub_lh.pial"),
        FIELDS | {"a < b": FIELDS["steps"]},
    )
    image = nibabel.GiftiImage.from_bytes((tmp_path / name).read_bytes())
    assert image.meta["AnatomicalStructurePrimary"] == "CortexLeft"
    assert [array.metadata["Name"] for array in image.darrays] == [*FIELDS, "a < b"]
    assert {array.data.dtype for array in image.darrays} == {np.dtype("float32")}
    expected = np.stack([*FIELDS.values(), FIELDS["steps"]], axis=1).astype("f4")
    np.testing.assert_array_equal(np.stack(image.agg_data(), axis=1), expected)


@pytest.mark.parametrize(
    ("name", "structure"),
    [
        ("lh.pial", "CortexLeft"),
        ("pial_right.gii.gz", "CortexRight"),
        ("100307.R.midthickness.surf.gii", "CortexRight"),
        ("tpl_hemi-L_white.surf.gii", "CortexLeft"),
        ("bright.left-over", "CortexLeft"),
        ("hand.ply", None),
        ("lhasa.ply", None),
    ],
)
def test_the_hemisphere_is_what_the_mesh_is_called(tmp_path, name, structure):
    from xml.etree import ElementTree

    write_fields(tmp_path / "x.shape.gii", Surface(SURFACE.vertices, SURFACE.faces, name=name), FIELDS)
    told = ElementTree.parse(tmp_path / "x.shape.gii").find("MetaData/MD/Value")
    assert (None if told is None else told.text) == structure


def test_gifti_of_values_is_named_so(tmp_path):
    for name in ("x.gii", "x.surf.gii", ".func.gii"):
        with pytest.raises(OutputError, match=r"can be written as \.npy, .*\.func\.gii, \.shape\.gii"):
            write_fields(tmp_path / name, SURFACE, FIELDS)
