"""How an interpolant weighs its anchors, checked; no numerical library is needed for it."""

from dataclasses import dataclass

from ..errors import ParameterError
from ..scalars import real_number

LEAST_EXPONENT, MOST_EXPONENT = 0.1, 20.0


@dataclass(frozen=True)
class Weights:
    """Weights of anchors, w(d) = r(d) ** -exponent: r(d) = d if the smoothness s is 0, else d^2 / (d + s D).

    D is the largest distance. Raises ParameterError for an exponent or a smoothness out of range.
    """

    exponent: float = 1.0
    smoothness: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "exponent", real_number(self.exponent, "The exponent of weights"))
        object.__setattr__(self, "smoothness", real_number(self.smoothness, "The smoothness of weights"))
        if not LEAST_EXPONENT <= self.exponent <= MOST_EXPONENT:
            raise ParameterError(
                f"The exponent of weights is a number from {LEAST_EXPONENT:g} to {MOST_EXPONENT:g}, "
                f"not {self.exponent:g}."
            )
        if not 0 <= self.smoothness <= 1:
            raise ParameterError(f"The smoothness of weights is a fraction from 0 to 1, not {self.smoothness:g}.")


INVERSE_DISTANCES = Weights()
"""The weights of the paper."""
