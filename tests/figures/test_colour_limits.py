"""Where colour bars end: words, numbers, and what is taken from another figure, by all who ask for a figure."""

import json
from dataclasses import replace

import numpy as np
import pytest

import app
from app.commands.figure import add_figure_options, chosen_recipe
from app.document.document import comparison
from app.document.edits import end_at, has_ends, with_range
from app.document.file import read_recipe
from app.document.looks import Colours
from app.document.quantities import quantity
from app.figures.colour_limits import ColourLimit, limits_in, with_limits, with_limits_of
from app.main import main
from app.scene.colour_maps import MAPS
from bihdist_core import ParameterError

SMALL = ["--size", "300x200"]


def document(*words):
    return comparison("hand", tuple(quantity(word) for word in words or ("biharmonic", "geodesic")))


def maxima(of):
    return [panel.maximum for panel in of.panels]


def recipe_of(*words):
    import argparse

    parser = argparse.ArgumentParser()
    add_figure_options(parser, "")
    return chosen_recipe(parser.parse_args(["hand", "-o", "x.png", *words]))


def test_words_and_numbers():
    plain = document()
    assert with_limits(plain, "fraction") == (replace(plain, range="fraction"), "")
    assert maxima(with_limits(plain, 0.5)[0]) == [0.5, 0.5]
    assert maxima(with_limits(plain, [0.5, None])[0]) == [0.5, None]
    # As PyVista has limits.
    assert maxima(with_limits(plain, (0, 0.5))[0]) == maxima(with_limits(plain, [-0.5, 0.5])[0]) == [0.5, 0.5]
    assert maxima(with_limits(replace(plain, range="shared"), (0.5, 2))[0]) == [0.5, 2]
    assert with_limits(replace(plain, range="shared"), 1.0)[0].range == "own"
    for wrong, sentence in [
        ([1.0, 2.0, 3.0], "3 colour limits for 2 panels"),
        (-1.0, "not -1"),
        ("everything", "'everything' are not one of own, shared, fraction"),
        ((0.1, 0.5, 1), "3 colour limits"),
        ((-0.1, 0.5), "not at -0.1"),
    ]:
        with pytest.raises(ParameterError, match=sentence):
            with_limits(plain, wrong)


def test_own_ends_are_gone_with_the_word_and_stay_otherwise():
    typed = end_at(document(), 1, 2.5)
    assert maxima(typed) == [None, 2.5]
    assert has_ends(typed)
    assert with_range(typed, "own") == document()
    assert maxima(with_range(typed, "shared")) == [None, 2.5]
    assert end_at(with_range(typed, "fraction"), 1, None) == document()


def test_the_options_of_colours_and_ranges():
    assert recipe_of().document.colours == Colours()
    assert recipe_of("--cmap", "ember", "--bands", "--flip-scalars").document.colours == Colours(
        "ember", (), True, True
    )
    assert recipe_of("--bands", "--no-bands").document.colours == Colours()
    assert recipe_of("--clim", "fraction").document.range == "fraction"
    assert recipe_of("--clim", "shared").document.range == "shared"
    assert maxima(recipe_of("--clim", "0.8").document) == [0.8, 0.8, 0.8]
    assert maxima(recipe_of("--clim", "0.8,own,2").document) == [0.8, None, 2.0]
    for words, sentence in [
        (["--clim", "1,2"], "2 colour limits for 3 panels"),
        (["--clim", "gone.json"], r"'gone\.json' are not one of"),
        (["--clim", "nan"], "not nan"),
        (["--cmap", "jet"], "no colour map 'jet'"),
    ]:
        with pytest.raises(ParameterError, match=sentence):
            recipe_of(*words)


def test_help_names_all_maps(capsys):
    with pytest.raises(SystemExit):
        main(["figure", "--help"])
    said = " ".join(capsys.readouterr().out.split())
    assert all(word in said.partition("colour map:")[2].partition("or a .txt")[0] for word in MAPS)


def test_colours_that_a_style_does_not_show_are_named(capsys):
    recipe_of("--style", "lines", "--isolines", "5")
    assert capsys.readouterr().err == ""
    recipe_of("--style", "lines", "--cmap", "safe", "--bands")
    assert "The style lines has no colours; --cmap, --bands cannot be seen in it." in capsys.readouterr().err


