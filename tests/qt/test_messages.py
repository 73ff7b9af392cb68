"""Messages that can be read and copied, one of several files, and the line above the panels."""

import pytest
from qtpy import QtCore, QtTest, QtWidgets

from app.qt.look.look import LOOK
from app.qt.pages.messages import Notice, WhichFile, ask_which, tell

pytestmark = pytest.mark.usefixtures("application")


@pytest.fixture
def window(application):
    window = QtWidgets.QMainWindow()
    LOOK.apply_theme(window)
    window.resize(640, 300)
    window.show()
    yield window
    window.close()
    window.deleteLater()
    QtTest.QTest.qWait(1)


def notice_in(window):
    middle, notice = QtWidgets.QWidget(), Notice()
    column = QtWidgets.QVBoxLayout(middle)
    column.setContentsMargins(0, 0, 0, 0)
    column.addWidget(notice)
    column.addStretch(1)
    window.setCentralWidget(middle)
    return notice


def settle(application, times=5):
    for _ in range(times):
        application.processEvents()


def test_a_message_does_not_wait_and_all_of_it_is_copied(application, window):
    message = tell(window, "It <b>failed</b>.", "line 1\nline 2")
    assert message.isVisible()
    assert message.sentence.text() == "It <b>failed</b>."
    assert message.details.isHidden()
    low = message.height()
    message.fold.click()
    assert not message.details.isHidden()
    assert message.height() > low
    message.fold.click()
    assert message.details.isHidden()
    message.copy.click()
    assert QtWidgets.QApplication.clipboard().text() == "It <b>failed</b>.\n\nline 1\nline 2"
    gone = []
    message.destroyed.connect(lambda: gone.append(1))
    message.close()
    QtTest.QTest.qWait(1)
    assert gone


def test_a_message_without_details_offers_none(window):
    message = tell(window, "No.")
    assert message.fold.isHidden()
    message.close()


def test_a_message_stands_above_a_dialog_that_is_open(application, window):
    dialog = QtWidgets.QDialog(window)
    dialog.open()
    settle(application)
    message = tell(window, "Not so.")
    assert message.parent() is dialog
    message.close()
    dialog.close()


def answered(window, paths, act):
    """What `ask_which` gives when the dialog is acted upon."""
    QtCore.QTimer.singleShot(0, lambda: act(QtWidgets.QApplication.activeModalWidget()))
    return ask_which(window, paths)


def test_one_of_several_files_is_chosen(window):
    paths = ["/far/away/a.off", "/far/away/b.off", "/near/a.off"]
    keys = QtCore.Qt.Key

    def second_by_key(dialog):
        QtTest.QTest.keyClick(dialog.list, keys.Key_Down)
        QtTest.QTest.keyClick(dialog.list, keys.Key_Return)

    def third_by_double_click(dialog):
        place = dialog.list.visualItemRect(dialog.list.item(2)).center()
        view, left = dialog.list.viewport(), QtCore.Qt.MouseButton.LeftButton
        QtTest.QTest.mouseClick(view, left, pos=place)
        QtTest.QTest.mouseDClick(view, left, pos=place)

    assert answered(window, paths, second_by_key) == paths[1]
    assert answered(window, paths, third_by_double_click) == paths[2]
    assert answered(window, paths, lambda dialog: dialog.reject()) is None


def test_the_list_of_files_tells_them_apart(window):
    dialog = WhichFile(["/far/away/a.off", "/near/a.off"], window)
    assert [dialog.list.item(k).text() for k in (0, 1)] == ["a.off", "a.off"]
    assert [dialog.list.item(k).toolTip() for k in (0, 1)] == ["/far/away/a.off", "/near/a.off"]
    dialog.deleteLater()


def test_a_notice_is_hidden_until_there_is_something_to_say(application, window):
    notice = notice_in(window)
    settle(application)
    assert notice.isHidden()
    done = []
    notice.show_text("What was shown can be restored.", "plain", ("Restore", lambda: done.append(1)))
    settle(application)
    assert notice.isVisible()
    notice.button.click()
    assert done == [1]
    assert notice.isHidden()
    notice.show_text("Again.")
    assert notice.button.isHidden()
    notice.shut.click()
    assert notice.isHidden()
    notice.show_text("Soon gone.", seconds=0.05)
    notice.show_text("It stays.")
    QtTest.QTest.qWait(150)
    assert notice.isVisible()
    notice.show_text("Soon gone.", seconds=0.05)
    QtTest.QTest.qWait(150)
    assert notice.isHidden()


def test_what_an_action_has_to_say_stays(application, window):
    notice = notice_in(window)
    notice.show_text("One.", action=("Do", lambda: notice.show_text("Two.")))
    notice.button.click()
    assert not notice.isHidden()
    assert notice.words.text() == "Two."


def test_a_long_notice_has_two_lines_and_all_of_it_in_the_tooltip(application, window):
    notice = notice_in(window)
    notice.show_text("Short.")
    settle(application)
    low = notice.height()
    assert notice.words.toolTip() == ""
    long = "The mesh has edges with more than two faces. " * 8
    notice.show_text(long, "warning", ("Show repairs", lambda: None))
    settle(application)
    assert low < notice.height() < 2 * low
    lines = notice.words.lines(notice.words.width())
    assert len(lines) == 2
    assert lines[1].endswith("…")
    assert notice.words.toolTip() == long.strip()
    assert window.width() == 640
    assert notice.shut.geometry().right() <= notice.width()
    window.resize(1500, 300)
    notice.show_text("The mesh has edges with more than two faces.", "warning")
    settle(application)
    assert notice.words.toolTip() == ""


def test_a_notice_has_the_ground_of_its_kind_in_each_theme(application, window):
    from app.qt.look.theme import DARK, LIGHT

    notice, before = notice_in(window), LOOK.choice
    try:
        for theme in (LIGHT, DARK):
            LOOK.choose(theme.word)
            for kind, ground in [
                ("plain", theme.hover),
                ("warning", theme.warning_ground),
                ("error", theme.error_ground),
            ]:
                notice.show_text("Words", kind)
                settle(application)
                picture = notice.grab().toImage()
                assert picture.pixelColor(picture.width() // 2, 3).name().upper() == ground
    finally:
        LOOK.choose(before)
