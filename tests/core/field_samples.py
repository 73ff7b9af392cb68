"""Files of values at five vertices as other programs write them: by SciPy, PyVista, meshio, trimesh and nibabel."""

import warnings

import numpy as np

from tests.core.mesh_samples import FACES, VERTICES

VALUES = np.array([0.5, -1, 2, 0, 3.25])
"""Single precision holds them, too."""
MORE = np.array([10.0, 20, 30, 40, np.nan])
LABELS = np.array([1, 2, 1, 1, 2])
NAMES, RGBA = ("???", "front", "back"), ((0, 0, 0, 0), (200, 30, 20, 255), (20, 90, 210, 255))


def field_files(folder):
    """Write a file of each kind into a folder; return its arrays by their names, those of labels as texts, by path."""
    return {folder / name: write(folder / name) for name, write in WRITERS.items()}


def _npy(path):
    np.save(path, VALUES)
    return {"values": VALUES}


def _npy_of_columns(path):
    np.save(path, np.stack([VALUES, MORE], axis=1).astype("f4"))
    return {"0": VALUES, "1": MORE}


def _npz(path):
    np.savez_compressed(path, thickness=VALUES, words=np.array(["a"]), count=np.array(3), both=[VALUES, MORE])
    return {"thickness": VALUES, "both 0": VALUES, "both 1": MORE}


def _mat(path):
    from scipy.io import savemat

    savemat(path, {"f": VALUES[:, None], "g": MORE[None], "words": "text"}, do_compression=True)
    return {"f": VALUES, "g": MORE}


def _text(form):
    def write(path):
        path.write_text(form, encoding="utf-8")
        return {"values": VALUES}

    return write


def _table(path):
    rows = [f"{k},{a!r},{'' if np.isnan(b) else b}" for k, (a, b) in enumerate(zip(VALUES.tolist(), MORE, strict=True))]
    path.write_text("\n".join(['vertex,"depth, mm",curv', *rows[::-1], ""]), encoding="utf-8")
    return {"depth, mm": VALUES, "curv": MORE}


def _missing(path):
    path.write_text("a,b,c\n0.5,,1\n-1, ,NA\n2,null,\n0,4,5\n3.25,N/A,6\n", encoding="utf-8")
    gap = np.nan
    return {"a": VALUES, "b": np.array([gap, gap, gap, 4, gap]), "c": np.array([1, gap, gap, 5, 6])}


def _points(path):
    import meshio

    mesh = meshio.Mesh(VERTICES, [("triangle", FACES)], point_data={"f": VALUES, "v": np.ones((5, 3)), "g": MORE})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        meshio.write(path, mesh)
    return {"f": VALUES, "g": MORE}


def _vtp(path):
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(np.array(VERTICES, float), np.array(FACES))
    mesh["f"], mesh["normals of mine"] = VALUES.astype("f4"), np.ones((5, 3))
    mesh.save(path)
    return {"f": VALUES}


def _glb(path):
    import trimesh

    mesh = trimesh.Trimesh(VERTICES, FACES, process=False, vertex_attributes={"thickness": VALUES.astype("f4")})
    mesh.export(path)
    return {"thickness": VALUES}


def _gifti(path):
    import nibabel

    arrays = [
        nibabel.gifti.GiftiDataArray(values.astype("f4"), intent="NIFTI_INTENT_SHAPE", meta={"Name": name})
        for name, values in (("sulc", VALUES), ("curv", MORE))
    ]
    nibabel.save(nibabel.GiftiImage(darrays=arrays), path)
    return {"sulc": VALUES, "curv": MORE}


def _label_gifti(path):
    import nibabel

    table = nibabel.gifti.GiftiLabelTable()
    for key, (name, rgba) in enumerate(zip(NAMES, RGBA, strict=True)):
        label = nibabel.gifti.GiftiLabel(key, *(part / 255 for part in rgba))
        label.label = name
        table.labels.append(label)
    keys = np.array([0, *LABELS[1:]], "i4")
    array = nibabel.gifti.GiftiDataArray(keys, intent="NIFTI_INTENT_LABEL", meta={"Name": "parts"})
    nibabel.save(nibabel.GiftiImage(darrays=[array], labeltable=table), path)
    return {"parts": [None, *(NAMES[k] for k in LABELS[1:])]}


def _annotation(path):
    import nibabel

    nibabel.freesurfer.write_annot(path, LABELS, np.array(RGBA), list(NAMES), fill_ctab=True)
    return {path.name.split(".")[1]: [NAMES[k] for k in LABELS]}


def _morph(path):
    import nibabel

    nibabel.freesurfer.write_morph_data(path, VALUES)
    return {path.name.split(".")[1]: VALUES}


def _cifti(path):
    from nibabel import cifti2

    left = cifti2.BrainModelAxis.from_surface([0, 2, 4], 5, "CortexLeft")
    right = cifti2.BrainModelAxis.from_surface([1, 3], 6, "CortexRight")
    if path.name.endswith(".dscalar.nii"):
        maps = cifti2.ScalarAxis(["myelin", "sulc"])
    else:
        table = {
            key: (name, tuple(c / 255 for c in rgba)) for key, (name, rgba) in enumerate(zip(NAMES, RGBA, strict=True))
        }
        maps = cifti2.LabelAxis(["parts"], [table])
    data = np.array([[1, 2, 1, 2, 0], [10, 20, 30, 40, 50]], "f4")[: len(maps)]
    cifti2.Cifti2Image(data, (maps, left + right)).to_filename(path)
    gap = np.nan
    if len(maps) == 1:
        return {
            "parts left": ["front", None, "back", None, "front"],
            "parts right": [None, "back", None, None, None, None],
        }
    return {
        "myelin left": [1, gap, 2, gap, 1],
        "myelin right": [gap, 2, gap, 0, gap, gap],
        "sulc left": [10, gap, 20, gap, 30],
        "sulc right": [gap, 40, gap, 50, gap, gap],
    }


WRITERS = {
    "f.npy": _npy,
    "columns.npy": _npy_of_columns,
    "f.npz": _npz,
    "f.mat": _mat,
    "f.txt": _text("# depth\n0.5\n-1\n2\n0\n3.25\n"),
    "one_row.csv": _text("0.5,-1,2,0,3.25"),
    "decimal_commas.csv": _text("values;\n0,5;\n-1;\n2;\n0;\n3,25;\n"),
    "with_ids.txt": _text("4 3.25\r\n0 .5\r\n1 -1\r\n2 2e0\r\n3 0\r\n"),
    "from_r.csv": _text('"","values"\n"1",0.5\n"2",-1\n"3",2\n"4",0\n"5",3.25\n'),
    "missing.csv": _missing,
    "table.csv": _table,
    "f.vtu": _points,
    "f.ply": _points,
    "f.vtp": _vtp,
    "f.glb": _glb,
    "f.shape.gii": _gifti,
    "f.label.gii": _label_gifti,
    "lh.aparc.annot": _annotation,
    "rh.thickness": _morph,
    "f.dscalar.nii": _cifti,
    "f.dlabel.nii": _cifti,
}
