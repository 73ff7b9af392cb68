"""How long work still takes, from how far it has come."""

from app.session.time_left import TimeLeft


def test_it_is_told_once_it_is_known_and_while_it_is_long():
    left = TimeLeft()
    assert left.words(0.1, "solving", 100.0) == ""
    assert left.words(0.11, "solving", 102.0) == ""
    assert left.words(0.2, "solving", 105.0) == "about 40 s left"
    assert left.words(0.6, "solving", 121.0) == "about 20 s left"
    assert left.words(0.9, "solving", 132.0) == ""
    assert left.words(0.3, "solving", 140.0) == ""  # another piece of work
    assert left.words(0.32, "solving", 150.0) == "about 6 min left"


def test_what_does_not_advance_says_nothing():
    left = TimeLeft()
    assert [left.words(0.5, "solving", now) for now in (0.0, 5.0, 50.0)] == ["", "", ""]


def test_what_is_expected_is_told_until_it_is_known():
    left, text = TimeLeft(), "Factoring the matrix: about 50 s"
    assert left.words(0.0, text, 0.0) == left.words(0.0, text, 9.0) == "about 50 s"
    assert left.words(0.1, text, 10.0) == "about 90 s left"
    assert left.words(0.9, text, 81.0) == ""
