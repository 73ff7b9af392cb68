"""Landmarks in files of other programs: whole kinds, as those programs write them, read as pins, anchors and pairs."""

import json
import re

import numpy as np
import pytest

from bihdist_core import ParameterError, Surface, read_pins, write_mesh, write_pins
from bihdist_core.formats.anchors import read_anchors, write_anchors
from bihdist_core.formats.landmarks import LANDMARKS
from bihdist_core.formats.pins import PIN_FORMATS, Pins, off_surface
from bihdist_core.formats.vertex_maps import read_pairs
from tests.commands import ran
from tests.shapes import bumpy, grid

VERTICES, NAMES = [5, 17, 120], ["nose", "left ear", "tail, tip"]
TURN = np.array([-1.0, -1.0, 1.0])


def shape():
    """A surface on which x and y with the other signs are elsewhere."""
    s = bumpy(200)
    return Surface(s.vertices + np.array([7.0, 3.0, 0.0]), s.faces, name="m.off")


SHAPE = shape()
AT = SHAPE.vertices[VERTICES] + 1e-4


def rows(at, names=None, end=""):
    lines = (f"{x:.9g} {y:.9g} {z:.9g}{end}\n" for x, y, z in at)
    return "".join(lines if names is None else (f"{name} {line}" for name, line in zip(names, lines, strict=True)))


def pts(at, names=None):
    return f"Version 1.0\n3\n{rows(at, names)}"


def fcsv(system, at, head="# Markups fiducial file version = 4.11"):
    columns = "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID"
    lines = "".join(
        f'vtkMRMLMarkupsFiducialNode_{k},{x:.9g},{y:.9g},{z:.9g},0,0,0,1,1,1,0,"{name}",,vtkMRMLModelNode4,2,0\n'
        for k, ((x, y, z), name) in enumerate(zip(at, NAMES, strict=True))
    )
    return f"{head}\n# CoordinateSystem = {system}\n# columns = {columns}\n{lines}"


def markup(system, at, **more):
    points = [
        {"id": str(k), "label": name, "description": "", "position": place, "selected": True, "visibility": True}
        for k, (place, name) in enumerate(zip(np.asarray(at).tolist(), NAMES, strict=True), 1)
    ]
    says = {} if system is None else {"coordinateSystem": system}
    return json.dumps({"markups": [{"type": "Fiducial", **says, "controlPoints": points, "display": {}, **more}]})


def avizo(*sets, head="# Avizo 3D ASCII 2.0", kind="float"):
    says = "".join(f"Markers {{ {kind}[3] Coordinates{k or ''} }} @{k + 1}\n" for k in range(len(sets)))
    data = "".join(f"@{k}\n{rows(at, end=' ')}\n" for k, at in enumerate(sets, 1))
    number = f"\tNumSets {len(sets)},\n"
    return (
        f'{head}\n\n\ndefine Markers 3\n\nParameters {{\n{number}\tContentType "LandmarkSet"\n}}\n\n'
        f"{says}Markers {{ int Types }} @9\n\n# Data section follows\n{data}@9\n1\n1\n1\n"
    )


def tps(at, id="m", scale=1.0, image=""):
    end = (f"IMAGE={image}\n" if image else "") + (f"ID={id}\n" if id else "")
    curves = "CURVES=1\nPOINTS3=2\n1 2 3\n4 5 6\n"
    return f"LM3=3\n{rows(np.asarray(at) / scale)}{curves}{end}" + (f"SCALE={scale}\n" if scale != 1 else "")


