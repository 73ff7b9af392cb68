"""Web pages written from the window: what is shown goes into them, and what cannot is said."""

import os
from dataclasses import replace

import pytest

from app.document.camera import Camera
from app.document.document import Panel
from app.document.looks import Colours, Isolines
from app.document.quantities import quantity
from app.document.shared_parts.pins import add_pins
from app.scene.colour_maps import MAPS
from tests.web.test_export import scene_in

pytestmark = pytest.mark.usefixtures("application")


@pytest.fixture
def page_dialog(small):
    """Opens the dialog of web pages."""
    from app.qt.files.figure_actions import export_page

    return lambda: export_page(small.context)


def _show(small, document):
    small.session.show(document)
    small.until(lambda: small.session.is_complete)


def test_a_page_is_written_in_the_background_of_what_is_shown(small, out, page_dialog):
    document = small.session.document
    shown = replace(
        add_pins(document, [3, 12]),
        camera=Camera((0.0, 0, 9), (0, 0, 0), (0, 1, 0), (0.3, 0.3)),
        colours=Colours(map="ember"),
        isolines=Isolines(7),
        panels=(replace(document.panels[0], maximum=0.5), Panel(1, quantity("biharmonic - geodesic"))),
        next_id=2,
    )
    _show(small, shown)
    dialog = page_dialog()
    assert dialog.windowTitle() == "Export web page"
    assert not dialog.carried.isVisibleTo(dialog)
    dialog.precision.setCurrentIndex(dialog.precision.findData("float32"))
    dialog.export(str(out / "p.html"))
    assert not dialog.isVisible()
    assert small.chip.share.text().startswith("Web page ")
    small.until(lambda: small.said or small.refusals)
    assert (small.said, small.refusals) == (["Saved p.html"], [])
    assert os.listdir(out) == ["p.html"]
    scene = scene_in(out / "p.html")
    assert scene["source"] == 5
    assert [pin["id"] for pin in scene["pins"]] == [3, 12]
    assert scene["camera"]["position"] == [0, 0, 9]
    assert scene["isolines"]["count"] == 7
    assert scene["panels"][0]["range"] == [0, 0.5]
    assert scene["panels"][1]["of"] == ["biharmonic", "geodesic"]
    assert scene["mesh"]["bits"] == "float32"
    assert scene["colours"]["map"][0] == [round(255 * x) for x in MAPS["ember"].stops[0][1]]


def test_the_size_of_eigenpairs_is_said_before_a_page_is_written(small, out, page_dialog):
    document = small.session.document
    _show(small, replace(document, panels=(replace(document.panels[0], shows=quantity("truncated(k=20)")),)))
    dialog = page_dialog()
    assert dialog.carried.isVisibleTo(dialog)
    assert dialog.carried.text() == "20 eigenpairs in the file, about 10 kB"
    dialog.export(str(out / "p.html"))
    small.until(lambda: small.said or small.refusals)
    assert (small.said, small.refusals) == (["Saved p.html"], [])
    assert 'id="points-truncated"' in (out / "p.html").read_text(encoding="utf-8")


def test_what_a_page_cannot_show_is_said_in_its_dialog(small, out, page_dialog):
    document = small.session.document
    _show(small, replace(document, panels=(replace(document.panels[0], shows=quantity("geodesic(method=heat)")),)))
    dialog = page_dialog()
    assert "Panel 1 (geodesic(method=heat)) is not exact" in dialog.refusal.text()
    dialog.export(str(out / "p.html"))
    assert dialog.isVisible()
    assert not small.exports.running
    dialog.close()


def test_a_field_of_ones_own_goes_into_the_page(small, out, page_dialog):
    values = small.session.mesh().surface.vertices[:, 0]
    field = small.session.given.add_field("mine", values)
    document = small.session.document
    panels = (document.panels[0], Panel(1, quantity("biharmonic - mine", fields=["mine"])))
    _show(small, replace(document, panels=panels, fields=(field,), next_id=2))
    page_dialog().export(str(out / "p.html"))
    small.until(lambda: small.said or small.refusals)
    assert (small.said, small.refusals) == (["Saved p.html"], [])
    scene = scene_in(out / "p.html")
    assert scene["panels"][1]["of"] == ["biharmonic", "field mine"]
    assert scene["given"] == ["field mine"]


def test_a_page_that_is_cancelled_leaves_nothing(small, out, page_dialog):
    page_dialog().export(str(out / "p.html"))
    small.chip.stop.click()
    small.until(lambda: not small.exports.running)
    assert os.listdir(out) == []
    assert (small.said, small.refusals) == ([], [])
