"""The page that the README links to is what the program makes today."""

import base64
import json
import re
import zlib
from pathlib import Path

from app.main import main

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "assets/guide/hand.html"
COMMAND = "page hand --sources 1727 -o assets/guide/hand.html"
ELEMENT = re.compile(r'<script type="([\w/]+)" id="([\w-]+)">(.*?)</script>', re.S)


def parts_of(path):
    """Its frame, with the script and the style; what stands in its elements, decoded; and its scene, but for what other
    processors round otherwise."""
    text = path.read_text(encoding="utf-8")
    found = {name: content for _, name, content in ELEMENT.findall(text)}
    scene = json.loads(found.pop("scene"))
    del scene["mesh"]["differs"], scene["camera"]
    return ELEMENT.sub("", text), {name: zlib.decompress(base64.b64decode(c), -15) for name, c in found.items()}, scene


def test_the_page_of_the_readme_is_not_out_of_date(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "assets/guide").mkdir(parents=True)
    assert main(COMMAND.split()) == 0
    assert parts_of(tmp_path / "assets/guide/hand.html") == parts_of(PAGE), f"make it again: bihdist {COMMAND}"


def test_it_is_small_and_found():
    assert PAGE.stat().st_size <= 300_000
    assert "](assets/guide/hand.html)" in (ROOT / "README.md").read_text(encoding="utf-8")
    assert COMMAND in (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
