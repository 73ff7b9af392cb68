"""What the build writes of the program itself: every name, option, key and record has its place."""

import re

import bihdist
import pytest

from assets.guide.building import library_pages
from assets.guide.building.command_pages import command_pages, commands, options_of
from assets.guide.building.record_page import record_page


def test_every_public_name_has_a_page_and_is_in_the_index():
    pages = library_pages.library_pages()
    text = "\n".join(pages.values())
    documented = re.findall(r"^\.\. auto(?:class|exception|function|data):: (\w+)$", text, re.M)
    assert sorted(documented) == sorted(bihdist.__all__)
    assert sorted(re.findall(r"`~bihdist\.(\w+)`", pages["reference/api/index.md"])) == sorted(bihdist.__all__)
    assert len({path.lower() for path in pages}) == len(pages)  # some file systems ignore case
    in_sidebar = "index", *re.findall(r"^\w+ <([\w-]+)>$", text, re.M), *library_pages.TOPICS
    assert {f"reference/api/{name}.md" for name in in_sidebar} == {*pages}


def test_a_name_without_a_topic_stops_the_build(monkeypatch):
    monkeypatch.setitem(library_pages.TOPICS, "errors", ("Errors", "", ["Cancelled", "nothing_of_the_kind"]))
    with pytest.raises(ValueError, match=r"mend BihdistError, MeshError, .*nothing_of_the_kind"):
        library_pages.library_pages()


def test_members_of_public_bases_are_linked_and_those_of_others_shown():
    pages = library_pages.library_pages()
    assert "exclude-members" not in pages["reference/api/Distance.md"]
    of_biharmonic = pages["reference/api/BiharmonicDistance.md"]
    assert re.search("exclude-members:.* from_sources,", of_biharmonic)
    assert "   ~Distance.from_sources\n" in of_biharmonic


def test_every_option_of_every_command_is_described_once_or_linked():
    pages = {path.rpartition("/")[2].removesuffix(".md"): text for path, text in command_pages().items()}
    described = {
        (name, option)
        for name, text in pages.items()
        for line in re.findall(r"^:::\{option\} (.+)\n[^:\n]", text, re.M)
        for option in re.findall(r"(?:^|, )(-[^\s,]+)", line)
    }
    for word, parser in commands().items():
        page = pages[word]
        assert parser.description in page
        assert re.search(rf"```sh\nbihdist {word} .+\n```\n\n```sh\n(bihdist .+\n){{2,3}}```", page), (
            "usage and examples"
        )
        links = re.findall(r"^- \{option\}`[^`]+ <bihdist (\S+) (\S+)>`: .", page, re.M)
        homes = {option: home for home, option in links}
        for each in options_of(parser):
            assert f"\n## {each.title}\n" in page
            for name in each.names[:1]:
                assert ((word, name) in described) != (name in homes), (word, name)
                assert (homes.get(name, word), name) in described, (word, name)


def test_the_index_has_every_command_under_the_headings_of_the_help():
    page = command_pages()["reference/commands/index.md"]
    assert re.findall(r"^## (.+)$", page, re.M) == [
        "Look",
        "Numbers",
        "Compare",
        "Many meshes",
        "More",
        "Without a command",
    ]
    for pattern in (r"^\| \[`(\w+)`\]\(\1\.md\) \| [A-Z].+\. \|$", r"^(\w+) <\1>$"):
        assert sorted(re.findall(pattern, page, re.M)) == sorted(commands())


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