def test_ends_are_taken_by_quantity_and_else_by_place():
    ends = [ColourLimit("geodesic", 3.0), ColourLimit("biharmonic", 1.0), ColourLimit("geodesic", 4.0)]
    taken, said = with_limits_of(document("biharmonic", "geodesic", "geodesic"), ends, "a.json")
    assert maxima(taken) == [1.0, 3.0, 4.0]
    assert said == "Colour bars end as in a.json: biharmonic 1, geodesic 3, geodesic 4."
    taken, said = with_limits_of(document("diffusion", "biharmonic", "commute-time", "biharmonic"), ends, "a.json")
    assert maxima(taken) == [3.0, 1.0, 4.0, None]
    assert "diffusion 3 (that of geodesic, panel 1 there)" in said
    assert said.endswith("biharmonic its own.")
    # A difference is no distance, whatever its place.
    taken, _ = with_limits_of(document("biharmonic - geodesic", "biharmonic"), ends, "a.json")
    assert maxima(taken) == [None, 1.0]
    with pytest.raises(ParameterError, match=r"a\.json has no panel"):
        with_limits_of(document(), [ColourLimit("geodesic", 0.0)], "a.json")


def test_two_figures_have_one_scale(tmp_path, capsys):
    first, second = tmp_path / "first.png", tmp_path / "second.png"
    words = ["--distance", "biharmonic", *SMALL]
    assert main(["figure", "hand", "--sources", "12", *words, "-o", str(first)]) == 0
    assert (
        main(
            [
                "figure",
                "hand",
                "--sources",
                "900",
                *words,
                "--clim",
                str(first.with_suffix(".json")),
                "-o",
                str(second),
            ]
        )
        == 0
    )
    said = capsys.readouterr().err
    picture = app.figure("hand", ["biharmonic"], source=12, layout={"size": "300x200"})
    own = picture.answers[0].maximum
    assert maxima(read_recipe(second.with_suffix(".json")).document) == [own]
    assert f"Colour bars end as in {first.with_suffix('.json')}: biharmonic {own:.4g}." in said
    # Again, and in Python, it is the same: the recipe has the number.
    again = app.figure(
        "hand", ["biharmonic"], source=900, layout={"size": "300x200"}, look={"clim": first.with_suffix(".json")}
    )
    assert maxima(again.document) == [own]
    assert np.array_equal(again.pixels, app.figure_again(second.with_suffix(".json")).pixels)


def test_ends_are_those_of_a_figure_that_shares_them(tmp_path):
    path = tmp_path / "a.png"
    assert (
        main(
            [
                "figure",
                "hand",
                "--distance",
                "biharmonic,geodesic",
                "--clim",
                "shared",
                *SMALL,
                "-o",
                str(path),
            ]
        )
        == 0
    )
    ends = limits_in(path.with_suffix(".json"))
    assert [end.shows for end in ends] == ["biharmonic", "geodesic"]
    assert ends[0].end == ends[1].end > 1


def test_a_map_from_a_file_is_in_the_recipe_which_draws_the_same(tmp_path):
    (tmp_path / "mine.txt").write_text("20 40 80\n250 250 220\n")
    words = ["--distance", "biharmonic", *SMALL, "--bands", "--isolines", "7"]
    path = tmp_path / "a.png"
    assert main(["figure", "hand", *words, "--cmap", str(tmp_path / "mine.txt"), "-o", str(path)]) == 0
    (tmp_path / "mine.txt").unlink()
    assert main(["figure", "--recipe", str(tmp_path / "a.json"), "-o", str(tmp_path / "b.png")]) == 0
    assert path.read_bytes() == (tmp_path / "b.png").read_bytes()
    colours = json.loads((tmp_path / "a.json").read_text())["document"]["colours"]
    assert colours["map"] == "mine"
    assert colours["bands"] is True
    plain = app.figure("hand", ["biharmonic"], layout={"size": "300x200"}, isolines=7).pixels
    from PIL import Image

    assert (np.asarray(Image.open(path))[..., :3] != plain).any()


def test_python_says_the_same():
    picture = app.figure(
        "hand",
        ["biharmonic", "geodesic"],
        layout={"size": "300x200"},
        look={"cmap": "safe", "flip_scalars": True, "bands": True, "clim": [0.5, None]},
    )
    assert picture.document.colours == Colours("safe", (), True, True)
    assert maxima(picture.document) == [0.5, None]
    assert (
        app.figure("hand", ["biharmonic"], layout={"size": "300x200"}, look={"clim": "shared"}).document.range
        == "shared"
    )
    own = Colours("mine", ((0.0, (0.0, 0.0, 0.0)), (1.0, (1.0, 1.0, 1.0))), bands=True)
    assert app.figure("hand", ["biharmonic"], layout={"size": "300x200"}, look={"cmap": own}).document.colours == own
