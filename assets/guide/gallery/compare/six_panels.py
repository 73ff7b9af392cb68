"""
Six distances in two rows
=========================

A figure has as many panels as you name distances; ``columns`` sets how many appear side by side. With
``clim="fraction"``, all colour bars show fractions of the maximum, so that colours mean the same in every panel
although the units differ. Parameters are given in parentheses.
"""

import bihdist

distances = [
    "biharmonic",
    "commute-time",
    "diffusion(t=1/4)",
    "geodesic",
    "truncated(k=20)",
    "power(alpha=3)",
]
picture = bihdist.figure(
    "beast",
    distances,
    source=8382,
    layout={"columns": 3, "size": "1000x860"},
    look={"clim": "fraction"},
)
picture.save("six_panels.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure beast --sources 8382 --columns 3 --clim fraction \
#        --size 1000x860 -o six_panels.png \
#        \
#        --distance \
#        'biharmonic,commute-time,diffusion(t=1/4),geodesic,truncated(k=20),power(alpha=3)'
