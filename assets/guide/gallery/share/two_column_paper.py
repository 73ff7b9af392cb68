"""
Figure for a two-column paper
=============================

``double`` is the width of a page with two columns, 178 mm, and ``column`` the width of one column, 85 mm; isolines and
text are vectors in PDF and SVG. Names are captions at the colour bars, every fifth isoline is labelled with its value,
empty margins are cropped, and ``tex=True`` writes a LaTeX snippet with a caption that describes the figure.
"""

from pathlib import Path

import bihdist

picture = bihdist.figure(
    "figure",
    ["biharmonic", "geodesic", "biharmonic - geodesic"],
    source=8207,
    isolines={"bold": 5, "labels": True},
    layout={"title": "caption", "crop": True, "size": "178mm@150dpi"},
)
picture.save("two_column_paper.png")
picture.save("two_column_paper.pdf", tex=True)

# %%
# The snippet:

print(Path("two_column_paper.tex").read_text())

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure figure --sources 8207 \
#        --distance 'biharmonic,geodesic,biharmonic - geodesic' \
#        --bold-isolines 5 --isoline-labels --title caption --crop \
#        --size 178mm@150dpi -o two_column_paper.png
#    bihdist figure --recipe two_column_paper.json --tex \
#        -o two_column_paper.pdf
