"""Labels of vertices with the names that files have for them."""

import gzip

import numpy as np
import pytest

from bihdist_core.errors import MeshError, ParameterError
from bihdist_core.formats.gifti import label_table
from bihdist_core.formats.parcel_labels import read_labels
from tests.core.mesh_samples import gifti, gifti_array
from tests.core.test_freesurfer import NAMES, annotation
from tests.core.test_freesurfer_label import label

LABELS = np.array([3, 0, 3, 1, -1], "i4")


def named_gifti(labels=LABELS, table=((0, "???"), (3, "V1"), (1, " S1 &amp; M1 ")), key="Key"):
    """A file of labels with a table of their names."""
    rows = "".join(f'<Label {key}="{k}" Red="1" Green="0" Blue="0" Alpha="1">{name}</Label>' for k, name in table)
    content = gifti(gifti_array("LABEL", labels)).decode()
    return content.replace("<LabelTable/>", f"<LabelTable>{rows}</LabelTable>").encode()


def test_names_of_gifti_stand_in_its_table(put):
    for path in (put("lh.label.gii", named_gifti()), put("a.label.gii.gz", gzip.compress(named_gifti(key="Index")))):
        found = read_labels(path, 5)
        np.testing.assert_array_equal(found.values, LABELS)
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
    np.save(tmp_path / "labels.npy", LABELS)
    found = read_labels(tmp_path / "labels.npy", 5)
    np.testing.assert_array_equal(found.values, LABELS)
    assert found.names == {}


def test_a_key_is_a_whole_number(put):
    with pytest.raises(MeshError, match=r"^a\.gii: label 1 of its table has the key 'x', not a whole number\.$"):
        label_table(named_gifti(table=((0, "a"), ("x", "b"))), "a.gii")
    with pytest.raises(ParameterError, match="has the key '', not"):
        read_labels(put("lh.label.gii", named_gifti(key="Number")), 5)
