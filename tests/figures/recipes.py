"""What the tests of recipes share: small figures, what a command refuses with, where anchors are."""

from app.main import main

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
    return [(document.point(anchor.point).at, anchor.value) for anchor in document.anchors]


def of_version_0_1(mesh):
    """What the first version wrote."""
    return {
        "format": 1,
        "program": "bihdist 0.1.0",
        "mesh": {"path": mesh},
        "areas": "voronoi",
        "panels": [{"distance": "diffusion", "t": 1.0, "source": 4, "maximum": None}],
        "views": ["home"],
        "zooms": [],
        "anchors": [],
        "isolines": 20,
        "shared_range": False,
        "height": 0.0,
        "hints": True,
        "columns": None,
        "size": "",
        "style": "paper",
        "transparent": False,
        "crop": False,
    }
