"""What a command hands back: its result as plain values, which `--json` prints, and its exit status."""

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from ..version import version

if TYPE_CHECKING:
    from bihdist_core import Distance
    from bihdist_core.distances.accuracy import ErrorEstimate
    from bihdist_core.distances.answers import Answer

Facts = dict[str, Any]


@dataclass(frozen=True)
class Result:
    """facts: by names in snake_case, those of the library's attributes where it has them; arrays and numbers of NumPy's
    may be among them.  ends_process: whether the process is to end at once when this has been printed."""

    facts: Facts = field(default_factory=dict)
    status: int = 0
    ends_process: bool = False


def as_json(command: str, status: int, facts: Mapping[str, Any]) -> str:
    """One object, in ASCII, so that any standard output takes it."""
    about = {"command": command, "version": version(), "exit_status": status}
    return json.dumps({**about, **_plain(facts)}, indent=2, allow_nan=False)


def _plain(value: Any) -> Any:
    """What JSON knows: null for what is not finite."""
    if isinstance(value, Mapping):
        return {str(name): _plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if hasattr(value, "tolist"):  # of NumPy
        return _plain(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value


def distance_facts(distance: "Distance", spec: object, everywhere: bool = False) -> Facts:
    """What is said of a distance that something was computed by.

    spec: as it was asked for.  everywhere: its accuracy on all components, also those not asked about.
    """
    estimate = distance.error_estimate(range(distance.surface.n_components) if everywhere else None)
    return {"distance": str(spec), "label": distance.label, "unit": distance.unit, **accuracy_facts(estimate)}


def accuracy_facts(estimate: "ErrorEstimate") -> Facts:
    """The accuracy as a fraction of the maximum, None where it is not known, and in words."""
    return {"accuracy": estimate.share, "accuracy_text": estimate.text}


def panel_facts(shows: object, answer: "Answer") -> Facts:
    """What is said of a field that is drawn: the failure in words, or nothing."""
    return {
        "distance": str(shows),
        "label": answer.label,
        "unit": answer.unit,
        "maximum": answer.maximum,
        **accuracy_facts(answer.accuracy),
        "failure": answer.failure,
    }


def facts_of(record: Any, *names: str) -> Facts:
    """Some attributes of a result of the library's, or all fields of one that is a dataclass."""
    return {name: getattr(record, name) for name in names} if names else asdict(record)
