"""The line over a panel: what is chosen there, and what it says."""

import pytest
from qtpy import QtCore, QtTest, QtWidgets

from app.document.panel_edits import panel_edits
from app.document.quantities import DistanceFrom, OwnField, quantity
from app.qt.panels.number_box import STEPS, shown_value, step_of_value, value_of_step
from bihdist_core.analysis.signature_types import SIGNATURES
from bihdist_core.distances.distance_types import BUILT_IN, Spec, distance_type
from tests.qt.events import send_mouse
from tests.qt.heads import choose, entries, shown


def test_every_distance_can_be_chosen_by_its_name_and_says_what_to_look_for(head):
    h = head(point="tail")
    for kind in (*BUILT_IN[1:], BUILT_IN[0]):
        name = kind.name.replace("^α", "ᵅ")
        hint = entries(h.name.menu())[name].toolTip()
        assert hint.lower() == kind.hint.lower()
        choose(h, name)
        assert h.choices[-1] == h.shows == DistanceFrom(Spec.of(kind.word), "tail")
        assert [text for text, action in entries(h.name.menu()).items() if action.isChecked()] == [name]
    choose(h, "Biharmonic")
    assert len(h.choices) == len(BUILT_IN), "what is shown already is no change"


def test_a_distance_chosen_again_has_its_old_parameters(head):
    h = head("diffusion(t=1/4)")
    choose(h, "Geodesic")
    choose(h, "Diffusion")
    assert str(h.choices[-1]) == "diffusion(t=1/4)"
    choose(h, "Difference with", "Diffusion")
    assert str(h.choices[-1]) == "diffusion(t=1/4) - diffusion", "the second has its own"


def test_a_slider_gives_values_in_equal_steps_of_the_logarithm_and_hits_the_marks(head):
    h = head("diffusion")
    (control,) = shown(h)
    assert control.slider.isVisible()
    control.slider.setValue(0)
    assert h.choices == [DistanceFrom(Spec.of("diffusion", t=1 / 15))]
    assert control.button.text() == "1/15"
    (t,) = distance_type("diffusion").parameters
    for mark in t.marks:
        control.slider.setValue(step_of_value(t, mark))
        assert h.shows.spec["t"] == mark
    for name in ("diffusion", "power", "truncated"):
        for parameter in distance_type(name).parameters:
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
    assert shown_value(distance_type(word).parameter(name), value) == text


def test_words_are_chosen_from_the_menu_of_their_value(head):
    h = head("geodesic")
    (method,) = shown(h)
    entries(method.menu())["Dijkstra"].trigger()
    assert str(h.choices[-1]) == "geodesic(method=dijkstra)"
    assert method.text() == "Dijkstra"
    assert [text for text, action in entries(method.menu()).items() if action.isChecked()] == ["Dijkstra"]


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
    choose(h, "Fractions of the maximum")
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


def test_the_panel_s_menu_asks_for_edits_that_are_possible(head):
    h, asked = head(), []
    h.asked.connect(asked.append)
    h.allow({"Duplicate panel", "Remove panel"}, set())
    possible = [word for word in panel_edits() if entries(h.more.menu())[word].isEnabled()]
    assert possible == ["Duplicate panel", "Remove panel"]
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


@pytest.mark.parametrize(("name", "is_passed"), [("Key_F", True), ("Key_Escape", False)])
def test_the_sheet_of_a_head_passes_keys_and_pointing_on(head, name, is_passed):
    h = head()
    keys, moves = [], []

    class Below(QtWidgets.QWidget):
        def keyPressEvent(self, event):
            keys.append(event.key())

        def mouseMoveEvent(self, event):
            moves.append(event.pos())

        def mousePressEvent(self, event):
            moves.append("pressed")

    below = Below(h.parentWidget())
    below.setMouseTracking(True)
    below.setGeometry(0, 40, 600, 60)
    below.show()
    QtTest.QTest.mouseClick(h.info, QtCore.Qt.MouseButton.LeftButton)
    assert h._sheet.isVisible()
    assert QtWidgets.QApplication.activePopupWidget() is None
    send_mouse(below, QtCore.QPoint(20, 20))
    assert moves
    assert h._sheet.isVisible()
    key = getattr(QtCore.Qt.Key, name)
    QtTest.QTest.keyClick(below, key)
    assert not h._sheet.isVisible()
    assert keys == [key] * is_passed
    # A click beside it closes it and does nothing else.
    QtTest.QTest.mouseClick(h.info, QtCore.Qt.MouseButton.LeftButton)
    moves.clear()
    QtTest.QTest.mouseClick(below, QtCore.Qt.MouseButton.LeftButton, pos=QtCore.QPoint(20, 20))
    assert not h._sheet.isVisible()
    assert "pressed" not in moves


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


def test_what_auto_stands_for_is_said(head):
    made = head("geodesic", 600)
    (control,) = made.controls
    assert control.text() == "auto"
    made.show_method(made.shows.specs, "geodesic, heat method")
    assert control.text() == "auto: heat method"
    made.show_quantity(quantity("geodesic(method=exact)"))
    assert control.text() == "exact"
    made.show_quantity(quantity("geodesic"))
    assert control.text() == "auto: heat method"


def test_a_stand_in_is_said_whatever_is_chosen(head):
    for word, said in (("geodesic", "auto: heat method"), ("geodesic(method=exact)", "exact, now heat method")):
        made = head(word, 600)
        (control,) = made.controls
        made.show_method(made.shows.specs, "geodesic, heat method", is_preview=True)
        assert control.text() == said
        made.show_method(made.shows.specs, "geodesic, exact")
        assert control.text() == ("auto: exact" if word == "geodesic" else "exact")


def test_heads_of_one_quantity_are_worded_alike_whatever_the_distance(head):
    one, other = head("interpolant by biharmonic"), head("interpolant by geodesic")
    seen = set()
    for width in range(400, 100, -2):
        for each in (one, other):
            each.resize(width, each.height())
        assert other.name.text() != "Interpolant" or one.name.text() == "Interpolant", width
        seen.add(one.controls[0].text())
    assert seen == {"by biharmonic", "by biharm."}


def test_signatures_are_chosen_by_name_and_keep_their_parameters(head):
    h = head(point="tail")
    for word, row in SIGNATURES.items():
        choose(h, row.name)
        assert str(h.choices[-1]) == word
        assert [text for text, action in entries(h.name.menu()).items() if action.isChecked()] == [row.name]
    choose(h, "Heat kernel signature")
    (control,) = shown(h)
    control.slider.setValue(0)
    assert str(h.choices[-1]) == "hks(t=1/100)"
    choose(h, "Centrality")
    choose(h, "Heat kernel signature")
    assert str(h.choices[-1]) == "hks(t=1/100)"
    choose(h, "Difference with", "Biharmonic")
    assert str(h.choices[-1]) == "hks(t=1/100) - biharmonic"
