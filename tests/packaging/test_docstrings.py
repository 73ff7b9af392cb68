"""Every public name of the library has a docstring that is understood where it pops up, alone."""

import ast
import inspect
import re
from importlib import import_module
from pathlib import Path

import pytest

from app.figures.picture import figure, figure_again
from app.qt.show import show

ROOT = Path(__file__).parents[2]
CORE = ROOT / "bihdist_core"

NOT_ALONE = {
    r"^(The same|Its?|They|Theirs?|Those of|That of|These)\b": "what it is about stands in no line before it",
    r"\b(see|as|said) (above|below|there)\b|\bsee the module\b|\bthe same errors\b|\bone above\b": "it sends elsewhere",
}


def public(body, names=()):
    """The classes, functions and methods of a body, with their names."""
    for node in body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and not node.name.startswith("_"):
            decorators = {ast.unparse(each).rpartition(".")[2] for each in node.decorator_list}
            if not decorators & {"overload", "setter"}:
                yield ".".join([*names, node.name]), node
            if isinstance(node, ast.ClassDef):
                yield from public(node.body, [*names, node.name])


def docstrings():
    for path in sorted(CORE.rglob("*.py")):
        for name, node in public(ast.parse(path.read_text(encoding="utf-8")).body):
            yield f"{path.relative_to(CORE)} {name}", ast.get_docstring(node) or ""
    for function in (figure, figure_again, show):
        yield function.__name__, function.__doc__ or ""


DOCSTRINGS = dict(docstrings())


def test_all_that_is_public_has_a_docstring():
    assert len(DOCSTRINGS) > 500
    assert [name for name, text in DOCSTRINGS.items() if not text] == []


def has_none(found, name):
    """Whether an attribute of a class or module has no docstring, and none of a base class."""
    places = found.__mro__ if inspect.isclass(found) else [found]
    return not any(inspect.getdoc(place.__dict__[name]) for place in places if name in place.__dict__)


def test_what_the_application_adds_has_docstrings_of_its_own_or_of_what_it_overrides():
    missing = []
    for path in sorted((ROOT / "app").rglob("*.py")):
        module = import_module(".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"))
        for name, _ in public(ast.parse(path.read_text(encoding="utf-8")).body):
            owner, _, attribute = name.rpartition(".")
            if has_none(getattr(module, owner) if owner else module, attribute):
                missing.append(f"{module.__name__} {name}")
    assert missing == []


@pytest.mark.parametrize("pattern", NOT_ALONE)
def test_docstrings_stand_alone(pattern):
    assert [name for name, text in DOCSTRINGS.items() if re.search(pattern, text)] == [], NOT_ALONE[pattern]
