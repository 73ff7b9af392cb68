"""
Effect of noise
===============

``perturb`` draws each distance before and after a change to the mesh, and the difference of the two, each divided by
its own maximum. Noise of 0.4 mean edge lengths matters most on the thin arms, where the biharmonic distance grows. The
geodesic distance grows almost equally everywhere, so its fractions change little.
"""

import bihdist

picture = bihdist.figure(
    "figure",
    ["biharmonic", "geodesic"],
    source=8102,
    perturb="noise=0.4,along=normals,seed=1",
    layout={"size": "900x1000"},
)
picture.save("noise.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure figure --sources 8102 --distance biharmonic,geodesic \
#        --perturb noise=0.4,along=normals,seed=1 --size 900x1000 \
#        -o noise.png
