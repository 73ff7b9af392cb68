"""The copy to be installed stands by itself: links lead somewhere, nothing is fetched, and it is small."""

import zlib

import pytest
from PIL import Image

from app.guide_pages import GUIDE
from assets.guide.building import installed_copy
from assets.guide.building.installed_copy import install
from assets.guide.building.links import wrong_links
from assets.guide.building.search_index import sections_of


@pytest.fixture
def pages(tmp_path):
    """A small guide, as Sphinx leaves it."""
    folder = tmp_path / "pages"
    (folder / "_downloads/0f").mkdir(parents=True)
    (folder / "_downloads/0f/one.py").write_text("pass")
    (folder / "style.css.map").write_text("{}")
    (folder / "index.html").write_text(
        '<script src="searchindex.js?v=1"></script><p id="here"><a href="#here">a</a><a href="b.html#there">b</a>'
        '<a href="https://example.org">elsewhere</a><a download="" href="_downloads/0f/one.py">c</a></p>'
    )
    (folder / "b.html").write_text('<p id="there"><img src="data:image/png;base64,"></p>')
    return folder


def test_what_is_copied(pages, tmp_path):
    target = tmp_path / "guide"
    target.mkdir()
    (target / "old.html").write_text("of the build before")
    assert install(pages, target).endswith("2 pages, 0.0 MB compressed")
    files = {path.relative_to(target).as_posix() for path in target.rglob("*") if path.is_file()}
    assert files == {"index.html", "b.html", "_downloads/0f/one.py.txt"}
    text = (target / "index.html").read_text()
    assert "searchindex" not in text
    assert '<a download="one.py" href="_downloads/0f/one.py.txt">' in text


@pytest.mark.parametrize("mode", ["RGB", "P"])
def test_pictures_travel_as_webp(pages, tmp_path, mode):
    (pages / "_images").mkdir()
    Image.new(mode, (40, 30), 3).save(pages / "_images/a.b.png")
    (pages / "c.html").write_text('<a href="_images/a.b.png"><img src="_images/a.b.png"></a> a.b.png')
    install(pages, tmp_path / "guide")
    assert [path.name for path in (tmp_path / "guide/_images").iterdir()] == ["a.b.webp"]
    page = (tmp_path / "guide/c.html").read_text()
    assert page == '<a href="_images/a.b.webp"><img src="_images/a.b.webp"></a> a.b.png'
    with Image.open(tmp_path / "guide/_images/a.b.webp") as picture:
        assert picture.size == (40, 30)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ('<a href="c.html">c</a>', "leads to no file"),
        ('<a href="b.html#nowhere">c</a>', "leads to no place on its page"),
        ('<img src="https://example.org/a.png">', "is fetched from elsewhere"),
        ('<script src="//example.org/a.js"></script>', "is fetched from elsewhere"),
        ('<link rel="stylesheet" href="http://example.org/a.css">', "is fetched from elsewhere"),
    ],
)
def test_wrong_links_leave_what_was_there(pages, tmp_path, wrong, told):
    (pages / "d.html").write_text(wrong)
    (tmp_path / "guide").mkdir()
    (tmp_path / "guide/index.html").write_text("before")
    with pytest.raises(ValueError, match=told):
        install(pages, tmp_path / "guide")
    assert (tmp_path / "guide/index.html").read_text() == "before"


def test_a_guide_that_is_too_large(pages, tmp_path, monkeypatch):
    monkeypatch.setattr(installed_copy, "MOST", 100)
    with pytest.raises(ValueError, match=r"more than 100; the largest: index\.html"):
        install(pages, tmp_path / "guide")


def test_sections_of_a_page():
    html = (
        "<nav>No</nav><article><section id='all'><h1>A title<a class='headerlink'>#</a></h1><p>One<br>two.</p>"
        "<section id='part'><h2>A <em>part</em></h2><p>Three</p></section></section></article><p>No</p>"
    )
    assert sections_of(html) == [("", "A title", "One two."), ("part", "A part", "Three")]


@pytest.mark.skipif(not GUIDE.is_file(), reason="the guide has not been built")
def test_the_guide_that_is_built():
    folder = GUIDE.parent
    assert wrong_links(folder) == []
    compressed = [len(zlib.compress(path.read_bytes())) for path in folder.rglob("*") if path.is_file()]
    assert sum(compressed) <= installed_copy.MOST
    assert list(folder.rglob("*.py")) == []
    for path in folder.rglob("*.html"):
        assert "MathJax" not in path.read_text(encoding="utf-8")
