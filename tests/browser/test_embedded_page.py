"""Pages that compute inside other people's pages: what scrolls, what is whole, who made them, and messages."""

import json
import re

import pytest

from app.citation import bibtex

from .shown_page import VIEW, made

SIZES = {(800, 500): 1280, (600, 380): 1280, (400, 300): 1280, (390, 500): 390}
"""Sizes of frames, each with the width of the window around it."""

HOST = """<!doctype html><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>body {{ margin: 0; height: 4000px }} iframe {{ display: block; border: 0 }}</style>
<iframe src="page.html{query}" width="{width}" height="{height}" allow="{allow}"></iframe>
<script>const told = []; addEventListener("message", ({{ data }}) => told.push(data));</script>"""

WHOLE = """(() => {
  const room = document.querySelector(".bihdist .stage").getBoundingClientRect();
  const parts = [...document.querySelectorAll(".bihdist .panel h2, .bihdist .view, .bihdist .scale")];
  const whole = [...document.querySelectorAll(".bihdist .tools, .bihdist .status, .bihdist .stage"), ...parts];
  return whole.every((part) => {
    const { left, right, top, bottom } = part.getBoundingClientRect(), isPart = parts.includes(part);
    const bounds = isPart ? room : { left: 0, top: 0, right: innerWidth, bottom: innerHeight };
    return part.clientHeight > 20 && left >= bounds.left && top >= bounds.top && right <= bounds.right + 1
      && bottom <= bounds.bottom + 1;
  });
})()"""
SHOWN = f"{VIEW}?.answers.every(Boolean) && !{VIEW}.drawn"
CAMERA = f"{VIEW}.sight.camera.distance"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the page is, with two panels and pins."""
    folder = tmp_path_factory.mktemp("embedded")
    page, path = made("hand", ("biharmonic", "geodesic"), folder)
    page.scene["pins"] = [{"id": 12, "name": "tip"}]
    page.scene["credit"] = "Scan: A. Author"
    page.write(path)
    return folder


@pytest.fixture
def embedded(browser, folder):
    """Open the page in a frame of a larger page."""

    def open_host(width=800, height=500, query="", allow="", window=1280):
        host = folder / "host.html"
        host.write_text(HOST.format(width=width, height=height, query=query, allow=allow), encoding="utf-8")
        browser.size(window, 720)
        browser.open(host)
        with browser.inside_frame():
            browser.until(SHOWN, 100)
        return browser

    return open_host


def inside(browser, expression):
    with browser.inside_frame():
        return browser.evaluate(expression)


@pytest.mark.parametrize("size", SIZES)
def test_panels_and_bars_are_whole_and_the_maker_is_named(embedded, size):
    browser = embedded(*size, window=SIZES[size])
    assert inside(browser, WHOLE)
    assert inside(browser, "document.querySelector('.bihdist .pins').hidden")
    made_by = inside(browser, "document.querySelector('.signature').textContent")
    assert re.fullmatch(r"Scan: A. Author ·bihdist \S+", made_by)
    assert inside(browser, "document.querySelector('meta[name=generator]').content").startswith("bihdist ")
    assert browser.errors == []


def test_the_wheel_scrolls_the_page_around_until_a_click(embedded):
    browser = embedded()
    before = inside(browser, CAMERA)
    browser.wheel(200, 250, 100)
    browser.until("scrollY > 0")
    assert inside(browser, CAMERA) == before
    assert inside(browser, "document.querySelector('.hint').classList.contains('shown')")
    browser.evaluate("scrollTo(0, 0)")
    # Ctrl+wheel zooms at once.
    browser.wheel(200, 250, -100, held=("control",))
    with browser.inside_frame():
        browser.until(f"{CAMERA} !== {before}")
    before = inside(browser, CAMERA)
    browser.click(200, 250)
    browser.wheel(200, 250, -100)
    with browser.inside_frame():
        browser.until(f"{CAMERA} !== {before}")
    assert browser.evaluate("scrollY") == 0
    # Once the mouse has left, the wheel scrolls again.
    before = inside(browser, CAMERA)
    browser.move(1000, 400)
    browser.move(200, 250)
    browser.wheel(200, 250, 100)
    browser.until("scrollY > 0")
    assert inside(browser, CAMERA) == before


def test_one_finger_scrolls_the_page_around_and_two_turn(embedded):
    browser = embedded(390, 500, window=390)
    assert inside(browser, "getComputedStyle(document.querySelector('.view')).touchAction") == "pan-y"
    camera = f"JSON.stringify({VIEW}.sight.camera)"
    before = inside(browser, camera)
    browser.touch([(60 + 5 * k, 200) for k in range(9)], [(120 + 5 * k, 220) for k in range(9)])
    with browser.inside_frame():
        browser.until(f"{camera} !== '{before}'")
    assert browser.evaluate("scrollY") == 0
    if browser.NAME == "Firefox":
        return  # the fingers of its driver scroll nothing
    before = inside(browser, camera)
    browser.touch([(100, 300 - 10 * k) for k in range(20)])
    browser.until("scrollY > 0")
    assert inside(browser, camera) == before
    assert inside(browser, "document.querySelector('.hint').classList.contains('shown')")


def test_a_page_by_itself_keeps_the_wheel(browser, folder):
    browser.open(folder / "page.html")
    browser.until(SHOWN, 100)
    before = browser.evaluate(CAMERA)
    browser.wheel(200, 250, -100)
    browser.until(f"{CAMERA} !== {before}")
    assert browser.evaluate("getComputedStyle(document.querySelector('.view')).touchAction") == "none"


def test_the_address_chooses_controls_and_theme(embedded):
    browser = embedded(query="?controls=0&theme=dark")
    assert not inside(browser, "document.querySelector('.tools').offsetHeight")
    assert inside(browser, f"{VIEW}.stage.theme.isDark")
    browser.dark(True)
    browser = embedded(query="?theme=light")
    assert inside(browser, "document.querySelector('.tools').offsetHeight")
    assert not inside(browser, f"{VIEW}.stage.theme.isDark")
    browser = embedded(query="?theme=%22%3E&controls=no")
    assert inside(browser, f"{VIEW}.stage.theme.isDark")
    assert inside(browser, "document.querySelector('.tools').offsetHeight")


def test_the_page_around_sets_the_source_and_hears_of_picks(embedded):
    source = 33
    browser = embedded(query=f"#source={source}")
    browser.until("told.length === 1")
    assert browser.evaluate("told") == [{"bihdist": {"event": "ready", "source": source}}]
    send = "void document.querySelector('iframe').contentWindow.postMessage(MESSAGE, '*')"
    wrong = [None, 7, "source", {"source": 7}, {"bihdist": 7}, {"bihdist": {"source": "7"}}]
    for message in [*wrong, {"bihdist": {"source": 1e9}}, {"bihdist": {"source": 900}}]:
        browser.evaluate(send.replace("MESSAGE", json.dumps(message)))
    shown = f"{VIEW}.visited.map((vertex) => {VIEW}.mesh.ids[vertex])"
    with browser.inside_frame():
        browser.until(f"{shown}.at(-1) === 900")
        assert browser.evaluate(shown) == [source, 900]
        # Another window than the one around the page is not heard; what it says would arrive first.
        browser.evaluate("void postMessage({ bihdist: { source: 77 } }, '*')")
    browser.evaluate(send.replace("MESSAGE", json.dumps({"bihdist": {"source": 901}})))
    with browser.inside_frame():
        browser.until(f"{shown}.at(-1) === 901")
        assert 77 not in browser.evaluate(shown)
        browser.evaluate(f"{VIEW}.choose({VIEW}.vertices.get(55))")
    browser.until("told.length === 2")
    assert browser.evaluate("told[1]") == {"bihdist": {"event": "pick", "source": 55}}


def test_where_the_clipboard_is_refused_the_link_is_shown(embedded):
    browser = embedded()
    inside(browser, "void (navigator.clipboard.writeText = () => Promise.reject(Error('refused')))")
    with browser.inside_frame():
        browser.evaluate("document.querySelector('button[title=\"Copy link\"]').click()")
        browser.until("document.querySelector('dialog[open] textarea')")
        link = browser.evaluate("document.querySelector('dialog[open] textarea').value")
        assert re.match(r"file:.*/page.html#source=\d+&pins=12:tip&camera=", link)
        assert "address bar" not in browser.evaluate("document.body.textContent")
        browser.evaluate("document.querySelector('dialog[open] .copied button').click()")
        browser.until("getSelection().toString() || document.activeElement.selectionEnd > 0")


def test_about_offers_the_html_to_embed_and_names_the_paper(browser, folder):
    browser.open(folder / "page.html")
    browser.until(SHOWN, 100)
    browser.evaluate("document.querySelector('.signature').click()")
    browser.until("document.querySelector('dialog[open]')")
    text = browser.evaluate("document.querySelector('dialog[open]').textContent")
    assert "Biharmonic Distance" in text
    assert "Scan: A. Author" in text
    link = browser.evaluate("document.querySelector('dialog[open] a').href")
    assert link == "https://doi.org/10.1145/1805964.1805971"
    code = browser.evaluate("document.querySelector('dialog[open] textarea').value")
    assert browser.evaluate("[...document.querySelectorAll('dialog[open] textarea')].at(-1).value") == bibtex()
    assert code.startswith('<iframe src="page.html" title="Distances on hand.ply" loading="lazy" ')
    assert browser.errors == []
