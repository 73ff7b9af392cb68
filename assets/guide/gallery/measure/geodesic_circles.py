"""
How round is a distance around its source?
==========================================

Along a geodesic circle around the source, a perfectly round distance would be constant. The biharmonic distance is
nearly constant close to the source; with 20 eigenpairs it is not.
"""

import bihdist
import matplotlib.pyplot as plt

source, distances = 5339, ["biharmonic", "truncated(k=20)", "geodesic"]
picture = bihdist.figure(
    "animal",
    distances,
    source=source,
    view={"insets": [(source, 4, 60)], "cpos": "front"},
    layout={"size": "1000x420"},
)
picture.save("geodesic_circles.png")

# %%
# Plot each field along circles of three radii, against the angle in the tangent plane of the source:

surface = bihdist.sample("animal")
geodesic = picture.answers[2].field
figure, charts = plt.subplots(
    1, 2, figsize=(8, 4), subplot_kw={"projection": "polar"}, layout="constrained"
)
for answer, axes in zip(picture.answers, charts, strict=False):
    for circle in bihdist.geodesic_circles(
        surface, answer.field, geodesic, source, radii=[0.1, 0.2, 0.3]
    ):
        for angles, values in zip(circle.angles, circle.values, strict=True):
            axes.plot(
                angles,
                values,
                label=f"radius {circle.radius}: ratio {circle.ratio:.2f}",
            )
    axes.set_title(answer.label)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, -0.4), fontsize=8)
figure.savefig("geodesic_circles-polar.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure animal --sources 5339 \
#        --distance 'biharmonic,truncated(k=20),geodesic' --insets 5339:4:60 \
#        --cpos front --size 1000x420 -o geodesic_circles.png
