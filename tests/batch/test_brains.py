"""Surfaces of brains and values on them, from the files of GIFTI and FreeSurfer, through a batch."""

import gzip
import json

import numpy as np
import pytest
from scipy.io import loadmat

from app.document.document import comparison
from app.document.file import checksum, recipe_text
from app.document.page import Recipe
from app.document.repairs import with_repairs
from bihdist_core import BiharmonicDistance, ParameterError, Surface, parcel_means
from bihdist_core.formats.mesh_io import read_surface
from tests.batch.runs import batch, rows
from tests.core.mesh_samples import freesurfer, gifti, gifti_array, gifti_surface
from tests.core.test_cutting import by_hand
from tests.core.test_freesurfer import NAMES, annotation, values
from tests.core.test_freesurfer_label import label
from tests.core.test_merging import torn
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


def hemispheres(folder):
    """Two surfaces by their names, with labels and a mask each that cuts a cap off, in files of their own."""
    surfaces = {"lh.pial": SHAPE, "rh.pial": Surface(SHAPE.vertices * (-2, 2, 2), SHAPE.faces[:, ::-1])}
    keeps = {name: surface.vertices[:, 2] < 0.6 * surface.vertices[:, 2].max() for name, surface in surfaces.items()}
    for name, surface in surfaces.items():
        (folder / f"{name}.surf.gii").write_bytes(gifti_surface(surface.vertices, surface.faces))
        (folder / f"{name}.label.gii").write_bytes(gifti(gifti_array("LABEL", LABELS.astype("i4"))))
        (folder / f"{name}.cortex.shape.gii").write_bytes(gifti(gifti_array("SHAPE", keeps[name].astype("f4"))))
    return surfaces, keeps


def test_parcels_of_both_hemispheres_without_what_is_cut_by_one_line(tmp_path):
    surfaces, keeps = hemispheres(tmp_path)
    out = tmp_path / "out"
    options = ("--labels", tmp_path / "{name}.label.gii", "--cut", tmp_path / "{name}.cortex.shape.gii")
    assert batch(tmp_path, out, "--do", "pairs", *options) == 0
    assert [row["mesh"] for row in rows(out)] == ["lh.pial", "rh.pial"]
    for name, surface in surfaces.items():
        cut = surface.without(~keeps[name])
        expected = parcel_means(BiharmonicDistance(cut), LABELS).distances
        found = np.load(out / f"{name}.pairs.biharmonic.npy")
        np.testing.assert_allclose(found, expected, rtol=1e-9)
        # Of a mesh cut by hand.
        alone, ids = by_hand(surface, np.flatnonzero(~keeps[name]).tolist())
        np.testing.assert_allclose(found, parcel_means(BiharmonicDistance(alone), LABELS[ids]).distances, rtol=1e-9)
        about = json.loads((out / f"{name}.pairs.biharmonic.json").read_text())
        assert about["repairs"] == [*cut.repairs]
        assert set(about["checksums"]) == {"cut", "labels"}
        assert "mask" not in about
    # Distances across what is masked are others.
    masked = tmp_path / "masked"
    options = ("--labels", tmp_path / "{name}.label.gii", "--mask", tmp_path / "{name}.cortex.shape.gii")
    assert batch(tmp_path, masked, "--do", "pairs", *options) == 0
    assert "distances still cross them" in json.loads((masked / "lh.pial.pairs.biharmonic.json").read_text())["mask"]
    there = np.load(masked / "lh.pial.pairs.biharmonic.npy")
    assert np.abs(there - np.load(out / "lh.pial.pairs.biharmonic.npy")).max() > 0.01


