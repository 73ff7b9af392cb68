"""Sessions with arrays, written again and again by a process that is killed, open every time."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from app.document.file import read_recipe
from app.document.page import Recipe
from app.session.array_store import ArrayStore, comparison_of_arrays
from app.session.recipe_file import recipe_written
from tests.shapes import bumpy

ROOT = Path(__file__).resolve().parents[2]

WRITES = """
import sys
import numpy as np
from app.document.page import Recipe
from app.session.array_store import comparison_of_arrays
from app.session.recipe_file import recipe_written
from tests.shapes import bumpy
surface = bumpy(2000)
fields = {"mine": surface.vertices[:, 0]}
document, given = comparison_of_arrays(surface, ["biharmonic", "mine"], fields, (5,))
k = 0
while True:
    k += 1
    with recipe_written(Recipe(document), given, sys.argv[1], "0"):
        pass
    if k == 1:
        print("begun", flush=True)
"""


def test_what_a_killed_process_was_writing_opens(tmp_path):
    path = tmp_path / "s.json"
    for after in (0.0, 0.004, 0.011):
        process = subprocess.Popen([sys.executable, "-c", WRITES, str(path)], stdout=subprocess.PIPE, cwd=ROOT)
        process.stdout.readline()
        time.sleep(after)
        process.kill()
        process.communicate()
        recipe = read_recipe(path)
        assert ArrayStore.read(recipe).surface(recipe.document.surfaces[0]).n_vertices == 2000


KILLED = """
import os, signal, sys
import numpy as np
from app.document.page import Recipe
from app.session.array_store import comparison_of_arrays
from app.session.recipe_file import recipe_written
from tests.shapes import bumpy
there, steps = os.replace, []
def replace(*paths):
    steps.append(paths)
    if len(steps) == int(sys.argv[2]):
        os.kill(os.getpid(), signal.SIGKILL)
    there(*paths)
os.replace = replace
surface = bumpy(100)
document, given = comparison_of_arrays(surface, ["mine"], {"mine": 2 * surface.vertices[:, 0]}, (5,))
with recipe_written(Recipe(document), given, sys.argv[1], "0"):
    pass
"""


@pytest.mark.parametrize("step", [1, 2])
def test_what_is_killed_between_its_two_files_leaves_the_session_that_was_there(tmp_path, step):
    path, surface = tmp_path / "s.json", bumpy(100)
    document, given = comparison_of_arrays(surface, ["mine"], {"mine": surface.vertices[:, 0]}, (5,))
    with recipe_written(Recipe(document), given, path, "0"):
        pass
    before = read_recipe(path)
    command = [sys.executable, "-c", KILLED, str(path), str(step)]
    assert subprocess.run(command, cwd=ROOT, check=False).returncode == -signal.SIGKILL
    recipe = read_recipe(path)
    assert recipe == before
    (field,) = recipe.document.fields
    assert np.array_equal(ArrayStore.read(recipe).field(field.sha256, "mine"), surface.vertices[:, 0])
    assert len(list(tmp_path.iterdir())) == 4  # two files of each, the killed one's perhaps by their hidden names
    with recipe_written(Recipe(document), given, path, "0"):
        pass
    assert {*tmp_path.iterdir()} == {path, Path(recipe.arrays)}
