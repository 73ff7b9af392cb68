"""Options of all commands: no abbreviations, hints for what is misspelt, and the table of them in CONTRIBUTING."""

from pathlib import Path

import pytest

from app.main import main
from tests.app.option_table import BEGINS, ENDS, commands, option_table

ROOT = Path(__file__).parents[2]


def refused(capsys, *words):
    """What is said of a command line that makes no sense."""
    with pytest.raises(SystemExit) as stop:
        main([*words])
    assert stop.value.code == 2
    return capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["field", "hand", "--source", "3", "-o", "x.npy"], "no option --source; did you mean --sources?"),
        # Before what is missing because of it.
        (["field", "hand", "--out", "x.npy"], "no option --out; did you mean --output?"),
        (["batch", "hand", "-o", "x", "--worker=3"], "no option --worker; did you mean --workers?"),
        (["figure", "hand", "--isoline", "3", "-o", "x.png"], "no option --isoline; did you mean --isolines?"),
        (["info", "hand", "-q"], "no option -q"),
    ],
)
def test_an_unknown_option_shows_its_command_and_the_nearest(capsys, words, said):
    told = refused(capsys, *words)
    assert f"usage: bihdist {words[0]} " in told
    assert said in told


@pytest.mark.parametrize("words", [["--dist", "geodesic"], ["--areas", "voronoi", "--are", "barycentric"]])
def test_options_are_not_abbreviated(capsys, words):
    assert "there is no option" in refused(capsys, "field", "hand", *words, "-o", "x.npy")


def test_options_before_the_command_and_more_words_than_it_takes(capsys):
    assert "no option --versio; did you mean --version?" in refused(capsys, "--versio")
    assert "usage: bihdist view" in refused(capsys, "view", "hand", "hand", "hand")


def test_an_option_is_given_once(capsys):
    words = ["--distance", "biharmonic", "--distance=geodesic"]
    assert "--distance is there twice" in refused(capsys, "figure", "hand", *words, "-o", "x.png")
    assert "--output is there twice" in refused(capsys, "field", "hand", "-o", "x.npy", "--output", "y.npy")


def test_one_name_means_one_thing():
    """The same metavar and the same choices wherever an option is, but for what its files are."""
    known = {}
    for word, parser in commands().items():
        for action in parser._actions:
            for name in action.option_strings:
                known.setdefault(name, {}).setdefault((action.metavar, tuple(action.choices or ())), []).append(word)
    differing = {name: kinds for name, kinds in known.items() if len(kinds) > 1}
    assert set(differing) == {"--anchors", "--distance", "--method", "--output", "--range", "-o"}, differing


def test_every_option_is_explained():
    for word, parser in commands().items():
        for action in parser._actions:
            assert action.help, (word, action.option_strings)


def test_contributing_has_the_table():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert BEGINS in text, "python -m tests.app.option_table writes it"
    assert text.partition(BEGINS)[2].partition(ENDS)[0] == option_table(), "python -m tests.app.option_table writes it"
