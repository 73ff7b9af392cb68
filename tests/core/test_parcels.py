"""Mean distances between parcels, and the names that files have for parcels."""

import gzip
import itertools

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, ParameterError
from bihdist_core.analysis.parcels import labelled, parcel_means, parcel_sums
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import MeshError
from bihdist_core.formats.gifti import label_table
from bihdist_core.formats.whole_numbers import read_labels
from bihdist_core.laplacian import Laplacian
from tests.core.mesh_samples import gifti, gifti_array
from tests.core.test_freesurfer import NAMES, annotation
from tests.core.test_freesurfer_label import label
from tests.shapes import bumpy, two_pieces

SURFACE = bumpy(300)
LABELS = np.random.default_rng(3).integers(-1, 7, len(SURFACE.vertices)) * 10


def slow_means(distance, labels):
    """Pair by pair, in words of the definition."""
    n = len(distance.surface.vertices)
    rows = distance.from_sources(np.arange(n))
    rows = (rows + rows.T) / 2
    names = sorted(set(labels[labels >= 0].tolist()))
    return names, [[rows[np.ix_(labels == a, labels == b)].mean() for b in names] for a in names]


@pytest.mark.parametrize("word", ["biharmonic", "geodesic(method=dijkstra)", "geodesic(method=heat)"])
def test_means_are_those_of_the_full_rows(word):
    distance = Spec.parse(word).build(Laplacian(SURFACE), None)
    found = parcel_means(distance, LABELS, memory=1e5)
    names, means = slow_means(distance, LABELS)
    assert found.labels.tolist() == names
    assert found.counts.tolist() == [int((name == LABELS).sum()) for name in names]
    np.testing.assert_allclose(found.distances, means, rtol=1e-12)


def test_parts_added_up_are_the_whole():
    distance = BiharmonicDistance(SURFACE)
    whole = parcel_means(distance, LABELS)
    cuts = [0, 17, 100, len(labelled(SURFACE, LABELS))]
    parts = [parcel_sums(distance, LABELS, None, a, b) for a, b in itertools.pairwise(cuts)]
    np.testing.assert_allclose((parts[2] + parts[0] + parts[1]).parcels.distances, whole.distances, rtol=1e-13)


def test_what_is_masked_does_not_count():
    distance = BiharmonicDistance(SURFACE)
    mask = np.arange(len(LABELS)) % 3 > 0
    found = parcel_means(distance, LABELS, mask)
    np.testing.assert_allclose(found.distances, slow_means(distance, np.where(mask, LABELS, -1))[1], rtol=1e-12)


@pytest.mark.parametrize("word", ["biharmonic", "geodesic(method=exact)"])
def test_other_reductions_are_those_of_the_full_rows(word):
    distance = Spec.parse(word).build(Laplacian(SURFACE), None)
    rows, areas, x = distance.from_sources(np.arange(300)), distance.laplacian.areas, SURFACE.vertices
    members = [np.flatnonzero(name == LABELS) for name in np.unique(LABELS[LABELS >= 0])]
    blocks = [[rows[np.ix_(a, b)] for b in members] for a in members]
    least = [[each.min() for each in row] for row in blocks]
    hausdorff = [[max(each.min(axis=0).max(), each.min(axis=1).max()) for each in row] for row in blocks]
    centres = [a[np.linalg.norm(x[a] - np.average(x[a], axis=0, weights=areas[a]), axis=1).argmin()] for a in members]
    mean = [
        [(np.outer(areas[a], areas[b]) * rows[np.ix_(a, b)]).sum() / areas[a].sum() / areas[b].sum() for b in members]
        for a in members
    ]
    for reduce, weights, expected in (
        ("min", None, least),
        ("hausdorff", None, hausdorff),
        ("centroid", "area", rows[np.ix_(centres, centres)]),
        ("mean", "area", mean),
    ):
        found = parcel_means(distance, LABELS, reduce=reduce, weights=weights)
        np.testing.assert_allclose(found.distances, expected, rtol=1e-9, atol=1e-12)
    with pytest.raises(ParameterError, match="reduced by mean, min, centroid, hausdorff, not by 'max'"):
        parcel_means(distance, LABELS, reduce="max")
    with pytest.raises(ParameterError, match="weighed by 'area' or by None, not by 'mass'"):
        parcel_means(distance, LABELS, weights="mass")