READ = [
    # name, content, names, what is said
    ("a.fcsv", fcsv("LPS", AT), NAMES, "are LPS, .* read as they are"),
    ("a.fcsv", fcsv("1", AT), NAMES, "are LPS, .* read as they are"),
    ("a.fcsv", fcsv("RAS", AT * TURN), NAMES, "are RAS, .* read as LPS"),
    ("a.fcsv", fcsv("0", AT * TURN), NAMES, "are RAS, .* read as LPS"),
    ("a.fcsv", fcsv("LPS", AT * TURN), NAMES, "are LPS, .* read as RAS"),
    ("a.fcsv", "# Fiducial List file x\n# columns = label,x,y,z,sel,vis\n" +
     rows(AT, [*NAMES[:2], "tip"], " 1 1").replace("left ear", "ear").replace(" ", ","), ["nose", "ear", "tip"],
     "are RAS, .* read as they are"),
    ("a.mrk.json", markup("LPS", AT), NAMES, "are LPS, .* read as they are"),
    ("a.mrk.json", markup("RAS", AT * TURN), NAMES, "are RAS, .* read as LPS"),
    ("a.json", markup(None, AT * TURN), NAMES, "are LPS, .* read as RAS"),
    ("a.pts", pts(AT, ["S000", "left ear", "C001"]), ["S000", "left ear", "C001"], None),
    ("a.pts", "Version 1.0\n4\n" + rows(AT) + "S003 9999 9999 9999\n", [""] * 3, "1 landmark without a position"),
    ("a.landmarkAscii", avizo(AT), [""] * 3, None),
    ("a.landmarkascii", avizo(AT, head="# AmiraMesh 3D ASCII 2.0", kind="double"), [""] * 3, None),
    ("a.tps", tps(AT), [""] * 3, None),
    ("a.tps", tps(AT, scale=0.05), [""] * 3, None),
    ("a.tps", "LM3=4\nNA NA NA\n" + rows(AT) + "ID=other\n", [""] * 3, "1 landmark without a position"),
    ("a.tps", tps(AT + 9, "k") + tps(AT), [""] * 3, None),
    ("a.TPS", tps(AT + 9, "", image="k.ply") + tps(AT, "", image="m.ply"), [""] * 3, None),
    ("a.pp", "<PickedPoints>" + "".join(
        f'<point x="{x}" y="{y}" z="{z}" name="{n}" active="1"/>' for (x, y, z), n in zip(AT, NAMES, strict=True)
    ) + "</PickedPoints>", NAMES, None),
    ("a.csv", rows(AT).replace(" ", ","), [""] * 3, None),
    ("a.csv", rows(AT).replace(" ", ";").replace("\n", "\r\n"), [""] * 3, None),
    ("a.csv", rows(AT, ["a", "b", "7"]).replace(" ", ", "), ["a", "b", "7"], None),
    ("a.csv", "Landmark,X,Y,Z\n" + rows(AT, ["a", "b", "c"]).replace(" ", ","), ["a", "b", "c"], None),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "content", "names", "said"), READ, ids=[f"{k}-{row[0]}" for k, row in enumerate(READ)]
)
def test_landmarks_are_read_as_pins_and_as_sources(tmp_path, capsys, name, content, names, said):
    (tmp_path / name).write_text(content, encoding="utf-8")
    found = read_pins(tmp_path / name, SHAPE)
    assert found.vertices.tolist() == VERTICES
    assert list(found.names) == names
    assert found.moved == pytest.approx(np.linalg.norm([1e-4] * 3), rel=1e-3)
    if said is None:
        assert found.facts == ()
    else:
        assert len(found.facts) == 1
        assert re.search(said, found.facts[0])
    # Sources are known by what the file holds, and the command says the same.
    write_mesh(tmp_path / "m.off", SHAPE)
    out = ran(capsys, "samples", tmp_path / "m.off", "--sources", f"@{tmp_path / name}", "-o", tmp_path / "out.npy")
    assert np.load(tmp_path / "out.npy").tolist() == VERTICES
    for fact in found.facts:
        assert fact in out.err


@pytest.mark.parametrize("extension", PIN_FORMATS)
def test_landmarks_are_written_back_in_the_same_form(tmp_path, extension):
    path, again = tmp_path / f"a{extension}", tmp_path / f"b{extension}"
    write_pins(path, SHAPE, Pins.of(SHAPE, VERTICES, NAMES))
    found = read_pins(path, SHAPE)
    assert found.vertices.tolist() == VERTICES
    assert found.moved.tolist() == [0, 0, 0]
    assert list(found.names) == (NAMES if extension not in LANDMARKS or LANDMARKS[extension].has_names else [""] * 3)
    write_pins(again, SHAPE, found)
    if any(found.names):
        assert again.read_bytes() == path.read_bytes()
    else:
        assert again.read_text().replace("\n", " ") == path.read_text().replace("\n", " ")


