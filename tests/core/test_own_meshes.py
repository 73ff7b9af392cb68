"""Experiments on meshes of a reader."""

from pathlib import Path

import numpy as np
import pytest

from bihdist_core import SolverError, Surface
from bihdist_core.analysis.circles import small_radius
from bihdist_core.analysis.upright import axes_of
from bihdist_core.distances.geodesic import GeodesicDistance
from bihdist_core.experiments import (
    EXPERIMENTS,
    NAMES,
    Parts,
    Shapes,
    _claims_growth,
    _claims_metric,
    _claims_sampling,
    _claims_topology,
    circles,
    fig3,
    fig6,
    shapes,
)
from bihdist_core.experiments._comparison import QUICK_FIELDS
from bihdist_core.experiments.circles import shared_circles
from bihdist_core.progress import part
from tests.shapes import bumpy, grid, spike, two_pieces

ASSETS = Path(__file__).resolve().parents[2] / "assets"

ANY_MESH = [id for id, experiment in EXPERIMENTS.items() if experiment.any_mesh]


@pytest.fixture(scope="module")
def of_a_reader():
    """Pieces, an unreferenced vertex, and a surface that is no person; shared by all experiments, as on their page."""
    s = two_pieces()
    b = bumpy(500)
    own = Surface(
        np.concatenate([s.vertices + 10, b.vertices]),
        np.concatenate([s.faces, b.faces + len(s.vertices)]),
        "my mesh.obj",
    )
    return Shapes(own=own)


@pytest.mark.parametrize("id", [id for id in ANY_MESH if id not in ("table1", "table2", "claims", "fig6")])
def test_on_the_own_mesh_of_a_reader(of_a_reader, id):
    r = EXPERIMENTS[id].compute(of_a_reader, quick=True)
    assert "my mesh.obj" in r.surfaces
    assert r.claims


@pytest.mark.parametrize("id", ["claims", "fig6"])
def test_on_a_closed_mesh_of_a_reader(id, monkeypatch):
    monkeypatch.setattr(_claims_growth, "QUICK_SIZES", (300, 600))
    monkeypatch.setattr(fig6, "_counts", lambda quick: (600, 200))
    r = EXPERIMENTS[id].compute(Shapes(own=bumpy(500)), quick=True)
    assert "bumpy" in r.surfaces or id == "fig6"


def test_shapes_come_from_a_folder_or_are_given():
    bundled = Shapes.from_folder(ASSETS)
    assert all(bundled[name].name == name for name in NAMES)
    assert bundled.names("figure", "hand") == ("figure", "hand")
    own = Shapes(own=bumpy(100))
    assert own.names("figure", "hand") == ("bumpy",)
    assert own["bumpy"] is own.own
    assert len(own.sized("bumpy", 250).vertices) == 250
    assert own.sized("bumpy", 250) is own.sized("bumpy", 250)
    assert small_radius(bumpy(100)) == pytest.approx(4 * bumpy(100).mean_edge_length)


def test_a_distance_that_cannot_be_had_leaves_the_others_their_pictures():
    result = EXPERIMENTS["fig4"].compute(Shapes(own=spike(60, 1e13)), quick=True)
    panels = {panel.heading.split(",")[0]: panel for panel in result.panels}
    assert panels["geodesic"].field is not None
    for kind in ("biharmonic", "diffusion t = 1"):
        assert panels[kind].field is None
        assert "emeshing would help" in panels[kind].failure
    assert {each.part for each in result.not_done} == {"biharmonic on spike", "diffusion t = 1 on spike"}
    assert [claim.verdict for claim in result.claims] == [None] * 3
    assert all("emeshing would help" in claim.failure for claim in result.claims)
    assert result.protocol.startswith("Nothing was measured")


@pytest.fixture(scope="module")
def circled():
    """What is kept of a surface once its circles are found: they take long, and no geodesic distance on it."""
    own = Shapes(own=bumpy(300))
    shared_circles(own, "bumpy", QUICK_FIELDS)
    return own.kept


@pytest.mark.parametrize("id", ["fig4", "fig5"])
def test_a_distance_that_fails_from_the_pictured_source_leaves_the_others_their_pictures(circled, id, monkeypatch):
    def broken(self, source, progress=None):
        raise IndexError("no such edge")

    monkeypatch.setattr(GeodesicDistance, "from_source", broken)
    own = Shapes(own=bumpy(300))
    own.kept.update(circled)
    result = EXPERIMENTS[id].compute(own, quick=True)
    panels = {panel.heading.split(",")[0]: panel for panel in result.panels}
    assert panels["geodesic"].failure == "An unexpected error, IndexError: no such edge."
    assert panels["biharmonic"].field is not None
    assert panels["diffusion"].field is not None
    assert [each.part for each in result.not_done] == ["geodesic on bumpy"]
    assert [bool(claim.failure) for claim in result.claims] == [False, False, True]


