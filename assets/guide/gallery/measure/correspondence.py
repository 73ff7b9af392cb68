"""
Corresponding points of two poses
=================================

A few known pairs of corresponding vertices give every other vertex a vector of its distances to them. Its match is the
vertex of the other mesh with the most similar vector. This map transfers the colours of the crouching beast to the
standing one; where the map is right, both have the same colours.
"""

import bihdist

known = [7710, 1437, 2991, 2990, 1, 8, 3129, 5444, 5711, 8942, 6525, 8382, 8393, 1758]
pairs = [(vertex, vertex) for vertex in known]
with open("correspondence-pairs.csv", "w") as file:
    file.writelines(f"{one},{other}\n" for one, other in pairs)

picture = bihdist.figure(
    "beast",
    ["biharmonic"],
    second_mesh="beast_pose2",
    pairs=pairs,
    maps=["pairs"],
    layout={"size": "900x520"},
)
picture.save("correspondence.png")

# %%
# Both poses have the same vertices, so the error of the whole map is known. It is the geodesic distance from each
# match to the true vertex.

one, other = bihdist.sample("beast"), bihdist.sample("beast_pose2")
found = bihdist.Correspondence(
    bihdist.BiharmonicDistance(one), bihdist.BiharmonicDistance(other), pairs
).map()
errors = bihdist.map_errors(
    bihdist.GeodesicDistance(other), found[::20], range(0, len(found), 20)
)
curve = bihdist.error_curve(errors)
print(f"error in roots of the area: mean {curve.mean:.4f}, median {curve.median:.4f}")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure beast beast_pose2 --distance biharmonic --map pairs \
#        --size 900x520 -o correspondence.png \
#        --pairs @correspondence-pairs.csv
#    bihdist correspond beast beast_pose2 -o correspondence.txt \
#        --pairs @correspondence-pairs.csv
