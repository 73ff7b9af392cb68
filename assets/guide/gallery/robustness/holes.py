"""
Effect of holes
===============

Twelve round holes are cut into the hand. Shortest paths go around each of them, so the geodesic distance changes only
behind the holes. The biharmonic distance depends on the whole surface and changes a little everywhere: the panels on
the right show by how much.
"""

import bihdist

picture = bihdist.figure(
    "hand",
    ["biharmonic", "geodesic"],
    source=6835,
    perturb="holes=12,seed=3",
    layout={"size": "900x1000"},
)
picture.save("holes.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 --distance biharmonic,geodesic \
#        --perturb holes=12,seed=3 --size 900x1000 -o holes.png
