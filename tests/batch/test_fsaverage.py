"""fsaverage5 as nilearn has it on disk, from GIFTI to a matrix of parcels by one command; skipped without nilearn."""

import shutil
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, parcel_means
from bihdist_core.formats.mesh_io import read_surface
from bihdist_core.formats.vertex_values import read_vertex_values
from tests.batch.runs import batch, rows

NILEARN = find_spec("nilearn")
PARCELS, OF_EACH = 5, 12


@pytest.mark.skipif(NILEARN is None, reason="nilearn, whose files these are, is not installed")
def test_parcels_of_both_hemispheres_without_the_medial_wall(tmp_path):
    (package, *_) = NILEARN.submodule_search_locations
    folder = Path(package) / "datasets" / "data" / "fsaverage5"
    labels, expected = {}, {}
    for side in ("left", "right"):
        cortex = read_vertex_values(folder / f"thick_{side}.gii.gz") > 0.5
        surface = read_surface(folder / f"pial_{side}.gii.gz")
        assert surface.n_vertices == len(cortex) == 10242
        assert 400 < (~cortex).sum() < 900
        chosen = np.random.default_rng(0).choice(np.flatnonzero(cortex), (PARCELS, OF_EACH), replace=False)
        labels[side] = np.full(len(cortex), -1)
        labels[side][chosen] = np.arange(PARCELS)[:, None]
        np.save(tmp_path / f"pial_{side}.cortex.npy", cortex)
        np.save(tmp_path / f"pial_{side}.labels.npy", labels[side])
        expected[side] = parcel_means(BiharmonicDistance(surface.without(~cortex)), labels[side]).distances
    options = ("--labels", tmp_path / "{name}.labels.npy", "--cut", tmp_path / "{name}.cortex.npy")
    out = tmp_path / "out"
    (tmp_path / "surf").mkdir()
    for side in ("left", "right"):
        shutil.copy(folder / f"pial_{side}.gii.gz", tmp_path / "surf")
    assert batch(tmp_path / "surf", out, "--do", "pairs", *options) == 0
    assert [row["mesh"] for row in rows(out)] == ["pial_left", "pial_right"]
    for side in ("left", "right"):
        np.testing.assert_allclose(np.load(out / f"pial_{side}.pairs.biharmonic.npy"), expected[side], rtol=1e-9)
