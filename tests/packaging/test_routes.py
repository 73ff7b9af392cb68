"""The routes in CONTRIBUTING.md: every function is where the list says, and no list comes back to a module."""

import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
STEP = re.compile(r"^\d+\. `([\w/]+)\.py`: (.*)$")


def routes() -> list[list[tuple[str, list[str]]]]:
    """Each list as its steps: the module, and the names in it."""
    found: list[list[tuple[str, list[str]]]] = []
    for line in (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8").splitlines():
        if step := STEP.match(line):
            if line.startswith("1. "):
                found.append([])
            found[-1].append((step[1].replace("/", "."), re.findall(r"`(\w+(?:\.\w+)?)`", step[2])))
    return found


def test_there_is_a_way_down_a_way_up_a_figure_a_page_a_data_set_and_an_export():
    assert [len(route) for route in routes()] == [15, 8, 12, 6, 7, 8]


@pytest.mark.parametrize("route", routes())
def test_every_step_exists_and_no_module_comes_twice(route):
    modules = [module for module, _ in route]
    assert len(set(modules)) == len(modules)
    for module, names in route:
        if module.startswith("app.qt"):
            pytest.importorskip("qtpy")
        assert names
        for name in names:
            owner = importlib.import_module(module)
            for part in name.split("."):
                assert hasattr(owner, part), f"{module} has no {name}"
                owner = getattr(owner, part)
