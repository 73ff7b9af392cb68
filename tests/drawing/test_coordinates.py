"""Positions as text: as many digits as tell a tenth of the mean edge."""

import pytest

from app.drawing.numbers import coordinates


@pytest.mark.parametrize(
    ("position", "edge", "text"),
    [
        # In a projected coordinate system, a centimetre counts.
        ((452000.123, 5411000.456, 0.0), 0.0116, "452,000.123  5,411,000.456  0"),
        ((-452000.123, 0.0003851, 12345678.9), 0.0116, "−452,000.123  0.0003851  12,345,678.900"),
        # Four digits where they are enough.
        ((0.35, -1.51, 12345.6), 40.0, "0.3500  −1.510  12,346"),
        ((0.35, 1.0, 120.0), 0.5, "0.3500  1.000  120.00"),
        ((1.0, 2.0, 3.0), 0.0, "1.000  2.000  3.000"),
        ((1e9, 2e-9, 0.0), 1e7, "1.000e9  2.000e−9  0"),
    ],
)
def test_positions_have_the_digits_of_their_mesh(position, edge, text):
    assert coordinates(position, edge) == text
