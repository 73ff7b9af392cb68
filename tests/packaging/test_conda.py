"""The conda package's recipe and menu: they say what the project says, and render for every platform."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from app.commands.desktop import menu_entry, mime_package
from app.version import version
from bihdist_core.formats.mesh_names import ARRAY_FILES, MESH_FORMATS

ROOT = Path(__file__).parents[2]
tomllib = pytest.importorskip("tomllib")
FOLDER = ROOT / ".ci/conda"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
OTHER_NAMES = {"matplotlib": "matplotlib-base", "pyqt5": "pyqt"}
"""Of distributions, in conda."""
BINDING = {"pyqt", "pyside6-essentials"}
"""Conda has PyQt5 everywhere, and does not count its bugfixes as PyPI does."""


def recipe():
    yaml = pytest.importorskip("yaml")
    return yaml.safe_load((FOLDER / "recipe.yaml").read_text(encoding="utf-8"))


def requirements(rows):
    """By name, what follows it."""
    found = {}
    for row in rows:
        name, bound = re.fullmatch(r"([\w-]+)\s*([^;]*?)\s*(?:;.*)?", row).groups()
        found[OTHER_NAMES.get(name.lower(), name.lower())] = bound
    return found


def test_the_recipe_is_of_this_version_and_its_dependencies():
    found = recipe()
    assert found["context"]["version"] == version()
    assert found["about"]["license"] == PROJECT["license"]
    assert found["about"]["license_file"] == PROJECT["license-files"]
    run = requirements(found["requirements"]["run"])
    wanted = {"python": "", **requirements(PROJECT["dependencies"])}
    assert {name: bound for name, bound in run.items() if name not in BINDING} == {
        name: bound for name, bound in wanted.items() if name not in BINDING
    }
    assert "pyqt" in run


@pytest.mark.parametrize("platform", ["linux-64", "linux-aarch64", "osx-64", "osx-arm64", "win-64"])
def test_the_recipe_renders(platform):
    rattler = pytest.importorskip("rattler_build")
    stage = rattler.Stage0Recipe.from_file(FOLDER / "recipe.yaml")
    here = "linux-64" if platform.startswith("linux") else platform
    config = rattler.PlatformConfig(target_platform=platform, build_platform=here, host_platform=platform)
    pythons = rattler.VariantConfig({"python": ["3.11.*", "3.14.*"]})
    rendered = [each.recipe.to_dict() for each in stage.render(pythons, rattler.RenderConfig(platform=config))]
    assert len(rendered) == 2
    for each in rendered:
        assert each["package"] == {"name": "bihdist", "version": version()}
        assert each["requirements"]["build"][0].endswith(f"_{platform}")
        assert any("Menu" in line for line in each["build"]["script"])


def test_the_menu_opens_what_the_desktop_entry_opens():
    entry = dict(line.split("=", 1) for line in menu_entry("python").splitlines()[1:])
    (item,) = json.loads((FOLDER / "menu.json").read_text(encoding="utf-8"))["menu_items"]
    assert (item["name"], item["description"]) == (entry["Name"], entry["Comment"])
    linux, windows = item["platforms"]["linux"], item["platforms"]["win"]
    assert windows["file_extensions"] == [each for each in MESH_FORMATS if each not in ARRAY_FILES]
    name = "{http://www.freedesktop.org/standards/shared-mime-info}%s"
    types = [each for each in ElementTree.fromstring(mime_package()) if each.find(name % "glob") is not None]
    patterns = {each.get("type"): each.find(name % "glob").get("pattern") for each in types}
    patterns = {type: pattern for type, pattern in patterns.items() if pattern[1:] in MESH_FORMATS}
    assert linux["MimeType"] == list(patterns)
    own = [each.get("type") for each in types if each.find(name % "comment") is not None]
    assert linux["glob_patterns"] == {type: pattern for type, pattern in patterns.items() if type in own}
    assert linux["Categories"] == entry["Categories"].strip(";").split(";")
    assert linux["StartupWMClass"] == entry["StartupWMClass"]


def test_the_icons_are_there():
    script = json.dumps(recipe()["build"]["script"])
    names = {name.replace("\\", "/") for name in re.findall(r"assets[/\\]+application[/\\]+[\w.-]+", script)}
    names = {re.sub("/+", "/", name) for name in names}
    assert len(names) == 3
    assert all((ROOT / name).is_file() for name in names)
