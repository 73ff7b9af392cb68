"""Programs that tests run in processes of their own."""

import os
import subprocess
import sys
from pathlib import Path

from tests.waiting import PATIENCE

ROOT = Path(__file__).resolve().parents[1]


def run(*command, cwd=ROOT, timeout=PATIENCE, **settings):
    """Run a command to its end, with settings of its environment beside this process's; what it has said is text."""
    words, env = [*map(str, command)], {**os.environ, **settings}
    return subprocess.run(words, cwd=cwd, env=env, capture_output=True, text=True, timeout=timeout, check=False)


def run_python(*words, **options):
    """Run Python with these words, as `run` does."""
    return run(sys.executable, *words, **options)


def run_app(*words, **options):
    """Run our command line, as `run` does."""
    return run_python("-m", "app", *words, **options)
