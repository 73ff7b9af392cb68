"""What the tests of recipes share: small figures, what a command refuses with, where anchors are."""

from app.main import main
from app.tools.interpolation.part import Anchors

SMALL = ["--size", "300x200@96dpi"]


def refused(capsys, *arguments):
    """The one sentence a command refuses with."""
    capsys.readouterr()
    assert main([*map(str, arguments)]) == 2
    said = capsys.readouterr().err.strip()
    assert said.startswith("bihdist: ")
    assert "\n" not in said
    return said


def anchors(document):
    return [(document.point(anchor.point).at, anchor.value) for anchor in document[Anchors].anchors]
