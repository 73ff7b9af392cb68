"""A session with all instruments open is the same window in another process."""

import json
from dataclasses import replace

import numpy as np
from PIL import Image
from qtpy import QtCore

from app.document.edits import move_source
from app.document.form import document_data
from app.document.shared_parts.pins import Pins, add_pins, change_pin
from app.document.shared_parts.selections import select
from app.tools.pins.part import PinsListing
from app.tools.profile.part import Profile
from app.tools.regions.part import show_regions
from app.tools.scatter.part import Scatter
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import Curve, SourceSet, SurfacePoint
from tests.programs import run_python
from tests.qt.parts import parts
from tests.shapes import bumpy

DOCKS = ("statistics", "pins", "quality", "regions", "scatter", "profile")
SIZE = (1500, 950)


def everything(s):
    """Pins, a profile, a scatter with selections, regions, extrema, a source of several parts, docks here and there."""
    surface, document = s.session.mesh().surface, s.document
    along = [SurfacePoint(face, (0.2, 0.3, 0.5)) for face in (0, *_neighbours(surface.faces, 0))]
    document = move_source(document, 0, SourceSet((5, SurfacePoint(40, (0.2, 0.5, 0.3)), Curve(tuple(along)))))
    document = add_pins(document, [7, 90, 200, 300])
    document = change_pin(document, replace(document[Pins].pins[1], name="tip", colour=6))
    document = select(select(document, "ear", np.arange(30)), "tail", np.arange(100, 160))
    document = show_regions(document, 1)
    points = tuple(pin.point for pin in document[Pins].pins)
    document = (
        replace(document, extrema=True)
        .with_part(Profile((points[2], points[0], points[3]), "edges", shares=False))
        .with_part(Scatter(across=document.panels[2].id, up=document.panels[0].id))
        .with_part(PinsListing(Spec.of("geodesic", method="dijkstra"), shares=True))
    )
    s.session.show(document)
    for dock in DOCKS:
        parts(s.window).docks.toggle(dock)
    docks = parts(s.window).docks._docks
    # As by hand: one on the other side, one in a tab of another, and other sizes.
    s.window.addDockWidget(QtCore.Qt.LeftDockWidgetArea, docks["quality"])
    s.window.tabifyDockWidget(docks["pins"], docks["regions"])
    docks["pins"].raise_()
    s.settle(0.2)
    s.window.resizeDocks([docks["quality"]], [350], QtCore.Qt.Horizontal)
    s.window.resizeDocks([docks["profile"]], [300], QtCore.Qt.Vertical)


def _neighbours(faces, face):
    """One that shares an edge."""
    shared = np.isin(faces, faces[face]).sum(axis=1)
    return [int(np.flatnonzero(shared == 2)[0])]


def rested(s):
    s.until(lambda: s.session.is_complete)
    s.until(lambda: parts(s.window).quality.is_complete and parts(s.window).regions.dividing.is_complete)
    s.settle(1.0)
    s.until(lambda: s.session.is_complete)


def test_all_instruments_open_are_the_same_in_another_process(screen, mesh_file, tmp_path):
    s = screen((Spec.of("biharmonic"), Spec.of("geodesic", method="dijkstra"), Spec.of("diffusion", t=1)))
    s.window.resize(*SIZE)
    s.open(mesh_file(bumpy(400)), 5)
    everything(s)
    rested(s)
    session, picture = tmp_path / "all.json", tmp_path / "other.png"
    parts(s.window).session_file.save(str(session))
    assert not parts(s.window).session_file.is_changed
    before = json.loads(json.dumps(document_data(parts(s.window).session_file.recipe().document)))
    s.window.grab().save(str(tmp_path / "one.png"))
    env = {"XDG_DATA_HOME": str(tmp_path / "data"), "WINDOW_SIZE": "{}x{}".format(*SIZE)}
    done = run_python("-m", "tests.qt.restored", session, picture, **env)
    assert done.returncode == 0, done.stderr[-2000:]
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["errors"] == []
    shown, stepped, undone = found["documents"]
    assert before["docks"] == list(DOCKS)
    assert before["dock_places"]["width"] == SIZE[0]
    for document in (shown, undone):
        assert document == before
    assert stepped != before
    one, other = (
        np.asarray(Image.open(tmp_path / name).convert("RGB")).astype(int) for name in ("one.png", "other.png")
    )
    assert one.shape == other.shape
    assert (np.abs(one - other).max(axis=2) > 40).mean() < 0.005
