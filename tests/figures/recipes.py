"""What the tests of recipes share: small figures, and where anchors are."""

from app.tools.interpolation.part import Anchors

SMALL = ["--size", "300x200@96dpi"]


def anchors(document):
    return [(document.point(anchor.point).at, anchor.value) for anchor in document[Anchors].anchors]
