"""The guide's search, in Chromium, from files: questions in whole sentences, the page that answers them first."""

import shutil
from pathlib import Path

import pytest

from app.guide_pages import GUIDE
from assets.guide.building.search_index import write_search_index
from tests.browser.chromium import Chromium

SEARCH = Path(__file__).parents[2] / "assets/guide/look/search.js"
PAGES = {
    "how-to/regions.html": ("Divide a surface into regions", "Each vertex belongs to the nearest of several points."),
    "how-to/pick.html": ("Call a function at each click", "A callback is handed the vertex that was picked."),
    "reference/options.html": ("Options", "regions points vertex surface click function <div>x</div> movie"),
    "explanation/heat.html": ("The heat method", "Distances are measured; how far off they are is estimated."),
}
FIELD = '<div class="bd-search-container"><input type="search" name="q"></div>'
SHOWN = "[...document.querySelectorAll('#guide-search-results a')].map(a => a.getAttribute('href'))"


@pytest.fixture(scope="module")
def browser():
    if Chromium.program() is None:
        pytest.skip("there is no Chromium")
    browser = Chromium()
    yield browser
    browser.close()


@pytest.fixture(scope="module")
def search(tmp_path_factory):
    """A page with a search over few pages."""
    folder = tmp_path_factory.mktemp("guide")
    for name, (title, text) in PAGES.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(
            f"<article><section id='top'><h1>{title}</h1><section id='more'><h2>More</h2><p>{text}</p></section>"
            "</section></article>"
        )
    write_search_index(folder)
    shutil.copy(SEARCH, folder)
    (folder / "search.html").write_text(
        f"<meta charset='utf-8'>{FIELD}<p id='guide-search-count'></p><ol id='guide-search-results'></ol>"
        "<script src='search-index.js'></script><script src='search.js'></script>"
    )
    return folder / "search.html"


def found(browser, page, question):
    browser.open(f"{page.as_uri()}?q={question.replace(' ', '+')}")
    return browser.evaluate(SHOWN)


@pytest.mark.parametrize(
    ("question", "first"),
    [
        ("how do I divide my surface into regions?", "how-to/regions.html"),
        ("a function that is called when somebody clicks", "how-to/pick.html"),
        ("how far off is the heat method", "explanation/heat.html"),
        ("movies", "reference/options.html"),
        ("measuring a distance", "explanation/heat.html"),
        ("call", "how-to/pick.html"),
    ],
)
def test_the_first_hit(browser, search, question, first):
    assert found(browser, search, question)[0].partition("#")[0] == first


def test_what_is_said_of_a_hit(browser, search):
    found(browser, search, "movie")
    assert browser.evaluate("document.getElementById('guide-search-count').textContent") == "1 page, the best first"
    assert browser.evaluate("document.querySelector('#guide-search-results mark').textContent") == "movie"
    assert browser.evaluate("document.querySelector('#guide-search-results div')") is None  # text, not marks
    assert browser.evaluate(f"{SHOWN}[0]") == "reference/options.html#more"
    assert found(browser, search, "zebra") == []
    assert browser.evaluate("document.getElementById('guide-search-count').textContent") == "No page has these words."
    assert found(browser, search, "") == []


def test_typing_searches_at_once(browser, search):
    found(browser, search, "")
    browser.evaluate(
        "(field => { field.value = 'heat'; field.dispatchEvent(new Event('input')); })(document.querySelector('input'))"
    )
    assert browser.evaluate(SHOWN)[0] == "explanation/heat.html"


@pytest.mark.skipif(not GUIDE.is_file(), reason="the guide has not been built")
def test_the_built_guide_is_searched_without_a_network(browser):
    assert found(browser, GUIDE.with_name("search.html"), "options of bihdist figure")
    assert browser._errors == []
    assert [each for each in browser._requests if not each.startswith("file:")] == []
