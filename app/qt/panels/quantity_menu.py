"""The menu of what a panel can show: distances, the user's own fields, and differences of two."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial

from qtpy import QtWidgets

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.signature_types import SIGNATURES, SignatureSpec
from bihdist_core.distances.distance_types import (
    DistanceType,
    Parameter,
    Spec,
    Value,
    distance_type,
    distance_types,
    limited,
)

from ...document.quantities import (
    Difference,
    DistanceFrom,
    OwnField,
    Quantity,
    VertexSignature,
    kind_name,
    quantity_kinds,
    quantity_name,
)
from .parameters import empty_menu, tick

RAW_WORDS: dict[Value, str] = {False: "fractions of the maximum", True: "in units"}
"""How the two ways to subtract are called, by `Difference.raw`."""


def offered_kinds() -> list[DistanceType]:
    """Return the distances that there are."""
    found = []
    for word in distance_types():
        with suppress(ParameterError):  # somebody else's that cannot be loaded; asked for by its word it says why
            found.append(distance_type(word))
    return found


class Choices:
    """Choices of quantities as pure steps from one to the next; each distance keeps the parameters it had last."""

    def __init__(self) -> None:
        self.fields: tuple[str, ...] = ()
        self.surface: Surface | None = None  # where parameters have their bounds
        self.has_other = False  # whether there is another surface, with points to be found on this one
        self._before: tuple[dict[str, Spec], dict[str, Spec]] = ({}, {})

    def keep(self, shows: Quantity) -> None:
        """Remember the parameters of what is shown, for each place of a difference."""
        for before, part in zip(self._before, shows.parts, strict=False):
            for spec in part.parametrised:
                before[spec.word] = spec

    def bounded(self, parameter: Parameter) -> Parameter:
        """Return a parameter with the values that it can have on the surface."""
        return parameter if self.surface is None else limited(parameter, self.surface)

    def with_part(self, shows: Quantity, place: int, chosen: str | OwnField) -> Quantity:
        """Return the quantity with another distance or signature, by its word, or another field at a place."""
        parts = list(shows.parts)
        # Where distances start, nobody chooses here.
        point = [*parts[place].points, *shows.points, "source"][0]
        now, found = parts[place], self._part(chosen, place, point)
        # What is made by a distance goes over to another.
        parts[place] = now.with_spec(found.specs[0]) if now.done and found.is_distance else found
        return shows.with_parts(tuple(parts))

    def difference(self, shows: Quantity, chosen: str | OwnField) -> Difference:
        """Return the difference of what is shown and another quantity."""
        return Difference(shows, self._part(chosen, 1, [*shows.points, "source"][0]))

    def _part(self, chosen: str | OwnField, place: int, point: str) -> Quantity:
        if isinstance(chosen, OwnField):
            return chosen
        spec = self._before[place].get(chosen) or (SignatureSpec if chosen in SIGNATURES else Spec).of(chosen)
        if isinstance(spec, SignatureSpec):
            return VertexSignature(spec)
        return DistanceFrom(spec if self.surface is None else spec.limited_to(self.surface), point)


def fill_menu(menu: QtWidgets.QMenu, shows: Quantity, choices: Choices, choose: Callable[[Quantity], None]) -> None:
    """Make the entries; `choose` is called with the quantity that one stands for."""
    empty_menu(menu)

    def choose_part(place: int, chosen: str | OwnField) -> None:
        choose(choices.with_part(shows, place, chosen))

    if isinstance(shows, Difference):
        for place, (word, part) in enumerate(zip(("First", "Second"), shows.parts, strict=True)):
            inner = menu.addMenu(_plain(f"{word}: {part.heading}"))
            _add_parts(inner, choices, part, partial(choose_part, place))
        _fill_for_difference(menu, shows, choose)
        return
    if shows.done:
        for each in shows.choices:
            tick(_add(menu, each.words, each.tip, partial(choose, each.shows)), each.is_shown)
        if shows.choices:
            menu.addSeparator()
        (spec,) = shows.specs
        _add_parts(menu.addMenu(_plain(f"By {kind_name(spec.distance_type)}")), choices, shows, partial(choose_part, 0))
        _add(menu, "Show the distance", "", partial(choose, DistanceFrom(spec)))
        return
    _add_parts(menu, choices, shows, partial(choose_part, 0))
    menu.addSeparator()
    offered = [kind.choice_by(shows.specs[0], choices.has_other) for kind in quantity_kinds() if shows.is_distance]
    for each in filter(None, offered):
        _add(menu, each.words, each.tip, partial(choose, each.shows))
    if shows.is_map:
        return  # of colours there are no differences

    def can_differ(part: Quantity) -> bool:
        """Return whether the difference with a part is not zero everywhere."""
        return part.word != shows.word or any(spec.values for spec in part.parametrised)

    inner = menu.addMenu("Difference with")
    _add_parts(inner, choices, None, lambda chosen: choose(choices.difference(shows, chosen)), can_differ)


def _fill_for_difference(menu: QtWidgets.QMenu, shows: Difference, choose: Callable[[Quantity], None]) -> None:
    swapped = Difference(shows.subtrahend, shows.minuend, shows.raw)
    _add(menu, "Swap them", f"Show {quantity_name(swapped)}", partial(choose, swapped))
    menu.addSeparator()
    for raw, words in RAW_WORDS.items():
        tip = "As they are, where both have the same units" if raw else "Each as a fraction of its own maximum"
        entry = _add(menu, f"{words[0].upper()}{words[1:]}", tip, partial(choose, replace(shows, raw=bool(raw))))
        tick(entry, raw == shows.raw)
    menu.addSeparator()
    _add(menu, "Show the first alone", f"Show {shows.minuend.heading}", partial(choose, shows.minuend))


def _add_parts(
    menu: QtWidgets.QMenu,
    choices: Choices,
    now: Quantity | None,
    choose: Callable[[str | OwnField], None],
    is_offered: Callable[[Quantity], bool] = lambda part: True,
) -> None:
    """Add an entry for every distance, then for every signature, then for every field."""
    menu.setToolTipsVisible(True)
    for kind in offered_kinds():
        if is_offered(DistanceFrom(Spec.of(kind.word))):
            action = _add(menu, kind_name(kind), f"{kind.hint[:1].upper()}{kind.hint[1:]}", partial(choose, kind.word))
            tick(action, now is not None and bool(now.specs) and now.specs[0].word == kind.word)
            if kind.word == "geodesic" and choices.surface is not None and not len(choices.surface.faces):
                action.setEnabled(False)
                action.setToolTip("Geodesic distance needs faces, and points have none")
    menu.addSeparator()
    for word, row in SIGNATURES.items():
        if is_offered(VertexSignature(SignatureSpec.of(word))):
            action = _add(menu, row.name, f"{row.hint[:1].upper()}{row.hint[1:]}", partial(choose, word))
            tick(action, now is not None and now.word == word)
    fields = [field for field in map(OwnField, choices.fields) if is_offered(field)]
    if fields:
        menu.addSeparator()
    for field in fields:
        tick(_add(menu, field.name, "A field of your own", partial(choose, field)), field == now)


def _add(menu: QtWidgets.QMenu, text: str, tip: str, choose: Callable[[], None]) -> QtWidgets.QAction:
    action = menu.addAction(_plain(text))
    action.setToolTip(tip)
    action.triggered.connect(lambda *_: choose())
    return action


def _plain(text: str) -> str:
    """Return a text in which "&" stands for itself."""
    return text.replace("&", "&&")
