"""
Isoline through a point
=======================

``isolines={"through": …}`` draws one more isoline, through a vertex of your choice: all points exactly as far from the
source as that vertex. From the top of the head, the fingertips are as far as the thighs in geodesic distance, as far
as the knees in biharmonic distance, and as far as the shins in diffusion distance.
"""

import bihdist

picture = bihdist.figure(
    "figure",
    ["biharmonic", "geodesic", "diffusion"],
    source=8102,
    isolines={"through": [8207], "count": 8},
    look={"cmap": "uniform"},
    layout={"size": "1000x560"},
)
picture.save("isoline_through_a_point.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure figure --sources 8102 \
#        --distance biharmonic,geodesic,diffusion --isoline-through 8207 \
#        --isolines 8 --cmap uniform --size 1000x560 \
#        -o isoline_through_a_point.png
