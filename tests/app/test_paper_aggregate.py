"""`bihdist paper --aggregate`: each statement over a folder of meshes."""

from dataclasses import replace
from pathlib import Path

import pytest

from app.main import main
from app.paper.aggregate import MeshStatements, over_meshes, strip
from bihdist_core.experiments import Claim
from bihdist_core.experiments.result import CLAIM_COLUMNS, STATEMENTS
from bihdist_core.experiments.verdicts import BySource
from tests.commands import ran
from tests.shapes import bumpy

MINIMA, CHANGE = (STATEMENTS[id].names[0] for id in ("fig1-1", "fig3-2"))


def measured(change: float, depth: float, thumbnail: bytes = b"") -> MeshStatements:
    claims = (
        Claim("fig3-2", {CHANGE: BySource((change,), (change, 0.9))}),
        Claim("fig1-1", {MINIMA: BySource((0.0,), (depth,))}),
    )
    rows = [",".join(f'"{"" if cell is None else cell}"' for cell in row) for claim in claims for row in claim.rows()]
    return MeshStatements.from_table("\n".join([",".join(CLAIM_COLUMNS), *rows]).encode(), thumbnail)


@pytest.mark.parametrize(
    ("changes", "verdict"),
    [
        ([0.01] * 9 + [0.2], "holds"),  # on 90 % of the meshes
        ([0.01] * 8 + [0.2] * 2, "partly"),
        ([0.01] * 5 + [0.2] * 5, "does not hold"),  # half is no majority
    ],
)
def test_a_statement_holds_if_it_does_on_most_meshes(changes, verdict):
    meshes = {f"mesh {k}": measured(change, 0.0) for k, change in enumerate(changes)}
    (result,) = over_meshes(["fig3"], meshes)
    claim = next(claim for claim in result.claims if claim.id == "fig3-2")
    # The pictured source's number of each mesh counts.
    assert claim.numbers[CHANGE] == BySource((), tuple(changes))
    assert claim.verdict == verdict
    assert claim.statement.parts[0].rule == "at most 5 %, 90 % of the meshes"
    failing = [name for name, mesh in meshes.items() if mesh.verdicts["fig3-2"] == "does not hold"]
    assert f"does not hold on {len(failing)} ({', '.join(failing)})" in claim.note
    # What no mesh has is there, too.
    assert [each.id for each in result.claims if each.failure] == ["fig3-1", "fig3-3", "fig3-4"]


def test_quick_numbers_of_many_meshes_are_judged_unless_their_sizes_decide():
    meshes = {f"mesh {k}": measured(0.01 + 0.003 * k, 0.0) for k in range(14)}
    claim = over_meshes(["fig3"], meshes, quick=True)[0].claims[1]
    part = claim.statement.parts[0]
    assert (claim.verdict, part.judge(claim.numbers[CHANGE], surely=True)) == ("holds", "holds")
    assert STATEMENTS["fig1-2"].whole
    trend = STATEMENTS["fig1-2"].names[0]
    whole = type(claim)("fig1-2", {trend: BySource((), (0.5,) * 14)}, quick=True)
    assert (whole.verdict, replace(whole, quick=False).verdict) == (None, "holds")
    # Of many meshes some are named.
    failing = {f"mesh {k}": measured(0.2, 0.0) for k in range(14)}
    assert "(mesh 0, mesh 1," in (note := over_meshes(["fig3"], failing)[0].claims[1].note)
    assert "mesh 11 and 2 more)" in note


def test_one_mesh_refutes_what_is_said_of_all():
    meshes = {"a": measured(0.01, 0.0), "b": measured(0.01, 0.06)}
    claim = over_meshes(["fig1"], meshes)[0].claims[0]
    # The deepest minimum of each mesh counts.
    assert claim.numbers[MINIMA].random == (0.0, 0.06)
    assert claim.verdict_words == "does not hold everywhere"


def test_the_strip_shows_each_mesh_with_its_verdicts():
    html = strip({"a <1>": measured(0.01, 0.0, b"jpg"), "b": measured(0.2, 0.06)})
    assert html.count("<figure>") == 2
    assert html.count("<img") == 1
    assert "a &lt;1&gt;" in html
    assert html.count("○ 2") == 1


def test_a_folder_is_measured_as_a_batch_that_resumes(mesh_file, tmp_path, capsys):
    folder, out = tmp_path / "meshes", tmp_path / "out"
    folder.mkdir()
    for name, count in (("a", 120), ("c", 150)):
        Path(mesh_file(bumpy(count))).rename(folder / f"{name}.off")
    (folder / "b.off").write_text("OFF\n1 1 0\n")
    words = ("paper", "--mesh", folder, "--aggregate", "--quick", "--only", "alpha", "--workers", 1, "-o", out)
    assert "b: statements: " in ran(capsys, *words, status=1).err
    page = (out / "index.html").read_text(encoding="utf-8")
    assert page.count("data:image/jpeg") == 2
    assert "measured on the 2 meshes in the folder meshes" in page
    assert 'id="alpha--alpha-3"' in page
    assert "from 2 meshes (2 within)" in page
    before = (out / "a.statements.csv").stat().st_mtime_ns
    ran(capsys, *words, status=1)
    assert (out / "a.statements.csv").stat().st_mtime_ns == before


@pytest.mark.parametrize(
    ("words", "said"),
    [(("--aggregate",), "needs a folder of meshes"), (("--workers", "2"), "--dask and --workers need --aggregate")],
)
def test_what_has_no_effect_is_refused(words, said, tmp_path, capsys):
    assert main(["paper", "-o", str(tmp_path / "out"), *words]) == 2
    assert said in capsys.readouterr().err
