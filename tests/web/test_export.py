"""Pages by the command and from Python: what the file holds, what is said of it, and what is refused."""

import doctest
import json
import re
import shutil
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import app as bihdist
from app.document.document import comparison
from app.document.file import recipe_text
from app.document.page import Recipe
from app.document.quantities import quantity
from app.main import main
from app.web import export, page as of_page
from app.web.stored_mesh import StoredMesh
from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    Laplacian,
    OutputError,
    ParameterError,
    PointCloud,
    Surface,
    TetrahedralMesh,
)
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from tests.commands import ran, refused
from tests.core.test_tetrahedra import ball

from ..shapes import bumpy, needles, slivers, two_pieces


def scene_in(path):
    """What a page's file says that it shows."""
    text = Path(path).read_text(encoding="utf-8")
    return json.loads(re.search(r'<script type="application/json" id="scene">(.*?)</script>', text, re.S)[1])


@pytest.fixture
def in_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


# ---------------------------------------------------------------------- the command
def test_the_command_writes_a_page_and_says_what_it_holds(mesh_file, in_folder, capsys):
    mesh = mesh_file(bumpy(400))
    options = ["--sources", "7", "--pins", "3,9", "--distance", "biharmonic,biharmonic - commute-time", "--viewup", "z"]
    assert main(["page", mesh, "-o", "out.html", *options, "--cmap", "ember", "--isolines", "8"]) == 0
    size = (in_folder / "out.html").stat().st_size
    said = capsys.readouterr().out
    assert said.startswith(f"out.html: {size / 1e3:.0f} kB, opened by any browser, without a network\n")
    assert "mesh.off: 400 vertices with 24 bits of each coordinate; biharmonic, exact; biharmonic" in said
    assert re.search(r"within \d\.\de-\d\d of the maximum \(biharmonic \d\S*, commute-time \d\S*\)", said)
    scene = scene_in("out.html")
    assert scene["source"] == 7
    assert [pin["id"] for pin in scene["pins"]] == [3, 9]
    assert [panel["distance"] for panel in scene["panels"]] == ["biharmonic", "difference"]
    assert scene["isolines"]["count"] == 8
    assert scene["camera"]["up"] == pytest.approx([0, 0, 1], abs=0.9)


def test_the_page_says_who_made_it_and_the_command_how_to_embed_it(mesh_file, in_folder, capsys):
    mesh = mesh_file(bumpy(300), "a <b>.off")
    assert main(["page", mesh, "-o", "a b&c.html", "--credit", "Scan: A. Author\n"]) == 0
    code = re.search("to embed it: (.*)", capsys.readouterr().out)[1]
    assert code.startswith('<iframe src="a%20b%26c.html" title="Distances on a &lt;b&gt;.off" loading="lazy" ')
    assert scene_in("a b&c.html")["credit"] == "Scan: A. Author�"
    assert scene_in("a b&c.html")["embed"] == code.replace("a%20b%26c.html", "PAGE")
    assert f'<meta name="generator" content="bihdist {bihdist.__version__}">' in Path("a b&c.html").read_text("utf-8")
    bihdist.page(bumpy(300), "p.html", ["biharmonic"], credit="B. Author")
    assert scene_in("p.html")["credit"] == "B. Author"


def test_without_words_it_is_named_after_the_mesh_and_needs_no_eigenpairs(mesh_file, in_folder, capsys):
    assert main(["page", mesh_file(bumpy(300), "a shape.off"), "--quiet"]) == 0
    assert [panel["distance"] for panel in scene_in("a shape.html")["panels"]] == ["biharmonic", "geodesic"]


def test_its_json_has_the_differences(mesh_file, in_folder, capsys):
    facts = json.loads(ran(capsys, "page", mesh_file(bumpy(300)), "-o", "p.html", "--bits", "float32", "--json").out)
    assert facts["outputs"] == ["p.html"]
    assert (facts["precision"], facts["n_vertices"]) == ("float32", 300)
    assert facts["bytes"] == Path("p.html").stat().st_size
    assert [each["distance"] for each in facts["distances"]] == ["biharmonic", "geodesic(method=exact)"]
    assert all(0 <= each["difference"] < 1e-6 for each in facts["distances"])
    assert scene_in("p.html")["mesh"]["bits"] == "float32"


