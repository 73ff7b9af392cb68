"""Arrays in .npy files: what NumPy has written is read, and whatever else is there is a sentence."""

import io
import pickle

import numpy as np
import pytest

from bihdist_core import ParameterError
from bihdist_core.formats.array_file import put_array, read_array
from bihdist_core.formats.whole_numbers import read_whole_numbers

ARRAYS = [
    np.arange(5),
    np.arange(6.0).reshape(2, 3).T,
    np.array("hand"),
    np.array([True, False]),
    np.zeros((0, 3), np.float32),
    np.array(3.5),
    np.arange(3, dtype=">u2"),
]


@pytest.mark.parametrize("array", ARRAYS, ids=str)
def test_what_numpy_writes_is_read(array, tmp_path):
    np.save(tmp_path / "a.npy", array)
    found = read_array(tmp_path / "a.npy", "map in")
    assert found.dtype == array.dtype
    assert found.shape == array.shape
    assert (found == array).all()


@pytest.mark.parametrize("array", [*ARRAYS, np.arange(12).reshape(3, 4)[:, ::2]], ids=str)
def test_the_bytes_are_those_of_numpy(array, tmp_path):
    np.save(tmp_path / "a.npy", array)
    with (tmp_path / "b.npy").open("wb") as file:
        put_array(file, array)
    assert (tmp_path / "a.npy").read_bytes() == (tmp_path / "b.npy").read_bytes()


def test_a_header_of_python_2_is_read(tmp_path):
    np.save(tmp_path / "a.npy", np.arange(7))
    content = (tmp_path / "a.npy").read_bytes().replace(b"(7,), } ", b"(7L,), }")
    (tmp_path / "a.npy").write_bytes(content)
    assert read_array(tmp_path / "a.npy", "map in").tolist() == list(range(7))


def with_header(text, numbers=b"", version=(1, 0)):
    header = text.encode("latin1")
    return b"\x93NUMPY" + bytes(version) + len(header).to_bytes(2, "little") + header + numbers


def of_objects():
    file = io.BytesIO()
    np.save(file, np.array([{}], object))
    return file.getvalue()


DAMAGED = {
    b"": "not a .npy file",
    b"12\n13\n": "not a .npy file",
    pickle.dumps([1, 2]): "not a .npy file",
    b"\x93NUMPY\x01": "header is damaged",
    with_header("{", version=(1, 0)): "header is damaged",
    with_header("{'descr': '<i8', 'fortran_order': False, 'shape': (3,)"): "header is damaged",
    with_header("'" * 3): "header is damaged",  # tokenize.TokenError, for NumPy
    with_header("(" * 5000): "header is damaged",
    with_header("{'descr': '<i8', 'fortran_order': False, 'shape': (-1,)}"): "header is damaged",
    with_header("{'descr': '<i8', 'fortran_order': 7, 'shape': (1,)}", bytes(8)): "header is damaged",
    with_header("{'descr': '<i8', 'fortran_order': False, 'shape': (True,)}", bytes(8)): "header is damaged",
    with_header("{'descr': '<i3', 'fortran_order': False, 'shape': (1,)}", bytes(3)): "header is damaged",
    with_header("{'descr': '<i8', 'fortran_order': False, 'shape': (1,)}", bytes(8), (9, 9)): "header is damaged",
    # With a lying header, MemoryError.
    with_header("{'descr': '<i8', 'fortran_order': False, 'shape': (99999999999,)}"): "announces 799,999,999,992 bytes",
    with_header("{'descr': '<i8', 'fortran_order': False, 'shape': (2,)}", bytes(15)): "announces 16 bytes of numbers",
    with_header("{'descr': '<i8', 'fortran_order': False, 'shape': (2,)}", bytes(17)): "and 17 follow",
    with_header("{'descr': [('x', '<i8')], 'fortran_order': False, 'shape': (1,)}", bytes(8)): "not hold plain numbers",
    of_objects(): "not hold plain numbers",
}


@pytest.mark.parametrize(("content", "words"), DAMAGED.items(), ids=range(len(DAMAGED)))
def test_what_is_damaged_is_a_sentence_with_the_file(content, words, tmp_path):
    (tmp_path / "a.npy").write_bytes(content)
    with pytest.raises(ParameterError, match=words) as error:
        read_array(tmp_path / "a.npy", "map in")
    assert str(error.value).startswith(f"The map in {tmp_path}/a.npy cannot be read: ")


def test_mutated_files_are_read_or_refused(tmp_path):
    """As many as 45 of 2,500 ended in something else once."""
    np.save(tmp_path / "a.npy", np.arange(20))
    content, random = (tmp_path / "a.npy").read_bytes(), np.random.default_rng(7)
    refused = []
    for _ in range(2000):
        mutant = bytearray(content)
        for _ in range(random.integers(1, 4)):
            mutant[random.integers(len(mutant) - 100)] = random.integers(256)
        (tmp_path / "b.npy").write_bytes(mutant[: random.integers(len(mutant) - 20, len(mutant) + 1)])
        try:
            read_whole_numbers(tmp_path / "b.npy", "map")
        except ParameterError as error:
            refused.append(str(error))
    assert len(refused) > 1000
    assert all("\n" not in words and len(words) < 500 for words in refused)


@pytest.mark.parametrize("values", [[2.0**63], [1e300], [-(2.0**60)], [float("nan")], [float("inf")]])
def test_floats_beyond_all_ids_are_no_whole_numbers(values, tmp_path):
    np.save(tmp_path / "a.npy", np.array(values))
    with pytest.raises(ParameterError, match="not whole numbers"):
        read_whole_numbers(tmp_path / "a.npy", "labels")


def test_whole_numbers_beyond_all_ids_are_named(tmp_path):
    np.save(tmp_path / "a.npy", np.array([2**63 + 5], np.uint64))
    with pytest.raises(ParameterError, match="9223372036854775813 is larger than any"):
        read_whole_numbers(tmp_path / "a.npy", "labels")
