"""The pages of the library's public names: an index, one for each topic, and one for each name."""

import inspect
from typing import Any, get_args

import bihdist

from .topics import RESULTS, TOPICS


def library_pages() -> dict[str, str]:
    """Return the text of each page, by its path in the guide; ValueError for names that have no topic, or two."""
    named = sorted(name for *_, names in TOPICS.values() for name in names)
    wrong = {name for name in {*named, *bihdist.__all__} if named.count(name) != 1 or name not in bihdist.__all__}
    if wrong:
        raise ValueError(f"topics.py has each public name once; mend {', '.join(sorted(wrong))}")
    pages = {
        _page_of(name): f"# bihdist.{name}\n\n{_rst(_directive(name), *map(_result, RESULTS.get(name, ())))}"
        for name in named
    }
    index = []
    for word, (title, about, names) in TOPICS.items():
        tree = "\n".join(f"{name} <{_page_of(name)}>" for name in names)
        table = ".. autosummary::\n   :nosignatures:\n\n" + "\n".join(f"   {name}" for name in names)
        pages[word] = f"# {title}\n\n{about}\n\n{_rst(table)}\n```{{toctree}}\n:hidden:\n\n{tree}\n```\n"
        index.append(f"[{title}]({word}.md)\n: {', '.join(f'{{py:obj}}`~bihdist.{name}`' for name in names)}\n")
    tree, named_by_topic = "\n".join(TOPICS), "\n".join(index)
    pages["index"] = (
        "# Every name of the Python library\n\nThe public names of `import bihdist`. [The Python library by "
        f"example](../library.md) shows how they are used together.\n\n{named_by_topic}\n"
        f"```{{toctree}}\n:hidden:\n\n{tree}\n```\n"
    )
    return {f"reference/api/{name}.md": text for name, text in pages.items()}


def _page_of(name: str) -> str:
    """Return the name of a page; some file systems take `Band` and `band` for the same."""
    return f"{name}-class" if name.lower() != name and name.lower() in bihdist.__all__ else name


def _rst(*directives: str) -> str:
    return "```{eval-rst}\n.. currentmodule:: bihdist\n\n" + "\n\n".join(directives) + "\n```\n"


def _directive(name: str) -> str:
    found = getattr(bihdist, name)
    if not inspect.isclass(found):
        return f".. autofunction:: {name}" if inspect.isfunction(found) else f".. autodata:: {name}\n   :no-value:"
    if issubclass(found, BaseException):
        return f".. autoexception:: {name}\n   :show-inheritance:"
    # What comes from bases that have no name here is shown as the class's own.
    inherited = _inherited(found)
    strangers = [base.__name__ for base in found.__mro__ if not base.__module__.startswith(("app", "bihdist"))]
    options = [":members:", f":inherited-members: {', '.join(strangers)}"]
    options += [f":exclude-members: {', '.join(inherited)}"] if inherited else []
    rows = [f"   ~{base}.{member}" for member, base in inherited.items()]
    table = [".. rubric:: Inherited", "", ".. autosummary::", "   :nosignatures:", "", *rows] if rows else []
    return "\n   ".join([f".. autoclass:: {name}", *options, "", *table]).rstrip()


def _inherited(kind: type) -> dict[str, str]:
    """Return the members that are described with a public base, and that base."""
    found: dict[str, str] = {}
    for base in kind.__mro__[:0:-1]:
        if getattr(bihdist, base.__name__, None) is base:
            above = _inherited(base)
            own = [name for name in dir(base) if name[0] != "_" and name not in above]
            found |= {name: base.__name__ for name in own if inspect.getdoc(getattr(base, name))}
    return {name: base for name, base in found.items() if name not in vars(kind)}


def describe_union(_app: object, what: str, _name: str, found: Any, _options: object, lines: list[str]) -> None:
    """Let a type that is a union have the docstrings of its classes; a listener of autodoc."""
    if what == "data":
        kinds = [f"- {inspect.getdoc(kind)}" for kind in get_args(found) if kind.__module__.startswith("bihdist")]
        lines[:] = ["A path, a tuple ``(vertices, faces)``, or an object of another library.", "", *kinds]


def _result(path: str) -> str:
    return f".. autoclass:: {path}()\n   :members:\n   :exclude-members: of"
