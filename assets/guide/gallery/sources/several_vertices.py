"""
The nearest of several vertices
===============================

A :class:`bihdist.SourceSet` is one source made of several vertices: the distance is measured from the nearest of them.
On the command line, the vertices are joined by a plus. Here they are the five fingertips.
"""

import bihdist

tips = bihdist.SourceSet((6945, 6835, 6772, 5885, 4506))
picture = bihdist.figure(
    "hand", ["biharmonic", "geodesic"], source=tips, layout={"size": "800x520"}
)
picture.save("several_vertices.png")

# %%
# You need not look for the tips by hand: :func:`bihdist.tips` finds the ends of limbs, and one at the open wrist.

print(bihdist.tips(bihdist.sample("hand")))

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6945+6835+6772+5885+4506 \
#        --distance biharmonic,geodesic --size 800x520 \
#        -o several_vertices.png
