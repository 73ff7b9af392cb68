"""
A page that computes
====================

:func:`bihdist.page` writes one HTML file with the mesh and the solver in it. It needs no server and no network: click
the hand below, and the distances start from there; drag to turn it.
"""

import bihdist

distances = ["biharmonic", "biharmonic - geodesic"]
picture = bihdist.figure("hand", distances, source=6835, size="800x460")
picture.save("live_page.png")
page = bihdist.page("hand", "live_page.html", distances, source=6835)

# %%
# The mesh is kept with 24 bits for a coordinate. What that changes is known, as a fraction of the maximum:

print(page.differs)

# %%
# A page can be made from the recipe of a figure, too:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 \
#        --distance 'biharmonic,biharmonic - geodesic' --size 800x460 \
#        -o live_page.png
#    bihdist page --recipe live_page.json -o live_page.html
