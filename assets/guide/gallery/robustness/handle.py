"""
Effect of a false handle
========================

Scans often join parts that only touch. A thin tube between two fingertips is a shortcut for the geodesic distance,
which drops all along the finger. The biharmonic distance depends on all ways together, and a thin tube carries little
of it.
"""

import bihdist

picture = bihdist.figure(
    "hand",
    ["biharmonic", "geodesic"],
    source=6835,
    perturb="handle=6835:6945",
    layout={"size": "900x1000"},
)
picture.save("handle.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 --distance biharmonic,geodesic \
#        --perturb handle=6835:6945 --size 900x1000 -o handle.png
