"""Letters of panels: at the left over each, beside the headings."""

import numpy as np
import pytest

from app.figures.description import Figure, FigurePanel
from app.figures.layout import lay_out, letter_of
from app.figures.size import Size
from tests.shapes import sphere

BALL = sphere(200)


def figure(**how):
    field = np.arange(200.0)
    panel = FigurePanel(BALL, field, heading="a long heading of a distance", label="distance", unit="mesh units")
    return Figure((panel,) * 3, size=Size.parse("600x300"), **how)


def words_in(layout):
    return [{line: words for words in cell.words for line in words.lines} for cell in layout.cells]


def test_letters_go_on_after_z():
    assert [letter_of(k) for k in (0, 1, 25, 26, 27, 52)] == ["a", "b", "z", "aa", "ab", "ba"]


@pytest.mark.parametrize("title", ["heading", "caption", "none"])
def test_each_panel_has_its_letter_at_the_left_over_the_view(title):
    layout = lay_out(figure(letters=True, title=title))
    for letter, cell, words in zip(("(a)", "(b)", "(c)"), layout.cells, words_in(layout), strict=True):
        half = layout.lettering.width(letter, words[letter].size, True) / 2
        assert cell.box.x <= words[letter].x - half <= cell.box.x + 10
        assert cell.box.y < words[letter].y - 0.7 * words[letter].size
        assert words[letter].y <= cell.views[0].y
        for text, each in words.items():
            if each.is_bold and text != letter:
                wide = layout.lettering.width(text, each.size, True)
                assert each.x - wide / 2 > words[letter].x + half


def test_letters_take_no_room_from_the_words_at_the_bars():
    plain, other = lay_out(figure()), lay_out(figure(letters=True))
    assert not any("(a)" in words for words in words_in(plain))
    assert plain.label == other.label
