"""Commands on several meshes, as JSON, to standard output; completion."""

import csv
import json
import shutil
import subprocess

import numpy as np
import pytest

from app.main import main
from app.version import version
from bihdist_core import BiharmonicDistance, CommuteTimeDistance, nearest, read_surface, write_mesh
from tests.commands import ran, refused
from tests.shapes import bumpy, torus


@pytest.fixture
def meshes(tmp_path):
    write_mesh(tmp_path / "one.off", bumpy(80))
    write_mesh(tmp_path / "ring.off", torus(12, 6))
    return [str(tmp_path / name) for name in ("one.off", "ring.off")]


@pytest.mark.parametrize("command", [["field", "--sources", "3,7"], ["pairs", "--sources", "3,7,9"]])
def test_each_mesh_has_an_output_of_its_own(meshes, tmp_path, capsys, command):
    word, *options = command
    said = json.loads(ran(capsys, word, *meshes, *options, "-o", tmp_path / "{name}_out.npy", "--json").out)["meshes"]
    assert [each["mesh"] for each in said] == meshes
    for mesh, each in zip(meshes, said, strict=True):
        assert each["outputs"] == [mesh.replace(".off", "_out.npy")]
        distance = BiharmonicDistance(read_surface(mesh))
        expected = distance.from_sources([3, 7]) if word == "field" else distance.pairwise([3, 7, 9])
        np.testing.assert_array_equal(np.load(*each["outputs"]), expected)


def test_several_meshes_with_one_output_are_refused(meshes, tmp_path, capsys):
    assert "write -o {name}.npy" in refused(capsys, "field", *meshes, "--sources", "3", "-o", tmp_path / "out.npy")
    assert not (tmp_path / "out.npy").exists()
    # So are two of one name, which `{name}` does not tell apart.
    other = tmp_path / "other"
    other.mkdir()
    shutil.copy(meshes[0], other)
    named = [meshes[0], str(other / "one.off")]
    assert main(["field", *named, "--sources", "3", "-o", str(tmp_path / "{name}.npy")]) == 2
    assert "would both be written to" in capsys.readouterr().err
    assert not (tmp_path / "one.npy").exists()


def test_a_mesh_that_is_missing_costs_no_other(meshes, tmp_path, capsys):
    options = ["--sources", "3", "-o", str(tmp_path / "{name}.npy")]
    said = ran(capsys, "field", meshes[0], "missing.off", meshes[1], *options, status=2)
    assert "missing.off" in said.err
    assert (tmp_path / "one.npy").exists()
    assert (tmp_path / "ring.npy").exists()


def test_info_as_json_has_numbers(meshes, capsys):
    one, ring = json.loads(ran(capsys, "info", *meshes, "--json").out)["meshes"]
    assert (one["n_vertices"], one["genus"], ring["genus"], ring["boundary_loop_count"]) == (80, 0, 1, 0)
    assert ring["area"] == pytest.approx(float(read_surface(meshes[1]).face_areas.sum()), rel=1e-12)
    assert ring["repairs"] == []


def test_text_goes_to_standard_output_and_words_beside_it(meshes, capsys):
    said = ran(capsys, "field", meshes[0], "--sources", "3", "-o", "-")
    lines = said.out.splitlines()
    assert lines[0] == "vertex,biharmonic_from_3"
    assert len(lines) == 81
    values = [float(line.split(",")[1]) for line in lines[1:]]
    np.testing.assert_array_equal(values, BiharmonicDistance(read_surface(meshes[0])).from_source(3))
    assert said.err.startswith("-: biharmonic, exact, 80 vertices")
    assert len(ran(capsys, "samples", meshes[0], "--sources", "farthest:4", "-o", "-").out.split()) == 4
    assert main(["pairs", meshes[0], "--sources", "all", "-o", "-"]) == 2
    assert capsys.readouterr().err.startswith("bihdist: - has the extension '.csv'")


def test_pictures_do_not_go_to_standard_output(meshes, capsys):
    assert "writes no text" in refused(capsys, "figure", meshes[0], "-o", "-")


