"""The program's first and last moments: Ctrl-C while it is loaded, standard streams that are closed or full."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.shapes import bumpy

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = (sys.executable, "-m", "app")
pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="of shells and /dev/full")

WHILE_LOADED = """
import builtins, os, signal, sys
sys.argv = ["bihdist", "--version"]
from app.program import run
there, seen = builtins.__import__, []
def load(name, *rest, **options):
    found = there(name, *rest, **options)
    if "argparse" in sys.modules and not seen:
        seen.append(name)
        os.kill(os.getpid(), signal.SIGINT)
    return found
builtins.__import__ = load
sys.exit(run())
"""


def ran(*arguments, shell="", **options):
    """What has become of the program; shell: what a shell does with its streams."""
    command = [*PROGRAM, *map(str, arguments)]
    if shell:
        command = ["sh", "-c", f'exec "$@" {shell}', "sh", *command]
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, timeout=120, check=False, **options)


def test_an_interruption_while_it_is_loaded_is_a_word():
    done = subprocess.run(
        [sys.executable, "-c", WHILE_LOADED], capture_output=True, text=True, cwd=ROOT, timeout=60, check=False
    )
    assert (done.returncode, done.stderr, done.stdout) == (130, "bihdist: interrupted.\n", "")


BEGUN = """
import sys
from app.program import run
print("begun", flush=True)
sys.argv[0] = "bihdist"
sys.exit(run())
"""


@pytest.mark.parametrize("after", [0.02, 0.05, 0.15, 0.4])
def test_an_interruption_in_the_first_moments_shows_no_code(after, tmp_path):
    command = [sys.executable, "-c", BEGUN, "pairs", "figure", "--sources", "all", "-o", str(tmp_path / "a.npy")]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT)
    process.stdout.readline()
    time.sleep(after)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=60)[1]
    assert "Traceback" not in said
    assert said.endswith("bihdist: interrupted.\n")
    assert process.returncode == 130


def test_an_interruption_that_is_ignored_stays_so():
    words = WHILE_LOADED.replace("import builtins", "import signal; signal.signal(2, signal.SIG_IGN); import builtins")
    done = subprocess.run(
        [sys.executable, "-c", words], capture_output=True, text=True, cwd=ROOT, timeout=60, check=False
    )
    assert done.returncode == 0


FULL = "bihdist: standard output could not be written: No space left on device.\n"
CLOSED = "bihdist: standard output could not be written: it is closed.\n"


@pytest.mark.parametrize("arguments", [["--version"], ["info", "figure"]])
@pytest.mark.parametrize(("shell", "said"), [(">/dev/full", FULL), (">&-", CLOSED)])
def test_a_standard_output_that_cannot_be_written_is_a_sentence(arguments, shell, said):
    done = ran(*arguments, shell=shell)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.endswith(said)
    assert "Traceback" not in done.stderr


def test_what_is_written_to_a_file_is_there_though_standard_output_is_closed(mesh_file, tmp_path):
    mesh = mesh_file(bumpy(100))
    done = ran("pairs", mesh, "--pairs", "1:2", "-o", tmp_path / "a.csv", shell=">&-")
    assert done.stderr == CLOSED
    assert (tmp_path / "a.csv").read_text().startswith("i,j,distance\n1,2,")
    done = ran("pairs", mesh, "--pairs", "1:2", "-o", "-", shell=">/dev/full")
    assert done.stderr.endswith(FULL)


@pytest.mark.parametrize("shell", ["2>&-", "<&-", "<&- 2>&-"])
def test_other_streams_may_be_closed(shell):
    done = ran("--version", shell=shell)
    assert done.returncode == 0
    assert done.stdout.startswith("bihdist ")
    assert ran("info", "nothing.off", shell=shell).stdout == ""


@pytest.mark.parametrize("arguments", [["--help"], ["info", "figure"], ["--completion", "bash"]])
def test_whoever_has_read_enough_is_told_nothing(arguments):
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(
        [*PROGRAM, *arguments], stdout=write, stderr=subprocess.PIPE, cwd=ROOT, timeout=60, check=False
    )
    os.close(write)
    assert (done.returncode, b"Broken" in done.stderr, b"Traceback" in done.stderr) == (0, False, False)


def test_what_is_typed_is_repeated_in_one_short_line():
    done = ran("pairs", "figure", "--sources", "x\ny" * 2000, "-o", "a.csv")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()[-1]) < 1100
    assert done.stderr.splitlines()[-1].startswith("bihdist pairs: error: ")
