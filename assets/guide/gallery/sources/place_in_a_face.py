"""
A source inside a face
======================

A source need not be a vertex: a :class:`bihdist.SurfacePoint` is a place in a face, by the weights of its corners. The
inset shows the triangles, and that the isolines close around the place and not around a vertex.
"""

import bihdist

place = bihdist.SurfacePoint.of(10444, 0.2, 0.5)
picture = bihdist.figure(
    "hand", ["biharmonic", "geodesic"], source=place, zooms=[(2157, 8, 100)], wireframe=True, size="1000x480"
)
picture.save("place_in_a_face.png")

# %%
# In words it is the face with the weights of its first two corners:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources f10444:0.2,0.5 \
#        --distance biharmonic,geodesic --zoom 2157:8:100 --wireframe \
#        --size 1000x480 -o place_in_a_face.png
