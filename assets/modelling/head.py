"""The person's head in the person's axes: metres, z up, face towards -y; the chin at z = 1.57, the crown at 1.80."""

from .fields import Field, ellipsoid, tube
from .joins import both_sides, carve, join


def head() -> Field:
    """Skull, face and ears, to be joined to a neck."""
    skull = join(0.06, *_skull())
    sockets = both_sides(ellipsoid((0.034, -0.098, 1.686), (0.024, 0.022, 0.015), right=(1, 0.35, 0)))
    face = join(0.026, carve(0.035, skull, sockets), *_features())
    return join(0.012, face, both_sides(_ear()))


def _skull() -> list[Field]:
    cranium = ellipsoid((0, 0.022, 1.700), (0.076, 0.094, 0.099))
    # From the brow down to the chin, wide at the cheekbones.
    front = tube(
        [
            # x, y, z, half-width, half-depth
            (0, -0.018, 1.715, 0.064, 0.060),
            (0, -0.026, 1.675, 0.066, 0.064),
            (0, -0.030, 1.640, 0.060, 0.062),
            (0, -0.036, 1.605, 0.047, 0.054),
            (0, -0.042, 1.584, 0.034, 0.042),
        ]
    )
    jaw = both_sides(
        tube([(0.056, 0.006, 1.655, 0.018), (0.049, -0.006, 1.610, 0.018), (0.022, -0.062, 1.583, 0.018)]), 0.01
    )
    return [cranium, front, jaw]


def _features() -> list[Field]:
    brow = both_sides(
        tube([(0.006, -0.085, 1.703, 0.009), (0.030, -0.079, 1.708, 0.009), (0.052, -0.060, 1.700, 0.008)])
    )
    nose = tube(
        [
            (0, -0.086, 1.698, 0.008, 0.010),
            (0, -0.096, 1.676, 0.0095, 0.012),
            (0, -0.105, 1.654, 0.0125, 0.014),
            (0, -0.107, 1.646, 0.0125, 0.012),
        ]
    )
    nostril_wings = both_sides(ellipsoid((0.012, -0.096, 1.645), (0.0085, 0.012, 0.009)))
    eyelids = both_sides(ellipsoid((0.033, -0.0755, 1.684), (0.018, 0.017, 0.013), right=(1, 0.3, 0)))
    cheeks = both_sides(ellipsoid((0.039, -0.054, 1.637), (0.026, 0.022, 0.037), right=(1, 0.8, 0)))
    upper_lip = tube(
        [(-0.022, -0.085, 1.6180, 0.005), (0, -0.0970, 1.6215, 0.0080), (0.022, -0.085, 1.6180, 0.005)], side=(0, 0, 1)
    )
    lower_lip = tube(
        [(-0.019, -0.085, 1.6120, 0.005), (0, -0.0955, 1.6065, 0.0085), (0.019, -0.085, 1.6120, 0.005)], side=(0, 0, 1)
    )
    chin = ellipsoid((0, -0.080, 1.585), (0.018, 0.016, 0.015))
    return [brow, nose, nostril_wings, eyelids, cheeks, join(0.004, upper_lip, lower_lip), chin]


def _ear() -> Field:
    shell = ellipsoid((0.080, 0.022, 1.670), (0.013, 0.022, 0.034), right=(1, 0.55, 0.1), up=(0.15, 0.2, 1))
    lobe = ellipsoid((0.074, 0.010, 1.642), (0.010, 0.011, 0.012), right=(1, 0.55, 0))
    bowl = ellipsoid((0.096, 0.010, 1.670), (0.012, 0.012, 0.020), right=(1, 0.55, 0.1), up=(0.15, 0.2, 1))
    return carve(0.008, join(0.015, shell, lobe), bowl)
