"""How a surface is seen that stands beside the first one of a document."""

from dataclasses import dataclass

from .camera import View, checked_view
from .looks import UPS, one_of


@dataclass(frozen=True)
class Beside:
    """surface: its name in the document.  camera, up: as those that the document has of its first surface."""

    surface: str
    camera: View = "auto"
    up: str = "auto"

    def __post_init__(self) -> None:
        checked_view(self.camera)
        one_of(self.up, UPS, "direction")
