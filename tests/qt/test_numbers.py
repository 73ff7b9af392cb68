"""What the docks say is what the command line writes: for each instrument, on a mesh of several pieces."""

import numpy as np
import pytest

from app.document.edits import show_dock
from app.document.shared_parts.pins import add_pins
from app.tools.regions.part import show_regions
from bihdist_core import SurfacePoint, field_quality, field_statistics, read_surface
from bihdist_core.distances.distance_types import Spec
from tests.qt.parts import parts
from tests.shapes import MESHES, needs_meshes

EXACT = 1e-9
"""Of the maximum; what a dock writes with four digits is compared as it is written."""

SHOWN = ("biharmonic", "diffusion", "geodesic(method=dijkstra)")
SOURCE = 200


@pytest.fixture
def written(tmp_path, capsys):
    """Runs a command on the mesh and gives the array that it wrote."""
    from app.main import main

    def run(command, *words, name="out.npy"):
        main([command, str(MESHES / "suzanne.obj"), *map(str, words), "-o", str(tmp_path / name)])
        capsys.readouterr()
        return np.load(tmp_path / name)

    return run


@pytest.fixture
def loaded(shared_screen):
    specs = [Spec.of("biharmonic"), Spec.of("diffusion"), Spec.of("geodesic", method="dijkstra")]
    return shared_screen(MESHES / "suzanne.obj", specs, SOURCE)


def dock(s, word):
    s.session.show(show_dock(s.document, word))
    s.settle(0.05)
    return parts(s.window).docks._docks[word].content


def fields(written):
    return [written("field", "--sources", SOURCE, "--distance", spec).ravel() for spec in SHOWN]


@needs_meshes
def test_pins_and_their_distances(loaded, written):
    s, pins = loaded, dock(loaded, "pins")
    surface = s.session.mesh().surface
    other = int(np.flatnonzero(surface.component_of_vertex == 1)[0])
    face = int(np.flatnonzero((surface.faces == 400).any(axis=1))[0])
    at = [77, 300, other, SOURCE, SurfacePoint.of(face, 0.2, 0.3)]
    s.session.show(add_pins(s.document, at))
    specs = [panel.shows.spec for panel in s.document.panels]
    s.until(lambda: all(pins.distances.known(spec) is not None for spec in specs))
    pins.copy_list()
    from qtpy.QtWidgets import QApplication

    rows = [line.split("\t") for line in QApplication.clipboard().text().splitlines()[1:]]
    corners = surface.faces[face]
    for k, field in enumerate(fields(written)):
        expected = np.append(field[at[:4]], [0.2, 0.3, 0.5] @ field[corners])
        for row, value in zip(rows, expected, strict=True):
            value_said, share_said = row[6 + 2 * k : 8 + 2 * k]
            if np.isnan(value):
                assert value_said == share_said == ""
            else:
                assert float(value_said) == pytest.approx(value, abs=EXACT * np.nanmax(field))
                assert float(share_said) == pytest.approx(value / np.nanmax(field), abs=EXACT)
        matrix = written("pairs", "--sources", ",".join(map(str, at[:4])), "--distance", SHOWN[k])
        assert np.array_equal(np.isnan(matrix), np.isnan(pins.distances.known(specs[k])[:4, :4]))
        assert np.nanmax(np.abs(matrix - pins.distances.known(specs[k])[:4, :4])) <= EXACT * np.nanmax(field)
        place = written("field", "--sources", f"f{face}:0.2,0.3", "--distance", SHOWN[k]).ravel()[at[:4]]
        assert np.array_equal(np.isnan(place), np.isnan(pins.distances.known(specs[k])[4, :4]))
        assert np.nanmax(np.abs(place - pins.distances.known(specs[k])[4, :4])) <= EXACT * np.nanmax(field)


def labels_of(path, count):
    """The field that a file in PLY has beside its (count) vertices."""
    _, body = path.read_bytes().split(b"end_header\n", 1)
    return np.frombuffer(body, "<f8", 4 * count).reshape(count, 4)[:, 3]


def numbers_of(path):
    """All in a .csv file with a header."""
    return np.genfromtxt(path, delimiter=",", skip_header=1)


