"""
Distances between parcels
=========================

A parcellation divides a surface into labelled regions. :func:`bihdist.parcel_means` gives the distances between all
parcels, as the mean over all pairs of vertices or, as here, from centre to centre. From this matrix, classical scaling
draws a map in which the limbs lie around the body.
"""

import bihdist
import matplotlib.pyplot as plt
import numpy as np

distance = bihdist.BiharmonicDistance(bihdist.sample("beast"))
centres = bihdist.farthest_points(distance, start=7710, count=16)
labels = bihdist.voronoi_regions(
    distance.surface, distance.from_sources(centres)
).labels
matrix = bihdist.parcel_means(distance, labels, reduce="centroid").distances

picture = bihdist.figure(
    "beast",
    ["biharmonic"],
    source=7710,
    marks={"pins": centres, "regions": "all"},
    isolines=0,
    look={"bands": True},
    layout={"size": "520x520"},
)
picture.save("parcels.png")

# %%
middle = np.eye(len(matrix)) - 1 / len(matrix)
values, vectors = np.linalg.eigh(-middle @ matrix**2 @ middle / 2)
x, y = (vectors[:, -2:] * np.sqrt(values[-2:])).T

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
drawn = left.imshow(matrix, cmap="viridis", extent=(0.5, 16.5, 16.5, 0.5))
figure.colorbar(drawn, label="biharmonic distance")
left.set(
    xlabel="parcel", ylabel="parcel", xticks=range(1, 17, 3), yticks=range(1, 17, 3)
)
right.scatter(y, x, c=matrix[0], s=60, cmap="viridis")
for number, place in enumerate(zip(y, x, strict=True), 1):
    right.annotate(str(number), place, xytext=(5, 5), textcoords="offset points")
right.set(aspect="equal", title="classical scaling to the plane")
figure.savefig("parcels-matrix.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure beast --sources 7710 --distance biharmonic \
#        --pins farthest:16:7710 --regions all --isolines 0 --bands \
#        --size 520x520 -o parcels.png
#    bihdist pairs beast --sources farthest:16:7710 -o parcels.npy
