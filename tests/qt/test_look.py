"""The themes can be read, the controls and icons can be seen, numbers are written alike everywhere."""

import math
import re
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest
from qtpy import QtCore, QtGui, QtWidgets
from qtpy.QtWidgets import QCheckBox, QComboBox, QHBoxLayout, QMenu, QRadioButton, QSpinBox, QWidget

from app.drawing.numbers import number, share, tick, ticks
from app.drawing.painters.qt import number_width, paint_number
from app.qt.look import desktop, icons, look, own_folder
from app.qt.look.desktop import Desktop
from app.qt.look.icons import icon_names, pixmap, put_icon
from app.qt.look.look import LOOK
from app.qt.look.style_sheet import ICONS, style_sheet
from app.qt.look.theme import DARK, LIGHT, THEMES, contrast, lightness
from tests.waiting import PATIENCE

READABLE = 4.5
"""Of text, by WCAG 2 (AA)."""

SEEN = 3.0
"""Of what is no text, by WCAG 2.1."""

GROUNDS = {
    "text": ["window", "canvas", "raised", "hover", "pressed", "selection"],
    "quiet": ["window", "canvas", "raised", "hover", "selection"],
    "accent": ["window", "canvas", "raised", "selection"],
    "on_fill": ["fill"],
    "warning": ["warning_ground", "window"],
    "error": ["error_ground", "window", "canvas", "raised"],
    "label_text": ["label"],
    "label_quiet": ["label"],
}

both_themes = pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])


@pytest.fixture(autouse=True)
def light_afterwards(application):
    LOOK.choose("light")
    yield
    LOOK.choose("light")


# ---------------------------------------------------------------------- colours
def test_contrast_is_that_of_the_standard():
    assert contrast("#000000", "#FFFFFF") == pytest.approx(21)
    assert contrast("#777777", "#FFFFFF") == pytest.approx(4.48, abs=0.005)  # the known grey that just fails
    assert lightness("#FF0000") == pytest.approx(0.2126)


@both_themes
@pytest.mark.parametrize(("text", "ground"), [(text, ground) for text in GROUNDS for ground in GROUNDS[text]])
def test_text_can_be_read_on_its_grounds(theme, text, ground):
    assert contrast(getattr(theme, text), getattr(theme, ground)) >= READABLE


@both_themes
def test_curves_are_seen_on_the_canvas_and_none_twice(theme):
    assert min(contrast(colour, theme.canvas) for colour in theme.curves) >= READABLE
    assert len(set(theme.curves)) == len(theme.curves)


@both_themes
def test_a_tick_and_the_focus_are_seen(theme):
    assert contrast(theme.on_fill, theme.fill) >= SEEN
    assert min(contrast(theme.accent, ground) for ground in (theme.window, theme.canvas, theme.raised)) >= SEEN


def rules(sheet):
    """Selectors, and what they set, in the order of the sheet."""
    for selectors, body in re.findall(r"([^{}]+)\{([^{}]*)\}", sheet):
        pairs = [line.partition(":")[::2] for line in body.split(";") if line.strip()]
        yield [each.strip() for each in selectors.split(",")], {name.strip(): value.strip() for name, value in pairs}


@both_themes
def test_rules_of_the_style_sheet_can_be_read(theme):
    checked = 0
    for selectors, sets in rules(style_sheet(theme)):
        if all("disabled" in each for each in selectors):
            continue
        for ink, ground in ("color", "background"), ("selection-color", "selection-background-color"):
            colours = sets.get(ink, ""), sets.get(ground, "")
            if all(each.startswith("#") for each in colours):
                assert contrast(*colours) >= READABLE, f"{selectors}: {colours}"
                checked += 1
    assert checked >= 15  # the parsing finds them


@both_themes
def test_the_style_sheet_is_whole(theme):
    sheet = style_sheet(theme, 1.35)
    assert sheet.count("{") == sheet.count("}")
    assert not re.sub(r"[^{}]+\{[^{}]*\}", "", sheet).strip()
    colours = set(re.findall(r"#[0-9A-Fa-f]{6}\b", sheet))
    own = {value for value in vars(theme).values() if isinstance(value, str)}
    assert colours <= own  # no colour is defined in passing


