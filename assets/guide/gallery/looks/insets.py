"""
Insets that enlarge details
===========================

``insets`` enlarges the surroundings of a vertex next to the shape: here the tip of an arm and the source, each with
its own magnification and number of isolines.
"""

import bihdist

picture = bihdist.figure(
    "octopus",
    ["biharmonic"],
    source=8301,
    view={"insets": [(8306, 4, 100), (8301, 3, 60)], "cpos": "high"},
    layout={"size": "900x520"},
)
picture.save("insets.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure octopus --sources 8301 --distance biharmonic \
#        --insets 8306:4:100,8301:3:60 --cpos high --size 900x520 -o insets.png
