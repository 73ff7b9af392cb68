"""What tasks that run at the same time share."""

import numpy as np

from bihdist_core.solver.worker_threads import Arena


def test_parts_of_an_arena_do_not_overlap_and_more_than_there_is_can_be_had():
    random, arena, held = np.random.default_rng(0), Arena(1000), []
    for k in range(300):
        if held and random.random() < 0.45:
            arena.release(held.pop(random.integers(len(held)))[0])
        part = arena.take(int(random.integers(0, 200)))
        part[:] = k
        held.append((part, k))
        assert all((other == value).all() for other, value in held)


def test_an_arena_hands_out_the_lowest_part_that_is_free():
    arena = Arena(100)
    low, middle, _ = arena.take(10), arena.take(40), arena.take(10)
    arena.release(low)
    arena.release(middle)
    with arena.of(40) as again:
        assert again.ctypes.data == low.ctypes.data
    assert arena.take(50).ctypes.data == low.ctypes.data