REFUSED = "It cannot be had here."


@pytest.fixture
def refuse(monkeypatch):
    """A function that makes a distance of a kind fail on surfaces of a number of vertices, or on all."""

    def refused(kind, vertices=None):
        had = shapes.distance

        def distance(laplacian, wanted, progress=None):
            if wanted == kind and vertices in (None, len(laplacian.surface.vertices)):
                raise SolverError(REFUSED)
            return had(laplacian, wanted, progress)

        for module in (shapes, circles, _claims_metric, _claims_sampling, _claims_topology):
            monkeypatch.setattr(module, "distance", distance, raising=False)

    return refused


def test_fig6_judges_what_needs_no_diffusion_distance_without_it(refuse, monkeypatch):
    monkeypatch.setattr(fig6, "_counts", lambda quick: (400, 150))
    refuse("diffusion t = 1")
    result = EXPERIMENTS["fig6"].compute(Shapes(own=bumpy(400)), quick=True)
    assert "diffusion t = 1 on 400 vertices" in {each.part for each in result.not_done}
    claims = {claim.id: claim for claim in result.claims}
    assert list(claims) == [f"fig6-{k}" for k in range(1, 8)]
    for k in range(1, 6):
        claim = claims[f"fig6-{k}"]
        assert (set(claim.numbers), claim.failure) == (set(claim.statement.names), "")
        assert "geodesic" in claim.note
    assert claims["fig6-5"].text == "Biharmonic distance is insensitive to simplification from 400 to 150 vertices."
    # A mesh has one pose: that is no failure.
    assert claims["fig6-6"].failure == "There is no other pose of this mesh to compare it with."
    assert not any("pose" in each.part for each in result.not_done)
    assert "diffusion t = 1" not in result.table("mean changes").values("distance")


def test_a_change_of_fig6_that_cannot_be_measured_leaves_the_others(refuse, monkeypatch):
    monkeypatch.setattr(fig6, "_counts", lambda quick: (400, 150))
    refuse("biharmonic", 150)
    result = EXPERIMENTS["fig6"].compute(Shapes(own=bumpy(400)), quick=True)
    claims = {claim.id: claim for claim in result.claims}
    assert [claims[f"fig6-{k}"].failure for k in range(1, 6)] == [""] * 4 + [REFUSED]
    assert {each.part for each in result.not_done} == {"biharmonic on 400 to 150 vertices", "400 to 150 vertices"}


def test_joins_without_a_distance_are_judged_by_the_others(refuse):
    refuse("diffusion t = 1")
    parts = Parts()
    own = Shapes(own=bumpy(400))
    found = _claims_topology.topology(own, "bumpy", True, parts, part(None, 0, 1))
    handle, weld = found.claims
    assert set(handle.numbers) == set(handle.statement.names)
    assert (handle.verdict is None, handle.failure) == (False, "")
    assert "diffusion" not in handle.note
    assert found.panels
    # On a surface without folds there is nothing to weld, which is no failure.
    assert weld.failure == "No two parts of this surface nearly touch, so none can be joined so."
    assert not any("weld" in each.part for each in parts.not_done)


def test_a_random_join_never_stands_for_the_pictured_one(monkeypatch):
    monkeypatch.setattr(_claims_topology, "tips", lambda surface: (0, 0))
    parts = Parts()
    own = Shapes(own=bumpy(400))
    found = _claims_topology.topology(own, "bumpy", True, parts, part(None, 0, 1))
    handle, _ = found.claims
    assert not found.panels
    assert [each.part for each in parts.not_done] == ["thin handle 1"]
    for numbers in handle.numbers.values():
        assert (len(numbers.pictured), len(numbers.random)) == (0, 2)
    assert handle.failure == parts.not_done[0].reason
    assert "At the pictured join" not in handle.note


def test_pairs_that_cannot_be_found_are_noted_and_leave_the_other_edit(monkeypatch):
    def broken(*_):
        raise SolverError(REFUSED)

    monkeypatch.setattr(_claims_topology, "nearly_touching", broken)
    parts = Parts()
    handle, weld = _claims_topology.topology(Shapes(own=bumpy(400)), "bumpy", True, parts, part(None, 0, 1)).claims
    assert handle.verdict
    assert (weld.verdict, weld.failure) == (None, REFUSED)
    assert [each.part for each in parts.not_done] == ["welds"]


@pytest.mark.parametrize(("kind", "judged"), [("diffusion t = 1", (3,)), ("geodesic", (1, 2)), ("biharmonic", (1,))])
def test_fig4_judges_each_statement_from_the_distances_it_needs(circled, refuse, kind, judged):
    refuse(kind)
    own = Shapes(own=bumpy(300))
    if kind == "geodesic":
        own.kept.update(circled)
    result = EXPERIMENTS["fig4"].compute(own, quick=True)
    assert [claim.id for claim in result.claims] == [f"fig4-{k}" for k in range(1, 4)]
    for k, claim in enumerate(result.claims, 1):
        if k in judged:
            assert (set(claim.numbers), claim.failure) == (set(claim.statement.names), "")
        else:
            assert (claim.verdict, claim.failure) == (None, REFUSED)
    assert [panel.failure for panel in result.panels] == [REFUSED if each == kind else "" for each in shapes.DISTANCES]
    assert all(table.rows for table in result.tables)


