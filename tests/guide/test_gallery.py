"""Each example of the gallery makes its pictures; its command lines and its recipes make the same; none has changed.

All run in a small version: sizes are SMALLER times smaller.  After a change that is wanted, all that is stored is made
again by `REMAKE=1 python -m pytest tests/guide/test_gallery.py`, and looked at.
"""

import os
import re
import runpy
import shlex
import shutil
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from PIL import Image

from app.commands.figure import chosen_recipe
from app.document.file import read_recipe, recipe_text, with_meshes_from
from app.figures.export import open_document
from app.figures.picture import figure_again
from app.main import main, parser_of_all
from app.session.array_store import ArrayStore

ROOT = Path(__file__).parents[2]
GALLERY = ROOT / "assets/guide/gallery"
STORED = Path(__file__).parent / "gallery"
EXAMPLES = sorted(GALLERY.rglob("*.py"))

SMALLER = 3
SIZE = re.compile(r"\b(\d{3,4})x(\d{3,4})\b|178mm@150dpi")
FRAMES = re.compile(r"(frames[ =])\d+")

DRAWN = ("three_distances", "correspondence")
"""Examples whose command lines and recipes are drawn; of all others the recipes are compared, which say it all."""

REDUCED = 8
"""What is stored of a picture: the mean colours of squares of so many pixels."""

ALIKE = 10.0
"""Steps of 255 by which these may differ on another machine: fonts and OpenGL shift edges by a fraction of a pixel.
Another source, view or colour map changes some by 30 and more."""


def small(text):
    """An example, or a command line, with small pictures and short movies."""
    text = SIZE.sub(
        lambda size: f"{int(size[1]) // SMALLER}x{int(size[2]) // SMALLER}" if size[1] else "178mm@40dpi", text
    )
    return FRAMES.sub(r"\g<1>3", text)


def commands(text):
    """The command lines of an example, as lists of words."""
    blocks = re.findall(r"^# \.\. code-block:: sh\n#\n((?:#    .*\n)+)", text, re.MULTILINE)
    lines = "".join(blocks).replace("\\\n", "\n").splitlines()
    joined = " ".join(line.removeprefix("#").strip() for line in lines)
    return [shlex.split(f"bihdist {words}")[1:] for words in joined.split("bihdist ")[1:]]


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """Runs an example in its small version, once; the folder with what it has saved."""
    folders = {}

    def run(example):
        if example not in folders:
            folder = folders[example] = tmp_path_factory.mktemp(example.stem)
            script = folder / example.name
            script.write_text(small(example.read_text("utf-8")), "utf-8")
            before = Path.cwd()
            os.chdir(folder)
            try:
                runpy.run_path(str(script))
            finally:
                os.chdir(before)
                script.unlink()
        return folders[example]

    return run


@pytest.fixture(autouse=True)
def no_charts_left():
    plt.switch_backend("Agg")
    yield
    plt.close("all")


def pixels(path):
    return np.asarray(Image.open(path).convert("RGB"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_makes_its_pictures_as_they_were(example, ran):
    folder = ran(example)
    assert all(path.name.removeprefix(example.stem)[0] in ".-" for path in folder.iterdir())
    pictures = sorted(folder.glob("*.png"))
    assert folder / f"{example.stem}.png" in pictures or len(pictures) > 1
    for path in pictures:
        now = Image.open(path).convert("RGB").reduce(REDUCED)
        if os.environ.get("REMAKE"):
            STORED.mkdir(exist_ok=True)
            now.save(STORED / path.name, optimize=True)
        then = Image.open(STORED / path.name)
        assert now.size == then.size, path.name
        assert np.abs(np.asarray(now, float) - np.asarray(then, float)).max() < ALIKE, path.name


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_command_lines_and_recipes_say_the_same(example, ran, tmp_path, monkeypatch, capsys):
    folder, figures = ran(example), 0
    monkeypatch.chdir(tmp_path)
    for line in commands(small(example.read_text("utf-8"))):
        for option, word in pairwise(line):
            if (option in ("--sources", "--recipe") and word.endswith(".json")) or word[:1] == "@":
                shutil.copy(folder / word.removeprefix("@"), tmp_path)  # which the example has written
        if line[0] != "figure" or example.stem in DRAWN:
            assert main(line) == 0, f"{shlex.join(line)}: {capsys.readouterr().err}"
        if line[0] == "figure" and "--recipe" not in line:
            path = folder / line[line.index("-o") + 1]
            assert said_by(line, path) == read_recipe(path.with_suffix(".json"))
            figures += 1
            if example.stem in DRAWN:
                assert np.array_equal(pixels(tmp_path / path.name), pixels(path))
                assert np.array_equal(figure_again(path.with_suffix(".json")).pixels, pixels(path))
    assert figures


def said_by(line, picture):
    """The recipe that a command line means, as it stands beside its picture."""
    recipe = chosen_recipe(parser_of_all().parse_args(line))
    document, _ = open_document(recipe, ArrayStore())
    recipe = replace(recipe, document=document, page=replace(recipe.page, format=picture.suffix[1:]))
    text = recipe_text(with_meshes_from(recipe, picture.with_suffix(".json")), "")
    written = Path("said.json")
    written.write_text(text, "utf-8")
    return read_recipe(written)
