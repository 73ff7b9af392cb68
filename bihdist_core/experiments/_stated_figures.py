"""The statements of figures 1 to 10, their rules and thresholds.

All of them are fixed by the paper's words and by reasoning, before anything is measured; a change of one is a change of
this file.
"""

from .verdicts import Part, Statement, above, at_least, at_most

DEEP = 0.01
"""An extremum that a reader sees persists over at least this share of the field's range: a fifth of the step between
two of the twenty isolines of a picture, and five times what refining the meshes changes of the fields (0.2 %)."""
INSENSITIVE = 0.05
"""A field is insensitive to a change if it moves, in the mean and divided by its maximum, by at most the step between
two of the twenty isolines."""
FALLS = 0.75
"""The asymptotic circles of biharmonic distance: d^2 = r^2 / (4 pi) (ln 1/r + c), c different in every direction.
As r falls to a sixteenth of itself, ln 1/r grows by 2.8 and the excess of the isotropy ratio over 1 falls to 0.4 to 0.5
of itself; that of an ellipse stays.  The limit is halfway between the two."""
RELATIVE = 0.5
"""Rounder than diffusion distance: at most half its excess of the isotropy ratio over 1, on the smallest circle."""
CIRCULAR, ELONGATED, PARALLEL = 1.25, 1.5, 3.0
"""The isotropy ratio is the ratio of an isoline's axes: nearly a circle to the eye, an ellipse, nearly parallel lines
(an ellipse three times as long as wide)."""
TWICE = 2.0
"""What is "much" or "many" beside another is at least twice it."""
CLEARLY = 1.5
"""What is "above all" on one side is there half as much again as on the other."""
STEP = 1 / 21
"""The step between two of the twenty isolines as a share of the range: what varies less may have no isoline."""

MINIMA = Part("deepest other minimum, biharmonic, of the range", at_most(DEEP, "%"), "everywhere")
TREND = Part("excess of isotropy ratio, smallest circle over one 16 times as wide", at_most(FALLS), needed=True)
ROUNDER = Part("excess of isotropy ratio, biharmonic over diffusion t = 1", at_most(RELATIVE))
CIRCLE = Part("isotropy ratio on the smallest circle, biharmonic", at_most(CIRCULAR))
LONG = Part("isotropy ratio on the smallest circle, diffusion t = 1", at_least(ELONGATED))
CHANGE = Part("mean change, biharmonic", at_most(INSENSITIVE, "%"))
OF_GEODESIC = "mean change, geodesic over biharmonic"
FREE, AWAY = "extrema without anchor", "extrema without anchor, away from tips"
"""Extrema of an interpolant, with and without those at tips of limbs."""


def _three_distances(id: str) -> tuple[Statement, ...]:
    """Return the statements of figures 4 and 5."""
    return (
        Statement(
            f"{id}-1",
            "With the source on the back, a local minimum of diffusion distance (t = 1) appears on the front.",
            *(("paper", "figure 4") if id == "fig4" else ("ours", "after figure 4, on the shapes of figure 5")),
            (Part("deepest minimum on the front, diffusion t = 1, of the range", at_least(DEEP, "%")),),
            whole=id == "fig5",
        ),
        Statement(
            f"{id}-2",
            "Near the source isolines of biharmonic distance are nearly circles, of diffusion distance (t = 1) "
            "elongated ellipses.",
            *("paper", "section 5.1"),
            (TREND, ROUNDER, CIRCLE, LONG),
            whole=id == "fig5",
        ),
        Statement(
            f"{id}-3",
            "Geodesic distance is not smooth: cusps and ridges, above all opposite to the source.",
            *("paper", "section 5.1"),
            (
                Part("share of edges in kinks, geodesic over biharmonic", at_least(TWICE), needed=True),
                Part("density of geodesic's kinks, opposite half over the source's half", at_least(CLEARLY)),
            ),
            whole=id == "fig5",
        ),
    )


def insensitive(to: str) -> str:
    """Return the statement of figure 6 on a change in words."""
    return f"Biharmonic distance is insensitive to {to}."


