"""
Isolines at given values
========================

By default, isolines are drawn at about twenty round values. ``isolines`` accepts a different number, or a dict with
their ``spacing`` or their ``values``. Here the isolines are labelled with their values, and the space between two
isolines has a single colour.
"""

import bihdist

values = [0.25, 0.5, 1, 1.5, 2, 2.5, 3, 3.4]
picture = bihdist.figure(
    "domain",
    ["biharmonic"],
    source=323,
    isolines={"values": values, "labels": True},
    look={"bands": True},
    layout={"size": "760x560"},
)
picture.save("isolines_at_values.png")

# %%
# The curves are also available as polylines.

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
