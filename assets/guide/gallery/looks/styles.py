"""
Styles for paper and slides
===========================

A style sets the background, the colours of lines and text, and the lighting: ``paper`` is white with white isolines,
``uniform`` has a perceptually uniform map, ``dark`` is for slides, and ``lines`` draws only outlines and isolines, in
black, which print anywhere.
"""

import bihdist

for style in ["paper", "uniform", "dark", "lines"]:
    picture = bihdist.figure(
        "beast",
        ["biharmonic"],
        source=1437,
        view={"cpos": "home-right"},
        layout={"style": style, "size": "420x420"},
    )
    picture.save(f"styles-{style}.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure beast --sources 1437 --distance biharmonic \
#        --cpos home-right --style dark --size 420x420 -o styles-dark.png
#    bihdist figure beast --sources 1437 --distance biharmonic \
#        --cpos home-right --style lines --size 420x420 -o styles-lines.png
