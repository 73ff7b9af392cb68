"""A document as JSON: records, lists, texts and numbers, written and read strictly."""

from dataclasses import fields, replace
from typing import Any

from bihdist_core.applications.changes import Perturbation, change_from_words, words_of_change
from bihdist_core.applications.weights import INVERSE_DISTANCES, Weights
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import BoundaryLoop, Curve, Source, SourceSet, SurfacePoint
from bihdist_core.sources.words import curve_rows, places_from

from .beside import Beside
from .camera import Camera, View
from .document import Anchor, Document, FieldArray, MeshFile, Panel, Point, Zoom
from .instruments import (
    ALONG_ALL_PINS,
    AS_LISTED,
    FIRST_TWO,
    DockPlaces,
    Pair,
    Pin,
    PinList,
    Profile,
    Scatter,
    Selection,
)
from .json_values import flag, listed, number, numbers, or_none, placed, record, text, whole
from .looks import AS_IT_IS, OF_THE_STYLE, Colours, Isolines, Shading
from .map_colours import SAME_FACES, MapFile, Truth
from .quantities import quantity_from, read_spec

LATER: dict[str, Any] = {
    "fields": [],
    "range": "own",
    "colours": {},
    "shading": {},
    "up": "y",
    "projection": "perspective",
    "axes": False,
    "weights": {},
    "pins": [],
    "pin_list": {},
    "profile": {},
    "scatter": {},
    "selections": [],
    "regions": [],
    "extrema": False,
    "docks": [],
    "dock_places": None,
    "snap": True,
    "beside": [],
    "linked": True,
    "pairs": [],
    "maps": [],
    "truth": {},
}
"""Parts of a document that it need not have, and what then holds: as it was before there were any."""


def document_data(document: Document) -> dict[str, Any]:
    """The document as records, lists, texts and numbers; `document_from` reads it back, equal."""
    own: dict[str, Any] = {
        "surfaces": [_mesh_data(mesh) for mesh in document.surfaces],
        "points": [_point_data(point) for point in document.points],
        "panels": [{**plain(panel), "shows": panel.shows.to_json()} for panel in document.panels],
        "camera": view_data(document.camera),
        "zooms": [plain(zoom) for zoom in document.zooms],
        "isolines": _isolines_data(document.isolines),
        "colours": _unlike(document.colours, OF_THE_STYLE),
        "shading": _unlike(document.shading, AS_IT_IS),
        "anchors": [_anchor_data(anchor) for anchor in document.anchors],
        "weights": _unlike(document.weights, INVERSE_DISTANCES),
        "fields": [plain(field) for field in document.fields],
        "pins": [plain(pin) for pin in document.pins],
        "pin_list": _pin_list_data(document.pin_list),
        "pairs": [plain(pair) for pair in document.pairs],
        "profile": _unlike(document.profile, ALONG_ALL_PINS),
        "scatter": _unlike(document.scatter, FIRST_TWO),
        "selections": [plain(selection) for selection in document.selections],
        "regions": list(document.regions),
        "docks": list(document.docks),
        "dock_places": document.dock_places and plain(document.dock_places),
        "maps": [plain(map) for map in document.maps],
        "truth": _truth_data(document.truth),
        "beside": [{**plain(each), "camera": view_data(each.camera)} for each in document.beside],
    }
    data = {f.name: own.get(f.name, getattr(document, f.name)) for f in fields(document)}
    # What came later is written where it differs from what was before.
    return {name: value for name, value in data.items() if name not in LATER or value != LATER[name]}


def plain(value: Any) -> dict[str, Any]:
    """The fields of a dataclass by name."""
    return {f.name: getattr(value, f.name) for f in fields(value)}


def _unlike(value: Any, usual: Any) -> dict[str, Any]:
    """Those fields that are not as usual."""
    return {name: each for name, each in plain(value).items() if each != getattr(usual, name)}


def _pin_list_data(pins: PinList) -> dict[str, Any]:
    data = _unlike(pins, AS_LISTED)
    return data if pins.distance is None else {**data, "distance": pins.distance.in_full}


def _truth_data(truth: Truth) -> dict[str, Any]:
    files = {name: getattr(truth, name) for name in ("file", "partners")}
    return {**_unlike(truth, SAME_FACES), **{name: plain(file) for name, file in files.items() if file is not None}}


