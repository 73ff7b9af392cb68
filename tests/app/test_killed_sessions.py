"""Sessions with arrays, written again and again by a process that is killed, open every time."""

import subprocess
import sys
import time
from pathlib import Path

from app.document.file import read_recipe
from app.session.array_store import ArrayStore

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
