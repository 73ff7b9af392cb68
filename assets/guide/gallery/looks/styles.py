"""
Styles: for paper, for slides, in lines alone
=============================================

A style sets the ground, the colours of lines and words, and the light: ``paper`` is white with white isolines,
``uniform`` has a perceptually uniform map, ``dark`` is for slides, and ``lines`` draws outlines and isolines in black,
which print anywhere.
"""

import bihdist

for style in ["paper", "uniform", "dark", "lines"]:
    picture = bihdist.figure("beast", ["biharmonic"], source=1437, views="home-right", style=style, size="420x420")
    picture.save(f"styles-{style}.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure beast --sources 1437 --distance biharmonic \
#        --view home-right --style dark --size 420x420 -o styles-dark.png
#    bihdist figure beast --sources 1437 --distance biharmonic \
#        --view home-right --style lines --size 420x420 -o styles-lines.png
