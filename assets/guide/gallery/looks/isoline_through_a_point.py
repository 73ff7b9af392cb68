"""
Everything as far as one point
==============================

``isoline_through`` draws one more isoline, through a vertex of your choice: all that is exactly as far from the source
as that vertex. From the top of the head, the fingertips are as far as the thighs by the geodesic distance, the knees by
the biharmonic distance and the shins by the diffusion distance.
"""

import bihdist

picture = bihdist.figure(
    "figure",
    ["biharmonic", "geodesic", "diffusion"],
    source=8102,
    isoline_through=[8207],
    isolines=8,
    colours="uniform",
    size="1000x560",
)
picture.save("isoline_through_a_point.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure figure --sources 8102 \
#        --distance biharmonic,geodesic,diffusion --isoline-through 8207 \
#        --isolines 8 --colours uniform --size 1000x560 \
#        -o isoline_through_a_point.png