def test_fig4_does_not_judge_kinks_where_there_are_none():
    # Nothing bends the geodesics of a square.
    claim = EXPERIMENTS["fig4"].compute(Shapes(own=grid(12, 12)), quick=True).claims[2]
    assert claim.verdict is None
    assert "undefined pictured" in claim.measured


def test_what_is_pictured_goes_by_the_axis_that_is_up(monkeypatch):
    def none(*_):
        raise SolverError("No circles, which take long.")

    monkeypatch.setattr(circles, "shared_circles", none)
    surface = bumpy(150)
    as_before = Shapes(own=surface)
    for up in ("-y", "x", "z"):
        # Its front and its top are where they were, in coordinates that are others.
        turned = Surface(surface.vertices @ axes_of(up).T, surface.faces, surface.name)
        by_axis = Shapes(own=turned, up=up)
        for side in ("front", "back"):
            at = [shapes.vertex_at(shapes.own, 0.4, 0.8, side) for shapes in (as_before, by_axis)]
            assert at[0] == at[1]
        assert Shapes(own=turned).vertex_at(turned, 0.4, 0.8, "back") != at[0]
    for id in ("fig1", "fig3", "fig4", "alpha"):
        one, other = (EXPERIMENTS[id].compute(shapes, quick=True) for shapes in (as_before, by_axis))
        assert [panel.marks[0] for panel in one.panels] == [panel.marks[0] for panel in other.panels], id
        if id == "fig4":
            # From sources on the back minima are looked for on the front.
            front, same = (next(iter(result.claims[0].numbers.values())) for result in (one, other))
            assert front.pictured == pytest.approx(same.pictured, abs=1e-9)
            assert front.random == pytest.approx(same.random, abs=1e-9)


def test_fig3_loses_no_statement(refuse, monkeypatch):
    refuse("diffusion t = 1")
    own = Shapes(own=bumpy(400))
    scan, punched, *beside = EXPERIMENTS["fig3"].compute(own, quick=True).claims
    assert (scan.verdict, scan.failure) == (None, "There is no scan of this mesh.")
    for claim in (punched, *beside):
        assert (set(claim.numbers), claim.failure) == (set(claim.statement.names), "")

    def broken(*_):
        raise SolverError(REFUSED)

    monkeypatch.setattr(fig3, "_with_holes", broken)
    result = EXPERIMENTS["fig3"].compute(own, quick=True)
    assert [claim.failure for claim in result.claims[:2]] == ["There is no scan of this mesh.", REFUSED]
    assert [each.part for each in result.not_done] == ["holes"]


def test_the_axioms_of_biharmonic_distance_need_no_other_one(refuse):
    refuse("diffusion t = 1")
    parts = Parts()
    found = _claims_metric.metric(Shapes(own=bumpy(300)), "bumpy", True, parts, part(None, 0, 1))
    assert [claim.verdict is None for claim in found.claims] == [False] * 3
    assert [each.part for each in parts.not_done] == ["metric axioms, diffusion t = 1"]
    assert "diffusion t = 4" in found.tables[0].values("distance")


def test_sub_sampling_is_judged_without_diffusion_distance(refuse):
    refuse("diffusion t = 1")
    parts = Parts()
    found = _claims_sampling.sampling(Shapes(own=bumpy(400)), "bumpy", True, parts, part(None, 0, 1))
    (claim,) = found.claims
    assert set(claim.numbers) == set(claim.statement.names)
    assert "diffusion t = 1" not in found.tables[0].values("distance")


def test_fig3_without_its_scan_has_the_holes():
    result = EXPERIMENTS["fig3"].compute(Shapes({"figure": bumpy(600)}), quick=True)
    assert [each.part for each in result.not_done] == ["scan"]
    assert [bool(claim.failure) for claim in result.claims] == [True, False, False, False]
    assert "'scan'" in result.claims[0].failure


@pytest.mark.parametrize(("n", "resolved"), [(5, 0), (60, 4)])
def test_fig8_judges_no_mesh_that_resolves_fewer_eigenpairs(n, resolved):
    result = EXPERIMENTS["fig8"].compute(Shapes(own=bumpy(n)), quick=True)
    (claim,) = result.claims
    assert (claim.verdict, claim.numbers) == (None, {})
    assert claim.failure.endswith(f" resolves {resolved}.")
    assert len(result.charts[0].series[0].x) == n - 1
