"""`bihdist paper`: pictures, numbers and one page that opens by itself."""

import re
import shutil

import numpy as np
import pytest

from app.paper import reproduce as reproducing, verdicts
from app.paper.charts import chart_svg
from app.paper.page import Section, page
from app.paper.pictures import figure_of, name_of, rows_of
from app.paper.reproduce import reproduce
from bihdist_core import OutputError, ParameterError
from bihdist_core.experiments import EXPERIMENTS, Chart, Claim, Mark, Panel, Result, Series, Table
from bihdist_core.experiments.result import STATEMENTS
from bihdist_core.experiments.verdicts import BySource, Estimate, above, at_least, at_most
from tests.shapes import bumpy, grid

MINIMA, CHANGE = (STATEMENTS[id].names[0] for id in ("fig1-1", "fig3-2"))


def result(**changes):
    surface, flat = bumpy(150), grid(5, 5)
    field = np.linspace(0, 1, 150)
    made = {
        "surfaces": {"bumpy": surface, "flat": flat},
        "panels": (
            Panel("one", "bumpy", field, "first", (Mark(3, "source"),), ("front", "back")),
            Panel("two", "bumpy", field, "first", views=("front", "zoom"), zoom_vertex=4, zoom_radius=0.2),
            Panel("three", "flat", flat.vertices[:, 1], "second row", (Mark(0, "maximum"),), style="height"),
            Panel("bare", "flat", None, "second row"),
        ),
        "charts": (Chart("a chart", "x", "y", (Series("s", np.array([1.0, 2]), np.array([1.0, 4])),), log_y=True),),
        "tables": (Table("numbers", ("what", "value"), (("a < b", 1.5), ("n", 1000), ("none", None))),),
        "claims": (
            Claim("fig1-1", {MINIMA: BySource((0.0,), (0.0, 0.002))}, note="a note <1>"),
            Claim("fig3-2", {CHANGE: BySource((0.08,), (0.09,))}, warning="It was late."),
        ),
    }
    return Result("fig1", "A title", "The protocol.", **(made | changes))


def test_each_row_of_panels_is_a_figure():
    drawn = {name_of(result(), row): figure_of(result(), panels) for row, panels in rows_of(result()).items()}
    assert list(drawn) == ["fig1-first", "fig1-second-row"]
    first, second = drawn["fig1-first"].panels, drawn["fig1-second-row"].panels
    assert first[0].views == ("front", "back")
    assert first[1].views[0] == "front"
    assert first[1].views[1].focal_point == pytest.approx(bumpy(150).vertices[4])
    assert second[0].warp_factor > 0
    assert second[1].field is None


def test_charts_are_svg_with_their_words():
    svg = chart_svg(result().charts[0])
    assert svg.startswith("<svg")
    assert "a chart" in svg


def test_the_page_says_what_holds_and_needs_nothing_else():
    section = Section(EXPERIMENTS["fig1"], result(), (("row", b"png"),), ("<svg></svg>",))
    failed = Section(EXPERIMENTS["fig2"], None, failure="no domain <here>")
    text = page("Title & more", "Introduction.", [section, failed])
    assert "of 2 statements" in text
    assert "a note &lt;1&gt;" in text
    assert text.count("● holds") == 2  # its own chip, and the one of the count
    assert text.count("○ does not hold") == 2
    assert "8&nbsp;% pictured; 9&nbsp;% from 1 random source (0 within)" in text
    assert "at most 5&nbsp;%, pictured sources and 90&nbsp;% of random ones" in text
    assert "the paper's words, section 5.1" in text
    assert "our words, after figure 3" in text
    assert "⚠ It was late." in text
    # The overview leads to each statement.
    for id in ("fig1-1", "fig3-2"):
        assert f'href="#fig1--{id}"' in text
        assert f'id="fig1--{id}"' in text
    assert "a &lt; b" in text
    assert "1,000" in text
    assert "Not done: no domain &lt;here&gt;" in text
    assert not re.findall(r'(?:src|href)="(?!data:|#)', text)


def test_an_experiment_on_the_readers_mesh(mesh_file, tmp_path):
    said = []
    path = reproduce(str(tmp_path / "out"), ["fig1"], mesh_file(bumpy(400)), quick=True, say=said.append).page
    assert path.read_text(encoding="utf-8").count("data:image/png;base64") >= 1
    names = {p.name for p in path.parent.iterdir()}
    assert {"index.html", "fig1.npz"} <= names
    assert any(name.endswith(".png") for name in names)
    assert said[0].startswith("fig1: ")


def test_a_quick_page_says_that_its_verdicts_are():
    section = Section(EXPERIMENTS["fig1"], result())
    assert "These are quick measurements" in page("Title", "Introduction.", [section], verdicts.QUICK)
    assert "These are quick measurements" not in page("Title", "Introduction.", [section])


