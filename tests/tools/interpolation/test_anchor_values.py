"""The values of anchors, written beside them in figures."""

import app as bihdist
from app.document.page import Page
from app.figures.export import figure_of
from tests.shapes import bumpy


def texts(**how):
    surface = bumpy(300)
    picture = bihdist.figure((surface.vertices, surface.faces), ["interpolant by biharmonic"], marks=how)
    (panel,) = figure_of(picture._recipe, picture._surfaces, picture.answers).panels
    assert picture._recipe.page == Page(anchor_values=how.get("anchor_values", False))
    return [mark.text for mark in panel.marks if mark.colour != "largest"]


def test_they_stand_there_where_they_are_asked_for_and_there_is_one():
    anchors = {5: 0.25, 80: -1.0, 200: None}
    assert texts(anchors=anchors) == ["", "", ""]
    assert texts(anchors=anchors, anchor_values=True) == ["0.25", "\u22121", ""]
