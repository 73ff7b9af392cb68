"""Public names have numpydoc docstrings: all of `bihdist.__all__`, with their public methods and properties."""

import ast
import dataclasses
import inspect
import re
import textwrap
import tomllib
from functools import cached_property
from pathlib import Path

from numpydoc.docscrape import get_doc_object
from numpydoc.validate import Validator, get_validation_checks, validate

import bihdist_core
from app.figures.picture import figure, figure_again
from app.qt.show import show
from app.samples import sample
from app.web.page import page
from app.web.widget import widget

PROJECT = Path(__file__).parents[2] / "pyproject.toml"
CHECKS = get_validation_checks(set(tomllib.loads(PROJECT.read_text())["tool"]["numpydoc_validation"]["checks"]))
NAME = r"`?[a-z_]\w*`?(?: \([^)]*\))?"
PRIVATE_GRAMMAR = re.compile(rf'(?:^|[.;"] +){NAME}(?:, {NAME})*: +\S')
NOT_ALONE = {
    r"^(The same|Its?|They|Theirs?|Those of|That of|These)\b": "its first words mean something in no line before it",
    r"\b(see|as|said) (above|below|there)\b|\bsee the module\b|\bthe same errors\b|\bone above\b": "it sends elsewhere",
}


def public_objects():
    """Return each public class, function, method and property once, by its full name."""
    found = {}
    of_core = [getattr(bihdist_core, name) for name in bihdist_core.__all__]
    for each in [*of_core, figure, figure_again, page, sample, show, widget]:
        if not inspect.isclass(each) and not inspect.isfunction(each):
            continue  # a union of types
        found[f"{each.__module__}.{each.__qualname__}"] = each
        for base in inspect.getmro(each) if inspect.isclass(each) else ():
            if base.__module__.startswith("bihdist_core"):
                for name, member in vars(base).items():
                    if (
                        not name.startswith("_")
                        and is_documented(member)
                        and not inherits_docstring(each, name, member)
                    ):
                        found[f"{base.__module__}.{base.__qualname__}.{name}"] = member
    return found


def is_documented(member):
    return inspect.isfunction(member) or isinstance(member, classmethod | staticmethod | property | cached_property)


def inherits_docstring(owner, name, member):
    """Return whether a member has no docstring of its own, but what it overrides has one."""
    return not member.__doc__ and any(getattr(vars(base).get(name), "__doc__", None) for base in owner.__mro__)


class ProjectValidator(Validator):
    """A docstring's validator that knows dataclasses and errors.

    The fields of a dataclass stand in its section Parameters or in Attributes. An error without a constructor of its
    own has no parameters to tell of. Of a class method, the function is looked at.
    """

    def __init__(self, obj_name):
        found = self._load_obj(obj_name)
        found = getattr(found, "__func__", found)
        self.is_data = dataclasses.is_dataclass(found) and "__dataclass_fields__" in vars(found)
        super().__init__(get_doc_object(found, config={"show_class_members": False}))

    @property
    def doc_all_parameters(self):
        return self._doc_parameters(["Parameters", "Other Parameters", *(["Attributes"] if self.is_data else [])])

    @property
    def signature_parameters(self):
        if inspect.isclass(self.obj) and issubclass(self.obj, Exception):
            return ()
        if self.is_data:
            return tuple(field.name for field in dataclasses.fields(self.obj) if not field.name.startswith("_"))
        return super().signature_parameters


def faults(name):
    """Return what is wrong with the docstring of a public name, a sentence each."""
    validator = ProjectValidator(name)
    found = [text for code, text in validate(name, ProjectValidator)["errors"] if code in CHECKS]
    documented = {kind for _, kind, _ in validator.doc["Raises"]}
    found += [f"{error} is raised, but not in Raises" for error in sorted(raised(validator.obj) - documented)]
    kinds = [kind for kind, _ in validator.doc_all_parameters.values()]
    kinds += [kind for _, kind, _ in validator.doc["Returns"]]
    found += [f"{kind!r} has no shape" for kind in kinds if "array" in kind and "(" not in kind]
    text = validator.clean_doc
    return found + [f"{why}: {match[0]!r}" for pattern, why in NOT_ALONE.items() if (match := re.search(pattern, text))]


def raised(found):
    """Return the names of the errors that a function's own lines raise; of a class, its constructor's."""
    functions = [found]
    if isinstance(found, property | cached_property):
        functions = [getattr(found, "fget", None) or found.func]
    elif inspect.isclass(found):
        functions = [vars(found)[name] for name in ("__init__", "__post_init__") if name in vars(found)]
    errors = set()
    for function in functions:
        try:
            tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
        except OSError:  # a constructor that a dataclass made
            continue
        for node in ast.walk(tree):
            if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
                errors.add(ast.unparse(node.exc.func))
    return {name for name in errors if name.endswith(("Error", "NotEnoughMemory"))} - {"NotImplementedError"}


def test_docstrings_are_sentences_and_sections():
    """Fail where a docstring explains a parameter or a field as in "path: where it is"."""
    found = []
    for path in sorted([*PROJECT.parent.glob("app/**/*.py"), *PROJECT.parent.glob("bihdist_core/**/*.py")]):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
                for paragraph in (ast.get_docstring(node) or "").split("\n\n"):
                    if match := PRIVATE_GRAMMAR.search(" ".join(paragraph.splitlines())):
                        found.append(f"{path.relative_to(PROJECT.parent)}: {match[0]}")
    assert found == []


def test_public_names_have_numpydoc_docstrings():
    names = public_objects()
    assert len(names) > 180
    assert {name: found for name in sorted(names) if (found := faults(name))} == {}
