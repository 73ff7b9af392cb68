"""
Profile along a path
====================

Distances along a path show where a field is steep, flat, or has a kink. Here the path is the shortest one from the tip
of the middle finger over the palm to the tip of the thumb, through one vertex in between.
"""

import bihdist
import matplotlib.pyplot as plt

through = [6945, 2157, 4506]
picture = bihdist.figure(
    "hand",
    ["biharmonic", "geodesic", "diffusion"],
    source=6945,
    marks={"profile": through},
    layout={"size": "1000x440"},
)
picture.save("profile_along_a_path.png")

# %%
# The path provides coordinates, lengths, and the values of any field along it.

path = bihdist.GeodesicPaths(bihdist.sample("hand")).path(through)
figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
for answer in picture.answers:
    axes.plot(
        path.arcs, path.along(answer.field) / answer.field.max(), label=answer.label
    )
axes.set(
    xlabel="length along the path",
    ylabel="fraction of the maximum",
    xlim=(0, path.length),
    ylim=(0, 1),
)
axes.grid(alpha=0.3)
axes.legend()
figure.savefig("profile_along_a_path-chart.png")

# %%
# The ``profile`` command writes such a chart, and the numbers:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6945 \
#        --distance biharmonic,geodesic,diffusion --profile 6945,2157,4506 \
#        --size 1000x440 -o profile_along_a_path.png
#    bihdist profile hand --sources 6945 --through 6945,2157,4506 \
#        -o profile.csv --chart profile.png
