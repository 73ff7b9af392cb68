"""How long work still takes, from how far it has come."""

from app.session.time_left import TimeLeft


def test_it_is_told_once_it_is_known_and_while_it_is_long():
    left = TimeLeft()
    assert left.words(0.1, 100.0) == ""
    assert left.words(0.11, 102.0) == ""
    assert left.words(0.2, 105.0) == "about 40 s left"
    assert left.words(0.6, 121.0) == "about 20 s left"
    assert left.words(0.9, 132.0) == ""
    assert left.words(0.3, 140.0) == ""  # another piece of work
    assert left.words(0.32, 150.0) == "about 6 min left"


def test_what_does_not_advance_says_nothing():
    left = TimeLeft()
    assert [left.words(0.5, now) for now in (0.0, 5.0, 50.0)] == ["", "", ""]