def test_eigenpairs_are_allowed_in_size_or_in_number(mesh_file, in_folder, capsys, monkeypatch):
    mesh = mesh_file(bumpy(300))
    asked = ["page", mesh, "-o", "p.html", "--distance", "truncated(k=30)"]
    for size, more in ((20_000, []), (10**6, ["--eigenpairs", "29"]), (10**6, ["--eigenpairs", "0"])):
        monkeypatch.setattr(export, "EIGENPAIR_BYTES", size)
        said = refused(capsys, *asked, *more)
        assert "truncated(k=30) needs 30 eigenpairs in the page, some 23 kB; allow them with --eigenpairs 30" in said
        assert not Path("p.html").exists()
    for more in ([], ["--eigenpairs", "30"]):
        assert main([*asked, *more]) == 0
        assert 'id="points-truncated"' in Path("p.html").read_text()
        assert scene_in("p.html")["panels"][0]["parameters"] == {"k": 30}


def offered_in(path):
    return {each["label"]: each["distance"] for each in scene_in(path)["offered"]}


def test_readers_are_offered_what_the_page_can_compute(tmp_path, monkeypatch):
    path = tmp_path / "p.html"
    exact = {"commute-time, exact": "commute_time", "geodesic, exact": "geodesic", "1/λ^1.5, exact": "power@1.5"}
    bihdist.page(bumpy(300), path, ["biharmonic", "diffusion(t=1/15)"])
    # Sliders have all times, that of the page among them.
    assert offered_in(path) == {**exact, "biharmonic, 200 eigenpairs": "truncated"}
    assert 'id="points-truncated"' in path.read_text()
    scene = scene_in(path)
    assert scene["panels"][1]["distance"] == f"diffusion@{1 / 15}"
    steps = scene["functions"]["diffusion"]["steps"]
    assert sum(step["label"] == scene["panels"][1]["label"] == "diffusion, t = 0.0666667" for step in steps) == 1
    exact["diffusion, t = 1"] = "diffusion@1.0"
    bihdist.page(bumpy(300), path, ["biharmonic"], eigenpairs=0)
    assert offered_in(path) == exact
    assert 'id="points-' not in path.read_text()
    monkeypatch.setattr(export, "EIGENPAIR_BYTES", 10_000)
    bihdist.page(bumpy(300), path, ["biharmonic"])
    assert offered_in(path) == exact
    # Faces without height have no exact geodesic distance here.
    bihdist.page(slivers(), path, ["commute-time"])
    assert "biharmonic, exact" in offered_in(path)
    assert "geodesic, exact" not in offered_in(path)


def test_a_recipe_is_taken_and_changed(mesh_file, in_folder, capsys):
    mesh = mesh_file(bumpy(300))
    document = comparison(mesh, tuple(map(quantity, ("commute-time", "biharmonic"))), (4,))
    Path("r.json").write_text(recipe_text(Recipe(replace(document, range="fraction")), "0"))
    assert main(["page", "--recipe", "r.json", "-o", "p.html", "--sources", "9"]) == 0
    scene = scene_in("p.html")
    assert scene["source"] == 9
    assert [(panel["distance"], panel["shares"]) for panel in scene["panels"]] == [
        ("commute_time", True), ("biharmonic", True),
    ]  # fmt: skip


def test_vertices_that_are_cut_out_are_not_on_the_page(mesh_file, in_folder):
    np.savetxt("mask.txt", np.arange(400) < 390, fmt="%d")
    assert main(["page", mesh_file(bumpy(400)), "--cut", "mask.txt", "-o", "p.html", "--sources", "0"]) == 0
    assert scene_in("p.html")["mesh"]["counts"]["vertices"] < 400


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--sources", "1,2"], "start from 2 sources"),
        (["--sources", "1+2"], "start from 1+2"),
        (["--distance", "biharmonic", "--method", "heat"], "--method heat is not a parameter"),
        (["--distance", "geodesic", "--method", "heat"], "is not exact"),
    ],
)
def test_what_it_cannot_do_is_a_sentence(mesh_file, in_folder, capsys, options, sentence):
    assert sentence in refused(capsys, "page", mesh_file(bumpy(200)), "-o", "p.html", *options)
    assert list(Path().glob("*.html")) == []


