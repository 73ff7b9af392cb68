"""The table of distances: words, canonical specs, what cannot be, and distances of somebody else's."""

import pickle

import pytest

from bihdist_core import Laplacian, ParameterError
from bihdist_core.distances.distance_types import BUILT_IN, Spec, distance_type, distance_types, limited
from tests.programs import ROOT, run_python
from tests.shapes import bumpy, needs_kernel, two_pieces

each_type = pytest.mark.parametrize("found", BUILT_IN, ids=lambda found: found.word)


@each_type
def test_each_type_makes_its_distance(found):
    spec = Spec.of(found.word, **({"k": 20} if any(p.name == "k" for p in found.parameters) else {}))
    distance = spec.build(Laplacian(bumpy(100)))
    assert distance.from_source(0)[0] == 0
    assert found.hint
    assert found.name


@each_type
def test_each_type_is_in_the_guide_with_its_parameters(found):
    names = ", ".join(p.name for p in found.parameters)
    word = f"`{found.word}({names})`" if names else f"`{found.word}`"
    row = f"| {word} | {found.name} | {found.squares} | {found.scaling} | {found.cost} |"
    assert row in (ROOT / "assets/guide/reference/distances.md").read_text(encoding="utf-8")


def test_a_spec_is_canonical_and_can_be_written_and_read():
    quarter = Spec.parse("diffusion(t=1/4)")
    assert quarter == Spec.of("diffusion", t=0.25) == Spec.parse(" diffusion ( t = 0.25 ) ")
    assert hash(quarter) == hash(Spec.of("diffusion", t=0.25))
    assert pickle.loads(pickle.dumps(quarter)) == quarter
    assert str(quarter) == "diffusion(t=1/4)"
    assert str(Spec.of("diffusion", t=1 / 15)) == "diffusion(t=1/15)"
    assert str(Spec.of("geodesic")) == "geodesic"
    assert str(Spec.of("truncated", k=50)) == "truncated(k=50)"
    assert Spec.of("truncated", k=50.0) == Spec.of("truncated", k=50)
    assert Spec.parse("power(alpha=2, k=7)").values == (("alpha", 2.0),)  # k is of old
    for value in (0.1, 1 / 3, 2.5, 1e-7, 123456.789):
        spec = Spec.of("diffusion", t=value)
        assert Spec.parse(str(spec)) == spec


