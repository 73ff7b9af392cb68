"""What pages that compute can be told: those of the options of figures that mean something for them."""

from ..document.option import Row
from ..figures.options import rows

USUAL = ("biharmonic", "geodesic")
"""The panels where none are named: neither needs eigenpairs."""

NAMES = ("areas", "cut", "isolines", "up", "views", "projection", "colours", "range", "style", "pins")
"""Of each row the first option."""


def page_rows() -> tuple[Row, ...]:
    """The rows of the table of figures' options that pages know."""
    return tuple(row for row in rows() if row.options and row.options[0].name in NAMES)


def other_names() -> list[str]:
    """The arguments of figures that pages have not."""
    known = {option.name for row in page_rows() for option in row.options}
    return [option.name for row in rows() for option in row.options if option.name not in known]
