"""
Values between anchors
======================

Shepard's method interpolates values given at a few vertices, with inverse-distance weights. How smooth the result is
depends on the distance: with the biharmonic distance there are no ridges, and no extrema except at the anchors.
"""

import bihdist

anchors = {8102: 0, 8207: 1, 8208: 0.3, 5: 0.7, 216: 0.1}
distances = ["interpolant by biharmonic", "interpolant by geodesic"]
picture = bihdist.figure(
    "figure",
    distances,
    marks={"anchors": anchors, "anchor_values": True},
    layout={"size": "800x560"},
)
picture.save("interpolation.png")

# %%
distance = bihdist.BiharmonicDistance(bihdist.sample("figure"))
values = bihdist.ShepardInterpolant(
    distance, list(anchors), list(anchors.values())
).evaluate()
print(f"{values.min():.3f} to {values.max():.3f}, at vertex 4000 {values[4000]:.3f}")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure figure \
#        --distance 'interpolant by biharmonic,interpolant by geodesic' \
#        --anchors 8102=0,8207=1,8208=0.3,5=0.7,216=0.1 --anchor-values \
#        --size 800x560 -o interpolation.png
#    bihdist interpolate figure \
#        --anchors 8102=0,8207=1,8208=0.3,5=0.7,216=0.1 -o interpolation.csv
