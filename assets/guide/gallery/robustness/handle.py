"""
What a wrong handle changes
===========================

A scan often joins what only touches. A thin tube between two fingertips is a shortcut for the geodesic distance, which
falls at once all along the finger. The biharmonic distance is carried by all ways together, and a thin tube carries
little.
"""

import bihdist

picture = bihdist.figure("hand", ["biharmonic", "geodesic"], source=6835, perturb="handle=6835:6945", size="900x1000")
picture.save("handle.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 --distance biharmonic,geodesic \
#        --perturb handle=6835:6945 --size 900x1000 -o handle.png