def _mesh_data(mesh: MeshFile) -> dict[str, Any]:
    data = {"name": mesh.name, "path": mesh.path, "sha256": mesh.sha256}
    if mesh.change is None:
        return data
    data["change"] = words_of_change(mesh.change)
    return {**data, "pose_sha256": mesh.change.pose_sha256} if mesh.change.pose_sha256 else data


def _point_data(point: Point) -> dict[str, Any]:
    data = {"name": point.name, "at": _source_data(point.at), "surface": point.surface}
    return {**data, "image_of": point.image_of} if point.image_of else data


def _anchor_data(anchor: Anchor) -> dict[str, Any]:
    return {"point": anchor.point, "value": anchor.value, **_unlike(anchor, Anchor(anchor.point, anchor.value))}


def _isolines_data(isolines: Isolines) -> int | dict[str, Any]:
    # Equal steps are what nothing says: files of older programs have no others.
    data = _unlike(isolines, Isolines(isolines.count, round=False))
    return {"count": isolines.count, **data} if data else isolines.count


def view_data(view: View) -> str | dict[str, Any]:
    if isinstance(view, str):
        return view
    return {name: list(values) for name, values in plain(view).items()}


def _source_data(at: Source | None) -> int | dict[str, Any] | None:
    if isinstance(at, SourceSet):
        return {"set": [_source_data(member) for member in at.members]}
    if isinstance(at, SurfacePoint):
        return {"face": at.face, "weights": list(at.weights)}
    if isinstance(at, BoundaryLoop):
        return {"loop": at.number}
    if isinstance(at, Curve):
        return {"curve": curve_rows(at), "closed": at.closed}
    return at


def document_from(data: Any, where: str = "document") -> Document:
    """The document that `document_data` has written; ParameterError, with the place, for anything else."""
    readers = {
        "surfaces": listed(_mesh),
        "points": listed(_point),
        "panels": listed(_panel),
        "areas": text,
        "isolines": read_isolines,
        "range": text,
        "shared_range": flag,
        "camera": read_view,
        "zooms": listed(_zoom),
        "anchors": listed(_anchor),
        "weights": _weights,
        "height": number,
        "tool": text,
        "next_id": whole,
        "fields": listed(_field_array),
        "colours": _colours,
        "shading": _shading,
        "up": text,
        "projection": text,
        "axes": flag,
        "pins": listed(_pin),
        "pin_list": _pin_list,
        "profile": _profile,
        "scatter": _scatter,
        "selections": listed(_selection),
        "regions": listed(whole),
        "extrema": flag,
        "docks": listed(text),
        "dock_places": _dock_places,
        "snap": flag,
        "beside": listed(_beside),
        "linked": flag,
        "pairs": listed(_pair),
        "maps": listed(_map_file),
        "truth": _truth,
    }
    values = record(data, where, readers, readers.keys() - LATER.keys() - {"shared_range"})
    return placed(Document, where, **with_range({"up": LATER["up"], **values}))


def with_range(values: dict[str, Any]) -> dict[str, Any]:
    """A document's parts with the range that was once a flag."""
    is_shared = values.pop("shared_range", False)
    return {"range": "shared" if is_shared else "own", **values}


def _mesh(data: Any, where: str) -> MeshFile:
    readers = {"name": text, "path": text, "sha256": text, "change": _change, "pose_sha256": text}
    values = record(data, where, readers, {"name", "path", "sha256"})
    pose = values.pop("pose_sha256", "")
    if pose and not values.get("change", Perturbation()).pose:
        raise ParameterError(f"{where} has the checksum of another pose, and no pose.")
    if pose:
        values["change"] = replace(values["change"], pose_sha256=pose)
    return MeshFile(**values)


def _change(data: Any, where: str) -> Perturbation:
    return placed(change_from_words, where, text=text(data, where))


def _beside(data: Any, where: str) -> Beside:
    return placed(Beside, where, **record(data, where, {"surface": text, "camera": read_view, "up": text}))


def _map_file(data: Any, where: str) -> MapFile:
    return placed(MapFile, where, **record(data, where, {"path": text, "sha256": text}, {"path"}))


def _truth(data: Any, where: str) -> Truth:
    readers = {"word": text, "file": _map_file, "partners": _map_file, "mirror": flag, "samples": whole}
    return placed(Truth, where, **record(data, where, readers, set()))


