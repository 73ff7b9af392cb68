"""What tests of pages rely on: gestures arrive as a user's would, errors and requests are told, the network is off."""

import io
import socket
import threading
from contextlib import suppress

import numpy as np
import pytest
from PIL import Image

from . import process
from .connection import BrowserError
from .process import has_namespaces

PAGE = """<!doctype html><meta charset="utf-8"><title>Events</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src
'unsafe-inline'; connect-src *">
<style>html, body {margin: 0; height: 100%; background: rgb(200, 10, 20)}
@media (prefers-color-scheme: dark) {body {background: rgb(10, 20, 200)}}
#pad {position: fixed; inset: 0; touch-action: none}</style>
<div id="pad"></div>
<script>
const told = []
for (const kind of ["pointerdown", "pointermove", "pointerup", "wheel", "keydown"])
  addEventListener(kind, e => told.push({kind, x: e.clientX, y: e.clientY, button: e.button, pointer: e.pointerType,
    id: e.pointerId, shift: e.shiftKey, control: e.ctrlKey, key: e.key, turn: e.deltaY}))
</script>"""


@pytest.fixture
def page(browser, tmp_path):
    """The browser at a page that writes down what happens to it."""
    path = tmp_path / "a page, with blanks.html"
    path.write_text(PAGE)
    browser.open(path)
    return browser


def _told(page, kind):
    return [event for event in page.evaluate("told") if event["kind"] == kind]


def test_scripts_give_values_wait_for_promises_and_tell_what_they_throw(page):
    assert page.evaluate("[1.5, 'ä', null, {a: [true]}]") == [1.5, "ä", None, {"a": [True]}]
    assert page.evaluate("new Promise(done => setTimeout(() => done(7), 50))") == 7
    assert page.evaluate("undefined") is None
    with pytest.raises(BrowserError, match="no such luck"):
        page.evaluate("(() => { throw Error('no such luck') })()")
    with pytest.raises(BrowserError, match=r"not done after 0\.2 s"):
        page.evaluate("new Promise(() => {})", seconds=0.2)


def test_the_mouse_clicks_drags_and_turns_its_wheel(page):
    page.click(100, 50, held=("shift",))
    (press,) = _told(page, "pointerdown")
    assert (press["x"], press["y"], press["button"], press["shift"]) == (100, 50, 0, True)
    page.drag((200, 100), (300, 140), steps=4, button="right")
    _, press = _told(page, "pointerdown")
    assert press["button"] == 2
    assert not press["shift"]
    way = [(e["x"], e["y"]) for e in _told(page, "pointermove")]
    assert way[-4:] == [(225, 110), (250, 120), (275, 130), (300, 140)]
    assert [e["button"] for e in _told(page, "pointerup")] == [0, 2]
    page.wheel(400, 300, 120)
    page.until("told.some(e => e.kind == 'wheel')")
    (turn,) = _told(page, "wheel")
    assert (turn["x"], turn["y"]) == (400, 300)
    assert turn["turn"] > 0


def test_keys_have_their_names_and_what_is_held_with_them(page):
    for key, held in (("ArrowLeft", ()), ("a", ()), ("Escape", ()), ("z", ("control",)), (" ", ())):
        page.key(key, held)
    told = [(e["key"], e["control"]) for e in _told(page, "keydown") if e["key"] != "Control"]
    assert told == [("ArrowLeft", False), ("a", False), ("Escape", False), ("z", True), (" ", False)]


def test_two_fingers_touch(page):
    page.touch([(100, 100), (120, 100), (140, 100)], [(300, 300), (280, 300), (260, 300)])
    page.until("told.filter(e => e.kind == 'pointerup').length == 2")
    down = _told(page, "pointerdown")
    assert {e["pointer"] for e in down} == {"touch"}
    assert len({e["id"] for e in down}) == 2
    assert {(e["x"], e["y"]) for e in down} == {(100, 100), (300, 300)}
    assert {(e["x"], e["y"]) for e in _told(page, "pointermove")} >= {(140, 100), (260, 300)}


def test_the_window_has_any_size_and_the_system_any_theme(page):
    page.size(360, 640, ratio=2)
    assert page.evaluate("[innerWidth, innerHeight, devicePixelRatio]") == [360, 640, 2]
    page.dark(True)
    picture = np.array(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
    assert picture.shape == (1280, 720, 3)
    assert np.abs(picture[600, 300].astype(int) - (10, 20, 200)).max() <= 2
    page.dark(False)
    page.size(3840, 1000)
    picture = np.array(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
    assert picture.shape == (1000, 3840, 3)
    assert np.abs(picture[900, 3700].astype(int) - (200, 10, 20)).max() <= 2


def test_a_page_has_webgl_webassembly_and_workers(page):
    """What pages that compute need; software does for WebGL."""
    assert page.evaluate("!!document.createElement('canvas').getContext('webgl2')")
    assert page.evaluate("typeof WebAssembly.instantiate == 'function' && typeof Worker == 'function'")


def test_errors_of_a_page_are_told(page):
    assert page.errors == []
    page.evaluate("void console.error('first', 1)")
    page.evaluate("void setTimeout(() => { throw Error('second') })")
    page.evaluate("void Promise.reject(Error('third'))")
    page.evaluate("new Promise(done => setTimeout(done, 100))")
    words = " | ".join(page.errors)
    assert all(word in words for word in ("first", "second", "third"))
    page.forget()
    assert page.errors == []


def test_what_the_policy_of_a_page_refuses_is_an_error(page):
    page.evaluate("void (new Image().src = 'https://example.org/picture.png')")
    page.evaluate("new Promise(done => setTimeout(done, 200))")
    assert any("refused https://example.org" in words for words in page.errors)


def _check_no_network(page):
    """Not even a server on this machine."""
    reached = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(3)

        def listen():
            with suppress(TimeoutError):
                reached.append(server.accept()[1])

        listener = threading.Thread(target=listen)
        listener.start()
        here = f"http://127.0.0.1:{server.getsockname()[1]}/"
        for url in (here, "https://example.org/"):
            assert page.evaluate(f"fetch('{url}').then(() => 'reached', () => 'not reached')") == "not reached"
            assert url in page.requests
        listener.join()
    assert not reached


def test_no_page_reaches_a_network(page):
    assert page.network == ("namespace" if has_namespaces() else "proxy")
    _check_no_network(page)


def test_without_namespaces_a_dead_proxy_lets_nothing_out(running_browser, monkeypatch, tmp_path):
    monkeypatch.setattr(process, "has_namespaces", lambda: False)
    path = tmp_path / "page.html"
    path.write_text(PAGE)
    browser = type(running_browser)()
    try:
        assert browser.network == "proxy"
        browser.open(path)
        _check_no_network(browser)
    finally:
        browser.close()


def test_memory_is_that_of_the_page(page):
    before = page.memory()
    page.evaluate("void (window.held = new Uint8Array(2e8).fill(1))")
    assert page.memory() - before == pytest.approx(2e8, rel=0.3)
    page.evaluate("void (window.held = null)")
    page.collect_garbage()
    assert page.memory() - before < 1e8