@pytest.mark.parametrize(("path", "words"), [("p.png", "extension '.png'"), ("nowhere/p.html", "nowhere")])
def test_a_path_that_cannot_be_is_refused_before_the_work(in_folder, capsys, path, words):
    assert words in refused(capsys, "page", "hand", "-o", path)


def test_options_of_figures_that_mean_nothing_here_are_refused(mesh_file, in_folder, capsys):
    with pytest.raises(SystemExit):
        main(["page", mesh_file(bumpy(200)), "--size", "85mm"])
    assert "no option --size" in capsys.readouterr().err


def test_a_large_mesh_is_refused_with_what_makes_it_smaller(monkeypatch, mesh_file, in_folder, capsys):
    monkeypatch.setattr(export, "MOST_VERTICES", 100)
    mesh = mesh_file(bumpy(200))
    said = refused(capsys, "page", mesh, "-o", "p.html")
    assert "has 200 vertices, and a page has up to 100; make it smaller with: " in said
    words = said.split("smaller with: bihdist ")[1].replace("100000", "90").split()
    assert main(words) == 0
    assert main(["page", "smaller.ply", "-o", "p.html"]) == 0


def test_points_and_tetrahedra_that_are_too_many_have_remedies_of_their_own(monkeypatch, in_folder, cloud):
    monkeypatch.setattr(export, "MOST_VERTICES", 100)
    monkeypatch.setattr(export, "MOST_OF_SOLIDS", 200)
    np.savetxt("scan.xyz", cloud.vertices)
    for mesh in (cloud, "scan.xyz"):
        with pytest.raises(ParameterError, match=r"300 vertices, .* up to 100; join near points with --merge"):
            bihdist.page(mesh, "p.html")
    with pytest.raises(ParameterError, match="250 vertices, and a page has up to 200; take coarser tetrahedra"):
        bihdist.page(TetrahedralMesh(*ball(250)), "p.html")


def test_a_file_that_announces_too_many_vertices_is_not_read(monkeypatch, mesh_file, in_folder, capsys):
    monkeypatch.setattr(export, "MOST_VERTICES", 100)
    mesh = mesh_file(bumpy(200))
    content = Path(mesh).read_text().splitlines()
    Path(mesh).write_text("\n".join(content[:20]))  # cut off, which reading it would say
    assert main(["page", mesh, "-o", "p.html"]) == 2
    assert "mesh.off has 200 vertices, and a page has up to 100; make it smaller" in capsys.readouterr().err
    # One that is cut on reading may be small enough.
    np.savetxt("mask.txt", np.arange(200) < 90, fmt="%d")
    assert "cut off" in refused(capsys, "page", mesh, "--cut", "mask.txt", "-o", "p.html")


def test_a_page_that_fails_leaves_what_was_there(mesh_file, in_folder, monkeypatch):
    Path("p.html").write_text("before")

    def fails(*_):
        raise OutputError("no room")

    monkeypatch.setattr(export, "page_text", fails)
    assert main(["page", mesh_file(bumpy(200)), "-o", "p.html"]) == 2
    assert Path("p.html").read_text() == "before"
    assert [path.suffix for path in Path().iterdir()].count(".html") == 1


# ---------------------------------------------------------------------- Python
def test_the_example_in_the_docstring_runs(monkeypatch):
    monkeypatch.setitem(sys.modules, "bihdist", bihdist)  # in a checkout the package has another name
    (test,) = doctest.DocTestFinder(recurse=False).find(of_page.page, "page")
    assert doctest.DocTestRunner().run(test) == (0, len(test.examples))


def test_the_function_takes_arrays_and_says_what_the_page_holds(tmp_path):
    s = bumpy(300)
    page = bihdist.page(
        (s.vertices, s.faces), tmp_path / "p.html", ["commute-time"], 5, marks={"pins": [2]}, isolines=0
    )
    assert page.labels == ("commute-time, exact",)
    scene = scene_in(tmp_path / "p.html")
    assert scene["source"] == 5
    assert scene["mesh"]["counts"] == {"vertices": 300, "faces": len(s.faces)}
    assert (scene["mesh"]["bits"], scene["mesh"]["operator"]) == (24, "")
    assert scene["mesh"]["differs"] == page.differs
    assert scene["isolines"]["count"] == 0
    assert [pin["id"] for pin in scene["pins"]] == [2]