def _field_array(data: Any, where: str) -> FieldArray:
    return placed(FieldArray, where, **record(data, where, {"name": text, "sha256": text, "surface": text}))


def _point(data: Any, where: str) -> Point:
    readers = {"name": text, "at": or_none(_source), "surface": text, "image_of": text}
    return placed(Point, where, **record(data, where, readers, {"name", "at", "surface"}))


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


def _panel(data: Any, where: str) -> Panel:
    readers = {"id": whole, "shows": quantity_from, "surface": text, "maximum": or_none(number)}
    return placed(Panel, where, **record(data, where, readers))


def _anchor(data: Any, where: str) -> Anchor:
    readers = {"point": text, "value": or_none(number), "left_out": flag, "name": text}
    return placed(Anchor, where, **record(data, where, readers, {"point", "value"}))


def _weights(data: Any, where: str) -> Weights:
    return placed(Weights, where, **record(data, where, {"exponent": number, "smoothness": number}, set()))


def read_isolines(data: Any, where: str) -> Isolines:
    if not isinstance(data, dict):
        return placed(Isolines, where, count=whole(data, where), round=False)
    readers = {
        "count": whole,
        "spacing": or_none(number),
        "values": listed(number),
        "bold": whole,
        "labels": flag,
        "through": listed(text),
        "round": flag,
    }
    return placed(Isolines, where, **{"round": False, **record(data, where, readers, set())})


def _colours(data: Any, where: str) -> Colours:
    readers = {"map": text, "stops": listed(_stop), "reversed": flag, "bands": flag}
    return placed(Colours, where, **record(data, where, readers, set()))


def _stop(data: Any, where: str) -> tuple[float, tuple[float, ...]]:
    if not isinstance(data, list) or len(data) != 2:
        raise ParameterError(f"{where} must be a place and a colour.")
    return number(data[0], f"{where}[0]"), numbers(3)(data[1], f"{where}[1]")


def _shading(data: Any, where: str) -> Shading:
    readers = {"normals": text, "crease": number, "wireframe": flag}
    return placed(Shading, where, **record(data, where, readers, set()))


def _pin(data: Any, where: str) -> Pin:
    return placed(Pin, where, **record(data, where, {"point": text, "name": text, "colour": whole}, {"point"}))


def _pair(data: Any, where: str) -> Pair:
    return placed(Pair, where, **record(data, where, {"first": text, "second": text, "colour": whole}, set()))


def _pin_list(data: Any, where: str) -> PinList:
    readers = {"distance": or_none(read_spec), "shares": flag, "positions": flag}
    return PinList(**record(data, where, readers, set()))


def _profile(data: Any, where: str) -> Profile:
    readers = {"points": listed(text), "way": text, "across": or_none(numbers(3)), "shares": flag}
    return placed(Profile, where, **record(data, where, readers, set()))


def _scatter(data: Any, where: str) -> Scatter:
    readers = {"across": or_none(whole), "up": or_none(whole), "shares": flag}
    return placed(Scatter, where, **record(data, where, readers, set()))


def _dock_places(data: Any, where: str) -> DockPlaces | None:
    readers = {"width": whole, "height": whole, "state": text}
    return None if data is None else placed(DockPlaces, where, **record(data, where, readers, set(readers)))


def _selection(data: Any, where: str) -> Selection:
    readers = {"name": text, "runs": listed(_run), "colour": whole, "surface": text}
    return placed(Selection, where, **record(data, where, readers, {"name", "runs"}))


def _run(data: Any, where: str) -> tuple[int, int]:
    ends = listed(whole)(data, where)
    if len(ends) != 2:
        raise ParameterError(f"{where} must be a first and a last vertex id, not {len(ends)} numbers.")
    return ends


def read_view(data: Any, where: str) -> View:
    """A standard view's name or a camera."""
    if isinstance(data, str):
        return data
    sizes = {"position": 3, "focal_point": 3, "up": 3, "extent": 2}
    return placed(Camera, where, **record(data, where, {name: numbers(count) for name, count in sizes.items()}))


def _zoom(data: Any, where: str) -> Zoom:
    readers = {"vertex": whole, "factor": number, "corner": text, "isolines": or_none(whole)}
    return placed(Zoom, where, **record(data, where, readers, {"vertex"}))
