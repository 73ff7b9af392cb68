"""Fonts: those installed after matplotlib listed them, and those of PostScript outlines in PDF and EPS."""

import pytest
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.t2CharStringPen import T2CharStringPen
from matplotlib import font_manager

from app.figures.draw import Figure, FigurePanel, save_figure
from app.figures.fonts import check_font, has_cff_outlines
from app.figures.size import Size
from bihdist_core import ParameterError
from tests.shapes import bumpy

SIGNS = [chr(code) for code in range(33, 127)]


def squares(path, family):
    """A font file with CFF outlines, in which every letter is a square."""
    pen = T2CharStringPen(600, None)
    for move, at in ((pen.moveTo, (50, 0)), (pen.lineTo, (50, 500)), (pen.lineTo, (550, 500)), (pen.lineTo, (550, 0))):
        move(at)
    pen.closePath()
    square, space = pen.getCharString(), T2CharStringPen(300, None).getCharString()
    names = [".notdef", "space", *(f"sign{ord(sign)}" for sign in SIGNS)]
    font = FontBuilder(1000, isTTF=False)
    font.setupGlyphOrder(names)
    font.setupCharacterMap({32: "space"} | {ord(sign): f"sign{ord(sign)}" for sign in SIGNS})
    letters = {name: space if name == "space" else square for name in names}
    font.setupCFF(family.replace(" ", ""), {"FullName": family}, letters, {})
    font.setupHorizontalMetrics({name: (300 if name == "space" else 600, 50) for name in names})
    font.setupHorizontalHeader(ascent=800, descent=-200)
    font.setupNameTable({"familyName": family, "styleName": "Regular", "psName": family.replace(" ", "")})
    font.setupOS2(sTypoAscender=800, usWeightClass=400)
    font.setupPost()
    font.save(path)


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """Installs a font of a new name for this test, which matplotlib's list does not have."""
    monkeypatch.setattr(font_manager.fontManager, "ttflist", list(font_manager.fontManager.ttflist))

    def install(family):
        path = tmp_path / "squares.otf"
        squares(path, family)
        (tmp_path / "broken.otf").write_bytes(b"no font")
        files = [str(tmp_path / "broken.otf"), str(path)]
        monkeypatch.setattr(font_manager, "findSystemFonts", lambda *_, **__: files)
        return family

    return install


def test_a_font_is_found_that_was_installed_after_the_list_was_made(installed):
    name = installed("Bihdist New Squares")
    check_font(name)
    assert has_cff_outlines(name)
    assert not has_cff_outlines("")
    with pytest.raises(ParameterError, match="there is Bihdist New Squares"):
        check_font("Bihdist Mew Squares")


def test_postscript_outlines_are_embedded_as_what_they_are(installed, tmp_path):
    ball = bumpy(60)
    panel = FigurePanel(ball, ball.vertices[:, 1] + 2, heading="squares", label="field", unit="mesh units")
    figure = Figure((panel,), size=Size.parse("60mm"), font=installed("Bihdist Squares"))
    for name in ("f.pdf", "f.eps"):
        save_figure(figure, tmp_path / name)
    pdf, eps = ((tmp_path / name).read_bytes() for name in ("f.pdf", "f.eps"))
    assert b"BihdistSquares" in pdf
    assert b"/FontFile2" not in pdf  # for TrueType only
    assert b"/Subtype /Type3" in pdf
    assert b"/FontName /BihdistSquares" in eps
    assert b"/FontType 42" not in eps
