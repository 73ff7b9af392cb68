"""What quantities are called in heads and charts."""

from bihdist_core.distances.kinds import Kind, Spec

from .map_colours import MapColours, MapFile
from .quantities import ChangeOf, Interpolant, OwnField, Part, Prediction, Quantity


def kind_name(kind: Kind) -> str:
    """With the power of the family's weights as a raised letter."""
    return kind.name.replace("^α", "ᵅ")


def part_name(part: Part) -> str:
    if isinstance(part, ChangeOf):
        return f"Change of {kind_name(part.spec.kind).lower()}"
    if isinstance(part, Interpolant):
        return "Weights" if part.total else "Interpolant"
    if isinstance(part, Prediction):
        return "Prediction"
    if isinstance(part, MapColours):
        return ("Full map" if isinstance(part.by, Spec) else f"Map {MapFile(part.by).name}") if part.by else "Positions"
    return part.name if isinstance(part, OwnField) else kind_name(part.spec.kind)


def quantity_name(shows: Quantity) -> str:
    """Its name in the head: "Biharmonic", "Biharmonic − Geodesic", "1/λᵅ"."""
    return " − ".join(part_name(part).removesuffix(" family") for part in shows.parts)
