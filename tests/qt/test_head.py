"""The line over a panel: what is chosen there, what fits, and what keys do."""

from itertools import pairwise

import pytest

pytest.importorskip("qtpy")

from qtpy import QtCore, QtGui, QtTest, QtWidgets

from app.document.edits import PANEL_EDITS
from app.document.quantities import DistanceFrom, OwnField, quantity
from app.qt.look.look import LOOK
from bihdist_core.distances.kinds import OURS, Spec, kind_of

SHOWN = (
    "biharmonic",
    "geodesic",
    "diffusion(t=1/4)",
    "power",
    "truncated",
    "biharmonic - geodesic",
    "raw diffusion - diffusion(t=1/4)",
    "power - truncated",
)


@pytest.fixture
def head(application):
    from app.qt.panels.head import PanelHead

    windows = []

    def make(text="biharmonic", width=600, fields=(), point="source"):
        window = QtWidgets.QWidget()
        window.resize(1000, 100)
        window.setPalette(QtWidgets.QApplication.palette())
        made = PanelHead(quantity(text, point, fields), window)
        made.show_quantity(made.shows, fields)
        made.setGeometry(0, 0, width, made.height())
        window.show()
        assert QtTest.QTest.qWaitForWindowExposed(window)
        made.choices = []
        made.changed.connect(made.choices.append)
        windows.append(window)
        return made

    yield make
    for window in windows:
        window.close()


def entries(menu):
    """The entries of a menu as it opens, by their words."""
    menu.aboutToShow.emit()
    return {action.text(): action for action in menu.actions() if not action.isSeparator()}


def choose(head, *path):
    """Go through the name's menu."""
    menu = head.name.menu()
    for word in path[:-1]:
        menu = entries(menu)[word].menu()
    entries(menu)[path[-1]].trigger()


def shown(head):
    return [control for control in head.controls if control.isVisibleTo(head)]


def test_every_distance_can_be_chosen_by_its_name_and_says_what_to_look_for(head):
    h = head(point="tail")
    for kind in (*OURS[1:], OURS[0]):
        name = kind.name.replace("^α", "ᵅ")
        hint = entries(h.name.menu())[name].toolTip()
        assert hint.lower() == kind.hint.lower()
        choose(h, name)
        assert h.choices[-1] == h.shows == DistanceFrom(Spec.of(kind.word), "tail")
        assert [text for text, action in entries(h.name.menu()).items() if action.isChecked()] == [name]
    choose(h, "Biharmonic")
    assert len(h.choices) == len(OURS), "what is shown already is no change"


def test_a_distance_chosen_again_has_its_old_parameters(head):
    h = head("diffusion(t=1/4)")
    choose(h, "Geodesic")
    choose(h, "Diffusion")
    assert str(h.choices[-1]) == "diffusion(t=1/4)"
    choose(h, "Difference with", "Diffusion")
    assert str(h.choices[-1]) == "diffusion(t=1/4) - diffusion", "the second has its own"


