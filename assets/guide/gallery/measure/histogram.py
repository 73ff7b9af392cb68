"""
How much of a surface is how far away?
======================================

Statistics are taken over the area, not over the vertices, so that refining one part of the mesh changes nothing. On
the person, measured from the nose, most of what is far away is in the limbs.
"""

import bihdist
import matplotlib.pyplot as plt

distances = ["biharmonic", "geodesic", "commute-time"]
picture = bihdist.figure(
    "scan",
    distances,
    source=8690,
    look={"bands": True, "clim": "fraction"},
    isolines=10,
    layout={"size": "900x520"},
)
picture.save("histogram.png")

# %%
surface = bihdist.sample("scan")
figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
for answer in picture.answers:
    found = bihdist.field_statistics(
        surface, answer.field / answer.field.max(), bins=40
    )
    axes.stairs(
        found.areas / found.areas.sum(),
        found.bins,
        label=f"{answer.label}: mean {found.mean:.2f}",
    )
axes.set(xlabel="fraction of the maximum", ylabel="fraction of the area", xlim=(0, 1))
axes.legend()
figure.savefig("histogram-chart.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure scan --sources 8690 \
#        --distance biharmonic,geodesic,commute-time --bands --isolines 10 \
#        --clim fraction --size 900x520 -o histogram.png
#    bihdist statistics scan --sources 8690 --distance commute-time \
#        --histogram histogram-of-one.png
