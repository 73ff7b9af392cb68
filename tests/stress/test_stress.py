"""The run of attacks: that it finds faults, goes on where it was, and a small version of each part."""

import json
import random
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, CommuteTimeDistance, SolverError
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from tests.extended_reference import needs_digits
from tests.shapes import bumpy, two_pieces
from tests.stress import (
    __main__ as program,
    accuracy,
    blocks,
    broken_kinds,
    broken_meshes,
    cancellations,
    documents,
    faulty,
    field_files,
    fields,
    hands,
    interruptions,
    laws,
    mesh_files,
    soak,
)
from tests.stress.blocks import block
from tests.stress.log import FILE
from tests.stress.outcome import LOST, OPENED, WRONG, Outcome, Tally
from tests.stress.parts import PARTS
from tests.stress.screens import there_is_a_screen
from tests.stress.sentences import fault_of

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="its limits are Linux's")


# ---------------------------------------------------------------------- the run itself
def test_a_block_counts_every_outcome_and_goes_on_behind_each():
    tally = block(faulty, 0)
    assert (tally.opened, tally.refused, tally.crashed, tally.hung, tally.lost, tally.wrong) == (1, 1, 2, 2, 1, 1)
    assert (tally.tried, tally.faulty, tally.ratio) == (8, 6, 0.25)
    assert tally.memory > 1e6
    told = {number: (kind, text) for number, kind, text in tally.faults}
    assert told[2] == ("crashed", "KeyError: 'nothing\\nforeseen' (faulty.py:21)")
    assert told[3][1].startswith("ended by SIGABRT: Fatal Python error: Aborted")
    assert told[4] == ("hung", "not done within its processor time")
    assert told[5] == ("wrong", "another number")
    assert told[6] == ("lost", "half a file")
    assert told[7] == ("hung", "not done within its time")


def test_a_part_that_does_not_begin_is_an_error(monkeypatch):
    monkeypatch.setattr(faulty, "__name__", "tests.stress.no_such")
    with pytest.raises(RuntimeError, match=r"(?s)no_such does not begin: .*No module named"):
        block(faulty, 0)


def test_a_block_that_is_stopped_does_not_count():
    with ThreadPoolExecutor(1) as workers:
        going = workers.submit(block, faulty, 0)
        while not blocks.RUNNING:
            time.sleep(0.01)
        blocks.stop()
        with pytest.raises(blocks.Stopped):
            going.result()


