"""What the build writes of the program itself: every name, option, key and record has its place."""

import re

import bihdist
import pytest

from assets.guide.building import library_pages
from assets.guide.building.option_pages import commands, option_pages, options_of
from assets.guide.building.record_page import record_page


def test_every_public_name_has_its_page():
    pages = library_pages.library_pages()
    documented = re.findall(r"^\.\. auto(?:class|exception|function|data):: (\w+)$", "\n".join(pages.values()), re.M)
    assert sorted(documented) == sorted(bihdist.__all__)
    index = pages["reference/api/index.md"]
    assert {f"reference/api/{word}.md" for word in re.findall(r"\]\((\w+)\.md\)", index)} == {*pages} - {
        "reference/api/index.md"
    }


def test_a_name_without_a_topic_stops_the_build(monkeypatch):
    monkeypatch.setitem(library_pages.TOPICS, "errors", ("Errors", "", ["Cancelled", "nothing_of_the_kind"]))
    with pytest.raises(ValueError, match=r"mend BihdistError, MeshError, .*nothing_of_the_kind"):
        library_pages.library_pages()


def test_bases_that_have_no_name_of_their_own_are_shown_with_what_inherits_from_them():
    page = library_pages.library_pages()["reference/api/distances.md"]
    of_distance = page.partition(".. autoclass:: Distance\n")[2].partition("```")[0]
    assert "exclude-members" not in of_distance
    of_biharmonic = page.partition(".. autoclass:: BiharmonicDistance\n")[2].partition("```")[0]
    assert "from_sources" in of_biharmonic.partition("exclude-members:")[2]


def test_every_option_of_every_command_is_there():
    (page,) = option_pages().values()
    for word, parser in commands().items():
        section = page.partition(f"\n## {word}\n")[2].partition("\n## ")[0]
        assert parser.description in section
        for name in options_of(parser):
            assert re.search(rf"`{name}[ `]", section), (word, name)
        for line in section.splitlines():
            assert not line.startswith(": ") or len(line) > 6, (word, line)
    shared = page.partition("\n## Options that several commands have\n\n")[2]
    (_, *words), _, *rows = ([cell.strip() for cell in line.split("|")[1:-1]] for line in shared.splitlines())
    assert len(rows) > 40
    for name, *dots in rows:
        having = {word for word, parser in commands().items() if name.strip("`") in options_of(parser)}
        assert {word for word, dot in zip(words, dots, strict=True) if dot} == having


def test_every_record_of_a_document_is_there_with_its_keys():
    (page,) = record_page().values()
    section = page.partition("\n## `points`\n")[2].partition("\n## ")[0]
    assert re.findall(r"^\| `(\w+)`", section, re.M) == ["name", "at", "surface", "image_of"]
    assert "| `at` | source | has to be there |" in section
    assert '| `range` | text | `own` | Where colour bars end, one of "own", "shared", "fraction". |' in page
    assert "| `up` | text | `y` |" in page  # what files mean that do not say it
    assert "| `pins` | list of record of `point`" in page
    assert "Error" not in page


def test_every_command_of_the_window_is_there():
    pytest.importorskip("qtpy")
    from app.qt.acts import ALL
    from assets.guide.building.key_page import key_page

    (page,) = key_page().values()
    rows = re.findall(r"^\| (.+?) \| (.*?) \| .*\|$", page, re.M)
    said = {(text, keys) for text, keys in rows if text not in ("Command", "---")}
    plain = {(act.text.replace("&", ""), ", ".join(f"{{kbd}}`{key}`" for key in act.keys if key)) for act in ALL}
    assert said == plain
