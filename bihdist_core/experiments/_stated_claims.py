"""The statements of figure 8, the tables, the family of weights and the text, their rules and thresholds.

All of them are fixed by the paper's words and by reasoning, before anything is measured; a change of one is a change of
this file.
"""

from dataclasses import replace

from ._stated_figures import CHANGE, DEEP, TWICE
from .verdicts import Part, Statement, above, at_least, at_most, between

AGREES = 0.1
"""An exponent is the one that is said within this: logarithmic factors alone are worth 0.1 over the sizes measured."""
LARGE = 0.25
"""A large change, of the maximum: from one of the colour map's five hues to the next."""
MUCH_FASTER = 1.5
"""In the paper's Table I Dijkstra's algorithm takes 1.3 to 2.3 times as long; "much faster" is from half as long
again."""
SAME_TIME = 1.25
"""The paper's "practically does not depend"."""
ROUNDING = 1e-7
"""A distance below this fraction of the largest is 0 within rounding: it is the root of a difference of squares, which
are known to 1e-15."""
FOUND_EQUAL = 1e-6
"""A sum over all eigenpairs and a direct solution agree within this fraction of the maximum."""


def _topology(id: str, change: str, where: str) -> Statement:
    return Statement(
        id,
        f"Biharmonic distance is insensitive to small changes of topology, geodesic distance is not: {change}.",
        *("paper", where),
        (
            replace(CHANGE, needed=True, of="joins"),
            Part("largest change, biharmonic", at_most(LARGE, "%"), of="joins"),
            Part("largest change, geodesic over biharmonic", at_least(TWICE), of="joins"),
        ),
        whole=True,
    )


