"""Small versions of all experiments: their numbers, and what a drawing program can rely on."""

import csv
from pathlib import Path

import numpy as np
import pytest

from bihdist_core import Cancelled, OutputError, ParameterError, Surface, read_surface
from bihdist_core.applications.resizing import simplified
from bihdist_core.experiments import EXPERIMENTS, Shapes, _claims_growth, fig6, fig10, table1, table2
from bihdist_core.experiments._stated_figures import AWAY, FREE
from bihdist_core.experiments.result import MARKS, statements_of
from bihdist_core.experiments.verdicts import VERDICTS, ends_of, mean_estimate, number_of

ASSETS = Path(__file__).resolve().parents[2] / "assets"

COUNTS = {"figure": 1500, "animal": 1500, "hand": 1200, "genus3": 1000, "domain": 1500, "scan": 1500}


@pytest.fixture(scope="module")
def shapes():
    """The sample meshes with a seventh of their vertices; the two poses keep the same triangles."""
    small = {}
    for name, count in COUNTS.items():
        whole = read_surface(ASSETS / f"{name}.ply")
        small[name], ids = simplified(whole, count)
        if name == "figure":
            posed = read_surface(ASSETS / "figure_pose2.ply").vertices[ids]
            small["figure_pose2"] = Surface(posed, small["figure"].faces)
    return Shapes(small)


@pytest.fixture(scope="module")
def result(shapes):
    """A function that gives the result of an experiment, computed once."""
    results = {}
    with pytest.MonkeyPatch.context() as patch:
        for module, sizes in [(table1, (500, 1000)), (table2, (500, 1000)), (_claims_growth, (500, 1000, 2000))]:
            patch.setattr(module, "QUICK_SIZES", sizes)
        patch.setattr(table1, "JUDGED", 1000)
        patch.setattr(fig6, "_counts", lambda quick: (1500, 450))

        def compute(id):
            if id not in results:
                results[id] = EXPERIMENTS[id].compute(shapes, quick=True)
            return results[id]

        yield compute


def numbers(table, column, **where):
    return np.array([v for v in table.values(column, **where) if v is not None], float)


# ------------------------------------------------------------------ what every result holds
@pytest.mark.parametrize("id", EXPERIMENTS)
def test_results_fit_together(result, id):
    r = result(id)
    assert r.id == id
    assert r.title == EXPERIMENTS[id].title
    assert len(EXPERIMENTS[id].shows) > 100
    assert r.claims
    assert r.seconds > 0
    assert r.protocol.endswith(".")
    for panel in r.panels:
        surface = r.surfaces[panel.surface]
        assert panel.field is None or panel.field.shape == (len(surface.vertices),)
        assert all(0 <= mark.vertex < len(surface.vertices) for mark in panel.marks)
        assert {mark.kind for mark in panel.marks} <= set(MARKS)
        assert set(panel.views) <= {"front", "back", "home", "home-back", "source", "zoom"}
        assert ("zoom" in panel.views) == (panel.zoom_vertex is not None)
        assert panel.style in ("surface", "height")
    for chart in r.charts:
        assert all(len(s.x) == len(s.y) > 1 for s in chart.series)
        assert all(np.isfinite(s.y).all() for s in chart.series)
    for table in r.tables:
        assert table.rows
        assert all(len(row) == len(table.columns) for row in table.rows)
        assert r.table(table.heading) is table
    for claim in r.claims:
        assert claim.id.partition("-")[0] == id
        assert claim.numbers or claim.failure
        assert "nan" not in claim.measured
        assert claim.verdict is None or claim.verdict in VERDICTS
    # Neither more nor fewer statements than the table has, each with all its parts.
    assert [claim.id for claim in r.claims] == [each.id for each in statements_of(id)]
    assert all(claim.failure or set(claim.numbers) == set(claim.statement.names) for claim in r.claims)


