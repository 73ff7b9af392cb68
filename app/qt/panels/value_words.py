"""What an answer says of a vertex, in words."""

import numpy as np

from bihdist_core.distances.answers import Answer

from ...document.quantities import Quantity
from ..look.numbers import number, percent, share

NOT_CONNECTED, UNDEFINED = "not connected to the source", "undefined here"
NOWHERE = "mapped nowhere"


def value_words(answer: Answer | None, vertex: int | None, shows: Quantity) -> tuple[str, str]:
    """A value and its fraction of the maximum, or where a map leads; empty where there is nothing to say."""
    if answer is None or vertex is None:
        return "", ""
    if answer.leads_to is not None:
        image = int(answer.leads_to[vertex])
        return (f"→ {image}" if image >= 0 else NOWHERE), ""
    if answer.field is None:
        return "", ""
    value = float(answer.field[vertex])
    if np.isnan(value):
        return (NOT_CONNECTED if shows.points else UNDEFINED), ""
    if answer.is_signed:
        return number(value, signed=True) + percent(answer.unit), ""
    return number(value), share(value / answer.maximum) if answer.maximum > 0 else ""


def copied_words(answer: Answer | None, vertex: int, shows: Quantity) -> str:
    """The same in a line, with what it is, for the clipboard."""
    if answer is None:
        return ""
    value, part = value_words(answer, vertex, shows)
    unit = "" if percent(answer.unit) else answer.unit
    sentence = f"{answer.label}: {value} {unit}{f' ({part})' if part else ''}"
    return sentence.strip()