def test_labels_may_be_strings():
    distance = BiharmonicDistance(SURFACE)
    named = np.where(LABELS < 0, "", np.char.add("area ", LABELS.astype(str)))
    found, expected = parcel_means(distance, named), parcel_means(distance, LABELS)
    order = [f"area {name}" for name in expected.labels]
    assert sorted(order) == found.labels.tolist()
    place = [found.labels.tolist().index(name) for name in order]
    np.testing.assert_allclose(found.distances[np.ix_(place, place)], expected.distances, rtol=1e-12)


def test_labels_may_be_strings_of_python_and_memory_is_a_number():
    """As pandas and Python have them."""
    distance = BiharmonicDistance(SURFACE)
    words = np.array(["", *"abcdefg"])[LABELS // 10 + 1]
    expected = parcel_means(distance, words)
    for reduce in ("mean", "centroid"):
        found = parcel_means(distance, words.astype(object), reduce=reduce)
        assert np.array_equal(found.labels, expected.labels)
    assert np.array_equal(parcel_means(distance, words.tolist()).distances, expected.distances)
    with pytest.raises(ParameterError, match="The memory for a block is a number, not 'much'"):
        parcel_means(distance, LABELS, memory="much")


def test_between_components_there_is_no_mean():
    surface = two_pieces()
    # One vertex belongs to no face; it has a label all the same, and does not count.
    labels = np.maximum(surface.component_of_vertex, 0) * 2 + np.arange(len(surface.vertices)) % 2
    distance = BiharmonicDistance(surface)
    means = parcel_means(distance, labels).distances
    piece = np.arange(4) // 2
    assert np.array_equal(np.isnan(means), piece[:, None] != piece)
    here, there = (np.flatnonzero((labels == k) & (surface.component_of_vertex >= 0)) for k in (0, 1))
    assert means[0, 1] == pytest.approx(distance.from_sources(here)[there].mean(), rel=1e-12)


@pytest.mark.parametrize(
    ("labels", "mask", "words"),
    [
        (LABELS[:-1], None, "one for each"),
        (LABELS * 1.0, None, "whole numbers or strings"),
        (np.full(len(LABELS), -1), None, "No vertex"),
        (LABELS, np.ones(3), "0 or 1 for each"),
        (LABELS, LABELS, "0 or 1 for each"),
    ],
)
def test_what_cannot_be_is_refused(labels, mask, words):
    with pytest.raises(ParameterError, match=words):
        parcel_means(BiharmonicDistance(SURFACE), labels, mask)


# ---------------------------------------------------------------------- parcel labels
NAMED = np.array([3, 0, 3, 1, -1], "i4")


def named_gifti(labels=NAMED, table=((0, "???"), (3, "V1"), (1, " S1 &amp; M1 ")), key="Key"):
    """A file of labels with a table of their names."""
    rows = "".join(f'<Label {key}="{k}" Red="1" Green="0" Blue="0" Alpha="1">{name}</Label>' for k, name in table)
    content = gifti(gifti_array("LABEL", labels)).decode()
    return content.replace("<LabelTable/>", f"<LabelTable>{rows}</LabelTable>").encode()


def test_names_of_gifti_stand_in_its_table(put):
    for path in (put("lh.label.gii", named_gifti()), put("a.label.gii.gz", gzip.compress(named_gifti(key="Index")))):
        found = read_labels(path, 5)
        np.testing.assert_array_equal(found.values, NAMED)
        assert found.names == {0: "???", 3: "V1", 1: "S1 & M1"}


def test_names_of_an_annotation_are_those_of_its_table(put):
    found = read_labels(put("lh.aparc.annot", annotation()), 5)
    assert found.values.tolist() == [1, 2, 0, 2, -1]
    assert found.names == dict(enumerate(NAMES))


def test_the_vertices_of_a_label_are_one_parcel_with_its_name(put):
    found = read_labels(put("lh.V1.label", label([4, 1])), 5)
    assert found.values.tolist() == [-1, 0, -1, -1, 0]
    assert found.names == {0: "V1"}


def test_bare_numbers_have_no_names(tmp_path):
    np.save(tmp_path / "labels.npy", NAMED)
    found = read_labels(tmp_path / "labels.npy", 5)
    np.testing.assert_array_equal(found.values, NAMED)
    assert found.names == {}


def test_a_key_is_a_whole_number(put):
    with pytest.raises(MeshError, match=r"^a\.gii: label 1 of its table has the key 'x', not a whole number\.$"):
        label_table(named_gifti(table=((0, "a"), ("x", "b"))), "a.gii")
    with pytest.raises(ParameterError, match="has the key '', not"):
        read_labels(put("lh.label.gii", named_gifti(key="Number")), 5)