WAYS = ("noise on each coordinate", "noise along the normals")


def _insensitive(id: str, to: str, where: str = "") -> Statement:
    parts: tuple[Part, ...] = (CHANGE,)
    if to.startswith("noise"):
        # The paper says neither.
        parts = tuple(Part(f"{CHANGE.name}, {way}", CHANGE.limit) for way in WAYS)
    whole = id != "fig6-6"
    return Statement(id, insensitive(to), "paper" if where else "ours", where or "after figure 6", parts, whole)


FIGURES = (
    Statement(
        "fig1-1",
        "Biharmonic distance has no local minima, except at the source point.",
        *("paper", "section 5.1"),
        (MINIMA,),
    ),
    Statement(
        "fig1-2",
        "Near the source biharmonic distance is locally isotropic.",
        *("paper", "section 1"),
        (TREND,),
        whole=True,
    ),
    Statement(
        "fig2-1",
        "Diffusion distance of small time has many local extrema far away.",
        *("paper", "section 3.1 and figure 2"),
        (Part("number of extrema, diffusion t = 1/15 over biharmonic", at_least(TWICE)),),
    ),
    Statement(
        "fig2-2",
        "Diffusion distance of large time does not reflect the source locally; biharmonic distance does.",
        *("paper", "section 3.1 and figure 2"),
        (TREND, ROUNDER, LONG),
    ),
    Statement(
        "fig2-3",
        "Geodesic distance has derivative singularities; biharmonic distance has none.",
        *("paper", "section 3.1"),
        (
            Part("largest jump of the gradient, refined mesh over this one, biharmonic", at_most(FALLS), needed=True),
            Part("largest jump of the gradient on the refined mesh, geodesic", at_least(0.5)),
        ),
    ),
    Statement(
        "fig3-1",
        "Biharmonic distance is largely insensitive to holes and missing parts: a scan.",
        *("paper", "section 3.2 and figure 3"),
        (CHANGE,),
    ),
    Statement(
        "fig3-2",
        "Biharmonic distance is largely insensitive to holes: punched ones.",
        *("ours", "after figure 3"),
        (CHANGE,),
    ),
    Statement(
        "fig3-3",
        "Holes change geodesic distance more than biharmonic distance.",
        *("ours", "after section 2"),
        (Part(OF_GEODESIC, above(1)),),
    ),
    Statement(
        "fig3-4",
        "A hole along a shortest path can have a significant effect on geodesic distances.",
        *("paper", "section 2"),
        (
            Part("largest change by such a hole, geodesic", at_least(INSENSITIVE, "%"), needed=True),
            Part("largest change by such a hole, geodesic over biharmonic", at_least(TWICE)),
        ),
    ),
    *_three_distances("fig4"),
    *_three_distances("fig5"),
    _insensitive("fig6-1", "noise of 10 % of the mean edge"),
    _insensitive("fig6-2", "noise of 40 % of the mean edge"),
    _insensitive("fig6-3", "noise of 100 % of the mean edge"),
    _insensitive("fig6-4", "noise of 400 % of the mean edge", "section 5.1 and figure 6"),
    _insensitive("fig6-5", "simplification from 14,000 to 4,000 vertices", "section 5.1 and figure 6"),
    _insensitive("fig6-6", "nearly isometric deformation", "section 5.1 and figure 6"),
    Statement(
        "fig6-7",
        "Noise of 100 % of the mean edge changes geodesic distance more than biharmonic distance.",
        *("ours", "after section 1"),
        tuple(Part(f"{OF_GEODESIC}, {way}", above(1)) for way in WAYS),
        whole=True,
    ),
    Statement(
        "fig7-1",
        "Diffusion distance with t = 0.125 is almost constant for distant points: few isolines in the palm.",
        *("paper", "section 5.1 and figure 7"),
        (Part("range of values in the palm, diffusion t = 0.125 over biharmonic", at_most(1 / TWICE)),),
    ),
    Statement(
        "fig7-2",
        "With t = 0.25 to 1 it fails near the source: isolines on the finger are nearly parallel.",
        *("paper", "section 5.1 and figure 7"),
        (
            Part("isotropy ratio on the smallest circle, diffusion t = 0.25", at_least(PARALLEL)),
            Part("isotropy ratio on the smallest circle, diffusion t = 1", at_least(PARALLEL)),
        ),
    ),
    Statement(
        "fig7-3",
        "Biharmonic distance captures both local and global properties of the shape.",
        *("paper", "section 5.1 and figure 7"),
        (
            TREND,
            ROUNDER,
            Part("range of values in the palm, biharmonic over diffusion t = 0.125", at_least(TWICE), needed=True),
        ),
    ),
    Statement(
        "fig9-1",
        "Biharmonic distance provides a well-behaved interpolant both close to the anchors and far away.",
        *("paper", "section 5.2"),
        tuple(Part(f"{which}, biharmonic", at_most(0), of="starts") for which in (FREE, AWAY)),
    ),
    Statement(
        "fig9-2",
        "Of the five distances its interpolant has the fewest extrema.",
        *("ours", "after figure 9: “balanced”"),
        tuple(
            Part(f"{which}, {kind} less biharmonic", above(0), "interval", of="starts")
            for kind in ("geodesic", "diffusion t = 1/4", "diffusion t = 1", "diffusion t = 4")
            for which in (FREE, AWAY)
        ),
    ),
    Statement(
        "fig9-3",
        "Ridges appear when geodesic distance is used.",
        *("paper", "section 5.2 and figure 9"),
        (Part("share of edges in kinks, geodesic over biharmonic", at_least(TWICE), of="starts"),),
    ),
    Statement(
        "fig9-4",
        "With t = 1/4 the interpolant is almost constant in a leg without anchor.",
        *("paper", "section 5.2 and figure 9"),
        (
            Part("range in such a leg, diffusion t = 1/4", at_most(STEP, "%"), needed=True, of="starts"),
            Part("range in such a leg, diffusion t = 1/4 over biharmonic", at_most(1 / TWICE), of="starts"),
        ),
    ),
    Statement(
        "fig9-5",
        "With t = 1 the interpolant is insensitive to where the anchor on the head is.",
        *("paper", "figure 9"),
        (Part("mean change on the head, diffusion t = 1 over biharmonic", at_most(1 / TWICE), of="starts"),),
    ),
    Statement(
        "fig9-6",
        "With t = 4 the interpolant has unintuitive extrema.",
        *("paper", "section 5.2 and figure 9"),
        tuple(Part(f"{which}, diffusion t = 4", at_least(1), of="starts") for which in (FREE, AWAY)),
    ),
    *(
        Statement(
            f"fig10-{k}",
            "Biharmonic distance predicts correspondences better than geodesic and diffusion distance, landmarks "
            f"{layout}.",
            *("ours", "after figure 10"),
            tuple(
                Part(f"median error more than biharmonic's, {kind}", above(0, "%"), "interval", of="starts")
                for kind in ("geodesic", "diffusion t = 1")
            ),
        )
        for k, layout in ((1, "spread"), (2, "clustered"))
    ),
    Statement(
        "fig10-3",
        "Geodesic distance produces bad predictions far from the known correspondences.",
        *("paper", "section 5.2 and figure 10"),
        tuple(
            Part(
                f"median error far from the landmarks more than biharmonic's, geodesic, landmarks {layout}",
                above(0, "%"),
                "interval",
                of="starts",
            )
            for layout in ("spread", "clustered")
        ),
    ),
    Statement(
        "fig10-4",
        "Diffusion distance produces unintuitive results for small areas off the centre, like the head.",
        *("paper", "figure 10"),
        tuple(
            Part(
                f"median error on the head more than biharmonic's, diffusion t = 1, landmarks {layout}",
                above(0, "%"),
                "interval",
                of="starts",
            )
            for layout in ("spread", "clustered")
        ),
    ),
)