def test_files_of_slicer_say_the_coordinate_system_of_the_mesh(tmp_path):
    for name, system in (("m.off", "LPS"), ("lh.pial", "RAS"), ("m.surf.gii", "RAS")):
        surface = Surface(SHAPE.vertices, SHAPE.faces, name=name)
        for file in ("a.fcsv", "a.mrk.json"):
            write_pins(tmp_path / file, surface, Pins.of(surface, VERTICES))
            assert f" {system}" in (tmp_path / file).read_text().replace('"', " ")


def test_a_surface_with_the_same_symmetry_decides_nothing(tmp_path):
    sphere = bumpy(200)
    centred = Surface(
        np.vstack([sphere.vertices, sphere.vertices * TURN]), np.vstack([sphere.faces, sphere.faces + 200])
    )
    (tmp_path / "a.fcsv").write_text(fcsv("RAS", centred.vertices[VERTICES]))
    found = read_pins(tmp_path / "a.fcsv", centred)
    assert found.vertices.tolist() == VERTICES
    assert "which decides nothing: read as they are" in found.facts[0]


# ---------------------------------------------------------------------- far from the surface
def test_distances_from_a_surface_are_those_of_dense_sampling():
    rng = np.random.default_rng(3)
    surface = bumpy(60)
    points = rng.normal(size=(40, 3)) * 1.3
    weights = np.array([(i, j, 60 - i - j) for i in range(61) for j in range(61 - i)]) / 60
    sampled = np.einsum("wc,fcx->fwx", weights, surface.vertices[surface.faces]).reshape(-1, 3)
    dense = np.array([np.linalg.norm(sampled - point, axis=1).min() for point in points])
    away = off_surface(points, surface)
    longest = np.linalg.norm(np.subtract(*surface.vertices[surface.edges.T]), axis=1).max()
    near = dense <= longest
    assert near.any()
    assert not near.all()
    # Samples are at most a 60th of a side from any point of their face.
    assert (away <= dense + 1e-12)[near].all()
    assert (dense - away <= longest / 60).all()
    assert (away[~near] > longest).all()
    assert off_surface(surface.vertices[:5], surface).tolist() == [0] * 5


def test_a_landmark_inside_a_large_face_is_on_the_surface_and_one_above_it_is_far(tmp_path):
    flat = grid(2, 2)
    surface = Surface(flat.vertices * 10.0, flat.faces, name="m.off")
    inside = surface.vertices[surface.faces[0]].mean(axis=0)
    corner, edge = ",".join(map(str, surface.vertices[0])), surface.mean_edge_length
    for height, far in ((0.0, 0), (0.9 * edge, 0), (1.1 * edge, 1), (50 * edge, 1)):
        (tmp_path / "a.csv").write_text(f"x,y,z\n{corner}\n{inside[0]},{inside[1]},{height}\n")
        facts = read_pins(tmp_path / "a.csv", surface).facts
        assert len(facts) == far
        assert all(f"1 of 2 landmarks farther from the surface than the mean edge, {edge:.3g}" in f for f in facts)


# ---------------------------------------------------------------------- anchors
@pytest.mark.parametrize("extension", [each for each, kind in LANDMARKS.items() if kind.has_names])
def test_names_of_landmarks_are_the_values_of_anchors(tmp_path, extension):
    path = tmp_path / f"a{extension}"
    write_anchors(path, SHAPE, VERTICES, [0.5, -2.0, 1e-3])
    found = read_anchors(path, SHAPE)
    assert (found.vertices.tolist(), found.values.tolist()) == (VERTICES, [0.5, -2.0, 1e-3])


# ---------------------------------------------------------------------- pairs
OTHER = bumpy(230)
THERE = [9, 40, 200]


