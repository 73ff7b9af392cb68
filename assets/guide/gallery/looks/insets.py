"""
Insets: places enlarged
=======================

``zooms`` enlarges the surroundings of a vertex beside the shape: here the tip of an arm and the source, each with
its factor and its number of isolines.
"""

import bihdist

picture = bihdist.figure(
    "octopus", ["biharmonic"], source=8301, zooms=[(8306, 4, 100), (8301, 3, 60)], views="high", size="900x520"
)
picture.save("insets.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure octopus --sources 8301 --distance biharmonic \
#        --zoom 8306:4:100,8301:3:60 --view high --size 900x520 -o insets.png
