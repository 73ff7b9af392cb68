"""The pages of the library's public names, one for each topic."""

import inspect

import bihdist

from .topics import TOPICS


def library_pages() -> dict[str, str]:
    """The text of each page, by its path in the guide; ValueError for names that have no topic, or two."""
    named = sorted(name for *_, names in TOPICS.values() for name in names)
    wrong = {name for name in {*named, *bihdist.__all__} if named.count(name) != 1 or name not in bihdist.__all__}
    if wrong:
        raise ValueError(f"topics.py has each public name once; mend {', '.join(sorted(wrong))}")
    pages = {f"reference/api/{word}.md": _page(*topic) for word, topic in TOPICS.items()}
    rows = [f"| [{title}]({word}.md) | {about} |" for word, (title, about, _) in TOPICS.items()]
    tree = "\n".join(TOPICS)
    pages["reference/api/index.md"] = (
        "# Every name of the Python library\n\n`import bihdist`: every public name, by topic. "
        f"[The Python library](../library.md) tells how they are used together.\n\n"
        f"| Topic | |\n| --- | --- |\n{chr(10).join(rows)}\n\n"
        f"```{{toctree}}\n:hidden:\n\n{tree}\n```\n"
    )
    return pages


def _page(title: str, about: str, names: list[str]) -> str:
    summary = "\n".join(f"   {name}" for name in names)
    directives = [f".. autosummary::\n   :nosignatures:\n\n{summary}", *map(_directive, names)]
    blocks = [f"```{{eval-rst}}\n.. currentmodule:: bihdist\n\n{each}\n```\n" for each in directives]
    return "\n".join([f"# {title}\n\n{about}\n", *blocks])


def _directive(name: str) -> str:
    found = getattr(bihdist, name)
    if inspect.isclass(found):
        if issubclass(found, BaseException):
            return f".. autoexception:: {name}\n   :show-inheritance:"
        # What comes from bases that have no name here is shown as its own.
        public = [base.__name__ for base in found.__mro__[1:] if getattr(bihdist, base.__name__, None) is base]
        shown = "\n   :show-inheritance:" if public and found.__bases__[0].__name__ in public else ""
        strangers = [base.__name__ for base in found.__mro__ if not base.__module__.startswith(("app", "bihdist"))]
        above = {member for base in public for member in dir(getattr(bihdist, base)) if member[0] != "_"} - {
            *vars(found)
        }
        left_out = f"\n   :exclude-members: {', '.join(sorted(above))}" if above else ""
        bases = ", ".join([*public, *strangers])
        return f".. autoclass:: {name}{shown}\n   :members:\n   :inherited-members: {bases}{left_out}"
    return f".. {'autofunction' if callable(found) and hasattr(found, '__code__') else 'autodata'}:: {name}"
