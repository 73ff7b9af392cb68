"""The beast's head in the beast's axes: metres, z up, snout towards -y; the throat at z = 0.82, the brow at 1.02."""

from .fields import Field, ellipsoid, tube
from .joins import both_sides, carve, join
from .plates import plated


def head() -> Field:
    """Skull with snout, brow, eyes and jaw; horns and ears."""
    sockets = both_sides(ellipsoid((0.092, -0.185, 0.952), (0.034, 0.034, 0.026), right=(1, -0.5, 0)))
    eyes = both_sides(ellipsoid((0.078, -0.168, 0.954), (0.026, 0.030, 0.025)))
    face = join(0.012, carve(0.03, _skull(), sockets), eyes)
    face = join(0.03, face, both_sides(_brow()), both_sides(_nostril_wing()), _nose_horn())
    face = carve(0.014, face, both_sides(_nostril()), _mouth())
    return join(0.02, face, both_sides(_horn()), both_sides(_ear()))


def _skull() -> Field:
    cranium = ellipsoid((0, -0.070, 0.945), (0.115, 0.120, 0.095))
    snout = tube(
        [
            # x, y, z, half-width, half-height
            (0, -0.130, 0.935, 0.090, 0.078),
            (0, -0.200, 0.915, 0.072, 0.062),
            (0, -0.270, 0.897, 0.058, 0.052),
            (0, -0.330, 0.885, 0.050, 0.045),
        ]
    )
    jaw = tube([(0, -0.090, 0.865, 0.085, 0.045), (0, -0.200, 0.852, 0.066, 0.036), (0, -0.300, 0.850, 0.040, 0.026)])
    cheek = both_sides(ellipsoid((0.085, -0.095, 0.890), (0.042, 0.070, 0.050), up=(0, 0.2, 1)), 0.01)
    wrinkled = plated(
        snout,
        [
            (0, -0.140, 0.930, 0.0, 0.0, 70),
            (0, -0.190, 0.915, 0.8, 0.004, 80),
            (0, -0.290, 0.892, 2.4, 0.004, 80),
            (0, -0.330, 0.885, 3.0, 0.0, 70),
        ],
        back=(0, 0, 1),
    )
    return join(0.03, join(0.06, cranium, wrinkled), jaw, cheek)


def _brow() -> Field:
    return tube(
        [
            (0.018, -0.215, 0.975, 0.016),
            (0.055, -0.198, 0.996, 0.020),
            (0.092, -0.155, 1.004, 0.021),
            (0.108, -0.105, 0.985, 0.015),
        ]
    )


def _nostril_wing() -> Field:
    return ellipsoid((0.030, -0.362, 0.905), (0.026, 0.026, 0.024))


def _nostril() -> Field:
    return ellipsoid((0.047, -0.384, 0.912), (0.016, 0.022, 0.016), right=(1, -0.5, 0))


def _nose_horn() -> Field:
    return tube([(0, -0.310, 0.925, 0.034), (0, -0.330, 0.965, 0.024), (0, -0.328, 1.000, 0.015)])


def _mouth() -> Field:
    """A groove round the snout between the lips."""
    return join(
        0.01,
        both_sides(
            tube([(0.105, -0.160, 0.872, 0.015), (0.070, -0.230, 0.867, 0.016), (0.047, -0.330, 0.863, 0.016)]), 0.002
        ),
        tube([(-0.047, -0.330, 0.863, 0.016), (0, -0.378, 0.864, 0.016), (0.047, -0.330, 0.863, 0.016)]),
    )


def _horn() -> Field:
    return tube(
        [
            (0.062, -0.055, 1.005, 0.044),
            (0.082, -0.030, 1.060, 0.036),
            (0.098, 0.020, 1.110, 0.029),
            (0.102, 0.080, 1.135, 0.021),
            (0.098, 0.125, 1.150, 0.015),
        ]
    )


def _ear() -> Field:
    shell = tube(
        [
            (0.095, -0.055, 0.955, 0.026, 0.030),
            (0.140, -0.040, 0.978, 0.025, 0.045),
            (0.190, -0.025, 0.990, 0.021, 0.042),
            (0.235, -0.010, 0.980, 0.016, 0.018),
        ],
        side=(0.2, -1, 0),
    )
    hollow = tube([(0.140, -0.072, 0.980, 0.014, 0.026), (0.200, -0.052, 0.992, 0.013, 0.022)], side=(0.2, -1, 0))
    return carve(0.014, shell, hollow)
