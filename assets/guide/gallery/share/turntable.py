"""
Movie of a turning shape
========================

Any figure can turn: ``save_movie`` writes a GIF, or with the extra ``movie`` an MP4 or WebM. It can also swing back and
forth, let the source move through some vertices, and change a parameter such as the diffusion time.
"""

import bihdist

picture = bihdist.figure(
    "elephant",
    ["biharmonic"],
    source=1866,
    isolines=12,
    layout={"title": "none", "size": "320x260"},
)
picture.save("turntable.png")
picture.save_movie("turntable-movie.gif", frames=16, fps=8)

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure elephant --sources 1866 --distance biharmonic \
#        --isolines 12 --title none --size 320x260 -o turntable.png
#    bihdist movie --recipe turntable.json --frames 16 --fps 8 \
#        -o turntable-movie.gif
