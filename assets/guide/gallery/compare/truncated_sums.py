"""
How many eigenpairs are enough?
===============================

The biharmonic distance is a sum over all eigenpairs of the Laplacian. Other programs stop after the first *k*; here
the distance is exact, so the truncation error can be measured. With few eigenpairs, the isolines around the source are
wide and uneven.
"""

import bihdist
import matplotlib.pyplot as plt

distances = ["truncated(k=5)", "truncated(k=20)", "truncated(k=100)", "biharmonic"]
picture = bihdist.figure(
    "animal",
    distances,
    source=5339,
    view={"cpos": "front"},
    layout={"size": "1200x380"},
)
picture.save("truncated_sums.png")

# %%
# :func:`bihdist.truncation_loss` gives the error for each *k* up to 100, as a fraction of the largest distance.

loss = bihdist.truncation_loss(bihdist.sample("animal"), 5339, most=100)
figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
axes.loglog(loss.counts, loss.largest, label="largest over the surface")
axes.loglog(loss.counts, loss.means, label="mean by area")
axes.set(xlabel="eigenpairs $k$", ylabel="loss, fraction of the maximum")
axes.grid(alpha=0.3)
axes.legend()
figure.savefig("truncated_sums-loss.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure animal --sources 5339 --cpos front --size 1200x380 \
#        -o truncated_sums.png \
#        --distance 'truncated(k=5),truncated(k=20),truncated(k=100),biharmonic'
#    bihdist statistics animal --sources 5339 --truncation --k 100
