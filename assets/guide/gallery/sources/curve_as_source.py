"""
A boundary or a curve as source
===============================

Distances can start from all points of a curve. A boundary loop is identified by its number, counted from the longest:
loop 0 of the hand is where it ends at the wrist.
"""

import json

import bihdist

picture = bihdist.figure(
    "hand",
    ["biharmonic", "geodesic"],
    source=bihdist.BoundaryLoop(0),
    layout={"size": "800x460"},
)
picture.save("curve_as_source.png")

# %%
# A :class:`bihdist.Curve` goes through any points, each given as a face and the weights of two of its corners. This
# one is a belt. Saved to a file, it is a source that a command line can name.

belt = {
    "points": [
        [5834, 0.3, 0.3],
        [18060, 0.3, 0.3],
        [12477, 0.3, 0.3],
        [5848, 0.3, 0.3],
    ],
    "closed": True,
}
with open("curve_as_source-belt.json", "w") as file:
    json.dump(belt, file)
curve = bihdist.Curve(
    tuple(bihdist.SurfacePoint.of(*row) for row in belt["points"]), closed=True
)

picture = bihdist.figure(
    "figure", ["biharmonic", "geodesic"], source=curve, layout={"size": "800x560"}
)
picture.save("curve_as_source-figure.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources loop:0 --distance biharmonic,geodesic \
#        --size 800x460 -o curve_as_source.png
#    bihdist figure figure --sources curve_as_source-belt.json \
#        --distance biharmonic,geodesic --size 800x560 \
#        -o curve_as_source-figure.png
