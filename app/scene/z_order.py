"""Morton's curve, the Z order: cells near each other in space are near each other on it."""

from collections.abc import Sequence

import numpy as np

from bihdist_core.arrays import AnyArray


def z_order(cells: Sequence[AnyArray], bits: int) -> AnyArray:
    """(n,) unsigned numbers of cells on Morton's curve, in the smallest type that holds them.

    cells: for each axis whole numbers (n,) from 0 to 2 ** bits - 1.
    """
    count = len(cells)
    dtype = np.min_scalar_type((1 << count * bits) - 1)
    cell = np.arange(1 << bits)
    spread = np.sum([(cell >> bit & 1) << count * bit for bit in range(bits)], axis=0).astype(dtype)
    codes: AnyArray = np.bitwise_or.reduce(
        [spread.take(of_axis) << dtype.type(axis) for axis, of_axis in enumerate(cells)]
    )
    return codes