def test_the_function_refuses_as_the_command_does(tmp_path):
    with pytest.raises(TypeError, match=r"page\(\) got an unknown key 'size' in layout"):
        bihdist.page("hand", tmp_path / "p.html", layout={"size": "85mm"})
    with pytest.raises(TypeError, match=r"page\(\) got .* 'cmap'; did you mean look=\{'cmap': …\}\?"):
        bihdist.page("hand", tmp_path / "p.html", cmap="safe")
    with pytest.raises(ParameterError, match="one of 24, float32, not '8'"):
        bihdist.page(bumpy(200), tmp_path / "p.html", ["biharmonic"], precision="8")
    with pytest.raises(ParameterError, match="eigenpairs in the page"):
        bihdist.page(bumpy(200), tmp_path / "p.html", ["truncated(k=20)"], eigenpairs=0)


def test_differences_are_those_of_the_rounded_mesh(tmp_path):
    """Of a mesh that single precision holds there are none but those of renumbering."""
    s = bumpy(300)
    single = Surface(s.vertices.astype(np.float32).astype(float), s.faces)
    assert max(bihdist.page(single, tmp_path / "p.html", precision="float32").differs.values()) < 1e-11
    page = bihdist.page(s, tmp_path / "p.html", ["biharmonic"], 0)
    step = np.ptp(s.vertices, axis=0).max() / (2**24 - 1)
    low = s.vertices.min(axis=0)
    rounded = Surface(low + step * np.rint((s.vertices - low) / step), s.faces)
    a, b = (BiharmonicDistance(each).from_source(0) for each in (s, rounded))
    assert 0 < np.abs(a - b).max() / a.max() <= page.differs["biharmonic"] * (1 + 1e-6)


def test_differences_are_about_the_largest_from_any_source_and_say_from_how_many(mesh_file, tmp_path, capsys):
    """On needles, from whose tips they are many times as large as from most vertices."""
    s = needles(bumpy(200), 1e-5, every=9)
    page = bihdist.page(s, tmp_path / "p.html", ["biharmonic", "commute-time"], 0)
    kept = StoredMesh.of(s)
    for name, make in (("biharmonic", BiharmonicDistance), ("commute-time", CommuteTimeDistance)):
        a = make(s).from_sources(kept.ids)[kept.ids]
        off = np.abs(a - make(kept.surface).from_sources(range(len(kept.ids)))).max(axis=0) / a.max(axis=0)
        assert off.max() / 1.6 < page.differs[name] <= off.max() * (1 + 1e-6)
        assert np.median(off) < page.differs[name]
    assert scene_in(tmp_path / "p.html")["mesh"]["sources"] == 8
    assert main(["page", mesh_file(s), "-o", str(tmp_path / "q.html")]) == 0
    assert "from 8 sources distances equal those on the original mesh within" in capsys.readouterr().out
    assert main(["page", mesh_file(s), "-o", str(tmp_path / "q.html"), "--json"]) == 0
    assert {each["difference_sources"] for each in json.loads(capsys.readouterr().out)["distances"]} == {8}


@pytest.fixture
def cloud():
    return PointCloud(bumpy(300).vertices, "scan.xyz")


@pytest.mark.parametrize("operator", ["intrinsic-delaunay", "tufted"])
def test_a_page_of_another_operator_measures_by_that(mesh_file, in_folder, operator):
    surface = bumpy(300)
    assert main(["page", mesh_file(surface), "--operator", operator, "-o", "p.html", "--sources", "7"]) == 0
    page = bihdist.page(surface, "q.html", ["biharmonic", "geodesic"], 7, operator=operator)
    laplacian, there = Laplacian(surface, operator=operator), page.mesh.laplacian("voronoi")
    for scene in (scene_in("p.html"), page.scene):
        assert [panel["distance"] for panel in scene["panels"]] == ["biharmonic", "geodesic"]
        assert scene["mesh"]["operator"].startswith(
            {"tufted": "Tufted cover"}.get(operator, "Intrinsic Delaunay, Voronoi areas")
        )
    source = int(np.flatnonzero(page.mesh.ids == 7)[0])
    expected = BiharmonicDistance(laplacian).from_source(7)[page.mesh.ids]
    off = np.abs(BiharmonicDistance(there).from_source(source) - expected).max() / expected.max()
    assert off <= page.differs["biharmonic"] * (1 + 1e-6) < 1e-6
    assert 0 < page.differs["geodesic(method=exact)"] < 1e-6
    # By the faces it would be another distance.
    assert np.abs(BiharmonicDistance(surface).from_source(7)[page.mesh.ids] - expected).max() > 1e-5 * expected.max()


