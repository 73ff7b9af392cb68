"""What is said on standard error: progress now and then where there is no terminal, notes, failures."""

import time

import pytest

from app.commands import terminal
from app.main import main
from bihdist_core import BiharmonicDistance
from tests.shapes import bumpy, two_pieces


class Clock:
    """Seconds that pass when they are told to."""

    now = 0.0

    def __call__(self):
        return self.now


def test_without_a_terminal_long_work_says_a_line_now_and_then(capsys):
    clock = Clock()
    with terminal.telling(clock=clock):
        for second in range(36):
            clock.now = float(second)
            # A command has several of them, one after another.
            with terminal.progress_line() as progress:
                progress(second / 40, "solving")
    assert capsys.readouterr().err.splitlines() == [f"bihdist: {share}% solving" for share in (25, 50, 75)]


def test_a_step_that_reports_nothing_for_long_is_told_of_meanwhile(capsys, monkeypatch):
    monkeypatch.setattr(terminal, "EVERY", 0.05)
    with terminal.telling(), terminal.progress_line() as progress:
        time.sleep(0.2)
        progress(0.3, "solving")
        time.sleep(0.2)
    lines = capsys.readouterr().err.splitlines()
    assert set(lines) == {"bihdist: under way", "bihdist: 30% solving"}
    assert len(lines) > 2


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


def test_tasks_that_take_long_are_told_of_meanwhile(capsys, monkeypatch):
    monkeypatch.setattr(terminal, "EVERY", 0.05)
    with terminal.telling(), terminal.task_lines(lambda: "1 of 2 done, others under way") as say:
        say("1 of 2: cat")
        time.sleep(0.2)
    first, *others = capsys.readouterr().err.splitlines()
    assert first == "bihdist: 1 of 2: cat"
    assert set(others) == {"bihdist: 1 of 2 done, others under way"}
    assert len(others) <= 4


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
    monkeypatch.setattr(terminal, "EVERY", 0.0)
    assert main(["pairs", mesh_file(bumpy(60)), *words, "-o", str(tmp_path / "p.npy")]) == 0
    assert [progress is None for progress in told] == [False]
    assert "% biharmonic, exact" in capsys.readouterr().err


def test_quiet_commands_leave_standard_error_to_what_fails(mesh_file, tmp_path, capsys):
    pieces, out = mesh_file(two_pieces()), str(tmp_path / "f.csv")
    by = ["--distance", "geodesic", "--method", "dijkstra"]
    assert main(["field", pieces, "--sources", "3", *by, "-o", out]) == 0
    assert "2 components" in (said := capsys.readouterr()).err
    assert "warning: " in said.err
    assert main(["field", pieces, "--sources", "3", *by, "-o", out, "--quiet"]) == 0
    assert capsys.readouterr() == (said.out, "")
    # What is said beside a file on standard output is a note, too.
    assert main(["field", pieces, "--sources", "3", "-o", "-", "--quiet"]) == 0
    assert capsys.readouterr().err == ""
    assert main(["field", pieces, "--sources", "999", "-o", out, "--quiet"]) == 2
    assert "no vertex 999" in capsys.readouterr().err
