"""Chromium, by the protocol of its developer tools."""

import base64
import shutil
import time

from .browser import TELL_REFUSED, Browser
from .connection import BrowserError, Connection
from .process import NOWHERE

HELD_BITS = {"alt": 1, "control": 2, "shift": 8}
KEY_CODES = {
    "Backspace": 8, "Tab": 9, "Enter": 13, "Escape": 27, " ": 32, "PageUp": 33, "PageDown": 34, "End": 35, "Home": 36,
    "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Delete": 46,
}  # fmt: skip
KEY_TEXTS = {"Enter": "\r", "Tab": ""}


class Chromium(Browser):
    """Debian's Chromium, or Chrome; drawn in software."""

    NAME = "Chromium"

    @staticmethod
    def program() -> str | None:
        """Where it is installed."""
        return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

    def _started(self) -> Connection:
        profile = self._process.folder / "profile"
        command = [
            self.program(), "--headless=new", f"--user-data-dir={profile}", "--remote-debugging-port=0",
            "--no-sandbox", "--no-first-run", "--disable-dev-shm-usage", "--disable-background-networking",
            "--disable-component-update", "--disable-extensions", "--mute-audio", "--hide-scrollbars",
            "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--force-color-profile=srgb",
            # A page behind others, as each is where there is no screen, would be slowed down.
            "--disable-backgrounding-occluded-windows", "--disable-renderer-backgrounding",
        ]  # fmt: skip
        if self.network == "proxy":
            command += [f"--proxy-server={NOWHERE}", "--proxy-bypass-list=<-loopback>"]
        self._process.start([*command, "about:blank"])
        port, path = self._process.wait_for(profile / "DevToolsActivePort").split()[:2]
        connection = Connection(f"ws://127.0.0.1:{port}{path}", self._process.connect(int(port)))
        self._connection, self._session, self._at = connection, "", (0.0, 0.0)
        while not (pages := [t for t in self._call("Target.getTargets")["targetInfos"] if t["type"] == "page"]):
            time.sleep(0.02)
        session = self._call("Target.attachToTarget", targetId=pages[0]["targetId"], flatten=True)
        self._session = session["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self._call(f"{domain}.enable")
        self._call("Page.addScriptToEvaluateOnNewDocument", source=TELL_REFUSED)
        return connection

    def _call(self, method: str, **parameters: object) -> dict:
        beside = {"sessionId": self._session} if self._session else {}
        return self._connection.call(method, parameters, **beside)

    def _end(self) -> None:
        self._session = ""
        self._call("Browser.close")

    def _go(self, url: str) -> None:
        if error := self._call("Page.navigate", url=url).get("errorText"):
            raise BrowserError(f"{url}: {error}")
        self._evaluated("document.readyState == 'complete' || new Promise(done => addEventListener('load', done))")

    _frame: int | None = None

    def _enter_frame(self) -> None:
        (frame, *_) = self._call("Page.getFrameTree")["frameTree"]["childFrames"]
        # Contexts that exist already are told of again.
        self._call("Runtime.disable")
        self._call("Runtime.enable")
        made = [e["params"]["context"] for e in self._connection.events if e["method"].endswith("ContextCreated")]
        self._frame = next(each["id"] for each in made[::-1] if each["auxData"]["frameId"] == frame["frame"]["id"])

    def _leave_frame(self) -> None:
        self._frame = None

    def _evaluated(self, expression: str) -> str | None:
        where = {} if self._frame is None else {"contextId": self._frame}
        answer = self._call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True, **where)
        if "exceptionDetails" in answer:
            raise BrowserError(_words_of(answer["exceptionDetails"]))
        return answer["result"].get("value")

    def size(self, width: int, height: int, ratio: float = 1) -> None:
        self._call(
            "Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=ratio, mobile=False
        )

    def dark(self, is_dark: bool) -> None:
        scheme = {"name": "prefers-color-scheme", "value": "dark" if is_dark else "light"}
        self._call("Emulation.setEmulatedMedia", features=[scheme])

    def screenshot(self) -> bytes:
        return base64.b64decode(self._call("Page.captureScreenshot", format="png")["data"])

    def collect_garbage(self) -> None:
        self._call("HeapProfiler.collectGarbage")

    def _mouse(self, kind: str, held: tuple[str, ...] = (), **more: object) -> None:
        x, y = self._at
        bits = sum(HELD_BITS[each] for each in held)
        self._call("Input.dispatchMouseEvent", type=kind, x=x, y=y, modifiers=bits, **more)

    _down, _held = "", ()

    def move(self, x: float, y: float) -> None:
        self._at = (x, y)
        buttons = {"": 0, "left": 1, "right": 2, "middle": 4}[self._down]
        self._mouse("mouseMoved", self._held, button=self._down or "none", buttons=buttons)

    def press(self, button: str = "left", held: tuple[str, ...] = ()) -> None:
        self._down, self._held = button, held
        self._mouse("mousePressed", held, button=button, clickCount=1)

    def release(self, button: str = "left", held: tuple[str, ...] = ()) -> None:
        self._down, self._held = "", ()
        self._mouse("mouseReleased", held, button=button, clickCount=1)

    def wheel(self, x: float, y: float, amount: float, held: tuple[str, ...] = ()) -> None:
        self._at = (x, y)
        self._mouse("mouseWheel", held, deltaX=0, deltaY=amount)

    def key(self, key: str, held: tuple[str, ...] = ()) -> None:
        text = KEY_TEXTS.get(key, key if len(key) == 1 else "") if set(held) <= {"shift"} else ""
        code = KEY_CODES.get(key) or (ord(key.upper()) if len(key) == 1 and key.isalnum() else 0)
        what = {"key": key, "windowsVirtualKeyCode": code, "modifiers": sum(HELD_BITS[each] for each in held)}
        self._call("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", text=text, **what)
        self._call("Input.dispatchKeyEvent", type="keyUp", **what)

    def touch(self, *fingers: list[tuple[float, float]]) -> None:
        self._call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        for k, points in enumerate(zip(*fingers, strict=True)):
            touched = [{"x": x, "y": y, "id": finger} for finger, (x, y) in enumerate(points)]
            self._call("Input.dispatchTouchEvent", type="touchMove" if k else "touchStart", touchPoints=touched)
        self._call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def _take(self, method: str, told: dict) -> None:
        if method == "Runtime.exceptionThrown":
            self._errors.append(_words_of(told["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "assert"):
            self._errors.append(" ".join(str(a.get("value", a.get("description", ""))) for a in told["args"]))
        elif method == "Log.entryAdded" and told["entry"]["level"] == "error":
            self._errors.append(f"{told['entry']['text']} {told['entry'].get('url', '')}".strip())
        elif method == "Network.requestWillBeSent":
            self._requests.append(told["request"]["url"])

    def _is_of_page(self, command: str) -> bool:
        return "--type=renderer" in command


def _words_of(details: dict) -> str:
    return details.get("exception", {}).get("description") or details["text"]
