"""What the window calls files when it asks where to save them."""

import pytest
from qtpy import QtWidgets

from tests.qt.parts import parts
from tests.shapes import bumpy


@pytest.fixture
def suggested(monkeypatch):
    """The names that dialogs suggest; each is dismissed."""
    names = []
    monkeypatch.setattr(QtWidgets.QFileDialog, "selectFile", lambda dialog, name: names.append(name))
    monkeypatch.setattr(QtWidgets.QFileDialog, "exec", lambda dialog: 0)
    return names


def test_every_dialog_suggests_the_mesh_what_is_saved_and_of_which_distance(screen, mesh_file, suggested):
    from app.qt.files.field_files import save_isolines

    s = screen()
    s.open(mesh_file(bumpy(300)), source=12)
    window, docks = s.window, parts(s.window).docks

    def content(word):
        return docks._docks[word].content

    panel = s.document.panels[0].id
    for word in ("statistics", "scatter", "pins", "profile", "anchors"):
        docks.toggle(word)
    s.settle()
    parts(window).session_file.choose_and_save()
    parts(window).files.choose_screenshot()
    parts(window).field_files.save(panel)
    parts(window).field_files.save_all()
    save_isolines(window.context, panel)
    content("statistics").save_numbers()
    content("scatter").save_figure()
    content("pins").files.save()
    content("profile").files.save_numbers()
    content("anchors").choose_and_save()
    assert suggested == [
        "mesh-session.json",
        "mesh-window.png",
        "mesh-field-biharmonic-from-12.npy",
        "mesh-fields.npy",
        "mesh-isolines-biharmonic-from-12.csv",
        "mesh-histogram-biharmonic-from-12.csv",
        "mesh-scatter-biharmonic-geodesic.pdf",
        "mesh-pins.csv",
        "mesh-profile.csv",
        "mesh-anchors.csv",
    ]
