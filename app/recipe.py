"""A figure's recipe: all that was chosen, as plain data that can be written down, read back and drawn again."""

import hashlib
import json
import math
import os
from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from bihdist_core import ParameterError
from bihdist_core.distances.kinds import Parameter, Spec, kind_of

FORMAT = 1
"""Goes up when a recipe could not be understood by older programs."""

PROGRAM = "bihdist"

AREAS = ("voronoi", "barycentric")


@dataclass(frozen=True)
class RecipePanel:
    """One panel: a distance, the vertex it starts from, and the end of its colour bar (its own maximum if None).

    A source of None stands for `session.first_source`, until the mesh is read.
    """

    spec: Spec
    source: int | None
    maximum: float | None = None


@dataclass(frozen=True)
class RecipeCamera:
    """A camera's numbers; see `camera.Camera`."""

    position: tuple[float, ...]
    focal_point: tuple[float, ...]
    up: tuple[float, ...]
    extent: tuple[float, ...]


@dataclass(frozen=True)
class RecipeZoom:
    """An inset; see `figures.Zoom`."""

    vertex: int
    factor: float = 3.0
    corner: str = "auto"


@dataclass(frozen=True)
class Recipe:
    """Everything a figure is made of.

    mesh: a path or the name of a sample; sha256: of the file's bytes.  anchors: marked vertices, each with a value or
    None.  height: as `figures.FigurePanel` has it.  size: as it is written, "" for the usual one.
    """

    mesh: str
    panels: tuple[RecipePanel, ...]
    sha256: str = ""
    areas: str = "voronoi"
    isolines: int = 20
    shared_range: bool = False
    views: tuple[str | RecipeCamera, ...] = ("home",)
    zooms: tuple[RecipeZoom, ...] = ()
    anchors: tuple[tuple[int, float | None], ...] = ()
    height: float = 0.0
    hints: bool = True
    columns: int | None = None
    size: str = ""
    style: str = "paper"
    transparent: bool = False
    crop: bool = False
    made_with: str = field(default="", compare=False)


def checksum(path: str | os.PathLike[str]) -> str:
    """The SHA-256 of a file's bytes; ParameterError if it cannot be read."""
    try:
        with open(path, "rb") as file:
            digest = hashlib.sha256()
            while block := file.read(1 << 20):
                digest.update(block)
    except OSError as error:
        raise ParameterError(f"{path} cannot be read: {error.strerror or error}.") from None
    return digest.hexdigest()


# ---------------------------------------------------------------------- writing
def recipe_text(recipe: Recipe, version: str) -> str:
    """The recipe as JSON."""
    data: dict[str, Any] = {"format": FORMAT, "program": f"{PROGRAM} {version}"}
    data["mesh"] = {"path": recipe.mesh, "sha256": recipe.sha256}
    data["areas"] = recipe.areas
    data["panels"] = [_panel_data(panel) for panel in recipe.panels]
    data["views"] = [v if isinstance(v, str) else _plain(v) for v in recipe.views]
    data["zooms"] = [_plain(zoom) for zoom in recipe.zooms]
    data["anchors"] = [{"vertex": v, "value": value} for v, value in recipe.anchors]
    for name in ("isolines", "shared_range", "height", "hints", "columns", "size", "style", "transparent", "crop"):
        data[name] = getattr(recipe, name)
    return json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def _panel_data(panel: RecipePanel) -> dict[str, Any]:
    return {"distance": panel.spec.word, **dict(panel.spec.values), "source": panel.source, "maximum": panel.maximum}


def _plain(record: RecipeCamera | RecipeZoom) -> dict[str, Any]:
    values = {f.name: getattr(record, f.name) for f in fields(record)}
    return {name: list(value) if isinstance(value, tuple) else value for name, value in values.items()}


def mesh_reference(mesh: str, recipe_path: str | os.PathLike[str]) -> str:
    """How a recipe at a path names a mesh: from its own folder where it can, so that both may move together."""
    if not os.path.exists(mesh):
        return mesh  # a sample's name
    try:
        return Path(os.path.relpath(mesh, Path(recipe_path).resolve().parent)).as_posix()
    except ValueError:  # on another drive
        return str(Path(mesh).resolve())


