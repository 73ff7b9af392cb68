"""Files from anybody are read in one way, and files are written whole: by these functions and no others."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

RULES = {
    r"\bjson\.loads?\(": ({"bihdist_core/file_content.py"}, "`file_content.json_value`, which bounds its depth"),
    r"\bnp\.load\(": (
        {"app/batch/execution.py", "app/batch/results.py"},  # of parts, as much as is looked at, and of archives
        "`formats.array_file.read_array`, which believes no header",
    ),
    r"\bnp\.save\(|\.tofile\(": (set(), "`formats.array_file.put_array`, which notices that a disk is full"),
    r"\.read_text\(": (
        {"bihdist_core/machine_memory.py", "app/figures/export.py", "app/plain_guide.py"}
        | {f"app/qt/look/{name}.py" for name in ("icons", "style_sheet")},
        "`file_content.file_text`, which bounds its size and waits for no pipe",
    ),
}
"""Patterns: who may have them, and what others call instead."""

WRITES = re.compile(r"\.write_(text|bytes)\(|\.open\(\"[wx]b?\"|\bopen\([^)\n]*\"[wx]b?\"")
WHOLE = re.compile(r"\batomic_write\b|\.writing\(")
MAY_WRITE = {
    "app/qt/look/style_sheet.py",  # into a folder of its own
    "app/figures/page_output.py",  # what it is given is temporary
    "bihdist_core/formats/tetrahedra.py",  # for meshio, into a folder of its own
}
EXAMPLE = re.compile(r"^ *>>> .*", re.MULTILINE)
"""A line of an example in a docstring, where users read and write as they like."""


def sources():
    for folder in ("app", "bihdist_core"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            yield path.relative_to(ROOT).as_posix(), EXAMPLE.sub("", path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("pattern", RULES)
def test_files_are_read_and_arrays_written_in_one_way(pattern):
    allowed, instead = RULES[pattern]
    others = [name for name, text in sources() if re.search(pattern, text) and name not in allowed]
    assert not others, f"{others}: use {instead}"
    assert all(re.search(pattern, (ROOT / name).read_text(encoding="utf-8")) for name in allowed)


def test_files_are_written_whole():
    writers = {name for name, text in sources() if WRITES.search(text) and not WHOLE.search(text)}
    assert writers == MAY_WRITE