def test_an_interrupted_run_keeps_nothing_of_its_last_block(run, monkeypatch, tmp_path):
    def interrupted(part, seed):
        raise KeyboardInterrupt

    monkeypatch.setattr(program, "block", interrupted)
    assert run()[0] == 130
    assert not (tmp_path / FILE).exists()


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Run the program on the faulty part with some options; what it prints, and what it has tried."""
    monkeypatch.setitem(PARTS, "faulty", faulty)
    tried = []

    def tally(part, seed):
        tried.append(seed)
        return Tally(
            opened=3, wrong=seed, ratio=0.5, seconds=0.75, memory=10**8, faults=[[4, "wrong", "two\u00a0lines"]] * seed
        )

    monkeypatch.setattr(program, "block", tally)

    def go(*options):
        tried.clear()
        status = program.main(["--parts", "faulty", "--folder", str(tmp_path), "--workers", "1", *options])
        return status, capsys.readouterr().out, list(tried)

    return go


def test_a_run_goes_on_where_it_was_and_tells_all(run, tmp_path):
    status, said, tried = run("--blocks", "1")
    assert (status, tried) == (0, [0])
    with (tmp_path / FILE).open("a") as file:
        file.write('{"part": "faulty", "se')  # cut off
    status, said, tried = run()
    assert (status, tried) == (1, [1])
    assert "faulty 1 4: wrong: two\u00a0lines" in said
    row = next(line for line in said.splitlines() if "faults on purpose" in line)
    assert [cell.strip() for cell in row.split("|")[2:-1]] == [
        "7",
        "6",
        "0",
        "0",
        "0",
        "0",
        "1",
        "0.5",
        "0.75 s",
        "100 MB",
    ]
    status, again, tried = run()
    assert (status, tried) == (1, [])
    assert row in again
    assert len((tmp_path / FILE).read_text().splitlines()) == 3


def test_no_block_is_begun_after_the_time(run):
    assert run("--minutes", "0")[2] == []


def test_the_table_goes_into_a_page(run, tmp_path):
    page = tmp_path / "page.md"
    page.write_text(f"before\n{program.BEGIN}\nold\n{program.END}\nafter\n")
    run("--table", str(page))
    text = page.read_text()
    assert text.startswith(f"before\n{program.BEGIN}\n20")
    assert text.endswith(f"{program.END}\nafter\n")
    assert "faults on purpose" in text
    assert "old" not in text
    page.write_text("nothing")
    with pytest.raises(SystemExit, match="has no place for the table"):
        run("--table", str(page))


def test_parts_that_are_none_are_refused(capsys):
    with pytest.raises(SystemExit):
        program.main(["--parts", "mesh_files,all"])
    assert "there is no part all; parts are mesh_files, field_files," in capsys.readouterr().err


def test_one_case_is_tried_again(monkeypatch, capsys):
    monkeypatch.setitem(PARTS, "faulty", faulty)
    assert program.main(["--case", "faulty", "0", "2"]) == 0
    assert "KeyError" in capsys.readouterr().out


def test_few_faults_are_told_and_all_are_counted():
    tally = Tally()
    for number in range(100):
        tally.add(Outcome(WRONG, "x"), number)
    assert (tally.wrong, len(tally.faults)) == (100, 20)
    written = json.loads(json.dumps(tally.as_json() | {"part": "x"}))
    assert Tally.from_json(written) == tally
    del written["seconds"]  # as before there was one
    assert Tally.from_json(written) == tally


# ---------------------------------------------------------------------- what counts as a fault
@pytest.mark.parametrize(
    ("message", "fault"),
    [
        ("a.off is empty.", ""),
        ("b.off is empty.", "does not name a.off"),
        ("a.off\nis empty.", "of several lines"),
        (f"a.off {'x' * 1000}.", "of 1007 characters"),
        ("a.off is too large for the memory of this computer.", "asks for all memory"),
        ("a.off", "no sentence"),
        (" ", "without a word"),
    ],
)
def test_a_refusal_is_a_sentence_that_names_the_file(message, fault):
    assert fault in fault_of(message, "a.off")
    assert bool(fault) == bool(fault_of(message, "a.off"))


def spoilt(monkeypatch, kind, name, spoil):
    """Let a method of a distance answer something else."""
    sound = getattr(kind, name)
    monkeypatch.setattr(kind, name, lambda self, *arguments, **more: spoil(sound(self, *arguments, **more)))


@pytest.mark.parametrize(
    ("kind", "name", "spoil", "law"),
    [
        (BiharmonicDistance, "between", lambda d: d * (1 + 1e-6), "`between` is not `from_source`"),
        (BiharmonicDistance, "pairwise", lambda d: d * (1 + 1e-6 * (len(d) > 2)), "`pairwise` is not `from_sources`"),
        (BiharmonicDistance, "from_sources", lambda f: f + 1e-3, "not zero at the source"),
        (BiharmonicDistance, "from_sources", lambda f: f * [1, 1, 1.01, 1, 1], "not symmetric"),
        (BiharmonicDistance, "from_sources", lambda f: f**3, "the triangle inequality"),
        (BiharmonicDistance, "from_sources", lambda f: f * np.nan, "not a number within a component"),
        (BiharmonicDistance, "from_sources", lambda f: -f, "below zero"),
        (ExactGeodesic, "columns", lambda f: 0.9 * f, "below straight lines"),
        (ExactGeodesic, "columns", lambda f: 2 * f, "above those along edges"),
    ],
)
def test_each_law_that_is_broken_is_found(monkeypatch, kind, name, spoil, law):
    spoilt(monkeypatch, kind, name, spoil)
    outcome = laws.checked(bumpy(60), np.random.default_rng(0))
    assert outcome.kind == WRONG
    assert law in outcome.text


@needs_digits
@pytest.mark.parametrize(
    ("kind", "name", "words"),
    [
        (BiharmonicDistance, "from_sources", "biharmonic, exact: fields from vertices: by"),
        (CommuteTimeDistance, "from_sources", "commute-time, exact: fields from vertices: by"),
        (BiharmonicDistance, "from_source", "biharmonic, exact: a place: by"),
    ],
)
def test_a_field_that_is_off_by_more_than_is_said_is_found(monkeypatch, tmp_path, kind, name, words):
    spoilt(monkeypatch, kind, name, lambda f: f * (1 + 1e-4))
    outcome = fields.case(SEED, 0, tmp_path)
    assert outcome.kind == WRONG
    assert words in outcome.text


def test_a_number_outside_of_a_component_is_found(monkeypatch):
    spoilt(monkeypatch, BiharmonicDistance, "from_sources", np.nan_to_num)
    assert "a number outside of the component" in laws.checked(two_pieces(), np.random.default_rng(0)).text


def test_sound_surfaces_obey():
    for surface in (bumpy(60), two_pieces()):
        outcome = laws.checked(surface, np.random.default_rng(0))
        assert (outcome.kind, outcome.text) == (OPENED, "")
        assert 0 < outcome.ratio < 1


# ---------------------------------------------------------------------- a small version of each part
def test_there_are_kinds_enough():
    assert len(broken_kinds.KINDS) >= 60


SEED = 0
SMALL = {
    mesh_files: 200,
    field_files: 200,
    documents: 200,
    broken_meshes: len(broken_kinds.KINDS),
    accuracy: 25,
    fields: 10,
    interruptions: 12,
    cancellations: 4,
}


@pytest.mark.parametrize("part", SMALL, ids=lambda part: part.__name__.rpartition(".")[2])
def test_nothing_crashes_hangs_is_lost_or_wrong(part):
    tally = block(part, SEED, SMALL[part])
    assert not tally.faults
    assert tally.tried > 0.8 * SMALL[part]
    assert tally.opened
    assert tally.ratio <= 1


def careless(name, folder, out):
    """Work that writes a file in its place, in two steps, and says nothing where there is no room."""

    def work():
        try:
            with out.open("wb", buffering=0) as file:
                file.write(b"a" * 1000)
                time.sleep(0.2)
                file.write(b"b" * 1000)
        except OSError:
            pass
        return 0

    return work


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
@pytest.mark.parametrize(
    ("attack", "kind", "words"),
    [
        (interruptions._killed, LOST, "field.npy is half written after a kill"),
        (interruptions._full, WRONG, "field.npy is not whole, and nothing is said"),
    ],
)
def test_careless_writing_is_found(tmp_path, monkeypatch, attack, kind, words):
    monkeypatch.setattr(interruptions, "_work", careless)
    sound = interruptions._sound("field.npy", tmp_path)
    outcomes = [attack("field.npy", tmp_path, sound, random.Random(seed)) for seed in range(9)]
    assert kind in [outcome.kind for outcome in outcomes]
    assert any(words in outcome.text for outcome in outcomes)


def test_work_that_is_not_cancelled_soon_is_found(monkeypatch):
    def deaf(surface, progress):
        end = time.process_time() + 0.3
        while time.process_time() < end:
            pass
        progress(0.5, "")

    monkeypatch.setattr(cancellations, "LARGE", 60)
    monkeypatch.setattr(cancellations, "FREE_WITHIN", 0.01)
    monkeypatch.setattr(cancellations, "WORKS", {"deaf work": deaf})
    assert "from its cancellation to its end" in cancellations._cancelled(random.Random(0)).text


@pytest.mark.parametrize(
    ("memory", "handles", "text"),
    [
        (np.linspace(1e8, 2e8, 100), [9] * 100, "memory grows by 80 MB"),
        (np.full(100, 1e8), range(100), "more handles and threads at the end"),
        (np.full(100, 1e8), [9] * 100, ""),
    ],
)
def test_what_grows_is_found(memory, handles, text):
    outcome = soak._flat(list(memory), list(handles))
    assert (outcome.kind == OPENED) == (not text)
    assert text in outcome.text


@pytest.mark.skipif(not there_is_a_screen(), reason="xvfb-run or xdotool is not installed")
def test_esc_at_any_moment_leaves_a_window_that_does_what_it_is_told(tmp_path):
    outcome = hands.moments(SEED, tmp_path, 5, 3000)
    assert (outcome.kind, outcome.text) == (OPENED, "")
    assert outcome.seconds > 0


def test_a_session_stays_as_it_is(tmp_path):
    assert soak.session(0, tmp_path, 200, 20) == Outcome(OPENED)


def test_geodesics_that_are_given_up_in_a_sentence_are_no_fault(monkeypatch, tmp_path):
    """A refusal, beside distances that open; what is no sentence is a fault."""
    number = 0
    while np.random.default_rng([0, number]).random() < accuracy.AGAINST_REFERENCE:
        number += 1
    for words, kind in (("Given up after 9 windows; use the heat method.", OPENED), ("given up", WRONG)):

        def given_up(self, source, words=words):
            raise SolverError(words)

        monkeypatch.setattr(ExactGeodesic, "distances", given_up)
        assert accuracy.case(0, number, tmp_path).kind == kind
