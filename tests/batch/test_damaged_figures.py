"""What stands beside a figure, damaged or of others: a sentence that names the file and the place in it."""

import json
import shutil

import pytest

from app.batch.storage import Folder
from app.batch.work_order import thumbnail_name
from bihdist_core import write_mesh
from tests.batch.runs import batch, rows
from tests.shapes import bumpy

FACTS = "bumpy.figure.json"


@pytest.fixture(scope="module")
def there(tmp_path_factory):
    """A mesh, and its figure in a folder."""
    place = tmp_path_factory.mktemp("drawn")
    write_mesh(place / "bumpy.off", bumpy(60))
    assert batch(place / "bumpy.off", place / "out", "--do", "figure") == 0
    return place


@pytest.fixture
def drawn(there, tmp_path):
    shutil.copytree(there, tmp_path, dirs_exist_ok=True)
    return tmp_path


def again(drawn, *options):
    return batch(drawn / "bumpy.off", drawn / "out", "--do", "figure", *options)


@pytest.mark.parametrize(
    ("damage", "reason"),
    [
        (lambda facts: facts.pop("panels"), "figure has no 'panels'"),
        (lambda facts: facts.update(panels={}), "figure.panels must be a list, not {}"),
        (lambda facts: facts["panels"].append(5), "figure.panels[1] must be a record in braces, not 5"),
        (lambda facts: facts["panels"][0].pop("unit"), "figure.panels[0] has no 'unit'"),
        (
            lambda facts: facts["panels"][0].update(maximum="long"),
            'figure.panels[0].maximum must be a number, not "long"',
        ),
        (lambda facts: facts["panels"][0].update(of_set=[1]), "figure.panels[0].of_set must be a text, not [1]"),
        (lambda facts: facts.update(range=None), "figure.range must be a text, not null"),
        (lambda facts: facts.pop("n_vertices"), "figure has no 'n_vertices'"),
        (
            lambda facts: facts.update(file="other.png"),
            'figure.file must be bumpy.figure.png, not "other.png"',
        ),
    ],
)
def test_facts_that_are_damaged_are_named(drawn, capsys, damage, reason):
    out = drawn / "out"
    facts = json.loads((out / FACTS).read_text())
    damage(facts)
    (out / FACTS).write_text(json.dumps(facts))
    shutil.copy(out / "bumpy.figure.png", out / "other.png")
    capsys.readouterr()
    assert again(drawn) == 2
    said = capsys.readouterr().err.splitlines()[-1]
    remedy = "delete it, and the same command draws the figure again."
    assert said == f"bihdist: {out}/{FACTS}: {reason}; {remedy}"
    assert [row["file"] for row in rows(out)] == [facts["file"]]
    (out / FACTS).unlink()
    assert again(drawn) == 0


def test_pictures_that_are_damaged_are_made_anew_or_named(drawn, capsys):
    out, small = drawn / "out", drawn / "out" / thumbnail_name("bumpy")
    before = small.read_bytes()
    small.write_bytes(b"no picture")
    assert again(drawn) == 0
    assert small.read_bytes() == before
    small.unlink()
    figure = out / "bumpy.figure.png"
    figure.write_bytes(b"x" * figure.stat().st_size)
    capsys.readouterr()
    assert again(drawn) == 2
    remedy = "the same command with --verify draws it again."
    assert capsys.readouterr().err.splitlines()[-1] == f"bihdist: {figure} is no picture; {remedy}"
    assert again(drawn, "--verify") == 0


@pytest.mark.parametrize("name", ["maxima", "scales"])
def test_maxima_of_other_kinds_are_found_again(drawn, name):
    out = drawn / "out"
    (facts,) = (path for path in out.rglob("*.json") if "maxima" in json.loads(path.read_text()))
    facts.write_text(json.dumps({**json.loads(facts.read_text()), name: ["long"]}))
    assert again(drawn) == 0
    assert Folder(str(out)).size("index.html")