def test_a_statement_on_other_sizes_than_its_own_is_told_in_theirs():
    words = "Biharmonic distance is insensitive to simplification from 400 to 150 vertices."
    claim = Claim("fig6-5", {"mean change, biharmonic": BySource((0.01,), (0.01,))}, words=words)
    for text in (verdicts.statements("fig6", [claim]), verdicts.overview([("fig6", [claim])])):
        assert words in text
        assert "14,000" not in text
    assert claim.rows()[0][1] == words


@pytest.mark.parametrize(
    ("limit", "numbers", "dots"),
    [
        (at_most(1), BySource((0.5,), (0.2, 3.0)), 2),
        (at_least(1), BySource((np.inf,), (2.0,)), 1),
        (above(0), Estimate(1.0, -0.5, 2.5, 25), 0),
        (above(0), Estimate(1.0, -np.inf, np.inf, 2), 0),
        (at_most(0), BySource((0.0,), (0.0, 0.0)), 2),
        (at_most(1), BySource((np.nan,), (0.2, np.nan, 3.0)), 2),
    ],
)
def test_a_spread_is_drawn_with_what_the_rule_allows(limit, numbers, dots):
    svg = verdicts._strip(limit, numbers)
    assert svg.count("class=random") == dots
    assert "class=allowed" in svg
    assert "nan" not in svg
    assert "inf" not in svg


def test_statements_that_do_not_hold_are_told_in_their_words(tmp_path, monkeypatch):
    unmeasured = Claim("fig9-2", failure="There was no animal.")
    long = Claim("fig4-3", {STATEMENTS["fig4-3"].names[0]: BySource((1.0,))})
    claims = (*result().claims, unmeasured, long)
    made = {"fig1": result(panels=(), claims=claims), "fig3": result(panels=(), claims=())}
    monkeypatch.setattr(reproducing.Experiment, "compute", lambda self, *_: made[self.id])
    said = []
    page = reproduce(str(tmp_path), ["fig1", "fig3"], say=said.append).page
    assert said[0].startswith("fig1: 1 holds, 2 do not hold, 1 not judged, ")
    assert said[1] == "  warning: It was late."
    assert said[2].startswith("  does not hold: Biharmonic distance is largely insensitive to holes: punched ones (")
    assert said[2].endswith("8 % pictured; 9 % from 1 random source)")
    assert said[3].startswith("  not judged: Of the five distances")
    assert said[3].endswith("(There was no animal)")
    assert len(said[4]) < 250
    assert said[5].startswith("fig3: no statements, ")
    assert len(said) == 6
    assert '<section id="fig1">' in page.read_text(encoding="utf-8")


def test_one_bad_mesh_of_a_folder_does_not_stop_the_others(mesh_file, tmp_path, monkeypatch):
    monkeypatch.setattr(reproducing.Experiment, "compute", lambda *_: result(panels=()))
    folder = tmp_path / "meshes"
    folder.mkdir()
    for name in ("a.off", "c.off"):
        shutil.copy(mesh_file(bumpy(100)), folder / name)
    (folder / "b.off").write_text("OFF\n1 1 0\n")
    said = []
    path = reproduce(str(tmp_path / "out"), ["fig1"], str(folder), quick=True, say=said.append).page
    text = path.read_text(encoding="utf-8")
    assert text.count("Not done") == 1
    assert "b.off" in text
    assert (path.parent / "contact-sheet-1.png").exists()
    assert (path.parent / "a" / "fig1.npz").exists()
    assert (path.parent / "c" / "fig1.npz").exists()


def test_a_folder_has_only_what_makes_sense_on_any_mesh(mesh_file, tmp_path, monkeypatch):
    monkeypatch.setattr(reproducing.Experiment, "compute", lambda *_: result(panels=()))
    folder = tmp_path / "meshes"
    folder.mkdir()
    shutil.copy(mesh_file(bumpy(100)), folder / "a.off")
    for only, there in ((["fig2", "fig3"], ["fig3"]), ([], list(reproducing.FOLDER_EXPERIMENTS))):
        path = reproduce(str(tmp_path / "out"), only, str(folder), say=lambda _: None).page
        sections = re.findall('<section id="(a-[^"]+)"', path.read_text(encoding="utf-8"))
        assert sections == [f"a-{id}" for id in there]


def test_what_cannot_be_is_refused(mesh_file, tmp_path):
    with pytest.raises(ParameterError, match="no experiment 'fig99'; choose among fig1"):
        reproduce(str(tmp_path), ["fig99"])
    with pytest.raises(ParameterError, match="bundled meshes only"):
        reproduce(str(tmp_path), ["fig2"], mesh_file(bumpy(100)))
    (tmp_path / "empty").mkdir()
    with pytest.raises(ParameterError, match="There is no mesh in"):
        reproduce(str(tmp_path / "out"), [], str(tmp_path / "empty"))
    (tmp_path / "file").write_text("x")
    with pytest.raises(OutputError, match="cannot be made"):
        reproduce(str(tmp_path / "file" / "out"), ["fig1"])
