"""
How much of a surface is how far?
=================================

Statistics are over the area, not over vertices, so that a finer mesh of one part changes nothing. On the person, seen
from the nose, the limbs hold most of what is far away.
"""

import bihdist
import matplotlib.pyplot as plt

distances = ["biharmonic", "geodesic", "commute-time"]
picture = bihdist.figure("scan", distances, source=8690, bands=True, isolines=10, range="shares", size="900x520")
picture.save("histogram.png")

# %%
surface = bihdist.sample("scan")
figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
for answer in picture.answers:
    found = bihdist.field_statistics(surface, answer.field / answer.field.max(), bins=40)
    axes.stairs(found.areas / found.areas.sum(), found.bins, label=f"{answer.label}: mean {found.mean:.2f}")
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
#        --range shares --size 900x520 -o histogram.png
#    bihdist statistics scan --sources 8690 --distance commute-time \
#        --histogram histogram-of-one.png
