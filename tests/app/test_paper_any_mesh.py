"""`bihdist paper --mesh`: a part that cannot be done is listed, the others are there, and the exit status says so."""

from pathlib import Path

import numpy as np
import pytest

from app.main import main
from app.paper import reproduce
from bihdist_core import Cancelled, OutputError, SolverError, Surface, write_mesh
from bihdist_core.experiments import Parts, _claims_growth, claims
from tests.commands import ran
from tests.shapes import bumpy


def pieces() -> Surface:
    """Two components, and a vertex of no face."""
    one, other = bumpy(300), bumpy(100, 1)
    n = len(one.vertices)
    vertices = np.concatenate([one.vertices, [[9, 9, 9]], other.vertices + 5])
    return Surface(vertices, np.concatenate([one.faces, other.faces + n + 1]))


def finned() -> Surface:
    """Not manifold: a third face on an edge."""
    s = bumpy(300)
    a, b, _ = s.faces[0]
    return Surface(np.concatenate([s.vertices, [[3, 0, 0]]]), np.concatenate([s.faces, [[a, b, len(s.vertices)]]]))


@pytest.fixture
def paper(mesh_file, tmp_path, monkeypatch, capsys):
    """A function that makes the page of claims of a surface: (exit status, output, errors, page)."""
    monkeypatch.setattr(_claims_growth, "REPEATS", 1)

    def made(surface, sizes=(250, 300, 350)):
        monkeypatch.setattr(_claims_growth, "QUICK_SIZES", sizes)
        out = tmp_path / "out"
        status = main(["paper", "--mesh", mesh_file(surface), "--quick", "--only", "claims", "-o", str(out)])
        said = capsys.readouterr()
        return status, said.out, said.err, (out / "index.html").read_text(encoding="utf-8")

    return made


def test_components_and_loose_vertices_lose_nothing(paper):
    status, out, _, page = paper(pieces())
    assert status == 0
    assert "not done" not in out
    assert "Not done" not in page
    assert page.count("data:image/png;base64") >= 1
    assert page.count("<svg") >= 4


def test_a_part_that_cannot_be_done_is_listed_and_the_others_are_there(paper):
    status, out, err, page = paper(finned(), (3, 250, 300, 350))
    assert status == 1
    reason = "3 vertices: mesh.off has 301 vertices and cannot be simplified to 3."
    assert f"  not done: {reason}\n" in out, out
    parts = out.count("not done: ")
    assert f"{parts} parts could not be done" in err if parts > 1 else "One part could not be done" in err
    assert reason in page
    assert page.count("<li>") >= parts
    assert '<a href="#claims">claims</a>' in page
    # What the other sizes tell is there.
    assert page.count("<svg") >= 4
    assert "processor seconds" in page


def test_every_part_of_the_claims_fails_by_itself(paper, monkeypatch):
    def broken(*_):
        raise SolverError("It cannot be solved.")

    names = ("metric", "cost", "eigenvalues", "refinement", "conformal", "topology")
    for name in names:
        monkeypatch.setattr(claims, name, broken)
    status, out, _, page = paper(bumpy(300))
    assert status == 1
    assert out.count("not done: ") == len(names)
    # No statement is lost: those of these parts say why they are not judged.
    assert page.count("Not measured: It cannot be solved.") == 10
    assert "of 11 statements" in page
    assert "sub-sampling" in page


def test_parts_note_what_fails_once_and_go_on():
    parts = Parts()
    assert parts.do("a sum", sum, (1, 2)) == 3
    for _ in range(2):
        assert parts.do("a quotient", divmod, 1, 0) is None
    parts.do("a sum", sum, 3)
    assert [each.part for each in parts.not_done] == ["a quotient", "a sum"]
    assert "ZeroDivisionError" in parts.not_done[0].reason

    def stop(error):
        raise error

    for error in (Cancelled("enough"), OutputError("full")):
        with pytest.raises(type(error)):
            parts.do("it all", stop, error)


def test_what_fails_beside_the_experiments_leaves_the_page(mesh_file, tmp_path, monkeypatch, capsys):
    def broken(*_):
        raise SolverError("It cannot be.")

    monkeypatch.setattr(reproduce, "guess_up", broken)
    monkeypatch.setattr(reproduce, "first_source", broken)
    folder, out = tmp_path / "meshes", tmp_path / "out"
    folder.mkdir()
    Path(mesh_file(bumpy(120))).rename(folder / "a.off")
    said = ran(capsys, "paper", "--mesh", folder, "--quick", "--only", "fig3", "-o", out, status=1)
    assert "2 parts could not be done" in said.err
    page = (out / "index.html").read_text(encoding="utf-8")
    for part in ("which way a.off is up", "a.off on the contact sheet"):
        assert f"not done: {part}: It cannot be." in said.out
        assert f"<li>{part}: It cannot be.</li>" in page
    assert '<section id="a-fig3">' in page


def test_a_folder_has_its_page_with_each_mesh_and_what_cannot_be_read(mesh_file, tmp_path, capsys):
    folder = tmp_path / "meshes"
    folder.mkdir()
    Path(mesh_file(bumpy(200))).rename(folder / "a.off")
    Path(mesh_file(bumpy(150))).rename(folder / "c.off")
    write_mesh(folder / "c.ply", bumpy(120))
    (folder / "b.off").write_text("OFF\n1 1 0\n")
    out = tmp_path / "out"
    assert "not done" in ran(capsys, "paper", "--mesh", folder, "--quick", "--only", "fig3", "-o", out, status=1).out
    page = (out / "index.html").read_text(encoding="utf-8")
    assert page.count("Not done") == 1
    for name in ("a", "c-off", "c-ply"):
        assert f'<section id="{name}-fig3">' in page
        assert list((out / name).glob("fig3*.png"))