@needs_meshes
def test_regions_and_farthest_points(loaded, written, tmp_path):
    s, regions = loaded, dock(loaded, "regions")
    surface = s.session.mesh().surface
    other = int(np.flatnonzero(surface.component_of_vertex == 1)[0])
    at = [77, 300, 400, other]
    s.session.show(add_pins(s.document, at))
    for panel in s.document.panels:
        s.session.show(show_regions(s.document, panel.id))
    s.until(lambda: parts(s.window).regions.dividing.is_complete)
    for panel, spec in zip(s.document.panels, SHOWN, strict=True):
        cut, lines = tmp_path / "cut.ply", tmp_path / "lines.csv"
        words = ("--sources", ",".join(map(str, at)), "--distance", spec, "--region-mesh", cut, "--boundaries", lines)
        labels = written("regions", *words, name=f"{panel.id}.npy")
        found = parts(s.window).regions.dividing.divided(panel.id).regions
        assert np.array_equal(np.where(found.labels < 0, np.nan, found.labels + 1), labels, equal_nan=True)
        mesh = read_surface(cut)
        assert found.areas.sum() == pytest.approx(mesh.face_areas.sum(), rel=EXACT)
        of_face = labels_of(cut, len(mesh.vertices))[mesh.faces[:, 0]].astype(int)
        areas = np.bincount(of_face, mesh.face_areas, minlength=5)[1:]
        for unit, whole in (("area", 1), ("share", surface.face_areas.sum())):
            regions.unit.buttons[unit].click()
            copied = [float(line.split("\t")[1 + panel.id]) for line in regions.text().splitlines()[1:]]
            assert copied == pytest.approx(areas / whole, rel=EXACT)
        my_cut, my_lines = tmp_path / "mine.ply", tmp_path / "mine.csv"
        regions.save(panel.id, "mesh", str(my_cut))
        regions.save(panel.id, "boundaries", str(my_lines))
        mine = read_surface(my_cut)
        assert np.array_equal(mine.faces, mesh.faces)
        assert mine.vertices == pytest.approx(mesh.vertices, abs=EXACT)
        assert np.array_equal(labels_of(my_cut, len(mine.vertices)), labels_of(cut, len(mesh.vertices)), equal_nan=True)
        # Columns of several sources and of one are solved by other kernels on some processors.
        assert numbers_of(my_lines) == pytest.approx(numbers_of(lines), abs=EXACT)
    regions.sampler.count.setValue(9)
    regions.sampler.save_to(str(tmp_path / "window.npy"))
    s.until((tmp_path / "window.npy").exists)
    assert np.array_equal(np.load(tmp_path / "window.npy"), written("samples", "--sources", f"farthest:9:{SOURCE}"))


@needs_meshes
def test_the_profile(loaded, written, tmp_path):
    s, profile = loaded, dock(loaded, "profile")
    surface = s.session.mesh().surface
    face = int(np.flatnonzero((surface.faces == 400).any(axis=1))[0])
    s.session.show(add_pins(s.document, [77, SurfacePoint.of(face, 0.2, 0.3), 300]))
    s.until(lambda: profile.path is not None and len(profile.path.knots) == 3)
    path, places = profile.path, profile.path.places
    assert path.label == "shortest geodesic, exact"  # on a surface that is not manifold, too
    for panel, field in zip(s.document.panels, fields(written), strict=True):
        expected = np.einsum("kc,kc->k", places.weights, field[places.corners])
        assert np.abs(profile.curves[panel.id].values - expected).max() <= EXACT * np.nanmax(field)
        assert np.abs(profile.curves[panel.id].shares - expected / np.nanmax(field)).max() <= EXACT
    assert np.allclose(np.einsum("kc,kcx->kx", places.weights, surface.vertices[places.corners]), path.points, 0, 1e-12)
    assert path.length == pytest.approx(np.linalg.norm(np.diff(path.points, axis=0), axis=1).sum(), rel=1e-12)


def read(text):
    """A number that is copied."""
    return {"–": np.nan, "∞": np.inf}.get(text) or float(text)


@needs_meshes
def test_statistics_scatter_and_quality(loaded, written):
    from scipy.stats import spearmanr

    from app.drawing.numbers import number, share

    s, (a, b, c) = loaded, fields(written)
    surface = s.session.mesh().surface
    statistics, scatter, quality = (dock(s, word) for word in ("statistics", "scatter", "quality"))
    s.until(lambda: statistics.facts.facts and len(scatter.facts.facts) > 3 and parts(s.window).quality.is_complete)
    s.settle(0.1)
    found = field_statistics(surface, a)
    facts = dict(fact[:2] for fact in statistics.facts.facts)
    assert facts["mean, by area"] == number(found.mean)
    assert facts["standard deviation"] == number(found.deviation)
    assert facts[f"greatest, at vertex {int(np.nanargmax(a))}"] == number(np.nanmax(a))
    quantiles = [(number(value), share(value / np.nanmax(a))) for value in found.quantiles]
    assert [fact[1:] for fact in statistics.quantiles.facts] == quantiles
    facts = dict(scatter.facts.facts)
    both = np.isfinite(a) & np.isfinite(b)
    assert facts["rank correlation"] == number(spearmanr(a[both], b[both]).statistic)
    # Circles are those of the geodesic distance that the mesh allows.
    near = written("field", "--sources", SOURCE, "--distance", "geodesic").ravel()
    table = [line.split("\t")[1:] for line in quality.text().splitlines()[1:]]
    for k, field in enumerate((a, b, c)):
        judged = field_quality(surface, field, near, SOURCE)
        assert [row[k] for row in table[:2]] == [str(len(judged.minima)), str(len(judged.maxima))]
        expected = (judged.isotropy, judged.kink, judged.kink_length)
        assert [read(row[k]) for row in table[2:5]] == pytest.approx(expected, rel=1e-6, nan_ok=True)
