"""Firefox, by WebDriver BiDi; on a screen of its own (Xvfb), because without one it has no WebGL on most machines."""

import base64
import json
import shutil

from .browser import TELL_REFUSED, Browser
from .connection import BrowserError, Connection
from .process import NOWHERE

BUTTONS = {"left": 0, "middle": 1, "right": 2}
KEYS = {
    "shift": "\ue008", "control": "\ue009", "alt": "\ue00a", "Backspace": "\ue003", "Tab": "\ue004", "Enter": "\ue007",
    "Escape": "\ue00c", "PageUp": "\ue00e", "PageDown": "\ue00f", "End": "\ue010", "Home": "\ue011",
    "ArrowLeft": "\ue012", "ArrowUp": "\ue013", "ArrowRight": "\ue014", "ArrowDown": "\ue015", "Delete": "\ue017",
}  # fmt: skip
"""The characters by which WebDriver names keys."""

PREFERENCES = {
    "remote.active-protocols": 1,
    "webgl.force-enabled": True,
    "webgl.disable-fail-if-major-performance-caveat": True,
    "app.update.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "browser.aboutwelcome.enabled": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "datareporting.policy.dataSubmissionPolicyBypassNotification": True,
    "toolkit.telemetry.reportingpolicy.firstRun": False,
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
    "dom.ipc.processPrelaunch.enabled": False,  # such a process would be counted as one of the page's
    "dom.w3c_touch_events.enabled": 1,
    "dom.disable_open_during_load": False,
}
DEAD_PROXY = {
    "network.proxy.type": 1,
    "network.proxy.http": NOWHERE.partition(":")[0],
    "network.proxy.http_port": int(NOWHERE.partition(":")[2]),
    "network.proxy.ssl": NOWHERE.partition(":")[0],
    "network.proxy.ssl_port": int(NOWHERE.partition(":")[2]),
    "network.proxy.allow_hijacking_localhost": True,
}


