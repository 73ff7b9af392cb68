"""
Colour maps
===========

Five maps come with the program: ``paper``, which resolves small distances and large ones alike; ``uniform``, where
equal steps look equal; ``ember``; ``safe``, which also works in grey and for colour-blind readers; and ``diverging``.
You can supply another map as a file of colours (``.txt``, ``.csv``, or ParaView's ``.json``), and ``flip_scalars``
reverses any map.
"""

import bihdist

for colours in ["paper", "uniform", "ember", "safe", "diverging"]:
    picture = bihdist.figure(
        "genus3",
        ["biharmonic"],
        source=2617,
        look={"cmap": colours},
        layout={"title": "none", "size": "360x380"},
    )
    picture.save(f"colour_maps-{colours}.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure genus3 --sources 2617 --distance biharmonic \
#        --cmap paper --title none --size 360x380 -o colour_maps-paper.png
#    bihdist figure genus3 --sources 2617 --distance biharmonic \
#        --cmap safe --title none --size 360x380 -o colour_maps-safe.png
