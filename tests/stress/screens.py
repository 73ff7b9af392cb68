"""Programs of the tests that drive the real window, on a screen of their own."""

import json
import resource
import shutil
import subprocess
import sys

from .blocks import ROOT
from .outcome import WRONG, Outcome

SCREEN = ("xvfb-run", "-a", "-s", "-screen 0 1600x1000x24")


def there_is_a_screen() -> bool:
    """Whether a screen can be had."""
    return shutil.which(SCREEN[0]) is not None and shutil.which("xdotool") is not None


def found_by(module: str, *arguments: object) -> dict | Outcome:
    """What a module of the window's tests prints at its end as JSON, or what is wrong."""
    # A child's limit is too low for libraries of the screen.
    resource.setrlimit(resource.RLIMIT_AS, 2 * resource.getrlimit(resource.RLIMIT_AS)[1:])
    command = [*SCREEN, sys.executable, "-m", f"tests.qt.{module}", *map(str, arguments)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        return Outcome(WRONG, f"the window ended with status {done.returncode}: {done.stderr[-300:]}")
    found: dict = json.loads(done.stdout.splitlines()[-1])
    wrong = [*found["errors"], *found["faults"]]
    return Outcome(WRONG, " ".join(wrong[0].split())[-300:]) if wrong else found
