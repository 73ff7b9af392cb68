"""Which docks of the window are open, and where they stand."""

from base64 import b64decode
from dataclasses import dataclass

from bihdist_core.errors import ParameterError


@dataclass(frozen=True)
class DockPlaces:
    """Where open docks are in the window, and how large.

    width, height: of the window, in logical pixels.  state: what Qt says of the docks, as base64.
    """

    width: int
    height: int
    state: str

    def __post_init__(self) -> None:
        if min(self.width, self.height) < 1:
            raise ParameterError(f"A window has a size of 1 or more, not {self.width} x {self.height}.")
        try:
            b64decode(self.state, validate=True)
        except ValueError:
            raise ParameterError(f"The places of docks are base64, not {self.state[:20]!r}.") from None