@pytest.mark.parametrize("id", ["fig2", "fig8", "table2"])
def test_results_are_saved(result, id, tmp_path):
    r = result(id)
    paths = r.save(tmp_path / "out")
    assert all(path.parent == tmp_path / "out" and path.stat().st_size for path in paths)
    assert len(paths) == 2 + len(r.tables) + len(r.charts)
    with np.load(tmp_path / "out" / f"{id}.npz") as arrays:
        for name, surface in r.surfaces.items():
            np.testing.assert_array_equal(arrays[f"surface {name} vertices"], surface.vertices)
        assert len([key for key in arrays if key.startswith("panel")]) == sum(p.field is not None for p in r.panels)
    with (tmp_path / "out" / f"{id}_claims.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["id"] for row in rows] == [claim.id for claim in r.claims for _ in claim.statement.parts]
    for claim in r.claims:
        for row, part in zip((row for row in rows if row["id"] == claim.id), claim.statement.parts, strict=True):
            assert (row["verdict"], row["part"], row["rule"]) == (claim.verdict or "", part.name, part.rule)
            if part.name not in claim.numbers:
                assert (row["number"], row["failure"]) == ("", claim.failure)
                continue
            numbers = claim.numbers[part.name]
            assert float(row["number"]) == number_of(numbers)
            assert (float(row["low"]), float(row["high"])) == ends_of(numbers)
    with (tmp_path / "out" / f"{id}_table1.csv").open(newline="") as file:
        assert next(tuple(row) for row in csv.reader(file)) == r.tables[0].columns


def test_a_folder_that_cannot_be_made_is_an_output_error(result, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be made"):
        result("fig8").save(tmp_path / "file" / "out")


@pytest.mark.parametrize("id", ["fig1", "fig4", "fig6", "fig8", "claims"])
def test_progress_rises_and_can_stop_the_work(shapes, id):
    said = []

    def listen(fraction, text):
        said.append(fraction)
        if len(said) > 6 or fraction > 0.4:
            raise Cancelled("enough")

    with pytest.raises(Cancelled):
        EXPERIMENTS[id].compute(shapes, True, listen)
    assert said == sorted(said)
    assert 0 <= said[0] <= said[-1] <= 1


def test_a_table_that_is_not_there_is_named(result):
    with pytest.raises(ParameterError, match=r"fig8 has no table 'speeds' but \['truncation errors'\]"):
        result("fig8").table("speeds")


# ------------------------------------------------------------------ the numbers, figure by figure
def test_fig1_biharmonic_fields(result):
    table = result("fig1").table("fields")
    assert len(table.rows) == 4
    assert (numbers(table, "maxima") >= 1).all()
    # On circles of four edges of these coarse meshes.
    assert (numbers(table, "isotropy ratio") < 2).all()


def test_fig2_extrema_kinks_and_isotropy_over_the_domain(result):
    table = result("fig2").table("fields")
    short, own = (
        numbers(table, "minima besides the source", distance=kind) + numbers(table, "maxima", distance=kind)
        for kind in ("diffusion t = 1/15", "biharmonic")
    )
    assert (short >= 2 * own).all()
    assert (own <= 5).all()
    assert numbers(table, "isotropy ratio", distance="geodesic") == pytest.approx(1, abs=1e-9)
    biharmonic = numbers(table, "isotropy ratio", distance="biharmonic")
    assert (numbers(table, "isotropy ratio", distance="diffusion t = 1") > 2 * biharmonic).all()
    # The largest jump of the gradient is one number in both tables.
    refined = result("fig2").table("kinks under refinement")
    for kind in ("geodesic", "biharmonic"):
        jump = table.value("largest jump", distance=kind)
        assert jump == refined.value("this mesh", source="pictured", distance=kind)
    assert {p.style for p in result("fig2").panels} == {"surface", "height"}


def test_fig3_holes_change_little(result):
    r = result("fig3")
    table = r.table("changes")
    for kind in ("biharmonic", "geodesic", "diffusion t = 1"):
        assert (numbers(table, "normalised mean", distance=kind) < 0.06).all()
        assert (numbers(table, "normalised mean", distance=kind) > 0).all()
    for claim, damage in zip(r.claims[:2], ("scan", "figure, punched"), strict=True):
        means = numbers(table, "normalised mean", surface=damage, distance="biharmonic")
        found = claim.numbers["mean change, biharmonic"]
        assert (*found.pictured, *found.random) == tuple(means)
        assert len(found.random) == 4
    intact, holed = (r.surfaces[name].face_areas.sum() for name in ("figure", "figure, punched"))
    # Whole faces are taken, each some thousandth of the area of this small mesh.
    assert 1 - holed / intact == pytest.approx(0.15, abs=0.003)
    assert "which take 15" in r.protocol
    over = numbers(table, "normalised mean", surface="figure, punched", distance="geodesic") / means
    found = r.claims[2].numbers["mean change, geodesic over biharmonic"]
    assert (*found.pictured, *found.random) == pytest.approx(tuple(over))
    # A hole of radius r lengthens a way past it by at most (pi - 2) r; of three paths, in 0.045 roots of the area.
    longest, _ = r.claims[3].numbers.values()
    assert len((*longest.pictured, *longest.random)) == 3
    assert all(0 < x < 0.1 for x in (*longest.pictured, *longest.random))


def test_fig4_the_minimum_of_diffusion_is_on_the_front(result):
    r = result("fig4")
    (panel,) = (p for p in r.panels if p.heading.startswith("diffusion"))
    z = r.surfaces["figure"].vertices[:, 2]
    (source,) = (m.vertex for m in panel.marks if m.kind == "source")
    lows = [m.vertex for m in panel.marks if m.kind == "minimum"]
    assert lows
    # Opposite to the source: as deep into the trunk as it is thick, some 0.2.
    assert max(z[lows]) > z[source] + 0.1
    deepest = {
        kind: numbers(r.table("fields"), "deepest of them, % of range", distance=kind, source="on the back").max(
            initial=0
        )
        for kind in ("biharmonic", "diffusion t = 1")
    }
    # The paper finds none for biharmonic distance; here there is one, much shallower than diffusion's.
    assert deepest["biharmonic"] < 2.5
    assert deepest["diffusion t = 1"] > 2 * deepest["biharmonic"]


def test_fig4_and_fig5_geodesic_circles_are_round(result):
    for id in ("fig4", "fig5"):
        table = result(id).table("fields")
        assert numbers(table, "isotropy ratio", distance="geodesic") == pytest.approx(1, abs=1e-9)
        biharmonic = numbers(table, "isotropy ratio", distance="biharmonic")
        assert (biharmonic < numbers(table, "isotropy ratio", distance="diffusion t = 1")).all()


def test_fig6_changes_grow_with_noise_and_are_small_for_poses_and_meshes(result):
    table = result("fig6").table("changes")
    cases = [f"noise of {s} %" for s in (10, 40, 100, 400)]
    for kind in ("biharmonic", "geodesic", "diffusion t = 1"):
        raw = [numbers(table, "raw mean", change=case, distance=kind).mean() for case in cases]
        assert raw == sorted(raw)
        # Noise of a tenth of an edge lengthens edges by about its square.
        assert raw[0] < 0.02
        normalised = [numbers(table, "normalised mean", change=case, distance=kind).mean() for case in cases]
        assert normalised[0] < 0.01 < normalised[3] < 0.2
        for case in ("another pose", "1,500 to 450 vertices"):
            assert numbers(table, "normalised mean", change=case, distance=kind).max() < 0.03


def test_fig6_compares_geodesic_distance_from_the_same_sources(result):
    r = result("fig6")
    row = {"change": "noise of 100 %", "source": "pictured"}
    geodesic, biharmonic = (
        r.table("changes").value("normalised mean", distance=kind, **row) for kind in ("geodesic", "biharmonic")
    )
    found = r.claims[-1].numbers["mean change, geodesic over biharmonic, noise on each coordinate"]
    assert found.pictured == (geodesic / biharmonic,)
    assert len(found.random) == 2


def test_fig7_isolines_in_the_palm_and_isotropy_on_the_finger(result):
    table = result("fig7").table("fields")
    reach = {
        kind: table.value("isolines in the palm", distance=kind, source="finger") for kind in table.values("distance")
    }
    assert reach["diffusion t = 0.125"] < reach["diffusion t = 1"] <= reach["biharmonic"]
    ratio = numbers(table, "isotropy ratio", source="finger")
    assert ratio[-1] == ratio.min()


def test_fig8_errors_fall_like_1_over_k(result):
    r = result("fig8")
    # Refused on so few vertices: those of a mean edge h resolve 1.2 area / (4 pi h^2) eigenpairs.
    assert (r.claims[0].numbers, r.claims[0].verdict) == ({}, None)
    assert "resolves 111." in r.claims[0].failure
    # Measured 0.8 % and 0.019 % on 1,500 vertices; the mesh has little to do with it.
    assert r.table("truncation errors").value("largest", K=200) == pytest.approx(0.008, rel=0.5)
    assert r.table("truncation errors").value("mean", K=200) == pytest.approx(0.00019, rel=0.3)
    for series in r.charts[0].series:
        assert len(series.x) == 200
        assert series.y[-1] < series.y[99] < series.y[9] < series.y[0]


def test_fig9_interpolants(result):
    r = result("fig9")
    table = r.table("interpolants")
    kinds = dict.fromkeys(table.values("distance"))
    ridges = {kind: table.value("edges in kinks, %", distance=kind, start="vertex 0") for kind in kinds}
    # With and without those at tips.
    by_id = {claim.id: claim for claim in r.claims}
    for id, kind in (("fig9-1", "biharmonic"), ("fig9-6", "diffusion t = 4")):
        free, at_tips = (numbers(table, c, distance=kind) for c in (FREE, "of these at tips"))
        for which, counts in ((FREE, free), (AWAY, free - at_tips)):
            judged = by_id[id].numbers[f"{which}, {kind}"]
            assert (*judged.pictured, *judged.random) == tuple(counts)
            assert len(counts) == 5
    assert ridges["geodesic"] > 1.5 * ridges["biharmonic"]
    anchors = [m.vertex for m in r.panels[0].marks if m.kind == "anchor"]
    assert len(anchors) == 4
    for panel in r.panels:
        assert panel.field[anchors] == pytest.approx(np.linspace(0, 1, 4))
        assert (panel.field.min(), panel.field.max()) == (0, 1)
    # Of starts that leave a leg without anchor, the values there are a small part of the range.
    assert (numbers(table, "leg spread, %") > 0).all()
    assert all(0 < v < 10 for v in table.values("leg spread, %", start="vertex 0"))


def test_fig10_candidates(result):
    r = result("fig10")
    table = r.table("errors")
    assert len(table.rows) == fig10.QUICK_STARTS * 2 * 3
    for row in table.rows:
        errors = dict(zip(table.columns, row, strict=True))
        assert errors["median"] <= errors["90 %"]
        # Counting the mirror image as right can only help.
        assert errors["median"] <= errors["median, mirror image wrong"]
        assert errors["90 %"] <= errors["90 %, mirror image wrong"]
        assert 0 < errors["AUC of the PCK curve to 0.25"] < 1
    # The mean of a curve is the AUC: equally many targets from each start.
    for chart, layout in zip(r.charts, fig10.LAYOUTS, strict=True):
        for series in chart.series:
            areas = numbers(table, "AUC of the PCK curve to 0.25", landmarks=layout, distance=series.name)
            assert np.trapezoid(series.y, series.x) / 0.25 == pytest.approx(areas.mean(), abs=0.005)
    # In the mean half of the candidates are within a quarter of the root of the area, about the width of the shoulders.
    means = r.table("mean errors")
    assert (numbers(means, "mean", error="median") < 0.25).all()
    assert (numbers(means, "low") <= numbers(means, "mean")).all()
    by_id = {claim.id: claim.numbers for claim in r.claims}
    for id, layout in (("fig10-1", "spread"), ("fig10-2", "clustered")):
        own, other = (numbers(table, "median", landmarks=layout, distance=kind) for kind in ("biharmonic", "geodesic"))
        found = by_id[id]["median error more than biharmonic's, geodesic"]
        assert found.count == 12
        assert found.value == pytest.approx((other - own).mean())
        assert found == mean_estimate(other - own)


@pytest.mark.parametrize(("id", "rows"), [("table1", 6), ("table2", 18)])
def test_tables_of_times(result, id, rows):
    table = result(id).table("times")
    assert len(table.rows) == rows
    assert (numbers(table, "least") > 0).all()
    assert (numbers(table, "least") <= numbers(table, "processor seconds")).all()
    assert (numbers(table, "processor seconds") <= numbers(table, "most")).all()
    assert (numbers(table, "wall seconds") > 0).all()


def test_alpha_orders_the_family(result):
    r = result("alpha")
    table = r.table("family")
    ratio = numbers(table, "upper back", measured="isotropy ratio")
    assert (np.diff(ratio) > 0).all()
    assert ratio[0] < 1.25
    # From all sources together, too.
    assert (np.diff(numbers(table, "random, median", measured="isotropy ratio")) > 0).all()
    (same, order, _) = r.claims
    assert same.verdict == "holds"
    assert order.numbers["isotropy ratio, least growth from one α to the next"].pictured[0] == pytest.approx(
        (ratio[1:] / ratio[:-1]).min()
    )


def test_claims_metric_and_smallest_distances(result):
    table = result("claims").table("metric")
    assert (numbers(table, "violations") == 0).all()
    least = {kind: table.value("smallest distance", distance=kind) for kind in table.values("distance")}
    # Neighbours on a mesh of 800 vertices are some hundredths of its size apart, and d falls like r sqrt(ln 1/r).
    assert 1e-3 < least["biharmonic"] < 0.02
    assert least["diffusion t = 1, 5 eigenpairs"] < 1e-2 * least["biharmonic"]


def test_claims_commute_time_diverges_and_is_conformally_invariant(result):
    r = result("claims")
    fine = r.table("refinement")
    n, squares = numbers(fine, "vertices"), numbers(fine, "commute-time squared")
    # The logarithmic singularity: 1 / (2 pi) per e-fold of N; coarse spheres are 2 % off.
    assert np.polyfit(np.log(n), squares, 1)[0] == pytest.approx(1 / (2 * np.pi), rel=0.04)
    # d^2 = sum_l (2l + 1) / (4 pi) (2 - 2 (-1)^l) / (l (l + 1))^2 on the unit sphere.
    odd = np.arange(1, 2001, 2)
    exact = np.sqrt(((2 * odd + 1) / np.pi / (odd * (odd + 1.0)) ** 2).sum())
    assert fine.value("biharmonic", vertices=2562) == pytest.approx(exact, rel=0.003)
    conformal = r.table("conformal")
    coarse, fine = numbers(conformal, "mean relative change", distance="commute-time")
    # Second order in the edges, which halve.
    assert fine == pytest.approx(coarse / 4, rel=0.3)
    assert fine < 0.001
    assert (numbers(conformal, "mean relative change", distance="biharmonic") > 0.1).all()


def test_claims_eigenvalues_follow_weyl(result):
    (chart,) = (c for c in result("claims").charts if c.heading == "eigenvalues")
    values, weyl = (s.y for s in chart.series)
    assert values[-1] / weyl[-1] == pytest.approx(1, abs=0.2)


def test_claims_shortcuts(result):
    table = result("claims").table("topology")
    assert {"weld 1", "thin handle 1", "thin handle 2"} <= set(table.values("change"))
    # From one end of a thin handle, the far end comes nearer by half; biharmonic distance hardly notices.
    at = {"change": "thin handle 1", "source": "at the join"}
    geodesic, biharmonic = (
        table.value("normalised largest", distance=kind, **at) for kind in ("geodesic", "biharmonic")
    )
    assert geodesic > 2 * biharmonic
    for change in set(table.values("change")):
        if change.startswith("thin handle"):
            assert (numbers(table, "normalised mean", change=change, distance="biharmonic") < 0.05).all()
    # The worst of the sources is judged.
    (claim,) = (c for c in result("claims").claims if c.id == "claims-handle")
    worst = numbers(table, "normalised largest", change="thin handle 1", distance="biharmonic").max()
    assert claim.numbers["largest change, biharmonic"].pictured == (worst,)
    assert claim.numbers["largest change, geodesic over biharmonic"].pictured[0] == pytest.approx(geodesic / worst)


def test_claims_sampling_of_fields(result):
    table = result("claims").table("sub-sampling")
    for how in ("smoothest", "piecewise linear"):
        few, many = numbers(table, "mean error", interpolant=how, distance="biharmonic")
        assert many < few < 0.01
        assert many < numbers(table, "mean error", interpolant=how, distance="geodesic")[-1]


def test_claims_two_points_that_few_eigenpairs_confuse(result):
    table = result("claims").table("two different points")
    (least,) = numbers(table, "distance over the largest", eigenpairs=2)
    # A closed surface does not fit into the plane; the images of the points are equal to rounding.
    assert least < 1e-14
    assert (numbers(table, "biharmonic over its largest") > 0.02).all()
    # Told from corner to corner of their faces.
    assert (numbers(table, "way along edges") > 0.15).all()
