"""
One distance against another
============================

Each vertex is a point, with one distance along the horizontal axis and another along the vertical one. Where the
points lie on a curve, both distances order the surface in the same way. The biharmonic distance grows faster along the
thin tail than along the wide body; the geodesic distance does not distinguish them.
"""

import bihdist
import matplotlib.pyplot as plt

picture = bihdist.figure(
    "elephant", ["biharmonic", "geodesic"], source=1866, layout={"size": "900x420"}
)
picture.save("scatter_of_two.png")

# %%
surface = bihdist.sample("elephant")
biharmonic, geodesic = (answer.field for answer in picture.answers)
points = bihdist.field_scatter(surface, biharmonic, geodesic, normalised=True)
agreement = bihdist.field_agreement(surface, biharmonic, geodesic, normalised=True)

figure, axes = plt.subplots(figsize=(5.5, 4.5), layout="constrained")
drawn = axes.scatter(
    points.x,
    points.y,
    s=3,
    c=surface.vertices[points.ids, 0],
    cmap="viridis",
    rasterized=True,
)
axes.plot([0, 1], [0, 1], color="0.6", linewidth=1)
axes.set(
    xlabel="biharmonic, fraction of the maximum",
    ylabel="geodesic, fraction of the maximum",
)
axes.set(title=f"rank correlation {agreement.spearman:.3f}")
figure.colorbar(drawn, label="position from tail to trunk")
figure.savefig("scatter_of_two-points.png")

# %%
# The ``statistics`` command draws such a chart, too:
#
# .. code-block:: sh
#
#    bihdist figure elephant --sources 1866 --distance biharmonic,geodesic \
#        --size 900x420 -o scatter_of_two.png
#    bihdist statistics elephant --sources 1866 \
#        --distance biharmonic,geodesic --scatter scatter.png