def test_values_beside_a_word_hold_where_it_does_not_say_otherwise():
    assert Spec.parse("diffusion", t=4.0, k=3)["t"] == 4
    assert Spec.parse("diffusion(t=2)", t=4.0)["t"] == 2
    assert Spec.parse("truncated", t=4.0, k=3)["k"] == 3


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("euclidean", "no distance 'euclidean'; choose one of biharmonic, truncated"),
        ("diffusion(t=0)", "t must be a number above 0, not 0"),
        ("diffusion(t=a)", "t must be a number above 0, not 'a'"),
        ("diffusion(t=1/0)", "t must be a number above 0"),
        ("diffusion(k=3)", "diffusion has no parameter 'k'; it has t"),
        ("biharmonic(t=1)", "biharmonic has no parameter 't'; it has none"),
        ("diffusion(t=1", "has no closing bracket; distances are written like diffusion"),
        ("diffusion(t)", "'t' in 'diffusion(t)' is not like t=1/4"),
        ("truncated(k=2.5)", "k must be a whole number above 0, not 2.5"),
        ("truncated(k=1e400)", "k must be a whole number above 0"),
        ("power(alpha=1)", "alpha must be a number above 1"),
        ("geodesic(method=fast)", "method must be one of auto, exact, virtual-sources, heat, dijkstra, not 'fast'"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(text, words):
    with pytest.raises(ParameterError) as error:
        Spec.parse(text)
    assert words in str(error.value)


def test_other_words_for_our_distances():
    for text in ("commute", "commute_time", "Commute-Time"):
        assert Spec.parse(text) == Spec.of(text) == Spec.of("commute-time")
    for method in ("heat", "dijkstra", "exact"):
        with pytest.raises(ParameterError, match=rf"'{method}'; did you mean geodesic\(method={method}\)\?"):
            Spec.parse(method)


@pytest.mark.parametrize("value", [True, "3", None, [1], 10**400, float("nan"), float("inf")])
def test_values_of_the_wrong_kind_are_refused(value):
    with pytest.raises(ParameterError, match="k must be a whole number above 0"):
        Spec.of("truncated", k=value)


def test_on_a_surface_k_is_bounded_by_the_eigenpairs_there_are():
    surface, k = two_pieces(), distance_type("truncated").parameter("k")
    bounded = limited(k, surface)
    assert (bounded.at_most, bounded.shown) == (59, (1, 59))
    assert bounded.checked(59) == 59
    with pytest.raises(ParameterError, match="k must be a whole number above 0 and at most 59, not 60"):
        bounded.checked(60)
    assert limited(k, bumpy(3000)).shown == k.shown
    assert Spec.of("truncated").limited_to(surface) == Spec.of("truncated", k=59)
    assert Spec.of("truncated", k=5).limited_to(surface) == Spec.of("truncated", k=5)
    alpha = distance_type("power").parameter("alpha")
    assert limited(alpha, surface) is alpha


@needs_kernel
def test_a_stand_in_is_asked_of_the_distance_itself(monkeypatch):
    monkeypatch.setattr("bihdist_core.distances.distance_types.FRAME_VERTICES", 99)
    laplacian, auto = Laplacian(bumpy(100)), Spec.of("geodesic")
    assert auto.quick(auto.build(laplacian)) == Spec.of("geodesic", method="virtual-sources")
    heat = Spec.of("geodesic", method="heat")
    assert heat.quick(heat.build(laplacian)) is None


# ---------------------------------------------------------------------- somebody else's
EXAMPLE = """
import numpy as np
from bihdist_core import Distance
from bihdist_core.distances.distance_types import DistanceType, Parameter


class Straight(Distance):
    label = "straight"
    length_power = 1.0

    def __init__(self, laplacian, stretch=1.0, progress=None):
        super().__init__(laplacian)
        self.stretch = stretch

    def prepare(self, component, progress=None):
        pass

    def compute_columns(self, component, index, progress):
        x = component.surface.vertices
        return self.stretch * np.linalg.norm(x[:, None] - x[index], axis=2)


KIND = DistanceType("straight", "Straight line", "through the air", Straight, (Parameter("stretch", 1.0, "a factor"),))
"""


@pytest.fixture
def package(tmp_path):
    """An installed package with a distance, one that cannot be imported, and one that claims a word of ours."""
    (tmp_path / "straight_distance.py").write_text(EXAMPLE)
    info = tmp_path / "straight_distance-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: straight-distance\nVersion: 1.0\n")
    entries = "straight = straight_distance:KIND\nbroken = not_there:KIND\nbiharmonic = straight_distance:KIND\n"
    (info / "entry_points.txt").write_text(f"[bihdist.distances]\n{entries}")
    return tmp_path


def run(package, code):
    said = run_python("-c", f"import sys; sys.path[:0] = [{str(package)!r}]\n{code}")
    return said.returncode, said.stdout + said.stderr


@pytest.mark.skipif(not (ROOT / "app").is_dir(), reason="the program is not here")
def test_a_distance_of_somebody_else_joins(package, mesh_file, tmp_path):
    mesh, out = mesh_file(bumpy(60)), tmp_path / "d.npy"
    status, said = run(
        package,
        "from app.main import main\nraise SystemExit(main(["
        f"'field', {str(mesh)!r}, '--sources', '3', '--distance', 'straight(stretch=2)', '-o', {str(out)!r}]))",
    )
    assert status == 0, said
    assert "straight, 60 vertices" in said


def test_others_are_imported_when_asked_for_and_what_is_wrong_with_them_is_said(package):
    status, said = run(
        package,
        "from bihdist_core import ParameterError\n"
        "from bihdist_core.distances.distance_types import Spec, distance_types, distance_type\n"
        "assert list(distance_types())[-2:] == ['broken', 'straight'], list(distance_types())\n"
        "assert 'straight_distance' not in sys.modules\n"
        "assert distance_type('biharmonic').name == 'Biharmonic'\n"
        "print(Spec.parse('straight(stretch=1/2)'))\n"
        "try:\n    Spec.of('broken')\nexcept ParameterError as error:\n    print(error)\n",
    )
    assert status == 0, said
    assert "straight(stretch=1/2)" in said
    assert "The distance 'broken' of not_there:KIND cannot be loaded" in said


def test_ours_come_first():
    assert list(distance_types())[: len(BUILT_IN)] == [found.word for found in BUILT_IN]
    assert distance_type("geodesic") in BUILT_IN
