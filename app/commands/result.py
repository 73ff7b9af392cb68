"""The result of a command: plain values, which `--json` prints, and the exit status."""

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
    """Facts by names in snake_case, those of the library's attributes where it has them; NumPy arrays may be among
    them.

    With `ends_process` the process ends at once when they have been printed.
    """

    facts: Facts = field(default_factory=dict)
    status: int = 0
    ends_process: bool = False


def as_json(command: str, status: int, facts: Mapping[str, Any]) -> str:
    """Return one JSON object in ASCII, which any standard output takes."""
    about = {"command": command, "version": version(), "exit_status": status}
    return json.dumps({**about, **_plain(facts)}, indent=2, allow_nan=False)


def _plain(value: Any) -> Any:
    """Return a value for JSON, with null for numbers that are not finite."""
    if isinstance(value, Mapping):
        return {str(name): _plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if hasattr(value, "tolist"):  # of NumPy
        return _plain(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value


def distance_facts(distance: "Distance", spec: object, everywhere: bool = False) -> Facts:
    """Return the facts about a distance that was asked for as `spec`.

    With `everywhere` its accuracy is that on all components, also on those not asked about.
    """
    estimate = distance.error_estimate(range(distance.surface.n_components) if everywhere else None)
    return {"distance": str(spec), "label": distance.label, "unit": distance.unit, **accuracy_facts(estimate)}


def accuracy_facts(estimate: "ErrorEstimate") -> Facts:
    """Return the accuracy as a fraction of the maximum, in words, and from how many vertices it was measured."""
    return {"accuracy": estimate.share, "accuracy_text": estimate.text, "accuracy_sources": estimate.sources}


def panel_facts(shows: object, answer: "Answer") -> Facts:
    """Return the facts about a field that is drawn, with its failure in words, or ""."""
    return {
        "distance": str(shows),
        "label": answer.label,
        "unit": answer.unit,
        "maximum": answer.maximum,
        **accuracy_facts(answer.accuracy),
        "failure": answer.failure,
    }


def facts_of(record: Any, *names: str) -> Facts:
    """Return some attributes of a result of the library, or all fields of a dataclass."""
    return {name: getattr(record, name) for name in names} if names else asdict(record)
