"""What commands say of long work: how far it is, and how long it still takes."""

from contextlib import nullcontext

import pytest

from app.commands import terminal
from app.main import main
from app.session.time_left import TimeLeft
from bihdist_core import BiharmonicDistance
from tests.commands import ran, refused
from tests.shapes import bumpy, two_pieces
from tests.waiting import until


@pytest.fixture(autouse=True)
def every_ten_seconds(monkeypatch):
    monkeypatch.setattr(terminal, "PROGRESS_INTERVAL_S", 10.0)


@pytest.fixture
def said(capsys):
    """All that has been said by now on standard error."""
    lines = []

    def said():
        lines.extend(capsys.readouterr().err.splitlines())
        return lines

    return said


def wait_for(words, said):
    until(lambda: words in said())


class Clock:
    """Seconds that pass when they are told to."""

    now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def unwatched(monkeypatch):
    """No thread that looks, once a second of the real clock, whether a line is due by the test's."""
    monkeypatch.setattr(terminal._Telling, "watched", lambda self, words: nullcontext())


@pytest.mark.usefixtures("unwatched")
def test_without_a_terminal_long_work_says_a_line_now_and_then(capsys):
    clock = Clock()
    with terminal.telling(clock=clock):
        for second in range(36):
            clock.now = float(second)
            # A command has several of them, one after another.
            with terminal.progress_line() as progress:
                progress(second / 40, "solving")
    assert capsys.readouterr().err.splitlines() == [f"bihdist: {share}% solving" for share in (25, 50, 75)]


def test_a_step_that_reports_nothing_for_long_is_told_of_meanwhile(said, monkeypatch):
    monkeypatch.setattr(terminal, "PROGRESS_INTERVAL_S", 0.05)
    with terminal.telling(), terminal.progress_line() as progress:
        wait_for("bihdist: under way", said)
        progress(0.3, "solving")
        wait_for("bihdist: 30% solving", said)
        count = len(said())
        until(lambda: len(said()) > count)  # again, though nothing is reported
    assert set(said()) == {"bihdist: under way", "bihdist: 30% solving"}


@pytest.mark.usefixtures("unwatched")
def test_work_that_is_expected_to_be_long_is_announced_at_once(capsys):
    clock = Clock()
    with terminal.telling(clock=clock), terminal.progress_line() as progress:
        for second in (0.1, 0.5, 4.0, 11.0):
            clock.now = second
            progress(second / 55, "Factoring the matrix: about 50 s")
        progress(11 / 55, "all pairs: 7 of 9 vertices")
        clock.now = 22.0
        progress(22 / 55, "all pairs: 8 of 9 vertices")
    assert capsys.readouterr().err.splitlines() == [
        "bihdist: 0% Factoring the matrix, about 50 s",
        "bihdist: 20% Factoring the matrix, about 40 s left",
        "bihdist: 40% all pairs: 8 of 9 vertices, about 30 s left",
    ]


def test_short_work_says_nothing(capsys):
    with terminal.telling(), terminal.progress_line() as progress:
        progress(0.5, "solving")
    assert capsys.readouterr() == ("", "")


def test_tasks_that_take_long_are_told_of_meanwhile(said, monkeypatch):
    monkeypatch.setattr(terminal, "PROGRESS_INTERVAL_S", 0.05)
    with terminal.telling(), terminal.task_lines(lambda: "1 of 2 done, others under way") as say:
        say("1 of 2: cat")
        wait_for("bihdist: 1 of 2 done, others under way", said)
    assert "bihdist: 1 of 2: cat" in said()
    assert set(said()) == {"bihdist: 1 of 2: cat", "bihdist: 1 of 2 done, others under way"}


def test_a_line_of_progress_is_said_only_after_so_long(capsys):
    clock = Clock()
    with terminal.telling(clock=clock):
        for clock.now in (4.0, 9.0, 10.0, 12.0, 19.0, 20.0):
            terminal._telling.line_if_due(lambda: f"{clock.now:g} s")
    assert capsys.readouterr().err.splitlines() == ["bihdist: 10 s", "bihdist: 20 s"]


def test_nothing_is_said_where_that_is_asked_for(capsys):
    clock = Clock()
    with terminal.telling(quiet=True, clock=clock) as notes:
        clock.now = 100.0
        with terminal.progress_line() as progress:
            assert progress is None
        terminal.tell("a note")
        terminal.warn("of this")
        terminal.tell_failure("that failed.")
    assert capsys.readouterr().err == "bihdist: that failed.\n"
    assert notes == ["a note", "warning: of this"]
    assert not terminal.is_quiet()


@pytest.mark.parametrize(
    ("name", "words"), [("of_pairs", ["--pairs", "1:2,3:4"]), ("pairwise", ["--sources", "1,2,3"])]
)
def test_pairs_tell_of_their_progress(mesh_file, tmp_path, capsys, monkeypatch, name, words):
    ask, told = getattr(BiharmonicDistance, name), []

    def asked(self, ids, progress):
        told.append(progress)
        return ask(self, ids, progress)

    monkeypatch.setattr(BiharmonicDistance, name, asked)
    monkeypatch.setattr(terminal, "PROGRESS_INTERVAL_S", 0.0)
    assert main(["pairs", mesh_file(bumpy(60)), *words, "-o", str(tmp_path / "p.npy")]) == 0
    assert [progress is None for progress in told] == [False]
    assert "% biharmonic, exact" in capsys.readouterr().err


def test_quiet_commands_leave_standard_error_to_what_fails(mesh_file, tmp_path, capsys):
    pieces, out = mesh_file(two_pieces()), str(tmp_path / "f.csv")
    by = ["--distance", "geodesic", "--method", "dijkstra"]
    assert "2 components" in (said := ran(capsys, "field", pieces, "--sources", "3", *by, "-o", out)).err
    assert "warning: " in said.err
    assert ran(capsys, "field", pieces, "--sources", "3", *by, "-o", out, "--quiet") == ("", "")
    # What is said beside a file on standard output is a note, too.
    assert ran(capsys, "field", pieces, "--sources", "3", "-o", "-", "--quiet").err == ""
    assert "no vertex 999" in refused(capsys, "field", pieces, "--sources", "999", "-o", out, "--quiet")


# ---------------------------------------------------------------------- time left
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
