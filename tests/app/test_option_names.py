"""Options of all commands: no abbreviations, and hints for what is misspelt."""

import re
import shlex

import pytest

from app.document.synonyms import COLOUR_MAPS, COMMAND_HINTS, OPTION_ALIASES, OPTION_HINTS
from app.main import main
from app.scene.colour_maps import MAPS
from assets.guide.building.command_pages import commands


def refused(capsys, *words):
    """What is said of a command line that makes no sense."""
    with pytest.raises(SystemExit) as stop:
        main([*words])
    assert stop.value.code == 2
    return capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["field", "hand", "--suorces", "3", "-o", "x.npy"], "no option --suorces; did you mean --sources?"),
        # Before what is missing because of it.
        (["field", "hand", "--out", "x.npy"], "no option --out; did you mean --output?"),
        (["figure", "hand", "--width", "3"], "no option --width; did you mean --size 160mm?"),
        (["figure", "hand", "--dpi=300"], "no option --dpi; did you mean --size 160mm@300dpi?"),
        (["figure", "hand", "--vmax", "1"], "no option --vmax; did you mean --clim 0.8?"),
        (["page", "hand", "--range", "0,1"], "no option --range; did you mean --clim 0.8?"),
        (["isolines", "hand", "--levels", "5"], "no option --levels; did you mean --isoline-values 0.1,0.2?"),
        (["figure", "hand", "--figsize", "4,3"], "no option --figsize; did you mean --size 160x80mm?"),
        (["figure", "hand", "--show_edges"], "no option --show_edges; did you mean --show-edges?"),
        (["figure", "hand", "--screenshot", "a.png"], "no option --screenshot; did you mean --output?"),
        (["figure", "hand", "--cmpa", "safe"], "no option --cmpa; did you mean --cmap?"),
        # What the command does not have, and what is like nothing, has no hint.
        (["pairs", "hand", "--cmap", "safe"], "no option --cmap."),
        (["pairs", "hand", "--dpi", "300"], "no option --dpi."),
        (["figure", "hand", "--frobnicate"], "no option --frobnicate."),
        (["figure", "hand", "--bad"], "no option --bad."),
        (["batch", "hand", "-o", "x", "--worker=3"], "no option --worker; did you mean --workers?"),
        (["figure", "hand", "--isoline", "3", "-o", "x.png"], "no option --isoline; did you mean --isolines?"),
        (["info", "hand", "-q"], "no option -q"),
    ],
)
def test_an_unknown_option_is_a_sentence_with_what_is_meant(capsys, words, said):
    told = refused(capsys, *words)
    assert told.startswith(f"bihdist: there is {said}")
    assert told.endswith(f" See `bihdist {words[0]} --help`.\n")
    assert told.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["field", "hand", "--sources", "12", "40", "-o", "x.npy"], "between them; write --sources 12,40."),
        (["field", "hand", "--sources=12", "40", "7", "-o", "x.npy"], "between them; write --sources 12,40,7."),
        (
            ["figure", "hand", "--distance", "biharmonic", "geodesic"],
            "--distance takes several with commas between them; write --distance biharmonic,geodesic.",
        ),
        (
            ["figure", "hand", "--distance", "biharmonic", "-", "geodesic"],
            "--distance takes one word; write --distance 'biharmonic - geodesic'.",
        ),
        (
            ["field", "hand", "--distance", "biharmonic", "geodesic", "-o", "x.npy"],
            "--distance takes one value, and geodesic is left over.",
        ),
        (["profile", "hand", "hare", "beast"], "unrecognized arguments: hare beast."),
        (["figure", "hand", "--isolines", "0.1,0.2"], "--isolines: '0.1,0.2' is not a number of isolines; for lines"),
        (["figure", "hand", "--isolines", "0.1,0.2"], "write --isoline-values 0.1,0.2."),
        (["samples", "hand"], "the following arguments are required: --sources."),
    ],
)
def test_words_that_are_left_over_and_bad_values_are_a_sentence(capsys, words, said):
    told = refused(capsys, *words)
    assert said in told
    assert told.startswith("bihdist: ")
    assert told.count("\n") == 1


