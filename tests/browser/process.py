"""A browser's process, with nothing but itself on its network."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from pathlib import Path

ALONE = ["unshare", "--user", "--map-root-user", "--net"]
NOWHERE = "127.0.0.1:9"
"""A port where nobody answers; a proxy there, where namespaces are not allowed, lets nothing out."""


@cache
def has_namespaces() -> bool:
    """Whether this machine lets its users make network namespaces."""
    if shutil.which("unshare") is None:
        return False
    return subprocess.run([*ALONE, "true"], capture_output=True).returncode == 0


class Process:
    """A browser that runs in a folder of its own, which goes with it.

    network: "namespace" if its network is a namespace with the loopback device alone, otherwise "proxy": it has been
    told to ask a proxy that is not there.
    """

    def __init__(self):
        self.folder = Path(tempfile.mkdtemp(prefix="browser-"))
        self.network = "namespace" if has_namespaces() else "proxy"
        self._process: subprocess.Popen | None = None
        self._screen: subprocess.Popen | None = None

    def screen(self) -> dict[str, str]:
        """The environment of what is to be seen on a screen that nobody sees, which goes with the browser."""
        read, write = os.pipe()
        command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1000x24", "-nolisten", "tcp"]
        self._screen = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as told:
            return {"DISPLAY": f":{told.readline().strip()}", "MOZ_ENABLE_WAYLAND": "0", "NO_AT_BRIDGE": "1"}

    def start(self, command: list[str], environment: Mapping[str, str] | None = None) -> None:
        """Run the browser; environment: what it has besides that of the tests."""
        if self.network == "namespace":
            command = [*ALONE, sys.executable, str(Path(__file__).with_name("alone.py")), self._door, *command]
        home = {"HOME": str(self.folder), "XDG_CACHE_HOME": str(self.folder / "cache")}
        with open(self.folder / "output.txt", "wb") as output:
            self._process = subprocess.Popen(
                command,
                stdout=output,
                stderr=output,
                env={**os.environ, **home, **(environment or {})},
                cwd=self.folder,
                start_new_session=True,
            )

    @property
    def _door(self) -> str:
        return str(self.folder / "door")

    def wait_for(self, path: Path, seconds: float = 60) -> str:
        """What stands in a file that the browser writes once it listens."""
        end = time.monotonic() + seconds
        while not (path.exists() and path.read_text().strip()):
            if self._process.poll() is not None or time.monotonic() > end:
                said = (self.folder / "output.txt").read_text(errors="replace")[-2000:]
                raise RuntimeError(f"The browser has not started: {said}")
            time.sleep(0.02)
        return path.read_text()

    def connect(self, port: int) -> socket.socket:
        """A connection to one of the browser's ports."""
        if self.network == "proxy":
            return socket.create_connection(("127.0.0.1", port))
        through = socket.socket(socket.AF_UNIX)
        through.connect(self._door)
        through.sendall(b"%d\n" % port)
        return through

    def commands(self) -> dict[int, str]:
        """The command lines of the browser's processes, by their ids."""
        parents, lines = {}, {}
        for entry in Path("/proc").glob("[0-9]*"):
            try:
                parents[int(entry.name)] = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
                lines[int(entry.name)] = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            except OSError:
                continue  # it has ended
        found, new = set(), {self._process.pid}
        while new:
            found |= new
            new = {child for child, parent in parents.items() if parent in new}
        return {each: lines[each] for each in found if each in lines}

    def close(self) -> None:
        """Wait for the browser, which has been asked to end, and end what is left of it."""
        if self._process is not None:
            left = self.commands()
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(10)
            for each in left:
                with suppress(ProcessLookupError):
                    os.kill(each, signal.SIGKILL)
            self._process.wait()
        if self._screen is not None:
            self._screen.terminate()
            self._screen.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


def private_bytes(process: int) -> int:
    """The memory that is a process's own: of the heap, of scripts, of WebAssembly."""
    for line in Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith("RssAnon:"):
            return 1024 * int(line.split()[1])
    return 0
