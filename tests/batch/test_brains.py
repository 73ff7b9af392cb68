"""Surfaces of brains and values on them, from the files of GIFTI and FreeSurfer, through a batch."""

import gzip

import numpy as np
import pytest

from app.document.file import checksum
from bihdist_core import BiharmonicDistance, ParameterError, parcel_means
from bihdist_core.formats.mesh_io import read_surface
from tests.batch.runs import batch, rows
from tests.core.mesh_samples import freesurfer, gifti, gifti_array, gifti_surface
from tests.core.test_freesurfer import annotation, values
from tests.shapes import bumpy

N = 90
SHAPE = bumpy(N)
LABELS = np.arange(N) % 4 - 1
MASK = np.arange(N) % 5 > 0


def test_parcels_of_a_folder_of_hemispheres(tmp_path):
    surf, labels = tmp_path / "surf", tmp_path / "labels"
    surf.mkdir()
    labels.mkdir()
    left, right = freesurfer(SHAPE.vertices, SHAPE.faces), gifti_surface(2 * SHAPE.vertices, SHAPE.faces)
    (surf / "lh.pial").write_bytes(left)
    (surf / "rh.pial.surf.gii.gz").write_bytes(gzip.compress(right))
    # What FreeSurfer has beside them is no mesh.
    (surf / "lh.thickness").write_bytes(values(np.ones(N)))
    (surf / "rh.sulc.shape.gii").write_bytes(gifti(gifti_array("SHAPE", np.ones(N))))
    for name in ("lh.pial", "rh.pial"):
        (labels / f"{name}.annot").write_bytes(annotation(LABELS.tolist(), ids=range(N)))
        (labels / f"{name}.func.gii").write_bytes(gifti(gifti_array("NONE", MASK.astype("f4"))))
    out = tmp_path / "out"
    options = ("--labels", labels / "{name}.annot", "--mask", labels / "{name}.func.gii")
    assert batch(surf, out, "--do", "pairs", *options) == 0
    assert [row["mesh"] for row in rows(out)] == ["lh.pial", "rh.pial"]
    for name, file in (("lh.pial", "lh.pial"), ("rh.pial", "rh.pial.surf.gii.gz")):
        distance = BiharmonicDistance(read_surface(surf / file))
        expected = parcel_means(distance, LABELS, MASK).distances
        np.testing.assert_allclose(np.load(out / f"{name}.pairs.biharmonic.npy"), expected, rtol=1e-9)


def test_a_checksum_covers_the_buffer_beside_a_gltf(tmp_path):
    from tests.core.test_gltf import beside

    path, buffer = beside(tmp_path, "mesh.bin")
    before = checksum(path)
    assert checksum(path) == before
    (tmp_path / "mesh.bin").write_bytes(buffer[:-4] + bytes(4))
    assert checksum(path) != before
    (tmp_path / "mesh.bin").unlink()
    with pytest.raises(ParameterError, match=r"'mesh.bin' beside it, cannot be read"):
        checksum(path)
