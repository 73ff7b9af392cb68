"""Recipes of format 1, as version 0.1 wrote them: each panel names its source, and looks stand beside the content."""

from typing import Any

from bihdist_core.distances.kinds import Parameter, Spec, kind_of
from bihdist_core.errors import ParameterError

from .document import Anchor, Document, MeshFile, Panel, Point
from .form import read_isolines, read_view, read_zoom, with_range
from .json_values import Reader, flag, listed, number, or_none, placed, record, text, whole
from .looks import Isolines
from .page import Page, Recipe
from .quantities import DistanceFrom

DOCUMENT = {
    "areas": text,
    "zooms": listed(read_zoom),
    "isolines": read_isolines,
    "shared_range": flag,
    "height": number,
}
PAGE: dict[str, Reader] = {
    "hints": flag,
    "columns": or_none(whole),
    "size": text,
    "style": text,
    "transparent": flag,
    "crop": flag,
}


def recipe_of_format_1(data: dict[str, Any]) -> Recipe:
    """The recipe that JSON of format 1 means; ParameterError, with the place, for what is wrong in it."""
    readers: dict[str, Reader] = {
        "format": whole,
        "program": text,
        "mesh": _mesh,
        "panels": listed(_panel),
        "views": listed(read_view),
        "anchors": listed(_anchor),
        **DOCUMENT,
        **PAGE,
    }
    values = record(data, "the recipe", readers, {"format", "panels"})
    mesh = values.get("mesh")
    if mesh is None or not mesh.path:
        raise ParameterError("the recipe names no mesh.")
    sources = dict.fromkeys(source for _, source, _ in values["panels"])
    names = {source: f"source {k}" if k > 1 else "source" for k, source in enumerate(sources, 1)}
    anchors = values.get("anchors", ())
    views = values.get("views") or ("home",)
    document = placed(
        Document,
        "the recipe",
        surfaces=(mesh,),
        points=(
            *(Point(name, source) for source, name in names.items()),
            *(Point(f"anchor {k}", vertex) for k, (vertex, _) in enumerate(anchors, 1)),
        ),
        panels=tuple(
            placed(Panel, f"panels[{k}]", id=k, shows=DistanceFrom(spec, names[source]), maximum=maximum)
            for k, (spec, source, maximum) in enumerate(values["panels"])
        ),
        anchors=tuple(Anchor(f"anchor {k}", value) for k, (_, value) in enumerate(anchors, 1)),
        camera=views[0],
        next_id=len(values["panels"]),
        **{
            "isolines": Isolines(round=False),
            **with_range({name: values[name] for name in DOCUMENT if name in values}),
        },
        up="y",
    )
    page = {"hints": True, **{name: values[name] for name in PAGE if name in values}}
    return Recipe(document, placed(Page, "the recipe", views=views if len(views) > 1 else (), **page))


def _mesh(data: Any, where: str) -> MeshFile:
    return MeshFile("A", **record(data, where, {"path": text, "sha256": text}, {"path"}))


def _panel(data: Any, where: str) -> tuple[Spec, int, float | None]:
    word = data.get("distance") if isinstance(data, dict) else None
    kind = placed(kind_of, where, word=text(word, f"{where}.distance"))
    own: dict[str, Reader] = {p.name: _parameter(p) for p in kind.parameters}
    readers: dict[str, Reader] = {"distance": text, "source": whole, "maximum": or_none(number), **own}
    values = record(data, where, readers, {"distance", "source"})
    spec = Spec.of(kind.word, **{name: values[name] for name in own if name in values})
    return spec, values["source"], values.get("maximum")


def _parameter(parameter: Parameter) -> Reader:
    return lambda data, where: placed(parameter.checked, where, value=data)


def _anchor(data: Any, where: str) -> tuple[int, float | None]:
    values = record(data, where, {"vertex": whole, "value": or_none(number)}, {"vertex"})
    return values["vertex"], values.get("value")