def test_a_page_of_points_leaves_out_what_needs_faces_and_says_so(cloud, in_folder, capsys):
    np.savetxt("scan.xyz", cloud.vertices)
    said = ran(capsys, "page", "scan.xyz", "-o", "p.html", "--sources", "7")
    assert "scan.xyz: 300 points with 24 bits of each coordinate; biharmonic, exact; commute-time, exact" in said.out
    said = ran(capsys, "page", "scan.xyz", "-o", "p.html", "--distance", "biharmonic,biharmonic - geodesic")
    assert "The page leaves out 1 panel with geodesic distance: scan.xyz has no faces." in said.err
    scene = scene_in("p.html")
    assert [panel["distance"] for panel in scene["panels"]] == ["biharmonic"]
    assert (scene["mesh"]["counts"], scene["mesh"]["backs"]) == ({"points": 300}, False)
    assert [each["label"] for each in scene["offered"]] == [
        "commute-time, exact", "1/λ^1.5, exact", "diffusion, t = 1", "biharmonic, 200 eigenpairs",
    ]  # fmt: skip
    assert bihdist.page(cloud, "q.html", source=7, fields={"x": cloud.vertices[:, 0]}).labels == (
        "biharmonic, exact", "commute-time, exact", "x",
    )  # fmt: skip
    page = bihdist.page(cloud, "q.html", ["biharmonic", "diffusion(t=1/4)"], 7)
    assert 0 < max(page.differs.values()) < 1e-6
    with pytest.raises(ParameterError, match=r"scan.xyz: geodesic distance needs faces"):
        bihdist.page(cloud, "q.html", ["geodesic"])


def test_a_page_of_tetrahedra_has_the_boundary_and_units_of_a_solid(in_folder):
    solid = TetrahedralMesh(*ball(300), "ball")
    page = bihdist.page(solid, "p.html", ["biharmonic", "diffusion"], 0)
    assert page.scene["mesh"]["counts"] == {"vertices": 300, "tetrahedra": len(solid.tetrahedra)}
    assert len(page.mesh.surface.faces) == solid.shape.n_faces
    assert max(page.differs.values()) < 1e-6
    made = Distances(Laplacian(solid))
    assert [panel["unit"] for panel in page.scene["panels"]] == ["mesh units^0.5", "mesh units^-1.5"]
    units = {each["distance"]: each["unit"] for each in page.scene["offered"]}
    for name, word in (("commute_time", "commute-time"), ("power@1.5", "power"), ("truncated", "truncated")):
        assert units[name] == made.get(Spec.of(word)).unit


def test_several_components_and_all_sorts_of_distances(tmp_path):
    page = bihdist.page(two_pieces(), tmp_path / "p.html", ["biharmonic", "truncated(k=2)"], eigenpairs=2)
    assert page.eigenpairs == {"truncated": 2}
    assert all(np.isfinite(list(page.differs.values())))


def test_names_cannot_end_the_element_that_has_them(mesh_file, in_folder):
    name = "<!--<script>&.off"
    mesh = mesh_file(bumpy(200), "m.off")
    shutil.move(mesh, in_folder / name)
    assert main(["page", name, "-o", "p.html"]) == 0
    assert scene_in("p.html")["mesh"]["name"] == name
    assert "<!--<script>&" not in Path("p.html").read_text()


def test_geodesic_distance_over_faces_without_height_is_refused_and_the_others_are_not(tmp_path):
    with pytest.raises(ParameterError, match=r"slivers has faces without height, .* leave that out, remesh"):
        bihdist.page(slivers(), tmp_path / "p.html", ["biharmonic", "geodesic"])
    assert not (tmp_path / "p.html").exists()
    page = bihdist.page(slivers(), tmp_path / "p.html", ["biharmonic", "commute-time"])
    assert repr(page) == "Page(biharmonic, exact, commute-time, exact, of slivers)"
