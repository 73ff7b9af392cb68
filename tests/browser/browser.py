"""A headless browser, as tests use it: what Chromium and Firefox have in common."""

import json
from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .connection import Connection
from .process import Process, private_bytes

TELL_REFUSED = """addEventListener("securitypolicyviolation", e => console.error(
    `The page's policy refused ${e.blockedURI} (${e.violatedDirective}).`))"""
"""A script put before those of each page; Firefox tells nobody else what a page's policy has refused."""

LOCAL = ("file:", "blob:", "data:", "about:")
"""The beginnings of addresses for which no network is asked."""


class Browser(ABC):
    """One page in a browser of its own, whose network is off.

    All positions are in pixels of the page from its upper left corner.  `held` names keys that are down meanwhile:
    "shift", "control", "alt".

    errors: what the page has written as errors, left uncaught, or its policy has refused, as sentences.
    requests: the addresses for which it has asked a network.
    """

    NAME: str
    """As people call it."""

    def __init__(self) -> None:
        self._process = Process()
        self._errors: list[str] = []
        self._requests: list[str] = []
        try:
            self._connection = self._started()
        except BaseException:
            self._process.close()
            raise

    @property
    def network(self) -> str:
        """How the network is off: "namespace", or "proxy" where this machine allows no namespaces."""
        return self._process.network

    @abstractmethod
    def _started(self) -> Connection:
        """A connection to the browser, once it runs and listens."""

    @abstractmethod
    def _end(self) -> None:
        """Ask the browser to end."""

    def close(self) -> None:
        """End the browser."""
        try:
            self._end()
            self._connection.close()
        finally:
            self._process.close()

    # Pages

    def open(self, page: str | Path) -> None:
        """Open a file, or an address, and wait until it is loaded."""
        self._go(page.absolute().as_uri() if isinstance(page, Path) else page)

    @abstractmethod
    def _go(self, url: str) -> None: ...

    def evaluate(self, expression: str, seconds: float = 60) -> Any:
        """The value of a JavaScript expression, as JSON can tell it; a promise is waited for, up to so many seconds.

        BrowserError with what it throws.
        """
        value = f"(async () => JSON.stringify(await ({expression})))()"
        late = (
            f"new Promise((_, fail) => setTimeout(() => fail(Error('not done after {seconds:g} s')), {1e3 * seconds}))"
        )
        text = self._evaluated(f"Promise.race([{value}, {late}])")
        return None if text is None else json.loads(text)

    def until(self, condition: str, seconds: float = 60) -> None:
        """Wait until a JavaScript expression is true."""
        again = f"new Promise(r => {{ const look = () => ({condition}) ? r() : setTimeout(look, 10); look() }})"
        self.evaluate(again, seconds)

    @contextmanager
    def inside_frame(self) -> Iterator[None]:
        """Evaluate expressions in the first frame of the page meanwhile."""
        self._enter_frame()
        try:
            yield
        finally:
            self._leave_frame()

    @abstractmethod
    def _enter_frame(self) -> None: ...

    @abstractmethod
    def _leave_frame(self) -> None: ...

    @abstractmethod
    def _evaluated(self, expression: str) -> str | None:
        """The text to which a promise resolves; None for undefined."""

    @abstractmethod
    def size(self, width: int, height: int, ratio: float = 1) -> None:
        """Set the size of the page's window in its pixels; ratio: pixels of the screen in one of them."""

    @abstractmethod
    def dark(self, is_dark: bool) -> None:
        """Have the system prefer dark pages, or light ones."""

    @abstractmethod
    def screenshot(self) -> bytes:
        """The page as it is seen, as PNG."""

    # The mouse, fingers and keys

    @abstractmethod
    def move(self, x: float, y: float) -> None: ...

    @abstractmethod
    def press(self, button: str = "left", held: tuple[str, ...] = ()) -> None:
        """Press a button of the mouse where the pointer is."""

    @abstractmethod
    def release(self, button: str = "left", held: tuple[str, ...] = ()) -> None: ...

    def click(self, x: float, y: float, button: str = "left", held: tuple[str, ...] = ()) -> None:
        """Move the pointer there, press and release."""
        self.move(x, y)
        self.press(button, held)
        self.release(button, held)

    def drag(self, start: tuple[float, float], end: tuple[float, float], steps: int = 8, **how: Any) -> None:
        """Press at the start, move to the end in steps, and release; how: as for `press`."""
        self.move(*start)
        self.press(**how)
        for k in range(1, steps + 1):
            self.move(*(a + (b - a) * k / steps for a, b in zip(start, end, strict=True)))
        self.release(**how)

    @abstractmethod
    def wheel(self, x: float, y: float, amount: float, held: tuple[str, ...] = ()) -> None:
        """Turn the wheel over a place: downwards where amount is positive."""

    @abstractmethod
    def key(self, key: str, held: tuple[str, ...] = ()) -> None:
        """Press a key and release it, by its name in the DOM: "a", "ArrowLeft", "Enter"."""

    @abstractmethod
    def touch(self, *fingers: list[tuple[float, float]]) -> None:
        """Fingers that go down, along their paths, all of as many points, and up."""

    # What is told of the page

    def forget(self) -> None:
        """Forget the errors and requests so far."""
        self._read_events()
        self._errors.clear()
        self._requests.clear()

    @property
    def errors(self) -> list[str]:
        self._read_events()
        return self._errors

    @property
    def requests(self) -> list[str]:
        self._read_events()
        return [url for url in self._requests if not url.startswith(LOCAL)]

    def _read_events(self) -> None:
        self.evaluate("0")  # what has happened until now has been told when this is answered
        for event in self._connection.events:
            self._take(event["method"], event["params"])
        self._connection.events.clear()

    @abstractmethod
    def _take(self, method: str, told: dict) -> None:
        """Keep what an event says of errors and requests."""

    @abstractmethod
    def collect_garbage(self) -> None:
        """Have the page's scripts give back the memory that they no longer use."""

    def memory(self) -> int:
        """The bytes in memory that the page's processes have for themselves."""
        return sum(private_bytes(each) for each, line in self._process.commands().items() if self._is_of_page(line))

    @abstractmethod
    def _is_of_page(self, command: str) -> bool:
        """Whether a process with that command line runs pages."""
