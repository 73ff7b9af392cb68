"""Maps between two meshes in documents: their colours, their files, what they are measured by."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.document import MeshFile, comparison
from app.document.edits import open_mesh
from app.document.file import read_recipe, recipe_text, with_all_paths, with_meshes_from
from app.document.form import document_data, document_from
from app.document.page import Recipe
from app.document.quantities import Difference, DistanceFrom, quantity
from app.document.second_mesh_edits import close_second_mesh, open_second_mesh
from app.figures.export import compute, open_document
from app.main import main
from app.session.array_store import ArrayStore
from app.tools.correspondence.maps import (
    MapColours,
    MapFile,
    Maps,
    Truth,
    map_colours,
    map_file,
    show_maps,
    with_map,
    with_truth,
    without_maps,
)
from app.tools.correspondence.pairs import Pairs, add_pairs
from app.tools.correspondence.quantity import predict
from bihdist_core import (
    BiharmonicDistance,
    Correspondence,
    ParameterError,
    Surface,
    noisy,
    read_surface,
    write_map,
    write_mesh,
)
from bihdist_core.applications.correspondence import DARKEST, LIGHTEST, carried_back, position_colours
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy

ORDER = np.random.default_rng(1).permutation(400)
"""Which vertex of the first mesh each of the second was."""

PLACES = [(v, int(np.flatnonzero(v == ORDER)[0])) for v in (3, 200, 350, 90)]


def renumbered(surface):
    """The same with its vertices in the order of ORDER."""
    return Surface(surface.vertices[ORDER], np.argsort(ORDER)[surface.faces])


@pytest.fixture
def meshes(tmp_path):
    """A shape, and the same with a little noise and other ids."""
    s = bumpy(400)
    write_mesh(tmp_path / "a.off", s)
    write_mesh(tmp_path / "b.off", renumbered(noisy(s, 0.1)))
    return str(tmp_path / "a.off"), str(tmp_path / "b.off")


@pytest.fixture
def two(meshes):
    """Both in a document, with pairs."""
    shown = comparison(meshes[0], (Spec.of("biharmonic"), Spec.of("geodesic")))
    return add_pairs(open_second_mesh(shown, MeshFile("", meshes[1])), PLACES)


def answers(document):
    document, surfaces = open_document(Recipe(document), ArrayStore())
    return document, compute(document, surfaces)


# ---------------------------------------------------------------------- colours
def test_positions_are_colours_from_the_least_to_the_largest_coordinate():
    surface = bumpy(400)
    colours = position_colours(surface)
    assert colours.min() == pytest.approx(DARKEST)
    assert colours.max() == pytest.approx(LIGHTEST)
    assert np.array_equal(colours.argmax(axis=0), surface.vertices.argmax(axis=0))
    moved = Surface(7 * surface.vertices + 2, surface.faces)
    assert position_colours(moved) == pytest.approx(colours)


def test_a_flat_surface_has_one_shade_of_the_colour_across_it():
    surface = bumpy(400)
    flat = Surface(surface.vertices * [1, 1, 0], surface.faces)
    assert np.ptp(position_colours(flat)[:, 2]) == 0


def test_each_vertex_has_the_colour_of_the_one_it_is_mapped_to():
    colours = np.random.default_rng(0).random((5, 3))
    carried = carried_back(colours, [4, 0, -1])
    assert np.array_equal(carried[:2], colours[[4, 0]])
    assert np.isnan(carried[2]).all()
    for wrong in ([5], [-2], [0.5], [[0]]):
        with pytest.raises(ParameterError):
            carried_back(colours, wrong)


# ---------------------------------------------------------------------- documents
def test_the_full_map_is_that_of_the_core_and_its_colours_those_of_where_it_leads(two):
    document, (reference, biharmonic, _) = answers(show_maps(two))
    one, other = (read_surface(mesh.path) for mesh in document.surfaces)
    found = Correspondence(BiharmonicDistance(one), BiharmonicDistance(other), PLACES).map()
    assert np.array_equal(biharmonic.leads_to, found)
    assert np.array_equal(reference.colours, position_colours(other))
    assert np.array_equal(biharmonic.colours, reference.colours[found])
    assert biharmonic.field is None
    assert not biharmonic.failure
    assert f"{len(np.unique(found))} of 400" in biharmonic.remark


def test_the_map_of_a_file_is_shown_beside_those_by_distances(two, tmp_path):
    found = np.roll(np.arange(400), 5)
    found[7] = -1
    write_map(tmp_path / "ours.txt", found)
    one, other = (read_surface(mesh.path) for mesh in two.surfaces)
    shown = with_map(two, map_file(str(tmp_path / "ours.txt"), one, other))
    ours = f"map {tmp_path / 'ours.txt'}"
    words = ["position colours", "map by biharmonic", "map by geodesic", ours]
    assert [str(panel.shows) for panel in shown.panels] == words
    assert [panel.surface for panel in shown.panels] == ["B", "A", "A", "A"]
    _, (reference, *_, last) = answers(shown)
    assert np.array_equal(last.leads_to, found)
    assert np.array_equal(last.colours[8:], reference.colours[found[8:]])
    assert np.isnan(last.colours[7]).all()
    assert "1 are mapped nowhere" in last.remark
    write_map(tmp_path / "ours.txt", np.arange(400))
    with pytest.raises(ParameterError, match="checksum"):
        answers(shown)


def test_without_pairs_there_is_no_map(two):
    shown = show_maps(two)
    document = shown.with_part(Pairs(pairs=()))
    _, (reference, first, _) = answers(document)
    assert reference.colours is not None
    assert "no pair" in first.failure
    with pytest.raises(ParameterError, match="second one"):
        show_maps(comparison("hand"))


def test_predictions_follow_on_maps_by_the_same_distances(two):
    again = predict(show_maps(predict(two)))
    assert [panel.shows for panel in again.panels] == [panel.shows for panel in predict(two).panels]
    assert {panel.id for panel in again.panels} <= set(range(again.next_id))


def test_with_another_mesh_maps_and_their_truth_are_gone(two, tmp_path):
    write_map(tmp_path / "ours.npy", np.arange(400))
    shown = with_truth(with_map(two, MapFile(str(tmp_path / "ours.npy"))), Truth("identity"))
    assert {panel.surface for panel in open_mesh(shown, MeshFile("A", "hand")).panels} == {"A", "B"}
    for after in (close_second_mesh(shown), open_mesh(shown, MeshFile("A", "hand")), without_maps(shown)):
        assert after[Maps].maps == ()
        assert after[Maps].truth == Truth()
        assert after.panels
        assert not any(isinstance(panel.shows, MapColours) for panel in after.panels)
    alone = shown.with_part(Pairs(), panels=shown.panels[:1], points=())
    assert [str(panel.shows) for panel in without_maps(alone).panels] == ["biharmonic"]


def test_documents_of_maps_are_read_as_they_were_written(two, tmp_path):
    truth = Truth("file", MapFile("t.npy", "1"), MapFile("s.txt", "2"), mirror=True)
    shown = with_truth(with_map(two, MapFile("ours.npy", "3")), truth)
    assert document_from(document_data(shown)) == shown
    assert "truth" not in document_data(two)
    for name in ("ours.npy", "t.npy", "s.txt"):
        write_map(tmp_path / name, np.arange(400))
    here = with_all_paths(shown, lambda path: str(tmp_path / path))
    file = tmp_path / "session.json"
    file.write_text(recipe_text(with_meshes_from(Recipe(here), file), "1"))
    assert '"ours.npy"' in file.read_text()
    again = read_recipe(file).document
    assert again[Maps].maps == here[Maps].maps
    assert again[Maps].truth == here[Maps].truth
    assert again.panels == here.panels


@pytest.mark.parametrize("words", ["map by geodesic(method=heat)", "position colours", "map folder/ours.npy"])
def test_maps_are_written_in_words(words):
    assert str(quantity(words)) == words
    assert quantity(words) == map_colours(words)


def test_what_makes_no_sense_is_refused(two, tmp_path):
    with pytest.raises(ParameterError, match="is not a map"):
        map_colours("biharmonic")
    with pytest.raises(ParameterError, match="colours"):
        Difference(DistanceFrom(Spec.of("biharmonic")), MapColours())
    with pytest.raises(ParameterError, match=r"no map 'x\.npy'"):
        replace(two, panels=(replace(two.panels[0], shows=MapColours("x.npy")),))
    with pytest.raises(ParameterError, match="from the surface 'A'"):
        replace(two, panels=(replace(two.panels[-1], shows=MapColours(Spec.of("biharmonic"))),))
    with pytest.raises(ParameterError, match="two"):
        comparison("hand").with_part(Maps(maps=(MapFile("x.npy"),)))
    with pytest.raises(ParameterError, match="file"):
        Truth("file")
    with pytest.raises(ParameterError, match="partners"):
        Truth(mirror=True)
    np.save(tmp_path / "short.npy", np.arange(3))
    with pytest.raises(ParameterError, match="3 vertices"):
        map_file(str(tmp_path / "short.npy"), bumpy(400), bumpy(400))


# ---------------------------------------------------------------------- the command line
def test_a_figure_of_two_meshes_shows_maps(meshes, tmp_path, capsys):
    pairs, found = tmp_path / "pairs.csv", tmp_path / "found.txt"
    pairs.write_text("i,j\n" + "".join(f"{i},{j}\n" for i, j in PLACES))
    assert main(["correspond", *meshes, "--pairs", f"@{pairs}", "-o", str(found)]) == 0
    capsys.readouterr()
    words = [
        "--map",
        f"pairs,{found}",
        "--pairs",
        f"@{pairs}",
        "--distance",
        "biharmonic",
        "--size",
        "600x200",
    ]
    assert main(["figure", *meshes, *words, "-o", str(tmp_path / "maps.png")]) == 0
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 3
    assert said[0].partition(":")[2] == said[1].partition(":")[2]
    recipe = read_recipe(tmp_path / "maps.json")
    assert [str(panel.shows) for panel in recipe.document.panels][:2] == ["position colours", "map by biharmonic"]
    one, again = tmp_path / "maps.png", tmp_path / "again.png"
    assert main(["figure", "--recipe", str(tmp_path / "maps.json"), "-o", str(again)]) == 0
    assert again.read_bytes() == one.read_bytes()
    np.savetxt(found, np.zeros(400, int), "%d")
    assert main(["figure", "--recipe", str(tmp_path / "maps.json"), "-o", str(again)]) == 2
    assert "checksum" in capsys.readouterr().err


def test_a_figure_of_two_meshes_shows_both(meshes, tmp_path):
    words = ["--distance", "biharmonic", "--sources", "3", "--size", "400x200"]
    assert main(["figure", *meshes, *words, "-o", str(tmp_path / "both.png")]) == 0
    document = read_recipe(tmp_path / "both.json").document
    assert [(panel.surface, str(panel.shows)) for panel in document.panels] == [
        ("A", "biharmonic"),
        ("B", "biharmonic"),
    ]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["A", "--map", "identity"], "name a second one"),
        (["A", "B", "--map", "pairs"], "name them with --pairs"),
        (["A", "B", "--map", "gone.npy"], "gone.npy"),
        (["A", "gone.off"], "gone.off"),
    ],
)
def test_maps_that_make_no_sense_are_refused(words, said, meshes, tmp_path, capsys):
    named = {"A": meshes[0], "B": meshes[1]}
    words = [named.get(word, word) for word in words]
    assert main(["figure", *words, "-o", str(tmp_path / "no.png")]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "no.png").exists()
