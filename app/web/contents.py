"""Contents of a page: the distances of a document under the page's names, and sentences on what it cannot compute."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from bihdist_core.counts import counted
from bihdist_core.distances.distance_types import BUILT_IN, Spec
from bihdist_core.errors import ParameterError
from bihdist_core.sentences import with_and
from bihdist_core.sources.words import short_words_of

from ..document.document import Document, Panel
from ..document.on_surface import SOURCE, Hidden
from ..document.quantities import DistanceFrom, OwnField, Quantity, own_fields
from ..document.shared_parts.pins import Pins

KNOWN = ", ".join(each.word for each in BUILT_IN if each.on_pages)
KNOWN += " distance (geodesic exact), and differences of two of them"


@dataclass(frozen=True)
class Contents:
    """The distances that a page computes.

    Attributes
    ----------
    document
        The document, with geodesic distances that are exact.
    fields
        Distances by the solver's names; of two truncated ones the second is "truncated_2". By poles it is the word with
        the parameter, "diffusion@0.25".
    """

    document: Document
    fields: dict[str, Spec]

    @classmethod
    def of(cls, document: Document) -> Contents:
        """Return the contents of a page for a document; raise ParameterError if it cannot show all panels."""
        if not document.panels:
            raise ParameterError("There is nothing to show on a page; add a panel.")
        if len(document.surfaces) != 1:
            raise ParameterError(
                f"A page that computes has one mesh, and here are {len(document.surfaces)}; make a page of each."
            )
        for number, panel in enumerate(document.panels, 1):
            _check_panel(document, panel, f"Panel {number} ({panel.shows})")
        _check_source(document)
        panels = tuple(replace(panel, shows=_exact(panel.shows)) for panel in document.panels)
        specs = dict.fromkeys(spec for panel in panels for spec in panel.shows.specs)
        return cls(replace(document, panels=panels), _named(specs))

    def name_of(self, shows: Quantity) -> str:
        """Return the solver's name of a distance, or the word of a field of the user's own."""
        if isinstance(shows, OwnField):
            return shows.word
        return next(name for name, each in self.fields.items() if (each,) == shows.specs)

    def without_geodesic(self, name: str) -> tuple[Contents, list[str]]:
        """Return the contents on a mesh of this name without faces, and a sentence on panels that need them."""
        panels = self.document.panels
        kept = tuple(panel for panel in panels if all(spec.word != "geodesic" for spec in panel.shows.specs))
        if not kept:
            raise ParameterError(f"{name}: geodesic distance needs faces, and there are none.")
        if kept == panels:
            return self, []
        gone = counted(len(panels) - len(kept), "panel")
        note = f"The page leaves out {gone} with geodesic distance: {name} has no faces."
        return Contents.of(replace(self.document, panels=kept)), [note]

    @property
    def own(self) -> tuple[OwnField, ...]:
        """The fields of the user's own in the panels."""
        return tuple(dict.fromkeys(field for panel in self.document.panels for field in own_fields(panel.shows)))

    @property
    def by_eigenpairs(self) -> dict[str, Spec]:
        """The fields whose distances need eigenpairs."""
        return {name: spec for name, spec in self.fields.items() if spec.distance_type.on_pages == "eigenpairs"}

    def with_offered(self, specs: Iterable[Spec]) -> dict[str, Spec]:
        """Return the distances by the solver's names, with further ones that readers can choose."""
        return _named(dict.fromkeys([*self.fields.values(), *specs]))

    @property
    def source(self) -> int | None:
        """The vertex from which all distances start, once the document is settled; None without a distance."""
        at = next(iter(self.document.sources), None)
        assert at is None or isinstance(at, int)  # the surface has put it somewhere
        return at


def _check_panel(document: Document, panel: Panel, which: str) -> None:
    for part in panel.shows.parts:
        if isinstance(part, OwnField):
            continue
        if not isinstance(part, DistanceFrom) or not part.spec.distance_type.on_pages:
            raise ParameterError(
                f"{which} cannot be on a page that computes, which has {KNOWN}; leave it out, or draw it with "
                "bihdist figure."
            )
        if part.spec.word == "geodesic" and part.spec["method"] not in ("auto", "exact"):
            raise ParameterError(
                f"{which} is not exact: geodesic distances on a page are; say geodesic(method=exact), or leave it out."
            )


def _check_source(document: Document) -> None:
    if len(document.sources) > 1:
        raise ParameterError(
            f"The panels start from {len(document.sources)} sources, and a page has one, which a click "
            "moves; choose one of them."
        )
    at = next(iter(document.sources), None)
    if at is not None and not isinstance(at, int):
        raise ParameterError(
            f"The panels start from {short_words_of(at)}, and a page starts from one vertex; choose one with "
            "--sources, or by a click in the window that snaps to vertices."
        )


def _exact(shows: Quantity) -> Quantity:
    """Return a quantity with exact geodesic distances for "auto", as a page knows no others."""

    def made_exact(part: Quantity) -> Quantity:
        is_geodesic = any(spec.word == "geodesic" for spec in part.specs)
        return part.with_spec(part.specs[0].changed(method="exact")) if is_geodesic else part

    return shows.with_parts(tuple(map(made_exact, shows.parts)))


def _named(specs: Iterable[Spec]) -> dict[str, Spec]:
    found: dict[str, Spec] = {}
    for spec in specs:
        name = spec.word.replace("-", "_")
        count = sum(each.word == spec.word for each in found.values())
        if spec.distance_type.on_pages == "poles":
            name += f"@{spec.values[0][1]}"
        elif count:
            name += f"_{count + 1}"
        found[name] = spec
    return found


def notes_on(document: Document, page_views: int) -> list[str]:
    """Return sentences on what a page leaves out of a document; page_views is the number of views in its figure."""
    lines, colours, shading = document.isolines, document.colours, document.shading
    left_out = {
        "isolines through points": bool(lines.through),
        "bold isolines": bool(lines.bold),
        "the values of isolines": lines.labels,
        "bands of one colour": colours.bands,
        "the base in grey": bool(document.base.scalars),
        "insets": bool(document.insets),
        "the triangles at extrema": document.extrema,
        "the height of a height field": bool(document.warp_factor),
        "the wireframe": shading.show_edges,
        "directions of axes": document.axes,
        "the scale bar": document.scale_bar,
        "views but the first": page_views > 1,
        "what tools mark, but for pins": any(not isinstance(part, Pins | Hidden) for part in document.parts),
        "that the source is hidden": SOURCE in document[Hidden].hidden,
    }
    words = [name for name, is_there in left_out.items() if is_there]
    return [f"The page leaves out {with_and(words)}."] if words else []
