"""A document as JSON: records, lists, texts and numbers, written and read strictly.

How a value is written and read follows from its type: a dataclass is a record of its fields, of which those that are as
usual are not written.  What stands otherwise in files has functions of its own below.
"""

from dataclasses import fields, is_dataclass, replace
from functools import singledispatch
from typing import Any

from bihdist_core.applications.changes import Perturbation, change_from_words, words_of_change
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import BoundaryLoop, Curve, Source, SourceSet, SurfacePoint
from bihdist_core.sources.words import curve_rows, places_from

from .camera import Camera, View
from .document import Document, MeshFile
from .json_values import Reader, field_readers, flag, listed, numbers, placed, reader_of, record, text, whole
from .looks import Isolines, Shading, one_of
from .page import Page
from .quantities import Quantity, quantity_from, read_spec
from .repairs import NO_REPAIRS, Repairs
from .tools import part_types

ALWAYS = {"surfaces", "points", "panels", "areas", "isolines", "camera", "insets", "warp_factor", "next_id"}
"""Parts of a document that stand in each file."""

BEFORE = {"up": "y"}
"""What files mean that do not say it, where that is not as usual."""

OLD_KEYS = {
    "beside": "second_views",
    "zooms": "insets",
    "height": "warp_factor",
    "projection": "parallel_projection",
    "crease": "feature_angle",
    "wireframe": "show_edges",
    "font": "font_family",
    "text": "font_size",
}
"""Keys of older files, of documents, their shading and pages."""

OLD_VALUES: dict[str, dict[str, Any]] = {
    "projection": {"perspective": False, "orthographic": True},
    "range": {"shares": "fraction"},
}


def with_new_keys(data: Any) -> Any:
    """Return a record of an older file with the keys and values of today; anything else as it is."""
    if not isinstance(data, dict):
        return data
    values = {
        key: OLD_VALUES[key].get(str(value), value) if key in OLD_VALUES else value for key, value in data.items()
    }
    return {OLD_KEYS.get(key, key): value for key, value in values.items()}


def document_data(document: Document) -> dict[str, Any]:
    """Return the document as records, lists, texts and numbers; `document_from` reads it back, equal."""
    data: dict[str, Any] = {}
    for each in fields(document):
        value = getattr(document, each.name)
        if each.name != "parts" and (each.name in ALWAYS or value != BEFORE.get(each.name, each.default)):
            data[each.name] = written(value)
    for part in document.parts:
        data |= {part.key: written(part)} if part.key else written(part)
    return data


def document_from(data: Any, where: str = "document") -> Document:
    """Return the document that `document_data` has written; ParameterError, with the place, for anything else."""
    own = field_readers(Document, READERS)
    del own["parts"]
    of_parts = {
        kind: {kind.key: reader_of(kind, READERS)} if kind.key else field_readers(kind, READERS)
        for kind in part_types()
    }
    # Files of before name the tool that is on, which follows from what is shown.
    readers: dict[str, Reader] = {**own, "tool": lambda data, _: one_of(text(data, "tool"), ("source",), "tool")}
    for more in of_parts.values():
        readers |= more
    values = record(with_new_keys(data), where, readers, ALWAYS)
    values.pop("tool", None)
    parts = []
    for kind, more in of_parts.items():
        found = {name: values.pop(name) for name in more if name in values}
        if found:
            parts.append(found[kind.key] if kind.key else placed(kind, where, **found))
    return placed(Document, where, **{**BEFORE, **values}, parts=tuple(parts))


# ---------------------------------------------------------------------- writing
@singledispatch
def written(value: Any) -> Any:
    """Return a value as records, lists, texts and numbers."""
    if isinstance(value, tuple):
        return [written(each) for each in value]
    if not is_dataclass(value):
        return value
    named = {each.name: (getattr(value, each.name), each.default) for each in fields(value)}
    return {name: written(each) for name, (each, usual) in named.items() if each != usual}


@written.register
def _(spec: Spec) -> Any:
    return spec.canonical


@written.register
def _(quantity: Quantity) -> Any:
    return quantity.to_json()


@written.register
def _(mesh: MeshFile) -> Any:
    data: dict[str, Any] = {"name": mesh.name, "path": mesh.path, "sha256": mesh.sha256}
    if mesh.repairs != NO_REPAIRS:
        data["repairs"] = written(mesh.repairs)
    if mesh.change is None:
        return data
    data["change"] = words_of_change(mesh.change)
    return {**data, "pose_sha256": mesh.change.pose_sha256} if mesh.change.pose_sha256 else data


@written.register
def _(isolines: Isolines) -> Any:
    # Equal steps are what nothing says: files of older programs have no others.
    usual = Isolines(isolines.count, round=False)
    named = {each.name: getattr(isolines, each.name) for each in fields(isolines)}
    data = {name: written(value) for name, value in named.items() if value != getattr(usual, name)}
    return {"count": isolines.count, **data} if data else isolines.count


@written.register
def _(source: SourceSet) -> Any:
    return {"set": [written(member) for member in source.members]}


@written.register
def _(loop: BoundaryLoop) -> Any:
    return {"loop": loop.number}


@written.register
def _(curve: Curve) -> Any:
    return {"curve": curve_rows(curve), "closed": curve.closed}


# ---------------------------------------------------------------------- reading
def _mesh(data: Any, where: str) -> MeshFile:
    readers: dict[str, Reader] = {
        "name": text, "path": text, "sha256": text, "repairs": reader_of(Repairs), "change": _change,
        "pose_sha256": text,
    }  # fmt: skip
    values = record(data, where, readers, {"name", "path", "sha256"})
    pose = values.pop("pose_sha256", "")
    if pose and not values.get("change", Perturbation()).pose:
        raise ParameterError(f"{where} has the checksum of another pose, and no pose.")
    if pose:
        values["change"] = replace(values["change"], pose_sha256=pose)
    return MeshFile(**values)


def _change(data: Any, where: str) -> Perturbation:
    return placed(change_from_words, where, text=text(data, where))


def _source(data: Any, where: str) -> Source:
    if isinstance(data, dict) and "set" in data:
        members = record(data, where, {"set": listed(_source)})["set"]
        return placed(SourceSet, where, members=members)
    if isinstance(data, dict) and "loop" in data:
        return placed(BoundaryLoop, where, number=record(data, where, {"loop": whole})["loop"])
    if isinstance(data, dict) and "curve" in data:
        values = record(data, where, {"curve": places_from, "closed": flag}, {"curve"})
        return placed(Curve, where, places=values["curve"], closed=values.get("closed", False))
    if isinstance(data, dict):
        return placed(SurfacePoint, where, **record(data, where, {"face": whole, "weights": numbers(3)}))
    return whole(data, where)


def read_isolines(data: Any, where: str) -> Isolines:
    """Isolines from their count, or from a record; ParameterError, with the place, for anything else."""
    if not isinstance(data, dict):
        return placed(Isolines, where, count=whole(data, where), round=False)
    return placed(Isolines, where, **{"round": False, **record(data, where, field_readers(Isolines), set())})


def read_view(data: Any, where: str) -> View:
    """Return a standard view's name or a camera."""
    return data if isinstance(data, str) else reader_of(Camera)(data, where)


READERS: dict[Any, Reader] = {
    MeshFile: _mesh,
    Isolines: read_isolines,
    Source: _source,
    View: read_view,
    Shading: lambda data, where: reader_of(Shading)(with_new_keys(data), where),
    Page: lambda data, where: reader_of(Page, {View: read_view})(with_new_keys(data), where),
    Quantity: quantity_from,
    Spec: read_spec,
}
"""Of what stands in files otherwise than its fields do."""
