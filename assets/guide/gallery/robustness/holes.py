"""
Robustness to holes
===================

Twelve round holes are cut into the hand. A geodesic has to go around each; the biharmonic distance, which is carried by
all paths together, changes less.
"""

import bihdist

picture = bihdist.figure("hand", ["biharmonic", "geodesic"], source=6835, perturb="holes=12,seed=3", size="900x1000")
picture.save("holes.png")

# %%
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 --distance biharmonic,geodesic --perturb holes=12,seed=3 \
#        --size 900x1000 -o holes.png