@pytest.mark.parametrize(
    ("files", "order"),
    [
        # The same names, in another order, correspond by them; others by their order.
        ({"a.pts": pts(AT, "abc"), "b.pts": pts(OTHER.vertices[THERE], "cab")}, [1, 2, 0]),
        ({"a.pts": pts(AT, "abc"), "b.pts": pts(OTHER.vertices[THERE], "xyz")}, [0, 1, 2]),
        ({"a.fcsv": fcsv("RAS", AT * TURN), "b.csv": rows(OTHER.vertices[THERE]).replace(" ", ",")}, [0, 1, 2]),
        ({"a.tps": tps(AT), "b.json": '{"pins": [{"vertex": 9}, {"vertex": 40}, {"vertex": 200}]}'}, [0, 1, 2]),
        ({"a.tps": tps(AT, "one") + tps(OTHER.vertices[THERE], "two")}, [0, 1, 2]),
        ({"a.tps": tps(OTHER.vertices[THERE], "bumpy") + tps(AT + 5, "x") + tps(AT, "m")}, [0, 1, 2]),
        ({"a.landmarkAscii": avizo(AT, OTHER.vertices[THERE])}, [0, 1, 2]),
    ],
)  # fmt: skip
def test_landmarks_on_two_meshes_are_pairs(tmp_path, capsys, files, order):
    for name, content in files.items():
        (tmp_path / name).write_text(content)
    path = ",".join(str(tmp_path / name) for name in files)
    wanted = [[i, THERE[k]] for i, k in zip(VERTICES, order, strict=True)]
    assert read_pairs(path, (SHAPE, OTHER)).tolist() == wanted
    write_mesh(tmp_path / "m.off", SHAPE)
    write_mesh(tmp_path / "bumpy.off", OTHER)
    meshes = [tmp_path / "m.off", tmp_path / "bumpy.off"]
    words = ",".join(f"{i}:{j}" for i, j in wanted)
    for name, pairs in (("a.npy", f"@{path}"), ("b.npy", words)):
        ran(capsys, "correspond", *meshes, "--pairs", pairs, "-o", tmp_path / name)
    assert np.load(tmp_path / "a.npy").tolist() == np.load(tmp_path / "b.npy").tolist()


def test_a_partner_without_a_position_leaves_both_out(tmp_path):
    (tmp_path / "a.tps").write_text(
        "LM3=3\n" + rows(AT) + "ID=a\nLM3=3\n1 0 0\nNA NA NA\n" + rows(OTHER.vertices[[200]])
    )
    pairs = read_pairs(tmp_path / "a.tps", (SHAPE, OTHER))
    assert pairs[:, 0].tolist() == [5, 120]
    assert pairs[1, 1] == 200


def test_a_figure_and_pairs_on_one_mesh_take_landmarks(tmp_path, capsys):
    write_mesh(tmp_path / "m.off", SHAPE)
    (tmp_path / "a.pts").write_text(pts(AT))
    (tmp_path / "b.csv").write_text(rows(SHAPE.vertices[[*THERE[:2], 3]]).replace(" ", ","))
    out = tmp_path / "pairs.csv"
    ran(capsys, "pairs", tmp_path / "m.off", "--pairs", f"@{tmp_path}/a.pts,{tmp_path}/b.csv", "-o", out)
    assert np.loadtxt(out, delimiter=",", skiprows=1)[:, :2].tolist() == [[5, 9], [17, 40], [120, 3]]


@pytest.mark.filterwarnings("always::bihdist_core.errors.LandmarkWarning")
def test_figures_say_what_is_known_of_landmarks_too(tmp_path, capsys):
    for name, surface in (("m.off", SHAPE), ("n.off", OTHER)):
        write_mesh(tmp_path / name, surface)
    points = "".join(f"{x},{y},{z},{k}\n" for k, (x, y, z) in enumerate(2 * AT - SHAPE.vertices.mean(axis=0)))
    (tmp_path / "a.fcsv").write_text(f"# Markups fiducial file\n# columns = x,y,z,label\n{points}")
    said, out = "3 of 3 landmarks farther from the surface", tmp_path / "a.png"
    mesh, marks = tmp_path / "m.off", f"@{tmp_path / 'a.fcsv'}"
    for option in ("--pins", "--anchors"):
        assert said in ran(capsys, "figure", mesh, "--distance", "biharmonic", option, marks, "-o", out).err
    (tmp_path / "b.csv").write_text(rows(OTHER.vertices[THERE]).replace(" ", ","))
    pairs = f"{marks},{tmp_path / 'b.csv'}"
    both = [mesh, tmp_path / "n.off", "--distance", "biharmonic", "--pairs", pairs, "--map", "pairs"]
    assert f"on m.off: {said}" in ran(capsys, "figure", *both, "-o", out).err


