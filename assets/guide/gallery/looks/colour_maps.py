"""
Colour maps
===========

Five maps come with the program: ``paper``, which shows small distances and large ones apart; ``uniform``, where equal
steps look equal; ``ember``; ``safe``, which also works in grey and for colour-blind readers; and ``diverging``. A file
of colours (``.txt``, ``.csv``, or ParaView's ``.json``) makes another, and ``reversed`` turns any of them around.
"""

import bihdist

for colours in ["paper", "uniform", "ember", "safe", "diverging"]:
    picture = bihdist.figure("genus3", ["biharmonic"], source=2617, colours=colours, title="none", size="360x380")
    picture.save(f"colour_maps-{colours}.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure genus3 --sources 2617 --distance biharmonic \
#        --colours paper --title none --size 360x380 -o colour_maps-paper.png
#    bihdist figure genus3 --sources 2617 --distance biharmonic \
#        --colours safe --title none --size 360x380 -o colour_maps-safe.png