class Firefox(Browser):
    """Debian's Firefox ESR, or Firefox; drawn in software."""

    NAME = "Firefox"

    @staticmethod
    def program() -> str | None:
        """Where it is installed, and there is a screen for it."""
        if shutil.which("Xvfb") is None:
            return None
        return next(filter(None, map(shutil.which, ("firefox-esr", "firefox"))), None)

    def _started(self) -> Connection:
        profile = self._process.folder / "profile"
        profile.mkdir()
        preferences = {**PREFERENCES, **(DEAD_PROXY if self.network == "proxy" else {})}
        lines = [f"user_pref({json.dumps(name)}, {json.dumps(value)});" for name, value in preferences.items()]
        (profile / "user.js").write_text("\n".join(lines))
        command = [self.program(), "--no-remote", "--profile", str(profile), "--remote-debugging-port=0"]
        self._process.start([*command, "--remote-allow-system-access", "about:blank"], self._process.screen())
        port = json.loads(self._process.wait_for(profile / "WebDriverBiDiServer.json"))["ws_port"]
        connection = Connection(f"ws://127.0.0.1:{port}/session", self._process.connect(port))
        self._connection, self._at = connection, (0.0, 0.0)
        self._call("session.new", capabilities={})
        self._context = self._call("browsingContext.getTree")["contexts"][0]["context"]
        self._call("session.subscribe", events=["log.entryAdded", "network.beforeRequestSent"])
        self._call("script.addPreloadScript", functionDeclaration=f"() => {{ {TELL_REFUSED} }}")
        return connection

    def _call(self, method: str, **parameters: object) -> dict:
        return self._connection.call(method, parameters)

    def _end(self) -> None:
        self._call("browser.close")

    def _go(self, url: str) -> None:
        self._call("browsingContext.navigate", context=self._context, url=url, wait="complete")

    _frame = ""

    def _enter_frame(self) -> None:
        tree = self._call("browsingContext.getTree", root=self._context)
        self._frame = tree["contexts"][0]["children"][0]["context"]

    def _leave_frame(self) -> None:
        self._frame = ""

    def _evaluated(self, expression: str) -> str | None:
        target = {"context": self._frame or self._context}
        answer = self._call("script.evaluate", expression=expression, target=target, awaitPromise=True)
        if answer["type"] == "exception":
            raise BrowserError(answer["exceptionDetails"]["text"])
        return answer["result"].get("value")

    def size(self, width: int, height: int, ratio: float = 1) -> None:
        size = {"width": width, "height": height}
        self._call("browsingContext.setViewport", context=self._context, viewport=size, devicePixelRatio=ratio)

    def dark(self, is_dark: bool) -> None:
        number = 0 if is_dark else 1
        self._in_chrome(f"Services.prefs.setIntPref('layout.css.prefers-color-scheme.content-override', {number})")
        # The page's process hears of it a little later.
        self.until(f"matchMedia('(prefers-color-scheme: dark)').matches == {str(is_dark).lower()}")

    def _in_chrome(self, expression: str) -> None:
        """Evaluate an expression where the browser's own scripts are."""
        chrome = self._call("browsingContext.getTree", **{"moz:scope": "chrome"})["contexts"][0]["context"]
        self._call("script.evaluate", expression=expression, target={"context": chrome}, awaitPromise=False)

    def collect_garbage(self) -> None:
        # All processes hear of it, and are not asked whether they are done.
        self._in_chrome("Services.obs.notifyObservers(null, 'memory-pressure', 'heap-minimize')")
        self.evaluate("new Promise((done) => setTimeout(done, 1000))")

    def screenshot(self) -> bytes:
        return base64.b64decode(self._call("browsingContext.captureScreenshot", context=self._context)["data"])

    def _act(self, *sources: dict) -> None:
        self._call("input.performActions", context=self._context, actions=list(sources))

    def _with_keys(self, held: tuple[str, ...], down: bool) -> None:
        if held:
            kind = "keyDown" if down else "keyUp"
            self._act({"type": "key", "id": "keys", "actions": [{"type": kind, "value": KEYS[each]} for each in held]})

    def _mouse(self, *actions: dict) -> None:
        self._act({"type": "pointer", "id": "mouse", "actions": list(actions)})

    def move(self, x: float, y: float) -> None:
        self._at = (x, y)
        self._mouse({"type": "pointerMove", "x": round(x), "y": round(y)})

    def press(self, button: str = "left", held: tuple[str, ...] = ()) -> None:
        self._with_keys(held, True)
        self._mouse({"type": "pointerDown", "button": BUTTONS[button]})

    def release(self, button: str = "left", held: tuple[str, ...] = ()) -> None:
        self._mouse({"type": "pointerUp", "button": BUTTONS[button]})
        self._with_keys(held, False)

    def wheel(self, x: float, y: float, amount: float, held: tuple[str, ...] = ()) -> None:
        self._with_keys(held, True)
        turn = {"type": "scroll", "x": round(x), "y": round(y), "deltaX": 0, "deltaY": round(amount)}
        self._act({"type": "wheel", "id": "wheel", "actions": [turn]})
        self._with_keys(held, False)

    def key(self, key: str, held: tuple[str, ...] = ()) -> None:
        self._with_keys(held, True)
        value = KEYS.get(key, key)
        actions = [{"type": "keyDown", "value": value}, {"type": "keyUp", "value": value}]
        self._act({"type": "key", "id": "keys", "actions": actions})
        self._with_keys(held, False)

    def touch(self, *fingers: list[tuple[float, float]]) -> None:
        def moved(x: float, y: float) -> dict:
            return {"type": "pointerMove", "x": round(x), "y": round(y), "duration": 0}

        sources = [
            {
                "type": "pointer",
                "id": f"finger {k}",
                "parameters": {"pointerType": "touch"},
                "actions": [moved(*path[0]), {"type": "pointerDown", "button": 0}, *(moved(*at) for at in path[1:]),
                            {"type": "pointerUp", "button": 0}],
            }
            for k, path in enumerate(fingers)
        ]  # fmt: skip
        self._act(*sources)

    def _take(self, method: str, told: dict) -> None:
        if method == "log.entryAdded" and told["level"] == "error":
            self._errors.append(told["text"])
        elif method == "network.beforeRequestSent":
            self._requests.append(told["request"]["url"])

    def _is_of_page(self, command: str) -> bool:
        return "-contentproc" in command and command.rstrip().endswith("tab")