# ---------------------------------------------------------------------- icons and marks
def inked(picture):
    """The colours of what is fully painted, and the share of what is painted at all."""
    image = picture.toImage()
    points = [image.pixelColor(x, y) for x in range(image.width()) for y in range(image.height())]
    painted = sum(point.alpha() > 0 for point in points) / len(points)
    return {point.name().upper() for point in points if point.alpha() == 255}, painted


@pytest.mark.parametrize("name", [path.stem for path in sorted(ICONS.glob("*.svg"))])
def test_icons_are_drawn_in_the_colour_of_each_theme(application, name):
    assert name in icon_names()
    for theme in THEMES.values():
        colours, painted = inked(pixmap(name, theme.text, 3))
        assert theme.text in colours
        assert 0.02 < painted < 0.7
    assert pixmap(name, LIGHT.text, 2).size().width() == 40
    assert pixmap(name, LIGHT.text).toImage() != pixmap(name, DARK.text).toImage()


def test_an_icon_that_is_kept_is_not_the_picture_it_was_painted_on(application, monkeypatch):
    """Such a picture keeps the buffers of its painter."""
    painted = []

    class Painter(QtGui.QPainter):
        def end(self):
            painted.append(self.device())
            return super().end()

    monkeypatch.setattr(icons.QtGui, "QPainter", Painter)
    kept = icons.pixmap.__wrapped__("pin", "#123456", 2)
    assert len(painted) == 1
    assert painted[0].cacheKey() != kept.cacheKey()
    assert (kept.width(), kept.devicePixelRatio()) == (40, 2)


def test_an_icon_on_a_button_follows_the_theme_until_the_button_is_gone(application):
    button = QtWidgets.QToolButton()
    put_icon(button, "pin")
    light = button.icon().pixmap(20, 20).toImage()
    off = button.icon().pixmap(20, 20, QtGui.QIcon.Mode.Disabled).toImage()
    LOOK.choose("dark")
    assert light != button.icon().pixmap(20, 20).toImage()
    assert light != off
    button.deleteLater()
    application.sendPostedEvents(None, QtCore.QEvent.Type.DeferredDelete)
    LOOK.choose("light")  # reaches nobody; a dead button would raise


def test_the_process_ends_well_with_windows_open(tmp_path):
    code = (
        "from app.qt.application import application; app = application()\n"
        "from qtpy import QtWidgets; from app.qt.look.look import LOOK; from app.qt.look.icons import put_icon\n"
        "window = QtWidgets.QMainWindow(); button = QtWidgets.QToolButton(window); put_icon(button, 'pin')\n"
        "LOOK.apply_theme(window); window.show(); LOOK.choose('dark'); app.processEvents(); print('done')"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=PATIENCE)
    assert (ended.returncode, ended.stdout) == (0, "done\n"), ended.stderr
    assert "Traceback" not in ended.stderr


def shown(widget, theme):
    """The picture of a widget in a theme."""
    LOOK.choose(theme.word)
    window = QWidget()
    QHBoxLayout(window).addWidget(widget)
    LOOK.apply_theme(window)
    window.ensurePolished()
    window.resize(window.sizeHint())
    return widget.grab()


@both_themes
def test_a_ticked_box_has_a_tick(application, theme):
    from qtpy.QtCore import QRect

    for kind in QCheckBox, QRadioButton:
        on, off = (shown(kind("", checked=checked), theme) for checked in (True, False))
        # Of the 16 pixels of the box, those in the middle: at the corners the ground of the window is seen.
        ratio = on.devicePixelRatio()
        box = QRect(
            round(3 * ratio), round((on.height() / ratio / 2 - 5) * ratio), round(10 * ratio), round(10 * ratio)
        )
        colours, _ = inked(on.copy(box))
        assert theme.fill in colours
        assert max(contrast(colour, theme.fill) for colour in colours) >= SEEN
        off_colours, _ = inked(off.copy(box))
        assert theme.raised in off_colours
        assert theme.fill not in off_colours


