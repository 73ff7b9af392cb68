"""
Several components and many holes
=================================

The hare is what four scanners saw of it: seven components and twenty boundary loops. There is no distance between
components, so the parts that the source cannot reach are grey; no repair is needed beforehand, and vertex ids stay the
same.
"""

import bihdist

picture = bihdist.figure(
    "hare", ["biharmonic", "geodesic"], source=7991, layout={"size": "800x560"}
)
picture.save("components_and_boundaries.png")

# %%
surface = bihdist.sample("hare")
print(surface.n_components, "components;", ", ".join(surface.facts))

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hare --sources 7991 --distance biharmonic,geodesic \
#        --size 800x560 -o components_and_boundaries.png
#    bihdist info hare