# ---------------------------------------------------------------------- what is wrong
@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.fcsv", "# columns = id,x,y\n", "line 1: the columns 'id,x,y' are without x, y or z"),
        ("a.fcsv", fcsv("IJK", AT), "line 2: the coordinate system 'IJK' is neither LPS nor RAS"),
        ("a.fcsv", "# columns = id,x,y,z\na,1,2\n", r"line 2: the position \(1, 2, nothing\)"),
        ("a.mrk.json", "{}", "holds no list of markups"),
        ("a.mrk.json", '{"markups": [1]}', "markup 1 holds no list of controlPoints"),
        ("a.mrk.json", '{"markups": [{"controlPoints": [{"position": [1, 2, "3"]}]}]}', "point 1: the position"),
        ("a.mrk.json", '{"markups": [{"controlPoints": [7]}]}', "point 1: 7 is not a control point"),
        ("a.mrk.json", markup("LPI", AT), "the coordinate system 'LPI'"),
        ("a.mrk.json", markup(["LPS"], AT), r"the coordinate system \['LPS'\]"),
        ("a.mrk.json", '{"markups": [{"controlPoints": [{"positionStatus": "undefined"}]}]}', "no landmark with a"),
        ("a.pts", "1 2 3\n", "does not begin with IDAV Landmark's"),
        ("a.pts", "Version 1.0\nx\n", "line 2: 'x' is not a number of landmarks"),
        ("a.pts", "Version 1.0\n3\na 1 2 3\n", "says that it has 3 landmarks, and has 1"),
        ("a.pts", "Version 1.0\n1\na 1 2\n", r"line 3: the position \(a, 1, 2\)"),
        ("a.landmarkAscii", "# Avizo\n@1\n1 2 3\n", "has no Markers with Coordinates"),
        ("a.landmarkAscii", avizo(AT).replace("Markers 3", "Markers 4"), "says that it has 4 landmarks, and has 3"),
        ("a.landmarkAscii", avizo(AT, AT), "has 2 sets of landmarks, set 1, set 2; .*called as the mesh is read, m"),
        ("a.tps", "LM=2\n1 2\n3 4\n", "line 1: LM= are landmarks in a picture"),
        ("a.tps", "LM3=2\n1 2 3\nID=a\n", "line 3: 1 landmark missing before 'ID=a'"),
        ("a.tps", "LM3=2\n1 2 3\n", "ends before 1 of its landmarks"),
        ("a.tps", "LM3=1\n1 2 3\n4 5 6\n", "line 3: '4 5 6' is not of a TPS file"),
        ("a.tps", "1 2 3\n", "line 1: '1 2 3' is not of a TPS file"),
        ("a.tps", "LM3=1\n1 2 3\nSCALE=big\n", "the scale 'big' of specimen '1' is not a number"),
        ("a.tps", tps(AT, "k") + tps(AT, "l"), "has 2 sets of landmarks, k, l"),
        ("a.tps", "LM3=1\nNA NA NA\n", "holds no landmark with a position"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(tmp_path, name, content, said):
    (tmp_path / name).write_text(content)
    with pytest.raises(ParameterError, match=said):
        read_pins(tmp_path / name, SHAPE)


@pytest.mark.parametrize(
    ("contents", "said"),
    [
        (("LM3=1\n1 2 3\n",), "1 set of landmarks; pairs are two"),
        ((tps(AT), "LM3=1\n1 2 3\n"), "3 landmarks and 1 are not pairs"),
        (("LM3=1\n1 2 3\nLM3=1\nNA NA NA\n",), "no pair of landmarks with positions"),
    ],
)
def test_landmarks_that_are_no_pairs_are_named(tmp_path, contents, said):
    for name, content in zip("ab", contents, strict=False):
        (tmp_path / f"{name}.tps").write_text(content)
    path = ",".join(str(tmp_path / f"{name}.tps") for name, _ in zip("ab", contents, strict=False))
    with pytest.raises(ParameterError, match=said):
        read_pairs(path, (SHAPE, OTHER))
    with pytest.raises(ParameterError, match="need both of their meshes"):
        read_pairs(path)
