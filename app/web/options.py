"""The options of figures that pages have, too."""

from ..document.option import Row
from ..figures.options import rows

USUAL = ("biharmonic", "geodesic")
"""The panels by default; neither distance needs eigenpairs."""

NAMES = (
    *(
        "areas",
        "cut",
        "isolines",
        "viewup",
        "cpos",
        "parallel_projection",
        "clip",
        "opacity",
        "cmap",
        "flip_scalars",
        "bands",
        "clim",
    ),
    *("style", "pins"),
)
"""The first option of each row."""


def page_rows() -> tuple[Row, ...]:
    """Return the rows of figures' options that pages have."""
    return tuple(row for row in rows() if row.options and row.options[0].name in NAMES)


def other_names() -> list[str]:
    """Return the arguments of figures that pages do not have."""
    known = {option.name for row in page_rows() for option in row.options}
    return [option.name for row in rows() for option in row.options if option.name not in known]
