"""The recorded run, on a mesh that takes no time."""

import json

import pytest

from . import record
from .chromium import Chromium
from .measured import grown


@pytest.mark.skipif(Chromium.program() is None, reason="Chromium is not installed")
def test_a_run_measures_goes_on_and_puts_its_table_into_a_page(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(record, "BROWSERS", (Chromium,))
    results, page = tmp_path / "results.json", tmp_path / "page.md"
    page.write_text(f"before\n{record.BEGIN}\nan old one\n{record.END}\nafter\n")
    words = ["--clicks", "2", "--growth", "100", "--results", str(results), "--table", str(page)]
    assert record.main(["bumpy:300", *words]) == 0
    known = json.loads(results.read_text())
    facts = known["meshes"]["bumpy:300"]
    within = facts["browsers"]["Chromium"]
    assert (facts["vertices"], within["errors"]) == (300, 0)
    assert facts["bytes"] > 1e5
    assert max(within["worst"].values()) < 1e-9
    assert set(within["worst"]) == set(within["clicks"]) | {"commute-time"}
    assert len(known["growth"]["Chromium"]) == 2
    text = page.read_text()
    assert text.startswith("before\n")
    assert text.endswith("after\n")
    assert "| bumpy:300 | 300 | " in text
    assert "an old one" not in text
    assert "after 100 clicks on one mesh" in text
    # What is done is not done again.
    known["meshes"]["bumpy:300"]["vertices"] = 12345
    results.write_text(json.dumps(known))
    assert record.main(["bumpy:300", *words]) == 0
    assert "| bumpy:300 | 12,345 | " in capsys.readouterr().out


def test_what_comes_and_goes_is_no_growth():
    assert grown([100, 150, 100, 160, 100, 140]) == 0
    assert grown([100, 150, 120, 160, 150, 170]) == 50
