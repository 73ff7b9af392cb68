"""Words on an answer: at the colour bar, beside the pointer, and on the clipboard."""

import numpy as np

from bihdist_core.distances.answers import Answer

from ...document.quantities import Quantity
from ...drawing.numbers import number, percent, share
from ...scene.field_actor import FieldActor
from .bar_layout import Reading

NOT_CONNECTED, UNDEFINED = "not connected to the source", "undefined here"
NOWHERE = "mapped nowhere"
NO_LABEL = "no label"


def value_words(answer: Answer | None, vertex: int | None, shows: Quantity) -> tuple[str, str]:
    """Return a value and its fraction of the maximum, or where a map leads; empty where there is nothing to say.

    Of a field with values on both sides of 0, the second says where it is the largest.
    """
    if answer is None or vertex is None:
        return "", ""
    if answer.labels is not None:
        return answer.labels.name_at(vertex) or NO_LABEL, ""
    if answer.leads_to is not None:
        image = int(answer.leads_to[vertex])
        return (f"→ {image}" if image >= 0 else NOWHERE), ""
    if answer.field is None:
        return "", ""
    value = float(answer.field[vertex])
    if np.isnan(value):
        return (NOT_CONNECTED if shows.points else UNDEFINED), ""
    if answer.is_signed:
        return number(value, signed=True) + percent(answer.unit), "largest" if vertex == answer.largest else ""
    return number(value), share(value / answer.maximum) if answer.maximum > 0 else ""


def copied_words(answer: Answer | None, vertex: int, shows: Quantity) -> str:
    """Return the same in a line, with what it is, for the clipboard."""
    if answer is None:
        return ""
    value, part = value_words(answer, vertex, shows)
    unit = "" if percent(answer.unit) else answer.unit
    sentence = f"{answer.label}: {value} {unit}{f' ({part})' if part else ''}"
    return sentence.strip()


def reading_of(answer: Answer, actor: FieldActor, in_shares: bool) -> Reading:
    """Return the words of the colour bar on an answer with a field, as an actor draws it.

    If `in_shares`, ticks are fractions of the maximum.
    """
    top, signed, lines = actor.maximum, answer.is_signed, actor.levels
    values = lines.values
    return Reading(
        -top if signed else 0.0,
        top,
        tuple(values.tolist()),
        answer.unit,
        signed,
        answer.maximum,
        has_shares=not signed,
        notes=_notes(answer, actor),
        in_shares=in_shares,
        bold=frozenset(values[lines.is_bold].tolist()),
        through=frozenset(values[lines.is_through].tolist()),
    )


def _notes(answer: Answer, actor: FieldActor) -> tuple[str, ...]:
    """Return a remark that stands in the place of the maximum, from the longest words to the shortest."""
    if sentence := answer.largest_words:
        place = sentence.partition(":")[0]
        return sentence, place, place.partition(" at vertex")[0]
    if answer.field is not None and answer.largest is not None:
        value = float(answer.field[answer.largest])
        return (f"largest {number(value, signed=True)} at vertex {answer.largest}",)
    return (f"no isolines: {actor.levels.wanted:,} are too many",) if actor.too_many else ()
