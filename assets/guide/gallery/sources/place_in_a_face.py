"""
A source inside a face
======================

A source need not be a vertex: a :class:`bihdist.SurfacePoint` is a point in a face, given by the weights of the face's
corners. The inset shows the triangles, and that the isolines close around this point and not around a vertex.
"""

import bihdist

place = bihdist.SurfacePoint.of(10444, 0.2, 0.5)
picture = bihdist.figure(
    "hand",
    ["biharmonic", "geodesic"],
    source=place,
    view={"insets": [(2157, 8, 100)]},
    look={"show_edges": True},
    layout={"size": "1000x480"},
)
picture.save("place_in_a_face.png")

# %%
# On the command line, write the face and the weights of its first two corners:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources f10444:0.2,0.5 \
#        --distance biharmonic,geodesic --insets 2157:8:100 --show-edges \
#        --size 1000x480 -o place_in_a_face.png