@pytest.mark.skipif(shutil.which("bash") is None, reason="bash is not installed")
def test_bash_completes_commands_and_options(capsys, tmp_path):
    with pytest.raises(SystemExit) as done:
        main(["--completion", "bash"])
    assert done.value.code == 0
    script = tmp_path / "completion.sh"
    script.write_text(capsys.readouterr().out)
    (tmp_path / "shape_12.obj").touch()

    def completed(*words):
        ask = (
            f"source {script}; cd {tmp_path}; COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; "
            f"COMP_LINE='{' '.join(words)}'; _shtab_bihdist; echo ${{COMPREPLY[@]}}"
        )
        return subprocess.run(["bash", "-c", ask], capture_output=True, text=True).stdout.split()

    assert completed("bihdist", "field", "--sou") == ["--sources"]
    assert completed("bihdist", "fie") == ["field"]
    assert completed("bihdist", "field", "sha") == ["shape_12.obj"]
    assert completed("bihdist", "batch", "list.txt", "--labels", "sha") == ["shape_12.obj"]
    assert completed("bihdist", "batch", "list.txt", "--clim", "s") == ["size", "shared"]


@pytest.mark.parametrize("ending", ["csv", "npy", "npz", "json"])
def test_nearest_vertices_of_several_meshes(meshes, tmp_path, ending):
    options = ["--nearest", "--k", "4", "--sources", "3,7", "--distance", "commute-time"]
    assert main(["pairs", *meshes, *options, "-o", str(tmp_path / f"{{name}}.{ending}")]) == 0
    for mesh in meshes:
        distance = CommuteTimeDistance(read_surface(mesh))
        indices, values = nearest(distance, [3, 7], 4)
        path = mesh.replace(".off", f".{ending}")
        if ending in ("csv", "npy"):
            table = np.load(path) if ending == "npy" else np.loadtxt(path, delimiter=",", skiprows=1)
            np.testing.assert_array_equal(table[:, 0], np.repeat([3, 7], 4))
            found, away = table[:, 1].reshape(2, 4), table[:, 2].reshape(2, 4)
        elif ending == "npz":
            found, away = (np.load(path)[name] for name in ("indices", "distances"))
        else:
            with open(path, encoding="utf-8") as file:
                said = json.load(file)
            assert (said["distance"], said["unit"], said["version"]) == ("commute-time", "no unit", version())
            assert [each["vertex"] for each in said["neighbours"]] == [3, 7]
            found, away = ([each[name] for each in said["neighbours"]] for name in ("indices", "distances"))
        np.testing.assert_array_equal(found, indices)
        np.testing.assert_array_equal(away, values)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--nearest", "--k", "2", "--sources", "80"], "has no vertex 80"),
        (["--nearest", "--k", "2", "--distance", "biharmonic,geodesic"], "of one distance; name one"),
        (["--nearest", "--k", "0"], "k must be a whole number above 0"),
    ],
)
def test_neighbours_that_cannot_be_are_refused(meshes, capsys, options, words):
    assert words in refused(capsys, "pairs", meshes[0], *options, "-o", "-")


@pytest.mark.parametrize(
    "command",
    [
        ["field", "--sources", "3,7"],
        ["pairs", "--sources", "3,7,9", "--distance", "biharmonic,diffusion(t=1/4)"],
        ["pairs", "--nearest", "--k", "3"],
    ],
    ids=["field", "pairs", "nearest"],
)
def test_a_table_has_one_header_line_and_numbers(meshes, tmp_path, command):
    word, *options = command
    assert main([word, meshes[1], *options, "-o", str(tmp_path / "out.csv")]) == 0
    with (tmp_path / "out.csv").open(newline="") as file:
        header, *lines = csv.reader(file)
    assert len(lines) > 2
    assert all(not cell.startswith("#") and not cell.replace(".", "").isdigit() for cell in header)
    assert {len(line) for line in lines} == {len(header)}
    assert np.isfinite(np.array(lines, float)).all()
