"""What lines that make a figure, which is of one mesh, need not say of pairs and maps."""

from ...document.option import unsaid

ROWS = (
    unsaid("with one mesh there are none", "Pairs.pairs", "Maps.maps"),
    unsaid("what maps are measured by, which no picture shows", "Maps.truth"),
)
