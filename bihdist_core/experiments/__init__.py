"""The paper's figures and tables as experiments: each computes a `Result`, and draws nothing.

shapes = Shapes.from_folder("assets")
result = EXPERIMENTS["fig4"].compute(shapes, quick=True)
result.save("out")
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib import import_module
from time import perf_counter

from ..progress import Progress, silent
from .parts import NotDone, Parts
from .result import Chart, Claim, Mark, Panel, Result, Series, Table
from .shapes import NAMES, SEEDS, Shapes

__all__ = [
    "EXPERIMENTS",
    "NAMES",
    "SEEDS",
    "Chart",
    "Claim",
    "Experiment",
    "Mark",
    "NotDone",
    "Panel",
    "Parts",
    "Result",
    "Series",
    "Shapes",
    "Table",
]


@dataclass(frozen=True)
class Experiment:
    """A figure or table of the paper; its module is imported when first needed.

    `any_mesh` is True if it makes sense on a reader's own mesh, `is_timed` if it measures times, which other work on
    the computer would disturb, `is_parallel` if it can be run beside others even so.
    """

    id: str
    any_mesh: bool = True
    is_timed: bool = False
    is_parallel: bool = True

    @property
    def title(self) -> str:
        """The title of the figure."""
        return str(import_module(f".{self.id}", __name__).TITLE)

    @property
    def shows(self) -> str:
        """Sentences on what the paper shows and claims there."""
        return str(import_module(f".{self.id}", __name__).__doc__).strip()

    def compute(self, shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
        """Run it, with smaller sizes and fewer sources if `quick`, for a first look.

        Raises ParameterError if a surface it needs is missing, and whatever `progress` raises.
        """
        run: Callable[..., Result] = import_module(f".{self.id}", __name__).compute
        start = perf_counter()
        result = run(shapes, quick, progress)
        (progress or silent)(1.0, self.id)
        claims = tuple(replace(claim, quick=quick) for claim in result.claims)
        return replace(result, claims=claims, seconds=perf_counter() - start)


EXPERIMENTS = {
    experiment.id: experiment
    for experiment in (
        Experiment("fig1"),
        Experiment("fig2", any_mesh=False),
        Experiment("fig3"),
        Experiment("fig4"),
        Experiment("fig5", any_mesh=False),
        Experiment("fig6"),
        Experiment("fig7", any_mesh=False),
        Experiment("fig8"),
        Experiment("fig9", any_mesh=False),
        Experiment("fig10", any_mesh=False),
        Experiment("table1", is_timed=True, is_parallel=False),
        Experiment("table2", is_timed=True, is_parallel=False),
        Experiment("alpha"),
        Experiment("claims", is_timed=True),
    )
}
"""In the paper's order."""
