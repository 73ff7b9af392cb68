"""
The difference of two distances
===============================

Two names with a minus between them are a panel of their own: each distance is divided by its maximum first, and the
difference is in percentage points, with a colour map of its own and a mark where it is largest. To the other fingers it
is farther by the biharmonic distance than by the geodesic one, since nothing but the palm joins them.
"""

import bihdist

distances = ["biharmonic", "geodesic", "biharmonic - geodesic"]
picture = bihdist.figure("hand", distances, source=6835, size="1000x480")
picture.save("difference_of_two.png")

# %%
# Where both have one unit, ``raw`` compares the values themselves.

picture = bihdist.figure("hand", ["raw biharmonic - geodesic"], source=6835, size="420x480")
print(f"{picture.answers[0].field.min():.3f} to {picture.answers[0].field.max():.3f} {picture.answers[0].unit}")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 \
#        --distance 'biharmonic,geodesic,biharmonic - geodesic' \
#        --size 1000x480 -o difference_of_two.png
