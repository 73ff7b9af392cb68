"""All statements that the experiments judge, in the paper's order: see the two tables for their rules."""

from ._stated_claims import CLAIMS
from ._stated_figures import FIGURES
from .verdicts import Statement

ORDER = (*(f"fig{k}" for k in range(1, 11)), "table1", "table2", "alpha", "claims")
"""The experiments, as the page has them."""

STATEMENTS: dict[str, Statement] = {
    statement.id: statement
    for statement in sorted((*FIGURES, *CLAIMS), key=lambda s: ORDER.index(s.id.partition("-")[0]))
}
"""By their ids: an experiment's id, a hyphen, and a number or a word."""


def statements_of(experiment: str) -> tuple[Statement, ...]:
    """The statements of an experiment, by its id."""
    return tuple(s for id, s in STATEMENTS.items() if id.partition("-")[0] == experiment)
