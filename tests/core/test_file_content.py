"""Files from anybody: regular, of bounded size, in UTF-8, JSON of bounded depth; whatever else is a sentence."""

import os
import sys

import pytest

from bihdist_core import ParameterError
from bihdist_core.file_content import DEEPEST, file_json, file_text, json_value, open_regular


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
    assert json_value(nested(DEEPEST))
    for text in (nested(DEEPEST + 1), nested(sys.getrecursionlimit() - 100), nested(1_000_000)):
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
