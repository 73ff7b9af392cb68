"""Files from anybody: regular, of bounded size, in UTF-8; whatever else is a sentence of bounded length."""

import gzip
import os
import pickle
import sys
from importlib import import_module

import pytest

from bihdist_core import BihdistError, NotEnoughMemory, OutputError, ParameterError
from bihdist_core.file_content import MOST_NESTED, file_json, file_text, json_value, open_regular
from bihdist_core.formats.mesh_names import FORMATS, FREESURFER, MESH_FORMATS, MNI, is_mesh_file, mesh_format, mesh_name
from bihdist_core.sentences import MOST_CHARACTERS, MOST_WORD_CHARACTERS, one_line, shortened, with_and
from tests.core.mesh_samples import (
    VERTICES,
    freesurfer,
    freesurfer_text,
    gifti,
    gifti_array,
    gifti_surface,
    mat,
    mni,
    npz,
    off,
)
from tests.core.test_freesurfer import values


def test_text_with_and_without_a_mark_is_the_same(tmp_path):
    (tmp_path / "a").write_bytes(b"\xef\xbb\xbf7\r\n")
    (tmp_path / "b").write_bytes(b"7\r\n")
    assert file_text(tmp_path / "a", "map in") == file_text(tmp_path / "b", "map in") == "7\r\n"


def test_what_cannot_be_read_is_named(tmp_path):
    (tmp_path / "latin").write_bytes(b"\xff")
    (tmp_path / "large").write_bytes(bytes(3_000_001))
    for name, words in {
        "none": "No such file or directory",
        ".": "it is a folder",
        "latin": "it is not a text file",
        "large": "it has 3 MB, and such a file has at most 1",
        "zero\0": r"(stat: )?embedded null (byte|character)",
        "x" * 5000: "File name too long",
    }.items():
        with pytest.raises(ParameterError, match=f"The map in .* cannot be read: {words}"):
            file_text(tmp_path / name, "map in", 1_000_000)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes in folders")
def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(ParameterError, match="it is not a regular file"):
        open_regular(tmp_path / "pipe", "map in")


def nested(depth):
    return "[" * depth + "]" * depth


def test_json_may_be_nested_so_deep_and_no_deeper():
    assert json_value(nested(MOST_NESTED))
    for text in (nested(MOST_NESTED + 1), nested(sys.getrecursionlimit() - 100), nested(1_000_000)):
        with pytest.raises(ParameterError, match="nested more than 64 deep"):
            json_value(text)
    with pytest.raises(ParameterError, match="nested more than 64 deep"):
        json_value('{"a": ' * 100 + "1" + "}" * 100)


def test_what_is_no_json_is_named(tmp_path):
    (tmp_path / "a.json").write_text('{"a": 1,\n b}')
    with pytest.raises(ParameterError, match=r"a\.json is not a curve: it is not JSON \(line 2: "):
        file_json(tmp_path / "a.json", "curve", "a curve")
    (tmp_path / "a.json").write_text("1" * 10_000)
    with pytest.raises(ParameterError, match="a number of thousands of digits"):
        file_json(tmp_path / "a.json", "curve", "a curve")


# ---------------------------------------------------------------------- sentences
def test_a_short_text_stays_and_a_long_one_loses_its_middle():
    assert shortened("abcdefghij", 10) == "abcdefghij"
    assert shortened("abcdefghijk", 10) == "abcde...jk"
    assert all(len(shortened("x" * 100, most)) == most for most in range(4, 100))


def test_names_are_listed_with_and_before_the_last():
    assert [with_and("abc"[:count]) for count in range(4)] == ["", "a", "a and b", "a, b and c"]


def test_a_message_is_one_line():
    assert one_line("a\nb\r\n\tc\x1b[1m\u2028d ") == "a b c [1m d"
    path = "/" + "x" * (MOST_WORD_CHARACTERS - 1)
    assert one_line(f"{path} is  missing.") == f"{path} is  missing."


@pytest.mark.parametrize("kind", [BihdistError, ParameterError, OutputError, NotEnoughMemory])
def test_errors_say_no_more(kind):
    error = kind(f"No {'x' * 3000} in\n{'a b ' * 500}; rename it.")
    assert len(str(error)) <= MOST_CHARACTERS
    assert "\n" not in str(error)
    assert str(error).startswith("No xxx")
    assert str(error).endswith("; rename it.")
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


# ---------------------------------------------------------------------- mesh names
@pytest.mark.parametrize(
    ("path", "form", "name"),
    [
        ("a.off", ".off", "a"),
        ("dir.x/A.B.OFF.GZ", ".off", "A.B"),
        ("lh.pial.surf.gii.gz", ".gii", "lh.pial"),
        ("pial_left.gii.gz", ".gii", "pial_left"),
        ("lh.pial", FREESURFER, "lh.pial"),
        ("sub-01_rh.sphere.reg.gz", FREESURFER, "sub-01_rh.sphere.reg"),
        ("lh.stl", ".stl", "lh"),
        ("a.step", "", "a"),
        ("mesh", "", "mesh"),
        (".gz", "", ""),
        ("shlh.pial", "", "shlh"),
    ],
)
def test_format_and_name(path, form, name):
    assert (mesh_format(path), mesh_name(path)) == (form, name)


def test_each_format_has_a_reader():
    assert {*FORMATS} == {*MESH_FORMATS, FREESURFER, MNI}
    for row in FORMATS.values():
        assert callable(getattr(import_module(f"bihdist_core.formats.{row.reader}"), f"read_{row.reader}"))


def test_meshes_of_a_folder_are_told_from_values_beside_them(put, tmp_path):
    shape = gifti(gifti_array("SHAPE", VERTICES[:, 0]))
    meshes = {
        "a.off": off(),
        "b.off.gz": gzip.compress(off().encode()),
        "lh.pial": freesurfer(),
        "outer_skin.surf": freesurfer(),
        "pial.asc": freesurfer_text(),
        "mni.obj": mni(),
        "cat0.mat": mat(),
        "a.npz": npz(),
        "rh.white.gz": gzip.compress(freesurfer()),
        "a.surf.gii": gifti_surface(),
        "left.gii.gz": gzip.compress(gifti_surface()),
        "cut.gii.gz": gzip.compress(gifti_surface())[:-20],  # reading says what is wrong
    }
    others = {
        "lh.curv": values(),
        "a.shape.gii": shape,
        "sulc.gii": shape,
        "a.func.gii": gifti_surface(),
        "a.txt": "1",
        "lh.a.label": "#!ascii label\n",
    }
    others |= {
        "lh.curv.asc": "000 0 0 0 1\n",
        "any.surf": "# HyperSurface\n",
        "lh.aparc.annot": b"\0\0\0\5",
        "rh.thickness.gz": b"no gzip",
    }
    others |= {"f.mat": mat(names=("X", "f")), "f.npz": npz().replace(b"faces", b"facet"), "cut.npz": npz()[:-9]}
    for name, content in (meshes | others).items():
        put(name, content)
    (tmp_path / "folder.gii").mkdir()
    found = {path.name for path in tmp_path.iterdir() if is_mesh_file(path) and path.is_file()}
    assert found == meshes.keys()