def test_a_slider_gives_values_in_equal_steps_of_the_logarithm_and_hits_the_marks(head):
    from app.qt.panels.number_box import STEPS, step_of_value, value_of_step

    h = head("diffusion")
    (control,) = shown(h)
    assert control.slider.isVisible()
    control.slider.setValue(0)
    assert h.choices == [DistanceFrom(Spec.of("diffusion", t=1 / 15))]
    assert control.button.text() == "1/15"
    (t,) = kind_of("diffusion").parameters
    for mark in t.marks:
        control.slider.setValue(step_of_value(t, mark))
        assert h.shows.spec["t"] == mark
    for name in ("diffusion", "power", "truncated"):
        for parameter in kind_of(name).parameters:
            assert all(step_of_value(parameter, value_of_step(parameter, k)) == k for k in range(STEPS + 1))
    middle = value_of_step(t, STEPS // 2)
    assert middle == pytest.approx((t.shown[0] * t.shown[1]) ** 0.5, rel=0.01)  # three digits


@pytest.mark.parametrize(
    ("word", "name", "value", "text"),
    [
        ("diffusion", "t", 1 / 8, "1/8"),
        ("diffusion", "t", 1.0, "1.00"),
        ("diffusion", "t", 1 / 7, "0.1429"),
        ("diffusion", "t", 0.5, "0.500"),
        ("power", "alpha", 1.5, "1.50"),
        ("truncated", "k", 2000, "2,000"),
        ("diffusion", "t", 250.0, "250"),
    ],
)
def test_values_are_fractions_at_the_marks_and_else_have_three_or_four_digits(application, word, name, value, text):
    from app.qt.panels.number_box import shown_value

    assert shown_value(kind_of(word).parameter(name), value) == text


def test_words_are_chosen_from_the_menu_of_their_value(head):
    h = head("geodesic")
    (method,) = shown(h)
    entries(method.menu())["dijkstra"].trigger()
    assert str(h.choices[-1]) == "geodesic(method=dijkstra)"
    assert method.text() == "dijkstra"
    assert [text for text, action in entries(method.menu()).items() if action.isChecked()] == ["dijkstra"]


def test_a_difference_is_made_changed_and_left_through_the_menu(head):
    h = head("biharmonic", fields=("height",))
    assert "Biharmonic" not in entries(entries(h.name.menu())["Difference with"].menu()), "it would be zero"
    choose(h, "Difference with", "Geodesic")
    assert str(h.shows) == "biharmonic - geodesic"
    assert h.name.text() == "Biharmonic − Geodesic"
    choose(h, "Second: Geodesic", "Diffusion")
    choose(h, "First: Biharmonic", "Commute-time")
    assert str(h.shows) == "commute-time - diffusion"
    choose(h, "Swap them")
    choose(h, "In units")
    assert str(h.shows) == "raw diffusion - commute-time"
    choose(h, "Shares of the maximum")
    choose(h, "Second: Commute-time", "height")
    assert h.shows.subtrahend == OwnField("height")
    choose(h, "Show the first alone")
    assert h.shows == DistanceFrom(Spec.of("diffusion"))
    assert h.choices[-1] == h.shows
    choose(h, "height")
    assert h.shows == OwnField("height")
    assert not shown(h)


def test_both_parts_of_a_difference_have_their_parameters(head):
    h = head("diffusion(t=1/4) - diffusion", 900)
    one, other, mode = shown(h)
    assert (one.sign, other.sign) == ("t₁", "t₂")
    assert one.slider.isVisible()
    assert other.slider.isVisible()
    other.slider.setValue(0)
    one.slider.setValue(one.slider.maximum())
    entries(mode.menu())["in units"].trigger()
    assert str(h.choices[-1]) == "raw diffusion(t=4) - diffusion(t=1/15)"


def test_what_the_document_says_is_shown_without_a_signal(head):
    h = head("diffusion")
    (control,) = shown(h)
    h.show_quantity(quantity("diffusion(t=1/8)"))
    assert shown(h) == [control], "a control may be in the user's hand"
    h.show_quantity(quantity("geodesic - biharmonic"))
    h.show_quantity(OwnField("unknown"))
    assert h.choices == []
    assert h.name.text() == "unknown"


def test_typing_in_the_pop_up_sets_the_exact_value(head):
    h = head("diffusion", 360)
    (control,) = shown(h)
    assert not control.slider.isVisible()
    QtTest.QTest.mouseClick(control.button, QtCore.Qt.MouseButton.LeftButton)
    box = control.pop_up.box
    assert control.pop_up.isVisible()
    box.selectAll()
    QtTest.QTest.keyClicks(box, "none")
    QtTest.QTest.keyClick(box, QtCore.Qt.Key.Key_Return)
    assert h.choices == []
    assert control.pop_up.isVisible()
    assert "above 0, not 'none'" in control.pop_up.complaint.text()
    assert box.property("wrong")
    h.show_quantity(quantity("diffusion(t=1/8)"))
    assert box.text() == "none", "what is being typed stays"
    box.selectAll()
    QtTest.QTest.keyClicks(box, "1/7")
    assert not control.pop_up.complaint.isVisible()
    QtTest.QTest.keyClick(box, QtCore.Qt.Key.Key_Return)
    assert h.choices == [DistanceFrom(Spec.of("diffusion", t=1 / 7))]
    assert not control.pop_up.isVisible()
    assert control.button.text() == "0.1429"


def test_the_pop_up_s_slider_counts_only_when_it_is_let_go(head):
    h = head("truncated", 600)
    (control,) = shown(h)
    slider = control.pop_up.slider
    control.open_under(control)
    slider.setSliderDown(True)
    slider.setSliderPosition(120)
    assert h.choices == []
    assert control.pop_up.box.text() == "1000"
    slider.setSliderDown(False)
    assert h.choices == [DistanceFrom(Spec.of("truncated", k=1000))]
    QtTest.QTest.keyClick(slider, QtCore.Qt.Key.Key_Right)
    assert h.shows.spec["k"] == 1009
    QtTest.QTest.keyClick(slider, QtCore.Qt.Key.Key_Escape)
    assert not control.pop_up.isVisible()


@pytest.mark.parametrize("text", SHOWN)
def test_nothing_overlaps_or_is_cut_at_any_width(head, text):
    h = head(text)
    for warning in ("", "only 3 % exact"):
        h.show_warning(warning)
        for width in range(120, 901, 7):
            h.resize(width, h.height())
            children = h.findChildren(QtWidgets.QWidget, options=QtCore.Qt.FindChildOption.FindDirectChildrenOnly)
            children = [child for child in children if child.isVisibleTo(h) and not child.isWindow()]
            places = sorted((child.geometry() for child in children), key=lambda place: place.left())
            for place, after in pairwise(places):
                assert place.right() < after.left(), width
            assert places[0].left() >= 0
            assert places[-1].right() < width
            for control in shown(h):
                button = getattr(control, "button", control)
                assert button.width() >= button.sizeHint().width(), width
                if button is not control and control.slider.isVisibleTo(h):
                    assert 72 <= control.slider.width() <= 88
                    assert width >= 440
            if h.name.is_cut:
                assert not shown(h), "the name is cut last"
                assert not h.info.isVisibleTo(h)


def test_words_leave_as_the_panel_becomes_narrower(head):
    h = head("power")

    def at(width):
        h.resize(width, h.height())
        sliders = [c.slider.isVisibleTo(h) for c in shown(h)]
        return len(shown(h)), any(sliders), h.info.isVisibleTo(h), h._about.isVisible()

    assert at(500) == (2, True, True, False)
    assert at(439) == (2, False, False, True)
    assert at(290) == (1, False, False, True)
    assert at(190) == (0, False, False, True)
    h.show_quantity(quantity("geodesic"))
    inner = entries(h.name.menu())["How it is computed: auto"].menu()
    {action.text(): action for action in inner.actions()}["heat"].trigger()
    assert str(h.choices[-1]) == "geodesic(method=heat)"


def test_a_hidden_number_opens_its_pop_up_from_the_name_s_menu(head, application):
    h = head("diffusion", 150)
    choose(h, "Diffusion time: 1.00 …")
    QtTest.QTest.qWait(20)
    (control,) = h.controls
    assert control.pop_up.isVisible()
    control.pop_up.box.setText("2")
    QtTest.QTest.keyClick(control.pop_up.box, QtCore.Qt.Key.Key_Return)
    assert str(h.choices[-1]) == "diffusion(t=2)"


def test_the_wheel_turns_no_slider_that_has_no_focus(head):
    h = head("diffusion")
    slider = shown(h)[0].slider
    h.name.setFocus()

    def turn():
        point = QtCore.QPointF(slider.rect().center())
        event = QtGui.QWheelEvent(
            point,
            QtCore.QPointF(slider.mapToGlobal(point.toPoint())),
            QtCore.QPoint(),
            QtCore.QPoint(0, 120),
            QtCore.Qt.MouseButton.NoButton,
            QtCore.Qt.KeyboardModifier.NoModifier,
            QtCore.Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QtWidgets.QApplication.sendEvent(slider, event)

    turn()
    assert h.choices == []
    h.window().activateWindow()
    slider.setFocus()
    assert QtTest.QTest.qWaitForWindowActive(h.window())
    turn()
    assert len(h.choices) == 1


def test_the_window_s_shortcuts_are_not_taken_by_the_box(head):
    h = head("diffusion", 360)
    control = shown(h)[0]
    control.open_under(control)
    box = control.pop_up.box
    keys, modifiers = QtCore.Qt.Key, QtCore.Qt.KeyboardModifier

    def is_taken(key, modifier=modifiers.ControlModifier):
        event = QtGui.QKeyEvent(QtCore.QEvent.Type.ShortcutOverride, key, modifier, "")
        event.ignore()
        QtWidgets.QApplication.sendEvent(box, event)
        return event.isAccepted()

    for key in (keys.Key_E, keys.Key_S, keys.Key_O, keys.Key_Z):
        assert not is_taken(key)
    assert not is_taken(keys.Key_D, modifiers.AltModifier)
    QtWidgets.QApplication.clipboard().setText("7")
    for key in (keys.Key_A, keys.Key_C, keys.Key_V, keys.Key_X):
        assert is_taken(key)
    QtTest.QTest.keyClicks(box, "5")
    assert is_taken(keys.Key_Z), "there is something to take back"


def test_every_control_is_reached_by_tab_and_has_a_name(head):
    h = head("power")
    h.window().activateWindow()
    assert QtTest.QTest.qWaitForWindowActive(h.window())
    alpha, k = shown(h)
    h.name.setFocus(QtCore.Qt.FocusReason.TabFocusReason)
    reached = []
    for _ in range(6):
        reached.append(QtWidgets.QApplication.focusWidget())
        QtTest.QTest.keyClick(reached[-1], QtCore.Qt.Key.Key_Tab)
    assert reached == [h.name, alpha.slider, alpha.button, k.button, h.info, h.more]
    for widget in reached:
        assert widget.accessibleName()
        assert widget.toolTip()


@pytest.mark.parametrize("key", ["Key_Space", "Key_Return", "Key_Down"])
def test_menus_and_sheets_open_by_keyboard(head, key):
    h = head("geodesic")
    opened = []
    for button in (h.name, shown(h)[0], h.more):
        menu = button.menu()
        menu.aboutToShow.connect(lambda menu=menu: opened.append(menu) or QtCore.QTimer.singleShot(0, menu.close))
        QtTest.QTest.keyClick(button, getattr(QtCore.Qt.Key, key))
    assert opened == [h.name.menu(), shown(h)[0].menu(), h.more.menu()]
    QtTest.QTest.keyClick(h.info, getattr(QtCore.Qt.Key, key))
    assert h._sheet.isVisible()
    h._sheet.close()


def test_the_focus_ring_is_there_by_keyboard_only(head):
    h = head()
    h.window().activateWindow()
    assert QtTest.QTest.qWaitForWindowActive(h.window())

    def ring():
        picture = h.name.grab().toImage()
        return picture.pixelColor(picture.width() // 2, 1).name().upper() == LOOK.theme.accent

    h.name.setFocus(QtCore.Qt.FocusReason.MouseFocusReason)
    assert not ring()
    h.name.clearFocus()
    h.name.setFocus(QtCore.Qt.FocusReason.TabFocusReason)
    assert ring()


def test_the_panel_s_menu_asks_for_edits_that_are_possible(head):
    h, asked = head(), []
    h.asked.connect(asked.append)
    h.allow({"Duplicate this panel", "Remove it"})
    possible = [word for word in PANEL_EDITS if entries(h.more.menu())[word].isEnabled()]
    assert possible == ["Duplicate this panel", "Remove it"]
    for word in possible:
        entries(h.more.menu())[word].trigger()
    assert asked == possible


def test_pressing_the_head_or_anything_in_it_says_so(head):
    h, pressed = head("diffusion"), []
    h.clicked.connect(lambda: pressed.append(True))
    QtTest.QTest.mouseClick(h, QtCore.Qt.MouseButton.LeftButton, pos=QtCore.QPoint(400, 10))
    QtTest.QTest.mousePress(shown(h)[0].slider, QtCore.Qt.MouseButton.LeftButton)
    QtTest.QTest.mouseRelease(shown(h)[0].slider, QtCore.Qt.MouseButton.LeftButton)
    QtTest.QTest.mouseClick(h.info, QtCore.Qt.MouseButton.LeftButton)
    assert len(pressed) == 3
    assert h._sheet.isVisible()
    h._sheet.close()


def test_a_poor_answer_is_marked_and_no_longer_called_exact(head):
    h = head("biharmonic")
    h.show_info("accurate to <b>7</b> digits")
    assert shown(h)[0].text() == "exact"
    assert not h.warning.isVisible()
    assert "<b>7</b>" in h.info.toolTip()
    h.show_warning("only 2 digits")
    assert shown(h) == []
    assert h.warning.isVisible()
    assert h.warning.toolTip() == "only 2 digits"
    assert "only 2 digits" in h.info.toolTip()
    h.show_warning("error < 3 %")
    assert "error &lt; 3 %" in h.info.toolTip(), "plain words among rich text"
    h.show_warning("")
    assert shown(h)[0].text() == "exact"
    assert "only 2 digits" not in h.info.toolTip()


def test_lower_in_a_panel_with_little_height(head):
    h = head()
    assert h.height() == 36
    h.set_compact(True)
    assert h.height() == 32
    assert h.sizePolicy().horizontalPolicy() == QtWidgets.QSizePolicy.Policy.Ignored
    assert h.minimumSizeHint().width() <= 72


def test_what_auto_stands_for_is_said(head):
    made = head("geodesic", 600)
    (control,) = made.controls
    assert control.text() == "auto"
    made.show_method("heat")
    assert control.text() == "auto: heat"
    made.show_quantity(quantity("geodesic(method=exact)"))
    assert control.text() == "exact"
    made.show_quantity(quantity("geodesic"))
    assert control.text() == "auto: heat"
