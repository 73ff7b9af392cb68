"""
Local extrema and the tips of limbs
===================================

A distance has its minimum at the source, and should have maxima only where the shape ends. Triangles mark all extrema
with a persistence of more than a thousandth of the range. The biharmonic distance has as many maxima as the octopus
has tips; the geodesic distance has more, where its fronts meet on the far sides of the arms.
"""

import bihdist

picture = bihdist.figure(
    "octopus",
    ["biharmonic", "geodesic", "diffusion"],
    source=8301,
    look={"extrema": True},
    view={"cpos": "high"},
    layout={"size": "1100x420"},
)
picture.save("extrema_and_tips.png")

# %%
surface = bihdist.sample("octopus")
for answer in picture.answers:
    found = bihdist.extrema(surface, answer.field)
    print(f"{answer.label:24} {len(found.maxima)} maxima, {len(found.minima)} minima")
print("tips of limbs:", *bihdist.tips(surface))

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure octopus --sources 8301 \
#        --distance 'biharmonic,geodesic,diffusion' --extrema --cpos high \
#        --size 1100x420 -o extrema_and_tips.png
