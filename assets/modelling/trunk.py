"""The person's trunk and neck in the person's axes: metres, z up, face towards -y."""

from .fields import Field, ellipsoid, tube
from .joins import both_sides, carve, join


def trunk() -> Field:
    """Chest, belly, back, hips and neck."""
    body = join(0.05, _core(), _neck(), both_sides(_back(), 0.006), both_sides(_seat(), 0.006))
    body = join(0.028, body, both_sides(_chest(), 0.004), both_sides(_belly(), 0.004))
    body = carve(0.024, body, _spine(), _midline(), both_sides(_hollows(), 0.002))
    return carve(0.012, join(0.016, body, both_sides(_cords(), 0.002), _larynx()), _navel())


def _core() -> Field:
    return tube(
        [
            # x, y, z, half-width, half-depth
            (0, 0.018, 0.850, 0.030, 0.048),
            (0, 0.015, 0.885, 0.070, 0.072),
            (0, 0.011, 0.930, 0.120, 0.088),
            (0, 0.006, 0.980, 0.144, 0.094),  # hips
            (0, 0.001, 1.030, 0.142, 0.091),
            (0, -0.003, 1.075, 0.136, 0.086),
            (0, -0.004, 1.125, 0.131, 0.083),  # waist
            (0, 0.000, 1.200, 0.138, 0.092),
            (0, 0.006, 1.280, 0.153, 0.102),
            (0, 0.014, 1.350, 0.154, 0.099),  # chest
            (0, 0.022, 1.410, 0.122, 0.078),
            (0, 0.026, 1.460, 0.066, 0.056),
        ]
    )


def _neck() -> Field:
    column = tube([(0, 0.034, 1.430, 0.064, 0.056), (0, 0.030, 1.510, 0.055, 0.053), (0, 0.020, 1.600, 0.053, 0.056)])
    trapezius = tube(
        [
            (0.018, 0.050, 1.540, 0.038, 0.030),
            (0.064, 0.042, 1.476, 0.040, 0.036),
            (0.120, 0.030, 1.447, 0.035, 0.038),
            (0.180, 0.018, 1.427, 0.032, 0.042),
        ],
        side=(0, 0, 1),
    )
    return join(0.04, column, both_sides(trapezius, 0.01))


def _chest() -> Field:
    """The breast muscle, drawn out to the armpit, and the arch of the ribs below it."""
    breast = join(
        0.03,
        ellipsoid((0.064, -0.069, 1.346), (0.064, 0.026, 0.060), right=(1, 0.30, 0.10)),
        tube([(0.085, -0.066, 1.350, 0.026, 0.034), (0.150, -0.030, 1.372, 0.022, 0.026)], side=(0, 1, 0)),
    )
    arch = tube(
        [
            (0.014, -0.078, 1.245, 0.012),
            (0.055, -0.077, 1.204, 0.014),
            (0.095, -0.053, 1.163, 0.015),
            (0.112, -0.016, 1.145, 0.013),
        ]
    )
    upper = ellipsoid((0.092, -0.036, 1.404), (0.062, 0.026, 0.034), right=(1, 0.35, 0.1))
    return join(0.02, join(0.03, breast, upper), arch)


def _belly() -> Field:
    """The straight muscle in three short swellings and a long one, and the oblique one above the hip."""
    straight = [
        ellipsoid((0.034, y, z), (0.029, 0.017, height), right=(1, 0.25, 0))
        for y, z, height in [
            (-0.0780, 1.215, 0.030),
            (-0.0775, 1.160, 0.030),
            (-0.0765, 1.104, 0.031),
            (-0.0760, 1.000, 0.095),
        ]
    ]
    oblique = ellipsoid((0.107, -0.004, 1.052), (0.032, 0.062, 0.048), up=(0.1, 0, 1))
    return join(0.02, join(0.012, *straight), oblique)


def _back() -> Field:
    broad = ellipsoid((0.092, 0.036, 1.275), (0.062, 0.056, 0.165), right=(1, 0.4, 0), up=(0.25, 0, 1))
    blade = ellipsoid((0.088, 0.088, 1.352), (0.052, 0.024, 0.070), right=(1, -0.35, 0.2), up=(0.15, 0.1, 1))
    spine_of_blade = tube([(0.040, 0.092, 1.390, 0.010), (0.095, 0.084, 1.415, 0.011), (0.150, 0.046, 1.426, 0.012)])
    erector = tube(
        [
            (0.030, 0.054, 0.975, 0.026, 0.022),
            (0.032, 0.058, 1.080, 0.028, 0.026),
            (0.034, 0.066, 1.180, 0.028, 0.026),
            (0.036, 0.078, 1.280, 0.024, 0.022),
        ]
    )
    return join(0.02, join(0.035, broad, erector), blade, spine_of_blade)


def _seat() -> Field:
    buttock = ellipsoid((0.070, 0.064, 0.900), (0.070, 0.062, 0.074), right=(1, -0.2, 0), up=(0.15, 0.1, 1))
    hip = ellipsoid((0.112, 0.008, 0.935), (0.058, 0.072, 0.090))
    return join(0.05, buttock, hip)


def _cords() -> Field:
    """Collar bones, and the two muscles that turn the head."""
    collar_bone = tube(
        [
            (0.017, -0.050, 1.428, 0.0110),
            (0.055, -0.050, 1.434, 0.0095),
            (0.105, -0.030, 1.443, 0.0095),
            (0.158, 0.006, 1.448, 0.0110),
        ]
    )
    turner = tube(
        [
            (0.050, 0.024, 1.615, 0.013),
            (0.042, 0.003, 1.550, 0.012),
            (0.029, -0.018, 1.485, 0.009),
            (0.015, -0.042, 1.438, 0.008),
        ]
    )
    return join(0.006, collar_bone, turner)


def _larynx() -> Field:
    return tube([(0, -0.020, 1.545, 0.012), (0, -0.025, 1.525, 0.012), (0, -0.024, 1.480, 0.010)])


def _spine() -> Field:
    return tube(
        [
            (0, 0.108, 0.965, 0.010),
            (0, 0.102, 1.040, 0.012),
            (0, 0.101, 1.110, 0.013),
            (0, 0.112, 1.200, 0.012),
            (0, 0.126, 1.300, 0.010),
            (0, 0.128, 1.380, 0.008),
        ]
    )


def _midline() -> Field:
    """Between the breasts and down to the navel."""
    return tube(
        [
            (0, -0.104, 1.385, 0.006),
            (0, -0.112, 1.330, 0.009),
            (0, -0.110, 1.280, 0.008),
            (0, -0.106, 1.200, 0.008),
            (0, -0.104, 1.120, 0.008),
            (0, -0.106, 1.060, 0.005),
        ]
    )


def _hollows() -> Field:
    """Behind the collar bone, and the fold from the hip bone to the groin."""
    above_collar_bone = ellipsoid((0.066, -0.022, 1.462), (0.022, 0.010, 0.009), right=(1, 0.5, 0))
    fold = tube([(0.132, -0.082, 0.968, 0.010), (0.090, -0.098, 0.918, 0.010), (0.045, -0.098, 0.872, 0.008)])
    return join(0.0, above_collar_bone, fold)


def _navel() -> Field:
    return ellipsoid((0, -0.096, 1.064), (0.0095, 0.014, 0.0120))