# ---------------------------------------------------------------------- reading
def read_recipe(path: str | os.PathLike[str]) -> Recipe:
    """Read a recipe; its mesh is then a path from here, or a sample's name.

    Raises ParameterError, with a sentence that names the file and what is wrong.
    """
    try:
        data = json.loads(Path(path).read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise ParameterError(f"The recipe {path} cannot be read: {error.strerror or error}.") from None
    except (ValueError, RecursionError):
        raise ParameterError(f"{path} is not a recipe: it is not JSON.") from None
    try:
        recipe = _recipe(data)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None
    beside = Path(path).parent / recipe.mesh
    # os.path, which takes a path that is too long for one that is not there.
    return replace(recipe, mesh=str(beside)) if os.path.exists(beside) else recipe


def is_recipe(path: str | os.PathLike[str]) -> bool:
    """Whether a file is a recipe, perhaps of another version: whether it may be replaced by one."""
    try:
        data = json.loads(Path(path).read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError):
        return False
    return isinstance(data, dict) and str(data.get("program", "")).startswith(PROGRAM) and "format" in data


def _recipe(data: Any) -> Recipe:
    if not isinstance(data, dict) or "format" not in data or "panels" not in data:
        raise ParameterError("this is not a recipe: it has no format and panels.")
    version = _whole(data["format"], "format")
    made_with = _text(data.get("program", ""), "program")
    if version > FORMAT:
        raise ParameterError(
            f"the recipe was made by a newer program ({made_with or 'unknown'}, format {version}); "
            f"this one reads format {FORMAT}."
        )
    readers: dict[str, Callable[[Any, str], Any]] = {
        "areas": _one_of(AREAS),
        "panels": _list(_panel),
        "views": _list(_view),
        "zooms": _list(_zoom),
        "anchors": _list(_anchor),
        "isolines": _whole,
        "shared_range": _flag,
        "height": _number,
        "hints": _flag,
        "columns": _or_none(_whole),
        "size": _text,
        "style": _text,
        "transparent": _flag,
        "crop": _flag,
    }
    _check_keys(data, {"format", "program", "mesh", *readers}, "the recipe")
    if "mesh" not in data:
        raise ParameterError("the recipe names no mesh.")
    mesh = _record(data["mesh"], "mesh", {"path": _text, "sha256": _text}, {"path"})
    if not mesh["path"]:
        raise ParameterError("the recipe names no mesh.")
    values = {name: read(data[name], name) for name, read in readers.items() if name in data}
    return Recipe(mesh=mesh["path"], sha256=mesh.get("sha256", ""), made_with=made_with, **values)


def _panel(data: Any, where: str) -> RecipePanel:
    word = data.get("distance") if isinstance(data, dict) else None
    try:
        kind = kind_of(_text(word, f"{where}.distance"))
        own = {p.name: _parameter(p) for p in kind.parameters}
        readers = {"distance": _text, "source": _whole, "maximum": _or_none(_positive), **own}
        values = _record(data, where, readers, {"distance", "source"})
        spec = Spec.of(kind.word, **{name: values[name] for name in own if name in values})
    except ParameterError as error:
        raise ParameterError(str(error) if where in str(error) else f"{where}: {error}") from None
    return RecipePanel(spec, values["source"], values.get("maximum"))


def _parameter(parameter: Parameter) -> Callable[[Any, str], Any]:
    def reader(data: Any, where: str) -> Any:
        try:
            return parameter.checked(data)
        except ParameterError as error:
            raise ParameterError(f"{where}: {error}") from None

    return reader


def _view(data: Any, where: str) -> str | RecipeCamera:
    if isinstance(data, str):
        return data
    sizes = {"position": 3, "focal_point": 3, "up": 3, "extent": 2}
    readers = {name: _numbers(count) for name, count in sizes.items()}
    return RecipeCamera(**_record(data, where, readers, set(sizes)))


def _zoom(data: Any, where: str) -> RecipeZoom:
    return RecipeZoom(**_record(data, where, {"vertex": _whole, "factor": _positive, "corner": _text}, {"vertex"}))


def _anchor(data: Any, where: str) -> tuple[int, float | None]:
    values = _record(data, where, {"vertex": _whole, "value": _or_none(_number)}, {"vertex"})
    return values["vertex"], values.get("value")


# ---------------------------------------------------------------------- single values
def _record(data: Any, where: str, readers: dict[str, Callable], needed: set[str]) -> dict[str, Any]:
    if not isinstance(data, dict):
        raise ParameterError(f"{where} must be a record in braces, not {_shown(data)}.")
    _check_keys(data, set(readers), where)
    missing = sorted(needed - set(data))
    if missing:
        raise ParameterError(f"{where} has no {missing[0]!r}.")
    return {name: readers[name](value, f"{where}.{name}") for name, value in data.items()}


def _check_keys(data: dict, known: set[str], where: str) -> None:
    unknown = sorted(set(data) - known)
    if unknown:
        raise ParameterError(f"{where} has the unknown key {unknown[0]!r}.")


def _list(read: Callable[[Any, str], Any]) -> Callable[[Any, str], tuple]:
    def reader(data: Any, where: str) -> tuple:
        if not isinstance(data, list):
            raise ParameterError(f"{where} must be a list, not {_shown(data)}.")
        return tuple(read(value, f"{where}[{k}]") for k, value in enumerate(data))

    return reader


def _numbers(count: int) -> Callable[[Any, str], tuple]:
    def reader(data: Any, where: str) -> tuple:
        values = _list(_number)(data, where)
        if len(values) != count:
            raise ParameterError(f"{where} must be {count} numbers, not {len(values)}.")
        return values

    return reader


def _or_none(read: Callable[[Any, str], Any]) -> Callable[[Any, str], Any]:
    return lambda data, where: None if data is None else read(data, where)


def _one_of(words: tuple[str, ...]) -> Callable[[Any, str], str]:
    def reader(data: Any, where: str) -> str:
        if data not in words:
            raise ParameterError(f"{where} must be one of {', '.join(words)}, not {_shown(data)}.")
        return data

    return reader


def _text(data: Any, where: str) -> str:
    if not isinstance(data, str):
        raise ParameterError(f"{where} must be a text, not {_shown(data)}.")
    return data


def _flag(data: Any, where: str) -> bool:
    if not isinstance(data, bool):
        raise ParameterError(f"{where} must be true or false, not {_shown(data)}.")
    return data


def _whole(data: Any, where: str) -> int:
    if not isinstance(data, int) or isinstance(data, bool) or data < 0:
        raise ParameterError(f"{where} must be a whole number of at least 0, not {_shown(data)}.")
    return data


def _number(data: Any, where: str) -> float:
    if isinstance(data, bool) or not isinstance(data, int | float) or not math.isfinite(data):
        raise ParameterError(f"{where} must be a number, not {_shown(data)}.")
    return float(data)


def _positive(data: Any, where: str) -> float:
    if _number(data, where) <= 0:
        raise ParameterError(f"{where} must be a number above 0, not {_shown(data)}.")
    return float(data)


def _shown(data: Any) -> str:
    text = json.dumps(data, ensure_ascii=False)
    return text if len(text) <= 40 else f"{text[:37]}..."
