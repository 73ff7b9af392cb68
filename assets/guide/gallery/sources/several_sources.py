"""
A row of panels for each source
===============================

A list of sources makes one row of panels per source. Distances are factored once; each further source then costs two
solves.
"""

import bihdist

picture = bihdist.figure(
    "genus3",
    ["biharmonic", "geodesic", "diffusion"],
    source=[2617, 2656],
    isolines=14,
    layout={"size": "900x700"},
)
picture.save("several_sources.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure genus3 --sources 2617,2656 \
#        --distance biharmonic,geodesic,diffusion --isolines 14 \
#        --size 900x700 -o several_sources.png