@both_themes
def test_a_combo_box_and_a_number_box_have_arrows(application, theme):
    for box, width in (QComboBox(), 24), (QSpinBox(specialValueText=" "), 20):
        picture = shown(box, theme)
        ratio = round(picture.devicePixelRatio())
        right = picture.copy(
            picture.width() - width * ratio, 4 * ratio, (width - 4) * ratio, picture.height() - 8 * ratio
        )
        colours, _ = inked(right)
        assert max(contrast(colour, theme.raised) for colour in colours) >= SEEN


def test_a_ticked_entry_of_a_menu_has_a_tick(application):
    for theme in THEMES.values():
        LOOK.choose(theme.word)
        menu = QMenu()
        LOOK.apply_theme(menu)
        action = menu.addAction("  ")
        action.setCheckable(True)
        without = inked(menu.grab())[0]
        action.setChecked(True)
        assert theme.accent in inked(menu.grab())[0] - without


def test_marks_are_written_again_after_the_folder_was_cleared(application):
    import shutil

    first = style_sheet(LIGHT)
    shutil.rmtree(own_folder.own_folder())
    files = re.findall(r'url\("([^"]+)"\)', style_sheet(LIGHT))
    assert len(set(files)) >= 8
    for file in files:
        assert "currentColor" not in Path(file).read_text(encoding="utf-8")
    assert first.count("url(") == len(files)


def test_without_a_folder_for_marks_the_sheet_is_whole(monkeypatch):
    def refuse(**_):
        raise OSError("full")

    monkeypatch.setattr(own_folder, "_kept", [])
    monkeypatch.setattr(own_folder.tempfile, "mkdtemp", refuse)
    sheet = style_sheet(DARK)
    assert "url(" not in sheet
    assert sheet.count("{") == sheet.count("}")


def test_a_folder_with_odd_letters_serves(application, monkeypatch, tmp_path):
    place = tmp_path / "a b (c) 'ü'"
    place.mkdir()
    monkeypatch.setattr(own_folder, "_kept", [])
    monkeypatch.setattr(own_folder.tempfile, "tempdir", str(place))
    colours, _ = inked(shown(QCheckBox("", checked=True), LIGHT))
    assert any(place.rglob("check-*.svg"))
    assert any(contrast(colour, LIGHT.fill) > SEEN for colour in colours - {LIGHT.window})


# ---------------------------------------------------------------------- the desktop's theme
@pytest.mark.parametrize(
    ("portal_says", "registry_says", "palette_says", "wanted"),
    [
        (True, None, False, DARK),
        (False, None, True, LIGHT),
        (None, True, False, DARK),
        (None, False, True, LIGHT),
        (None, None, True, DARK),
        (None, None, False, LIGHT),
    ],
)
def test_the_first_source_that_knows_decides(monkeypatch, portal_says, registry_says, palette_says, wanted):
    monkeypatch.setattr(desktop, "portal", lambda: fake_portal(portal_says))
    monkeypatch.setattr(desktop, "registry_is_dark", lambda: registry_says)
    monkeypatch.setattr(desktop, "palette_is_dark", lambda: palette_says)
    assert Desktop().theme() is wanted


def fake_portal(is_dark):
    class Fake(QtCore.QObject):
        changed = QtCore.Signal()

    fake = Fake()
    fake.is_dark = is_dark
    return fake


def test_the_window_follows_the_desktop_only_if_it_is_told_to(monkeypatch):
    fake = fake_portal(False)
    monkeypatch.setattr(desktop, "portal", lambda: fake)
    monkeypatch.setattr(look, "DESKTOP", Desktop())
    here = look.Look()
    here.choose("desktop")
    assert here.theme is LIGHT
    fake.is_dark = True
    fake.changed.emit()
    assert here.theme is DARK
    here.choose("light")
    fake.changed.emit()
    assert here.theme is LIGHT


