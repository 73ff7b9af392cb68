"""
Regions around points
=====================

The region of a pin is the part of the surface that is nearer to it than to any other pin, in the distance shown in the
panel. The boundaries are exact: they cross faces where the two distances are equal.
"""

import bihdist

pins = [9403, 6739, 2068, 22, 133, 19, 9467]
picture = bihdist.figure(
    "animal",
    ["biharmonic", "geodesic"],
    source=9403,
    marks={"pins": pins, "regions": "all"},
    isolines=0,
    view={"cpos": "front"},
    layout={"size": "1000x520"},
)
picture.save("voronoi_regions.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure animal --sources 9403 --distance biharmonic,geodesic \
#        --pins 9403,6739,2068,22,133,19,9467 --regions all --isolines 0 \
#        --cpos front --size 1000x520 -o voronoi_regions.png
#    bihdist regions animal --sources 9403,6739,2068,22,133,19,9467 \
#        -o voronoi_regions.csv