CLAIMS = (
    Statement(
        "fig8-1",
        "The truncation error of the first K eigenvectors is bounded by a line in 1/K.",
        *("paper", "section 3.3"),
        (Part("exponent of K, largest error", at_most(-1 + AGREES), "interval", of="pairs"),),
        whole=True,
    ),
    Statement(
        "table1-1",
        "For all pairs biharmonic distance is much faster than Dijkstra's algorithm.",
        *("paper", "section 5.1 and table I"),
        (Part("processor time at the largest size, Dijkstra over biharmonic", at_least(MUCH_FASTER), "interval"),),
        whole=True,
    ),
    Statement(
        "table1-2",
        "Time grows at most like N^2 for biharmonic distance, N^2 log N for Dijkstra, N^1.5 for diffusion.",
        *("paper", "section 5.1"),
        (
            Part("exponent of N, biharmonic", at_most(2 + AGREES), "interval", needed=True),
            Part("exponent of N, Dijkstra", at_most(2 + 2 * AGREES), "interval"),
            Part("exponent of N, diffusion t = 0.125", at_most(1.5 + AGREES), "interval"),
        ),
        whole=True,
    ),
    Statement(
        "table1-3",
        "For all pairs diffusion distance is much faster than biharmonic distance.",
        *("paper", "section 5.1 and table I"),
        (Part("processor time at the largest size, biharmonic over diffusion", at_least(MUCH_FASTER), "interval"),),
        whole=True,
    ),
    Statement(
        "table2-1",
        "Dijkstra's algorithm is fastest for small M.",
        *("paper", "section 5.1 and table II"),
        tuple(
            Part(f"processor time at M = 2, {kind} over Dijkstra", above(1), "interval")
            for kind in ("biharmonic", "diffusion t = 0.125")
        ),
        whole=True,
    ),
    Statement(
        "table2-2",
        "Biharmonic distance becomes the fastest for large M.",
        *("paper", "section 5.1 and table II"),
        tuple(
            Part(f"processor time at M = 400, {kind} over biharmonic", above(1), "interval")
            for kind in ("Dijkstra", "diffusion t = 0.125")
        ),
        whole=True,
    ),
    Statement(
        "table2-3",
        "The time for diffusion distance practically does not depend on M.",
        *("paper", "section 5.1 and table II"),
        (Part("processor time, M = 400 over M = 2, diffusion t = 0.125", at_most(SAME_TIME), "interval"),),
        whole=True,
    ),
    Statement(
        "alpha-1",
        "With α = 2 the family of weights 1/λ^α is biharmonic distance.",
        *("paper", "sections 3.1 and 6"),
        (Part("largest difference from the direct solution, of the maximum", at_most(FOUND_EQUAL)),),
    ),
    Statement(
        "alpha-2",
        "A slower decay is more local, a faster one more global.",
        *("paper", "section 3.1"),
        (Part("isotropy ratio, least growth from one α to the next", at_least(1.05)),),
    ),
    Statement(
        "alpha-3",
        "Every member is a usable distance field: no minima but the source.",
        *("ours", "after section 6"),
        (Part("deepest other minimum of any α, of the range", at_most(DEEP, "%"), "everywhere"),),
    ),
    Statement(
        "claims-triangle",
        "Biharmonic distance satisfies the triangle inequality.",
        *("paper", "section 4"),
        (Part("random triples that break it by more than rounding", at_most(0), "once"),),
    ),
    Statement(
        "claims-identity",
        "Biharmonic distance tells all points apart.",
        *("paper", "section 4"),
        (Part("smallest distance of different vertices over the largest", at_least(10 * ROUNDING), "once"),),
    ),
    Statement(
        "claims-truncated",
        "Diffusion distance is not necessarily a metric when computed from the first few eigenpairs.",
        *("paper", "section 1"),
        (
            Part("distance of two different points over the largest", at_most(ROUNDING), "once", needed=True),
            Part("biharmonic distance of the same points over the largest", at_least(DEEP, "%"), "once"),
        ),
    ),
    Statement(
        "claims-cost",
        "Factorization and each column cost O(N).",
        *("paper", "section 4"),
        (
            Part("exponent of N, operations of the factorization", at_most(1 + AGREES), "once"),
            Part("exponent of N, operations of one column", at_most(1 + AGREES), "once"),
        ),
        whole=True,
    ),
    Statement(
        "claims-weyl",
        "Eigenvalues grow like k.",
        *("paper", "section 4"),
        (Part("exponent of k", between(1 - AGREES, 1 + AGREES), "once"),),
        whole=True,
    ),
    Statement(
        "claims-commute",
        "Commute-time distance cannot be defined on surfaces: it diverges.",
        *("paper", "section 2"),
        (Part("growth of its square per e-fold of N, times 2π", between(1 - AGREES, 1 + AGREES), "once"),),
    ),
    Statement(
        "claims-converges",
        "Biharmonic distance is defined on surfaces: it converges.",
        *("paper", "section 4"),
        (
            Part("change at the last refinement", at_most(0.01, "%"), "once"),
            Part("difference from the exact value on the sphere", at_most(0.01, "%"), "once"),
        ),
    ),
    Statement(
        "claims-conformal",
        "Commute-time distance is the same on every two conformally equivalent surfaces; biharmonic is not.",
        *("paper", "section 2"),
        (
            Part("mean change, commute-time", at_most(0.01, "%"), "once", needed=True),
            Part("mean change, biharmonic", at_least(0.05, "%"), "once"),
        ),
    ),
    _topology("claims-handle", "a thin handle", "section 1"),
    _topology("claims-weld", "a weld", "section 1"),
    Statement(
        "claims-sampling",
        "Biharmonic distance can be approximated by sub-sampling, geodesic distance less well.",
        *("paper", "section 5.1"),
        (
            Part("mean error, biharmonic, smoothest interpolant", at_most(DEEP, "%"), needed=True),
            Part("mean error, geodesic over biharmonic, smoothest interpolant", at_least(TWICE), needed=True),
            Part("mean error, geodesic over biharmonic, piecewise linear interpolant", above(1)),
        ),
    ),
)
