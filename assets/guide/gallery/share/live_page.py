"""
A page that computes
====================

:func:`bihdist.page` writes one HTML file that contains the mesh and the solver. It needs no server and no network:
click the hand below, and the distances start from there; drag to turn it.
"""

import bihdist

distances = ["biharmonic", "biharmonic - geodesic"]
picture = bihdist.figure("hand", distances, source=6835, layout={"size": "800x460"})
picture.save("live_page.png")
page = bihdist.page("hand", "live_page.html", distances, source=6835)

# %%
# The mesh is stored with 24 bits per coordinate. The resulting deviation is known, as a fraction of the maximum:

print(page.differs)

# %%
# You can also make a page from the recipe of a figure:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 \
#        --distance 'biharmonic,biharmonic - geodesic' --size 800x460 \
#        -o live_page.png
#    bihdist page --recipe live_page.json -o live_page.html