def test_an_explicit_choice_asks_no_desktop(monkeypatch):
    def asked():
        raise AssertionError("the desktop was asked")

    monkeypatch.setattr(desktop, "portal", asked)
    monkeypatch.setattr(desktop, "palette_is_dark", asked)
    monkeypatch.setattr(look, "DESKTOP", Desktop())
    here = look.Look()
    for word in "dark", "light", "dark":
        here.choose(word)
        assert here.theme is THEMES[word]


def test_without_a_bus_no_portal_is_looked_for(monkeypatch, tmp_path):
    portal = pytest.importorskip("app.qt.look.portal", exc_type=ImportError)
    monkeypatch.delenv("DBUS_SESSION_BUS_ADDRESS", raising=False)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    assert not portal.has_bus()
    assert desktop.portal() is None
    (tmp_path / "bus").touch()
    assert portal.has_bus()


def test_the_words_of_the_portal():
    portal = pytest.importorskip("app.qt.look.portal", exc_type=ImportError)
    once = portal.QtDBus.QDBusVariant()
    once.setVariant(portal.DARK)
    assert portal.darkness(once) is portal.darkness(portal.DARK) is True
    assert portal.darkness(portal.LIGHT) is False
    assert [portal.darkness(said) for said in (0, 3, None, "1", [])] == [None] * 5


# ---------------------------------------------------------------------- numbers
@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"),
        (0.35672, "0.3567"),
        (1.15749, "1.157"),
        (9.9996, "10.00"),
        (12345.4, "12,345"),
        (-0.023, "−0.02300"),
        (1.2e-7, "1.200e−7"),
        (3e9, "3.000e9"),
        (math.nan, "–"),
        (-math.inf, "–"),
    ],
)
def test_numbers_have_four_digits(value, text):
    assert number(value) == text


def test_signs_and_shares():
    assert (number(0.5, signed=True), number(0, signed=True)) == ("+0.5000", "0")
    assert (share(0.7762), share(-0.1, signed=True), share(0.1, signed=True)) == ("77.6 %", "−10.0 %", "+10.0 %")
    assert share(math.nan) == "–"
    assert (tick(0.1 + 0.2), tick(-2.5)) == ("0.3", "−2.5")


@pytest.mark.parametrize("most", [1, 2, 3, 5, 9])
@pytest.mark.parametrize("span", [(0, 0.4597), (0, 1), (-3.1, 7.7), (1000.2, 1000.9), (0, 6e-9), (0, 2.4e11)])
def test_ticks_are_round_inside_and_few(span, most):
    low, high = span
    found = ticks(low, high, most)
    slack = 1e-6 * (high - low)
    assert len(found) <= max(most, 2)
    assert all(low - slack <= each <= high + slack for each in found)
    if len(found) > 1:
        step = found[1] - found[0]
        assert [b - a for a, b in pairwise(found)] == pytest.approx([step] * (len(found) - 1))
        leading = step / 10 ** math.floor(math.log10(step * (1 + 1e-9)))
        assert min(abs(leading - round_one) for round_one in (1, 2, 2.5, 5)) < 1e-4


def test_no_ticks_where_there_is_no_range():
    assert ticks(1, 1, 5) == ticks(0, math.inf, 5) == ticks(math.nan, 1, 5) == ticks(2, 1, 5) == []


@pytest.mark.parametrize("family", ["", "DejaVu Serif", "URW Bookman"])
def test_equally_many_digits_are_equally_wide(application, family):
    from qtpy.QtGui import QImage, QPainter

    font = LOOK.font(13, bold=True)
    if family:
        font.setFamily(family)
    image = QImage(300, 40, QImage.Format.Format_ARGB32)
    painter = QPainter(image)
    painter.setFont(font)
    ends = {paint_number(painter, 10, 20, text) for text in ("0.1111", "0.4830", "8.8888")}
    painter.end()
    assert len(ends) == 1
    assert ends.pop() - 10 == pytest.approx(number_width(font, "0.0000"))
