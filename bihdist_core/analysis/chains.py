"""Segments put end to end."""

from collections import defaultdict

import numpy as np

from ..arrays import IntArray


def chains(segments: IntArray) -> list[tuple[IntArray, bool]]:
    """Join segments (m, 2) of ids to chains: the ids (k,) of each in order, and whether its last joins its first.

    Each segment is in one chain. Chains end where not exactly two segments meet; a closed one names its first id once,
    and has three or more.
    """
    at: defaultdict[int, list[tuple[int, int]]] = defaultdict(list)
    for s, (i, j) in enumerate(segments.tolist()):
        at[i].append((s, j))
        at[j].append((s, i))
    used = [False] * len(segments)
    found = []
    # Open chains first; what is left after them is closed.
    for start in sorted(at, key=lambda node: (len(at[node]) == 2, node)):
        for first, following in at[start]:
            if used[first]:
                continue
            used[first] = True
            chain, node = [start, following], following
            while len(at[node]) == 2 and node != start:
                segment, node = next(((s, k) for s, k in at[node] if not used[s]), (-1, -1))
                if segment < 0:
                    break
                used[segment] = True
                chain.append(node)
            ends_meet = chain[0] == chain[-1]
            found.append((np.array(chain[:-1] if ends_meet else chain), ends_meet and len(chain) > 3))
    return found