def test_parcels_have_the_names_of_the_table(tmp_path):
    (tmp_path / "lh.pial").write_bytes(freesurfer(SHAPE.vertices, SHAPE.faces))
    (tmp_path / "lh.annot").write_bytes(annotation(LABELS.tolist(), ids=range(N)))
    out, words = tmp_path / "out", (tmp_path / "lh.pial", tmp_path / "out", "--do", "pairs")
    assert batch(*words, "--labels", tmp_path / "lh.annot", "--format", "npz") == 0
    about = json.loads((out / "lh.pial.pairs.biharmonic.json").read_text())
    assert (about["labels"], about["names"]) == ([0, 1, 2], list(NAMES))
    table = rows(out, about["parcels"].removesuffix(".csv"))
    assert [*table[1]] == ["label", "name", "vertices"]
    assert [(int(row["label"]), row["name"], int(row["vertices"])) for row in table] == [
        (k, name, int((k == LABELS).sum())) for k, name in enumerate(NAMES)
    ]
    with np.load(out / "lh.pial.pairs.biharmonic.npz") as file:
        assert file["names"].tolist() == list(NAMES)
        assert file["labels"].tolist() == [0, 1, 2]
    # A parcel that a mask empties has no row, and no name.
    (tmp_path / "rest.label").write_bytes(label(np.flatnonzero(LABELS != 1)))
    mask = "--labels", tmp_path / "lh.annot", "--mask", tmp_path / "rest.label"
    assert batch(*words, *mask, "--format", "mat") == 0
    about = json.loads((out / "lh.pial.pairs.biharmonic.json").read_text())
    assert about["names"] == [NAMES[0], NAMES[2]]
    there = loadmat(out / "lh.pial.pairs.biharmonic.mat")
    assert [str(each[0]) for each in there["names"].ravel()] == [NAMES[0], NAMES[2]]
    # Bare numbers have none.
    np.save(tmp_path / "labels.npy", LABELS)
    assert batch(*words, "--labels", tmp_path / "labels.npy") == 0
    assert not {"names", "parcels"} & json.loads((out / "lh.pial.pairs.biharmonic.json").read_text()).keys()


def test_a_label_of_freesurfer_cuts_and_is_a_list_of_sources(tmp_path):
    (tmp_path / "lh.pial").write_bytes(freesurfer(SHAPE.vertices, SHAPE.faces))
    keeps = np.flatnonzero(SHAPE.vertices[:, 2] < 0.5)
    (tmp_path / "lh.cortex.label").write_bytes(label(keeps))
    surface = read_surface(tmp_path / "lh.pial")
    cut = surface.without(np.setdiff1d(np.arange(N), keeps))
    seeds = np.flatnonzero(cut.component_of_vertex == 0)[[7, 2]]
    (tmp_path / "lh.seeds.label").write_bytes(label(seeds))
    options = "--cut", tmp_path / "lh.cortex.label", "--sources", f"@{tmp_path / 'lh.seeds.label'}"
    assert batch(tmp_path / "lh.pial", tmp_path / "out", "--do", "fields", *options) == 0
    found = np.load(tmp_path / "out" / "lh.pial.fields.biharmonic.npy")
    np.testing.assert_allclose(found, BiharmonicDistance(cut).from_sources(seeds.tolist()), rtol=1e-9, atol=1e-12)
    (tmp_path / "lh.cortex.label").write_bytes(label([*keeps, N]))
    assert batch(tmp_path / "lh.pial", tmp_path / "out", "--do", "fields", *options) == 1
    assert f"vertex {N} is not one of the {N} of the surface" in rows(tmp_path / "out", "failures")[0]["reason"]


