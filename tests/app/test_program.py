"""The program's first and last moments: Ctrl-C while it is loaded, standard streams that are closed or full."""

import os
import signal
import subprocess
import sys
import time

import pytest

from app.program import run
from tests.programs import ROOT, run as run_program, run_python
from tests.shapes import bumpy
from tests.waiting import PATIENCE

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


def ran(*arguments, shell=""):
    """What has become of the program; shell: what a shell does with its streams."""
    return run_program("sh", "-c", f'exec "$@" {shell}', "sh", *PROGRAM, *arguments)


def test_an_interruption_while_it_is_loaded_is_a_word():
    done = run_python("-c", WHILE_LOADED)
    assert (done.returncode, done.stderr, done.stdout) == (130, "bihdist: interrupted.\n", "")


WHEN_IMPORTED = """
import os, signal, sys
class Sends:
    def find_spec(self, name, *rest):
        if name == {module!r}:
            os.kill(os.getpid(), signal.{signal})
sys.meta_path.insert(0, Sends())
sys.argv = ["bihdist", *{words!r}]
"""


def when_imported(module, number, words, start):
    """What becomes of the program that gets a signal when it begins to import a module."""
    code = WHEN_IMPORTED.format(module=module, signal=number, words=words)
    return run_python("-c", f"{code}\n{start}")


@pytest.mark.parametrize("module", ["bihdist_core", "app.main"])
@pytest.mark.parametrize("start", [
    "import runpy; runpy.run_module('app', run_name='__main__', alter_sys=True)",
    "from app.program import run; sys.exit(run())",
])  # fmt: skip
def test_an_interruption_at_the_first_import_is_a_word(module, start):
    done = when_imported(module, "SIGINT", ["--version"], start)
    assert (done.returncode, done.stderr) == (130, "bihdist: interrupted.\n")


def test_before_the_program_listens_it_imports_nothing_else_of_ours():
    code = "import sys; before = {*sys.modules}; import app.program; print(*sorted({*sys.modules} - before))"
    done = run_python("-S", "-c", code)
    there = {*done.stdout.split()}
    assert {"app", "app.program"} <= there
    assert not [
        name for name in there - {"app", "app.program"} if name.partition(".")[0] not in sys.stdlib_module_names
    ]
    assert not there & {"typing", "argparse", "pathlib", "ast", "re", "subprocess"}


def test_an_interruption_once_the_command_line_is_over_is_a_word(monkeypatch, capfd):
    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr("app.main.main", interrupted)
    assert run() == 130
    assert capfd.readouterr().err == "bihdist: interrupted.\n"


def test_sigterm_ends_a_window_while_it_is_loaded_though_somebody_catches_all():
    caught = """
class Catches(Sends):
    def find_spec(self, *names):
        try:
            super().find_spec(*names)
        except BaseException:
            print("caught", flush=True)
sys.meta_path[0] = Catches()
from app.program import run
sys.exit(run())
"""
    done = when_imported("app.qt.screen", "SIGTERM", ["view", "figure"], caught)
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGTERM, "", "")


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
    said = process.communicate(timeout=PATIENCE)[1]
    assert "Traceback" not in said
    assert said.endswith("bihdist: interrupted.\n")
    assert process.returncode == 130


def test_an_interruption_that_is_ignored_stays_so():
    words = WHILE_LOADED.replace("import builtins", "import signal; signal.signal(2, signal.SIG_IGN); import builtins")
    done = run_python("-c", words)
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
        [*PROGRAM, *arguments], stdout=write, stderr=subprocess.PIPE, cwd=ROOT, timeout=PATIENCE, check=False
    )
    os.close(write)
    assert (done.returncode, b"Broken" in done.stderr, b"Traceback" in done.stderr) == (0, False, False)


def test_what_is_typed_is_repeated_in_one_short_line():
    done = ran("pairs", "figure", "--sources", "x\ny" * 2000, "-o", "a.csv")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()[-1]) < 1100
    assert done.stderr.startswith("bihdist: ")
