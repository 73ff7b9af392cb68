"""What recipes and sessions hold: a table for each record of their JSON, from the types that read and write it."""

import re
import sys
from dataclasses import MISSING, Field, fields, is_dataclass
from inspect import getdoc
from typing import Any, get_args, get_origin, get_type_hints

from numpydoc.docscrape import NumpyDocString

from app.document.camera import Camera, SecondMeshView
from app.document.document import Document, FieldArray, Inset, MeshFile, Panel, Point
from app.document.form import ALWAYS, BEFORE
from app.document.looks import Colours, Isolines, Shading
from app.document.page import Page
from app.document.repairs import Repairs
from app.document.tools import part_types
from bihdist_core.applications.changes import Perturbation
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import Source

from .command_pages import markdown

INTRODUCTION = """# Every key of recipes and sessions

The keys of each record, their types, and what holds where a key is left out. [Recipes and sessions](documents.md) tells
how they fit together.

"""
RECORDS = {
    "document": Document, "surfaces": MeshFile, "repairs": Repairs, "points": Point, "panels": Panel,
    "isolines": Isolines, "camera": Camera, "insets": Inset, "fields": FieldArray, "colours": Colours,
    "shading": Shading, "second_views": SecondMeshView, "page": Page,
}  # fmt: skip
IN_FILES = {(Document, "up"): BEFORE["up"], (Isolines, "round"): False}
"""What is read where a file does not say it, which older programs wrote, is not what a new document has."""

TOGETHER = "Keys of tools beside those of the document"


def record_page() -> dict[str, str]:
    """The text of the page, by its path in the guide."""
    parts = [INTRODUCTION]
    parts += [f"## `{key}`\n\n{_table(kind)}" for key, kind in RECORDS.items()]
    parts += [f"## `{kind.key}`\n\n{_table(kind)}" for kind in part_types() if kind.key]
    beside = [_table(kind) for kind in part_types() if not kind.key]
    return {"reference/records.md": "\n".join([*parts, f"## {TOGETHER}\n", *beside])}


def _table(kind: type) -> str:
    meanings, types = _meanings(kind), get_type_hints(kind)
    rows = [
        f"| `{each.name}` | {_words(types[each.name])} | {_default(kind, each)} | {meanings.get(each.name, '')} |"
        for each in fields(kind)
        if not (kind is Document and each.name == "parts")
    ]
    return "\n".join(["| Key | Type | If left out | Meaning |", "| --- | --- | --- | --- |", *rows, ""])


def _meanings(kind: type) -> dict[str, str]:
    """Return what the sections of a record's docstring say of its keys."""
    sections = NumpyDocString(getdoc(kind) or "")
    rows = [*sections["Parameters"], *sections["Attributes"]]
    return {name: _meaning(" ".join(row.desc), kind) for row in rows for name in row.name.split(", ")}


def _meaning(text: str, kind: type) -> str:
    """In words for who writes JSON: no null of Python, and the choices instead of the name of their list."""
    here = vars(sys.modules[kind.__module__])
    text = re.sub(r"\b[A-Z]{3,}\b", lambda name: _choices(here.get(name[0], name[0])), text)
    text = re.sub(r" ?\(`[a-z_.]+`\)", "", text).replace("None", "null")
    return "`".join(piece if odd % 2 else markdown(piece) for odd, piece in enumerate(text.split("`")))


def _choices(found: object) -> str:
    return ", ".join(f'"{each}"' for each in found) if isinstance(found, tuple) else str(found)


def _default(kind: type, each: Field[Any]) -> str:
    if each.default is MISSING or (kind is Document and each.name in ALWAYS):
        return "has to be there"
    usual = IN_FILES.get((kind, each.name), each.default)
    if isinstance(usual, bool):
        return f"`{str(usual).lower()}`"
    return f"`{usual}`" if isinstance(usual, int | float) or (isinstance(usual, str) and usual) else ""


def _words(kind: Any) -> str:
    """A type as JSON has it."""
    simple = {str: "text", int: "whole number", float: "number", bool: "true or false", Source: "source"}
    if kind in simple:
        return simple[kind]
    arguments = [each for each in get_args(kind) if each is not Ellipsis]
    if get_origin(kind) is tuple:
        return f"list of {_words(arguments[0])}" if Ellipsis in get_args(kind) else f"{len(arguments)} values"
    if arguments:
        known = [each for each in arguments if each is not type(None)]
        return "source" if {*get_args(Source)} <= {*known} else " or ".join(map(_words, known))
    named = next((f"[{key}](#{key})" for key, each in RECORDS.items() if each is kind), "")
    written = {Spec: "a distance in words", Perturbation: "text, as `--perturb` takes it"}.get(kind, "")
    record = f"record of {', '.join(_keys(kind))}" if _keys(kind) else kind.__name__.lower()
    return named or written or record


def _keys(kind: type) -> list[str]:
    return [f"`{each.name}`" for each in fields(kind)] if is_dataclass(kind) else []
