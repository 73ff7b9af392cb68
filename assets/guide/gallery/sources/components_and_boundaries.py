"""
Several components and many holes
=================================

The hare is what four scanners saw of it: seven components and twenty boundary loops. There is no distance between
components, so what the source cannot reach is grey; nothing has to be repaired before, and vertex ids stay.
"""

import bihdist

picture = bihdist.figure("hare", ["biharmonic", "geodesic"], source=7991, size="800x560")
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
