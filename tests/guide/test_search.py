"""The guide's search: pages that answer questions, ranked by Node; what it shows, in Chromium, from files."""

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

from app.guide_pages import GUIDE
from assets.guide.building.build import write_sources
from assets.guide.building.search_index import sections_of, synonyms, write_search_index
from tests.browser.chromium import Chromium

SEARCH = Path(__file__).parents[2] / "assets/guide/look/search.js"
QUESTIONS = tomllib.loads(Path(__file__).with_name("questions.toml").read_text(encoding="utf-8"))["questions"]
RANK = f"""
const {{answers, indexed}} = require({json.dumps(str(SEARCH))});
const {{pages, synonyms, questions}} = JSON.parse(require("fs").readFileSync(0, "utf8"));
const index = indexed(pages, synonyms);
console.log(JSON.stringify(questions.map((question) => answers(index, question).map((each) => each.page))));
"""
PAGES = {
    "how-to/regions.html": ("Divide a surface into regions", "Each vertex belongs to the nearest of several points."),
    "how-to/pick.html": ("Call a function at each click", "A callback is handed the vertex that was picked."),
    "reference/options.html": ("Options", "regions points vertex surface click function <div>x</div> movie"),
    "explanation/heat.html": ("The heat method", "Distances are measured; how far off they are is estimated."),
}
FIELD = '<input type="search" name="q">'
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
        f"<meta charset='utf-8'><div class='bd-search-container'>{FIELD}</div>"
        "<p id='guide-search-count'></p><ol id='guide-search-results'></ol>"
        f"<dialog id='pst-search-dialog'><form>{FIELD}</form></dialog><script src='search.js'></script>"
    )
    return folder / "search.html"


def written_page(name, text):
    """What the index has of a page, from its Markdown, or from an example of the gallery."""
    keywords = re.findall(r"^ *keywords: *(.*)$", text, re.MULTILINE)
    text = re.sub(r"\A---\n.*?\n---\n", "", text, flags=re.DOTALL)
    if name.endswith(".py"):
        name, text = name.replace("gallery/", "gallery/auto/"), re.sub(r'\A"""\n(.*)\n=+\n', r"# \1\n", text)
    parts = re.split(r"^#{1,3} (.*)\n", text, flags=re.MULTILINE)
    sections = [["", heading, body] for heading, body in zip(parts[1::2], parts[2::2], strict=True)]
    return {"page": str(Path(name).with_suffix("")), "keywords": " ".join(keywords), "sections": sections}


@pytest.fixture(scope="module")
def ranked(tmp_path_factory):
    """The pages found for each question, the best first, by the text of the whole guide."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("there is no Node")
    source = tmp_path_factory.mktemp("source")
    write_sources(source)
    paths = [*source.rglob("*.md"), *(source / "gallery").rglob("*.py")]
    pages = [written_page(path.relative_to(source).as_posix(), path.read_text(encoding="utf-8")) for path in paths]
    questions = [each["question"] for each in QUESTIONS]
    data = {"pages": pages, "synonyms": synonyms(), "questions": questions}
    done = subprocess.run([node, "-e", RANK], input=json.dumps(data), capture_output=True, text=True, check=True)
    return dict(zip(questions, json.loads(done.stdout), strict=True))


@pytest.mark.parametrize("asked", QUESTIONS, ids=lambda asked: asked["question"])
def test_a_page_that_answers_is_among_the_first_three(ranked, asked):
    assert {*asked["pages"]} & {*ranked[asked["question"]][:3]}, ranked[asked["question"]][:5]


def test_options_are_sections_of_their_pages():
    option = '<dl><dt class="sig std" id="there">--cmap NAME<a class="headerlink">#</a></dt><dd>colour map</dd></dl>'
    page = f'<article><section id="top"><h1>Figure</h1><section id="look"><h2>Look</h2>{option}</section></section>'
    assert sections_of(page) == [("", "Figure", ""), ("look", "Look", ""), ("there", "--cmap NAME", "colour map")]


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


@pytest.mark.parametrize(
    ("field", "answers"), [("", "#guide-search-results"), ("dialog ", "dialog .guide-search-results")]
)
def test_typing_searches_at_once(browser, search, field, answers):
    found(browser, search, "")
    browser.evaluate(
        "(field => { field.value = 'heat'; field.dispatchEvent(new Event('input')); })"
        f"(document.querySelector('{field}input'))"
    )
    assert browser.evaluate(f"document.querySelector('{answers} a').getAttribute('href')") == "explanation/heat.html"


@pytest.mark.skipif(not GUIDE.is_file(), reason="the guide has not been built")
def test_the_built_guide_is_searched_without_a_network(browser):
    assert found(browser, GUIDE.with_name("search.html"), "options of bihdist figure")
    assert browser._errors == []
    assert [each for each in browser._requests if not each.startswith("file:")] == []
