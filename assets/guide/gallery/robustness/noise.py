"""
Robustness to noise
===================

``perturb`` draws each distance before and after a change to the mesh, and the difference of the two. Noise of 0.4 mean
edge lengths along the normals roughens the surface, and makes every path along it longer.
"""

import bihdist

picture = bihdist.figure(
    "figure", ["biharmonic", "geodesic"], source=8102, perturb="noise=0.4,along=normals,seed=1", size="900x1000"
)
picture.save("noise.png")

# %%
# .. code-block:: sh
#
#    bihdist figure figure --sources 8102 --distance biharmonic,geodesic \
#        --perturb noise=0.4,along=normals,seed=1 --size 900x1000 -o noise.png
