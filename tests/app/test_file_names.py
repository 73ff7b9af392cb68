"""Names of files that nobody has typed: one pattern for all."""

import pytest

from app.document.file_names import file_name


@pytest.mark.parametrize(
    ("meshes", "what", "of", "name"),
    [
        (["/home/a/spot.obj"], "figure", (), "spot-figure"),
        (["spot.obj"], "field", ("biharmonic_from_12",), "spot-field-biharmonic-from-12"),
        (["cat.off", "dog.off"], "pairs", (), "cat-dog-pairs"),
        (["cat.off", "cat.off"], "map", ("diffusion(t=1/4)",), "cat-map-diffusion-t-1-4"),
        (["hand, noise 0.3"], "regions", ("labels",), "hand-noise-0.3-regions-labels"),
        (["scan.v2.ply"], "selection", ("left / right: ß",), "scan.v2-selection-left-right-ß"),
        ([""], "session", (), "session"),
        ([], "curve", (), "curve"),
    ],
)
def test_a_name_says_the_mesh_what_it_is_and_of_what(meshes, what, of, name):
    assert file_name(meshes, what, *of) == name
