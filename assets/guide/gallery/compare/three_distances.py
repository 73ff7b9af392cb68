"""
Three distances from one source
===============================

:func:`bihdist.figure` draws one panel for each distance, with one camera and with isolines at round values. The
isolines of the geodesic distance are circles around the source, far into the shape. Those of the biharmonic distance
also close around the source, but soon follow the shape: straight across the trunk, and level along the legs.
"""

import bihdist

distances = ["biharmonic", "geodesic", "diffusion"]
picture = bihdist.figure(
    "animal",
    distances,
    source=5339,
    view={"cpos": "front"},
    layout={"size": "1000x420"},
)
picture.save("three_distances.png")

# %%
# Each panel has its own unit and its own maximum. The values are also available:

for answer in picture.answers:
    print(f"{answer.label:24} up to {answer.field.max():.3f}")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure animal --sources 5339 \
#        --distance biharmonic,geodesic,diffusion --cpos front \
#        --size 1000x420 -o three_distances.png
