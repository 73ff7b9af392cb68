"""What stands beside a result, damaged: the result is made again, and the tables are whole."""

import json

import numpy as np
import pytest

from bihdist_core import write_mesh
from tests.batch.runs import batch, rows
from tests.shapes import bumpy


@pytest.mark.parametrize(
    "damage",
    [
        {"accuracy": {}},
        {"accuracy": 10**400},
        {"seconds": "long"},
        {"mean": [1]},
        {"shape": 100},
        {"shape": ["100", "2"]},
        {"repairs": [None]},
        {"repairs": "none"},
    ],
    ids=str,
)
def test_facts_of_other_kinds_are_of_no_result(tmp_path, damage, capsys):
    write_mesh(tmp_path / "bumpy.off", bumpy(60))
    work = (tmp_path / "bumpy.off", tmp_path / "out", "--do", "fields", "--sources", "5,7")
    assert batch(*work) == 0
    facts = next((tmp_path / "out").glob("*.json"))
    sound, table = json.loads(facts.read_text()), rows(tmp_path / "out")
    facts.write_text(json.dumps({**sound, **damage}))
    capsys.readouterr()
    assert batch(*work) == 0
    assert "there before" not in capsys.readouterr().out
    assert {**json.loads(facts.read_text()), "seconds": 0} == {**sound, "seconds": 0}
    assert [{**row, "seconds": ""} for row in rows(tmp_path / "out")] == [{**row, "seconds": ""} for row in table]
    assert np.load(tmp_path / "out" / sound["file"]).shape == (60, 2)
