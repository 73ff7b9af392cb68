"""The widget in a notebook: its cells run as nbclient runs them, with a kernel of their own."""

import os
from pathlib import Path

import pytest

from tests.waiting import PATIENCE

pytest.importorskip("anywidget", reason="anywidget is not installed: pip install 'bihdist[widget]'")
pytest.importorskip("ipykernel")
nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")

ROOT = Path(__file__).parents[2]
CELLS = (
    "import app as bihdist, traitlets\nfrom tests.shapes import bumpy\ns, picked = bumpy(300), []",
    "fields = {'mine': s.vertices[:, 0]}\n"
    "one = bihdist.widget(s, ['biharmonic - mine'], 12, fields=fields, on_pick=picked.append)\none",
    "other = bihdist.widget(s, ['geodesic'])\ntraitlets.link((one, 'source'), (other, 'source'))\nother",
    # What a click in the first one sends.
    "one.set_state({'source': 90, 'pins': [{'id': 7, 'name': 'tip'}]})\none._handle_custom_msg({'picked': 90}, [])",
    "print(other.source, picked, one.pins)",
)


def test_a_click_in_one_cells_widget_changes_what_another_prints(tmp_path, monkeypatch):
    for name, value in {"PYTHONPATH": ROOT, "IPYTHONDIR": tmp_path, "JUPYTER_DATA_DIR": tmp_path}.items():
        monkeypatch.setenv(name, os.fspath(value))
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text) for text in CELLS])
    nbclient.NotebookClient(notebook, timeout=PATIENCE, kernel_name="python3", resources={}).execute(cwd=str(tmp_path))
    outputs = [cell["outputs"] for cell in notebook.cells]
    views = [outputs[k][0]["data"]["application/vnd.jupyter.widget-view+json"]["model_id"] for k in (1, 2)]
    assert outputs[4][0]["text"] == "90 [90] [{'id': 7, 'name': 'tip'}]\n"
    # What a front end is sent, so that it shows them.
    states = notebook.metadata["widgets"]["application/vnd.jupyter.widget-state+json"]["state"]
    one, other = (states[view]["state"] for view in views)
    assert one["source"] == other["source"] == 90
    assert one["scene"]["given"] == ["field mine"]
    paths = {tuple(buffer["path"]) for buffer in states[views[0]]["buffers"]}
    assert paths == {("contents", each) for each in ("kernel", "mesh", "given", "points-truncated")}
