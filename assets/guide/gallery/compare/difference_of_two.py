"""
Difference of two distances
===========================

Two names with a minus between them make a panel of their own: each distance is first divided by its maximum, and the
difference is shown in percentage points, with its own colour map and a mark where it is largest. The other fingers are
farther away in biharmonic than in geodesic distance, because only the palm connects them.
"""

import bihdist

distances = ["biharmonic", "geodesic", "biharmonic - geodesic"]
picture = bihdist.figure("hand", distances, source=6835, layout={"size": "1000x480"})
picture.save("difference_of_two.png")

# %%
# If both distances have the same unit, ``raw`` compares the values themselves.

picture = bihdist.figure(
    "hand", ["raw biharmonic - geodesic"], source=6835, layout={"size": "420x480"}
)
answer = picture.answers[0]
print(f"{answer.field.min():.3f} to {answer.field.max():.3f} {answer.unit}")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 \
#        --distance 'biharmonic,geodesic,biharmonic - geodesic' \
#        --size 1000x480 -o difference_of_two.png
