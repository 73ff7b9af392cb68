"""
Isolines at given values
========================

Isolines are at about twenty round values unless you say otherwise: ``isolines`` for how many, ``isoline_spacing`` for
their step, ``isoline_values`` for where they are. Here the values stand on the lines, and there is one colour between
two lines.
"""

import bihdist

values = [0.25, 0.5, 1, 1.5, 2, 2.5, 3, 3.4]
picture = bihdist.figure(
    "domain", ["biharmonic"], source=323, isoline_values=values, isoline_labels=True, bands=True, size="760x560"
)
picture.save("isolines_at_values.png")

# %%
# The curves are there as polylines, too.

field = picture.answers[0].field
for curve in bihdist.isolines(bihdist.sample("domain"), field, [0.5, 3]):
    print(f"at {curve.value}: {len(curve.points)} points, {curve.length:.3f} long")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure domain --sources 323 --distance biharmonic \
#        --isoline-values 0.25,0.5,1,1.5,2,2.5,3,3.4 --isoline-labels --bands \
#        --size 760x560 -o isolines_at_values.png
#    bihdist isolines domain --sources 323 --isoline-values 0.5,3 \
#        -o isolines_at_values.csv
