"""The paper's index in browsers: its links lead to pages that show what its figures do."""

import base64

import numpy as np
import pytest

from app.paper.reproduce import reproduce
from bihdist_core import write_mesh
from tests.shapes import bumpy

from .shown_page import READ, VIEW


@pytest.fixture(scope="module")
def paper(tmp_path_factory):
    folder = tmp_path_factory.mktemp("paper")
    write_mesh(folder / "mine.off", bumpy(500))
    reproduce(str(folder / "out"), ["fig4"], str(folder / "mine.off"), quick=True, say=lambda _: None, up="y")
    return folder / "out"


def test_a_link_under_a_figure_leads_to_its_fields(browser, paper):
    browser.open(paper / "index.html")
    link = browser.evaluate("document.querySelector('#fig4 figure .live a').getAttribute('href')")
    browser.open(paper / link)
    browser.until(f"{VIEW}?.answers.every(Boolean)", 100)
    shown, ids = browser.evaluate(READ), browser.evaluate(f"[...{VIEW}.mesh.ids]")
    drawn = np.load(paper / "fig4.npz")
    fields = [drawn[name] for name in drawn.files if name.startswith("panel ")]
    assert len(fields) == 3
    values = np.frombuffer(base64.b64decode(shown["fields"]), "<f8").reshape(3, -1)
    # Positions with 24 bits change distances by some 1e-7, and eigenpairs have 16 bits.
    for here, field, tolerance in zip(values, fields, (1e-6, 1e-6, 1e-3), strict=True):
        assert np.abs(here - field[ids]).max() < tolerance * field.max()
    assert browser.errors == []
    assert browser.requests == []
