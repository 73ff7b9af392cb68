"""Figures of where a point of one mesh is on another: from the command line, and again from their recipes."""

import numpy as np
import pytest

import app as bihdist
from app.document.file import read_recipe
from app.drawing.glyphs import CANDIDATE
from app.figures.export import compute, figure_of, open_document
from app.main import main
from app.session.array_store import ArrayStore
from app.tools.correspondence.pairs import Pairs
from bihdist_core import BiharmonicDistance, Correspondence, ParameterError, write_mesh
from bihdist_core.formats.vertex_maps import read_pairs, write_pairs
from tests.shapes import bumpy

PAIRS = [(3, 7), (20, 25), (60, 61), (130, 140)]
SMALL = ["--distance", "biharmonic", "--size", "600x200"]


@pytest.fixture
def named(tmp_path):
    """Paths of two meshes and of their pairs, by letter."""
    write_mesh(tmp_path / "a.off", bumpy(200))
    write_mesh(tmp_path / "b.off", bumpy(230, seed=1))
    write_pairs(tmp_path / "pairs.csv", PAIRS)
    return {"A": str(tmp_path / "a.off"), "B": str(tmp_path / "b.off"), "P": f"@{tmp_path}/pairs.csv"}


def drawn(named, words, out):
    return main(["figure", *(named.get(word, word) for word in words), "-o", str(out)])


def test_the_best_is_said_and_marked_and_a_recipe_draws_it_again(named, tmp_path, capsys):
    assert drawn(named, ["A", "B", "--pairs", "P", "--predict", "44", *SMALL], tmp_path / "one.png") == 0
    distances = BiharmonicDistance(bumpy(200)), BiharmonicDistance(bumpy(230, seed=1))
    misfit = Correspondence(*distances, PAIRS).misfit(44)
    best = int(misfit.argmin())
    said = f"the best is vertex {best}, misfit {misfit[best]:.4g}, {100 * misfit[best] / misfit.max():.1f} %"
    assert said in capsys.readouterr().out
    assert drawn(named, ["--recipe", str(tmp_path / "one.json")], tmp_path / "two.png") == 0
    assert (tmp_path / "two.png").read_bytes() == (tmp_path / "one.png").read_bytes()
    recipe = read_recipe(tmp_path / "one.json")
    document, surfaces = open_document(recipe, ArrayStore())
    first, second = figure_of(recipe, surfaces, compute(document, surfaces)).panels
    assert [mark.vertex for mark in first.marks] == [3, 20, 60, 130, 44]
    (candidate,) = [mark for mark in second.marks if mark.glyph is CANDIDATE]
    assert (candidate.vertex, candidate.number) == (best, 5)
    assert candidate.text == str(best)
    assert candidate.aside.endswith(" %")
    assert (first.heading, first.hint) == ("a.off", "Point 5, vertex 44, waits for its partner on B")


def test_a_caption_says_what_waits(named, tmp_path):
    words = ["A", "B", "--pairs", "P", "--predict", "44", *SMALL, "--tex"]
    assert drawn(named, words, tmp_path / "one.pdf") == 0
    caption = (tmp_path / "one.tex").read_text()
    assert "A.off: Point 5, vertex 44, waits for its partner on B; prediction by biharmonic" in caption
    assert "not shown" not in caption


def test_another_point_is_predicted_beside_a_recipe(named, tmp_path):
    assert drawn(named, ["A", "B", "--pairs", "P", "--predict", "44", *SMALL], tmp_path / "one.png") == 0
    assert drawn(named, ["--recipe", str(tmp_path / "one.json"), "--predict", "9"], tmp_path / "two.png") == 0
    document = read_recipe(tmp_path / "two.json").document
    assert len(document[Pairs].pairs) == 5
    assert document.point(document[Pairs].pairs[-1].first).at == 9


def test_python_draws_what_the_command_draws(named, tmp_path):
    words = ["A", "B", "--pairs", "P", "--predict", "44", "--distance", "biharmonic", "--size", "600x200"]
    assert drawn(named, words, tmp_path / "one.png") == 0
    how = {"second_mesh": named["B"], "pairs": PAIRS, "layout": {"size": "600x200"}}
    picture = bihdist.figure(named["A"], ["biharmonic"], **how, predict=44)
    picture.save(tmp_path / "two.png")
    assert (tmp_path / "two.png").read_bytes() == (tmp_path / "one.png").read_bytes()
    one, two = ((s.vertices, s.faces) for s in (bumpy(200), bumpy(230, seed=1)))
    arrays = bihdist.figure(one, ["biharmonic"], **{**how, "second_mesh": two}, predict=44)
    assert arrays.answers[1].field == pytest.approx(picture.answers[1].field, rel=1e-12)
    maps = bihdist.figure(named["A"], ["biharmonic"], **how, maps=["pairs"])
    distances = BiharmonicDistance(bumpy(200)), BiharmonicDistance(bumpy(230, seed=1))
    (found,) = [answer.leads_to for answer in maps.answers if answer.leads_to is not None]
    assert np.array_equal(found, Correspondence(*distances, PAIRS).map())


@pytest.mark.parametrize(
    ("how", "said"),
    [
        ({"pairs": PAIRS}, "second_mesh= with pairs="),
        ({"second_mesh": "B", "predict": 4}, "give pairs="),
        ({"second_mesh": "B", "pairs": PAIRS, "predict": 4, "maps": ["pairs"]}, "cannot be combined"),
        ({"second_mesh": "B", "pairs": [1, 2], "predict": 4}, r"shape \(k, 2\)"),
        ({"second_mesh": "B", "pairs": [(1.5, 2.5)], "predict": 4}, "whole numbers"),
    ],
)
def test_what_python_cannot_predict_is_refused(how, said, named):
    with pytest.raises(ParameterError, match=said):
        bihdist.figure(
            named["A"], ["biharmonic"], **{**how, **({"second_mesh": named["B"]} if "second_mesh" in how else {})}
        )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["A", "--predict", "4"], "name a second one"),
        (["A", "B", "--predict", "4"], "--predict needs pairs"),
        (["A", "B", "--pairs", "P", "--map", "pairs", "--predict", "4"], "cannot be combined"),
        (["A", "B", "--pairs", "P", "--predict", "200"], "no vertex 200"),
    ],
)
def test_what_cannot_be_predicted_is_refused(words, said, named, tmp_path, capsys):
    assert drawn(named, words, tmp_path / "no.png") == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "no.png").exists()


def test_pairs_are_written_as_they_are_read_and_ids_are_those_of_the_meshes(named, tmp_path):
    assert np.array_equal(read_pairs(tmp_path / "pairs.csv", (bumpy(200), bumpy(230))), PAIRS)
    (tmp_path / "wrong.csv").write_text("a,b\n3,7\n200,4\n")
    with pytest.raises(ParameterError, match=r"line 3: .* has vertices 0 to 199, not 200"):
        read_pairs(tmp_path / "wrong.csv", (bumpy(200), bumpy(230)))
    (tmp_path / "wrong.csv").write_text("3,-1\n")
    with pytest.raises(ParameterError, match="0 to 229, not -1"):
        read_pairs(tmp_path / "wrong.csv", (bumpy(200), bumpy(230)))