def test_all_kinds_of_work_are_on_what_is_left(tmp_path):
    surfaces, keeps = hemispheres(tmp_path)
    out = tmp_path / "out"
    options = ("--do", "fields,eigen,fps", "--sources", "farthest:5", "--k", "20")
    assert batch(tmp_path / "lh.pial.surf.gii", out, *options, "--cut", tmp_path / "{name}.cortex.shape.gii") == 0
    gone = ~keeps["lh.pial"]
    cut = surfaces["lh.pial"].without(gone)
    ids = np.load(out / "lh.pial.fps.biharmonic.npy").tolist()
    assert not gone[ids].any()
    fields = np.load(out / "lh.pial.fields.biharmonic.npy")
    np.testing.assert_allclose(fields, BiharmonicDistance(cut).from_sources(ids), rtol=1e-9, atol=1e-12)
    assert np.isnan(fields[gone]).all()
    with np.load(out / "lh.pial.eigen.npz") as eigen:
        assert np.isnan(eigen["eigenvectors"][gone]).all() or (eigen["eigenvectors"][gone] == 0).all()
    # Another mask is other work, and a mask that does not fit fails alone.
    (tmp_path / "lh.pial.cortex.shape.gii").write_bytes(gifti(gifti_array("SHAPE", np.ones(N - 1, "f4"))))
    assert batch(tmp_path, out, *options, "--cut", tmp_path / "{name}.cortex.shape.gii") == 1
    assert {row["mesh"] for row in rows(out, "failures")} == {"lh.pial"}
    assert "this one has the shape (89,)" in rows(out, "failures")[0]["reason"]


def test_merged_meshes_have_a_table_of_ids_and_labels_follow(tmp_path):
    surface = torn(SHAPE)
    whole, ids = surface.merged()
    labels = np.arange(len(ids)) % 3
    labels = labels[np.unique(ids, return_index=True)[1]][ids]
    (tmp_path / "lh.pial.surf.gii").write_bytes(gifti_surface(surface.vertices, surface.faces))
    np.save(tmp_path / "labels.npy", labels)
    out = tmp_path / "out"
    options = ("--do", "pairs", "--labels", tmp_path / "labels.npy", "--merge", "0")
    assert batch(tmp_path / "lh.pial.surf.gii", out, *options) == 0
    table = np.loadtxt(out / "lh.pial.ids.csv", int, delimiter=",", skiprows=1)
    np.testing.assert_array_equal(table[:, 1], ids)
    assert json.loads((out / "lh.pial.pairs.biharmonic.json").read_text())["new_ids"] == "lh.pial.ids.csv"
    expected = parcel_means(BiharmonicDistance(whole), labels[np.unique(ids, return_index=True)[1]]).distances
    np.testing.assert_allclose(np.load(out / "lh.pial.pairs.biharmonic.npy"), expected, rtol=1e-9)


def test_fields_come_back_as_gifti(tmp_path, capsys):
    nibabel = pytest.importorskip("nibabel")
    surfaces, keeps = hemispheres(tmp_path)
    left = [surface.without(~keeps[name]).component_of_vertex >= 0 for name, surface in surfaces.items()]
    sources = ",".join(map(str, np.flatnonzero(np.all(left, axis=0))[[3, 20]]))
    out = tmp_path / "out"
    options = ("--do", "fields", "--sources", sources, "--format", "func.gii")
    assert batch(tmp_path, out, *options, "--cut", tmp_path / "{name}.cortex.shape.gii") == 0
    image = nibabel.load(out / "rh.pial.fields.biharmonic.func.gii")
    assert image.meta["AnatomicalStructurePrimary"] == "CortexRight"
    assert len(image.agg_data()) == 2
    assert json.loads((out / "rh.pial.fields.biharmonic.json").read_text())["dtype"] == "float32"
    capsys.readouterr()
    assert batch(tmp_path, out, *options, "--dtype", "float64") == 2
    assert "single precision; leave out --dtype float64" in capsys.readouterr().err
    assert batch(tmp_path, out, "--do", "eigen", "--format", "func.gii") == 2
    assert "they are written by --do fields" in capsys.readouterr().err


def test_a_recipe_with_a_cut_of_its_own_is_refused(tmp_path, capsys):
    hemispheres(tmp_path)
    mesh, cut = tmp_path / "lh.pial.surf.gii", tmp_path / "lh.pial.cortex.shape.gii"
    recipe = with_repairs(comparison(str(mesh)), cut=str(cut))
    (tmp_path / "r.json").write_text(recipe_text(Recipe(recipe), "1"))
    assert batch(mesh, tmp_path / "out", "--do", "figure", "--recipe", tmp_path / "r.json") == 2
    assert "batch does what --cut, --merge, --largest-component and --operator say" in capsys.readouterr().err
