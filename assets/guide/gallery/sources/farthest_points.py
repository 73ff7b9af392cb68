"""
Points spread over a surface
============================

Farthest point sampling starts at one vertex and repeatedly adds the vertex farthest from those chosen so far. With the
biharmonic distance, the first samples are the ends of limbs. The pins are numbered in the order of the samples.
"""

import bihdist

surface = bihdist.sample("beast")
distance = bihdist.BiharmonicDistance(surface)
points = bihdist.farthest_points(distance, start=7710, count=14)
print(points)

picture = bihdist.figure(
    "beast",
    ["biharmonic"],
    source=7710,
    marks={"pins": points},
    view={"cpos": ["home", "home-back"]},
    layout={"size": "900x480"},
)
picture.save("farthest_points.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist samples beast --sources farthest:14:7710 -o farthest_points.txt
#    bihdist figure beast --sources 7710 --distance biharmonic \
#        --pins farthest:14:7710 --cpos home,home-back --size 900x480 \
#        -o farthest_points.png
