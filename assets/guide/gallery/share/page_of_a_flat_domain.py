"""
A page of a flat domain
=======================

In a room with walls, the biharmonic distance goes around corners, and its isolines are smooth where the isolines of
the geodesic distance have kinks behind each corner. Click a corridor, and compare.
"""

import bihdist

distances = ["biharmonic", "geodesic"]
picture = bihdist.figure("domain", distances, source=323, layout={"size": "1000x400"})
picture.save("page_of_a_flat_domain.png")
bihdist.page(
    "domain",
    "page_of_a_flat_domain.html",
    distances,
    source=323,
    view={"cpos": "front"},
)

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure domain --sources 323 --distance biharmonic,geodesic \
#        --size 1000x400 -o page_of_a_flat_domain.png
#    bihdist page domain --sources 323 --distance biharmonic,geodesic \
#        --cpos front -o page_of_a_flat_domain.html