def test_other_names_are_taken_for_options(tmp_path):
    for name in ("--source", "--sources"):
        assert main(["samples", "hand", name, "farthest:3", "-o", str(tmp_path / f"{name}.txt")]) == 0
    assert (tmp_path / "--source.txt").read_text() == (tmp_path / "--sources.txt").read_text()
    figure = commands()["figure"]
    for name in ("--cmap", "--colors", "--colormap", "--cmap", "--colourmap", "--color-map"):
        assert figure.parse_args(["hand", name, "safe"]).cmap == "safe"
        assert figure.parse_args(["hand", f"{name}=safe"]).cmap == "safe"


def test_an_option_is_not_given_by_two_names(capsys):
    assert "--cmap is given twice" in refused(capsys, "figure", "hand", "--cmap", "safe", "--cmap", "ember")


def test_each_name_leads_to_one_that_there_is():
    known = {name.lstrip("-") for parser in commands().values() for name in parser._option_string_actions}
    for name, hint in (OPTION_ALIASES | OPTION_HINTS).items():
        assert hint.split()[0] in known, name
    assert not OPTION_ALIASES.keys() & (known | OPTION_HINTS.keys())
    assert set(COMMAND_HINTS.values()) <= commands().keys()
    assert not COMMAND_HINTS.keys() & commands().keys()
    assert set(COLOUR_MAPS.values()) <= MAPS.keys()
    assert not COLOUR_MAPS.keys() & MAPS.keys()


@pytest.mark.parametrize("words", [["--dist", "geodesic"], ["--areas", "voronoi", "--are", "barycentric"]])
def test_options_are_not_abbreviated(capsys, words):
    assert "there is no option" in refused(capsys, "field", "hand", *words, "-o", "x.npy")


def test_options_before_the_command_and_more_words_than_it_takes(capsys):
    assert "no option --versio; did you mean --version?" in refused(capsys, "--versio")
    assert "See `bihdist view --help`." in refused(capsys, "view", "hand", "hand", "hand")


def test_an_option_is_given_once(capsys):
    words = ["--distance", "biharmonic", "--distance=geodesic"]
    assert "--distance is given twice" in refused(capsys, "figure", "hand", *words, "-o", "x.png")
    assert "--output is given twice" in refused(capsys, "field", "hand", "-o", "x.npy", "--output", "y.npy")


def test_one_name_means_one_thing():
    """The same metavar and the same choices wherever an option is, but for what its files are."""
    known = {}
    for word, parser in commands().items():
        for action in parser._actions:
            for name in action.option_strings:
                known.setdefault(name, {}).setdefault((action.metavar, tuple(action.choices or ())), []).append(word)
    differing = {name: kinds for name, kinds in known.items() if len(kinds) > 1}
    known_ones = {"--anchors", "--pins", "--distance", "--method", "--output", "--clim", "--layout", "-o"}
    assert set(differing) == known_ones, differing


def test_every_option_is_explained():
    for word, parser in commands().items():
        for action in parser._actions:
            assert action.help, (word, action.option_strings)


def test_commands_are_under_headings_with_examples_that_parse(capsys):
    from app.main import COMMANDS, HEADINGS

    with pytest.raises(SystemExit):
        main(["--help"])
    shown = capsys.readouterr().out
    for title, words in HEADINGS.items():
        section = shown.split(f"\n{title}:\n")[1].split("\n\n")[0]
        assert re.findall(r"^  (\S+)", section, re.MULTILINE) == list(words)
    for word, parser in commands().items():
        assert COMMANDS[word].EXAMPLES
        for line in COMMANDS[word].EXAMPLES:
            name, *rest = shlex.split(line)[1:]
            parser.parse_args(rest if name == word else [name, *rest])  # what cannot be parsed exits
            assert f"  {line}\n" in parser.format_help()


def test_the_usage_names_what_is_required_only():
    assert commands()["samples"].usage == "bihdist samples --sources SOURCES MESH [options]"
