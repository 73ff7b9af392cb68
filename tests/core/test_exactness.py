"""Exact means exact: dense references, the closed form on the sphere, and independent programs."""

import numpy as np
import pytest
from scipy.special import eval_legendre

from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    PowerDistance,
    TruncatedBiharmonicDistance,
    read_surface,
)
from tests import dense_reference as dense
from tests.shapes import ORACLE, ORACLE_NAMES, bumpy, fin, grid, needs_oracle, slivers, sphere, tetrahedron, torus

SURFACES = [bumpy(300), grid(9, 7), torus(), tetrahedron(), fin()]


def error(d, reference):
    """Largest difference as a fraction of the largest distance."""
    return np.nanmax(np.abs(d - reference)) / np.nanmax(reference)


@pytest.mark.parametrize("areas", ["voronoi", "barycentric"])
@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)
def test_biharmonic_is_the_papers_pseudo_inverse(surface, areas):
    distance, everyone = BiharmonicDistance(Laplacian(surface, areas)), np.arange(len(surface.vertices))
    reference = dense.biharmonic_pseudo_inverse(surface, areas)
    # The pseudo-inverse itself loses digits to the squared condition number.
    assert error(distance.from_sources(everyone), reference) < 1e-8
    assert error(distance.pairwise(everyone), reference) < 1e-8


@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)
def test_all_eigenpairs_give_the_exact_distances(surface):
    values, vectors = dense.full_spectrum(surface)
    sources = np.array([0, 3])
    for distance, weights in [
        (BiharmonicDistance(surface), values**-2),
        (TruncatedBiharmonicDistance(surface, k=len(values)), values**-2),
        (CommuteTimeDistance(surface), 1 / values),
        (PowerDistance(surface, alpha=1.25), values**-1.25),
        (DiffusionDistance(surface, t=0.3), np.exp(-0.3 * values / values[0])),
    ]:
        reference = dense.spectral(weights, vectors, sources)
        assert error(distance.from_sources(sources), reference) < 1e-7, distance.label


def test_commute_time_is_the_papers_pseudo_inverse():
    s = bumpy(300)
    assert error(CommuteTimeDistance(s).from_sources(np.arange(300)), dense.commute_time_pseudo_inverse(s)) < 1e-10


def test_pairs_keep_their_digits_on_slivers():
    """Neighbours across a thin face, where differences of large numbers would lose them."""
    s = slivers()
    distance = BiharmonicDistance(s)
    field = distance.from_source(1)
    for v in (0, 2, 16, 17):
        reference = dense.biharmonic_rational(s, 1, v)  # a dense eigh keeps 5 digits here, a pseudo-inverse none
        assert distance.between(1, v) == pytest.approx(reference, rel=1e-9)
        assert field[v] == pytest.approx(reference, rel=1e-8)


def test_large_sets_of_pairs_equal_small_ones():
    distance = BiharmonicDistance(bumpy(300))
    many = distance.pairwise(np.arange(100))  # one product of matrices
    few = distance.pairwise(np.arange(20))  # differences
    assert error(many[:20, :20], few) < 1e-9


def sphere_closed_form(cosine):
    """d^2 = sum (2l+1)/(2 pi) (1 - P_l(cos)) / (l (l+1))^2 on the unit sphere."""
    degree = np.arange(1, 4000)
    weight = (2 * degree + 1) / (2 * np.pi * (degree * (degree + 1.0)) ** 2)
    legendre = np.array([(weight * (1 - eval_legendre(degree, c))).sum() for c in cosine])
    return np.sqrt(legendre)


def test_converges_to_the_closed_form_on_the_sphere():
    errors = []
    for n in (250, 1000, 4000):
        s = sphere(n)
        source = 0
        some = np.argsort(s.vertices @ s.vertices[source])[:: n // 50]
        expected = sphere_closed_form(np.clip(s.vertices[some] @ s.vertices[source], -1, 1))
        errors.append(np.abs(BiharmonicDistance(s).from_source(source)[some] - expected).max() / expected.max())
    assert errors[0] > 2.5 * errors[1] > 6 * errors[2]  # about first order in 1/n
    assert errors[2] < 5e-3


@needs_oracle
@pytest.mark.parametrize("name", ORACLE_NAMES)
class TestAgainstIndependentPrograms:
    """The references' convention: barycentric areas (see the shared folder's README)."""

    @pytest.fixture
    def case(self, name):
        surface = read_surface(ORACLE / f"{name}.off")
        sources = np.loadtxt(ORACLE / f"{name}_sources0.txt", dtype=int)
        return Laplacian(surface, "barycentric"), sources, lambda what: np.load(ORACLE / f"{name}_{what}.npy")

    def test_biharmonic(self, case):
        laplacian, sources, oracle = case
        distance = BiharmonicDistance(laplacian)
        fields = distance.from_sources(sources)
        assert error(fields, oracle("rustamov_exact")) < 1e-7
        assert error(distance.pairwise(sources), oracle("poisson_pairs")) < 1e-11
        assert error(fields, dense.biharmonic_inverse(laplacian.surface, "barycentric")[:, sources]) < 1e-9
        if len(laplacian.surface.vertices) < 1000:  # the others have passed too, in a minute
            values, vectors = dense.full_spectrum(laplacian.surface, "barycentric")
            assert error(fields, dense.spectral(values**-2, vectors, sources)) < 1e-9

    def test_commute_time_truncated_and_diffusion(self, case):
        laplacian, sources, oracle = case
        assert error(CommuteTimeDistance(laplacian).from_sources(sources), oracle("commute_full_eigh")) < 1e-6
        for k in (10, 60, 200):
            truncated = TruncatedBiharmonicDistance(laplacian, k=k)
            assert error(truncated.from_sources(sources), oracle(f"gptoolbox_p2_k{k}")) < 1e-6
        diffusion = DiffusionDistance(laplacian, t=2)
        assert error(diffusion.from_sources(sources), oracle("diffusion_t_1_over_lam1_full_eigh")) < 1e-6

    def test_geodesic(self, case):
        laplacian, sources, oracle = case
        found = GeodesicDistance(laplacian, "exact").from_sources(sources)
        assert error(found, oracle("exactgeo_pygeodesic")) < 1e-12  # some hundred roundings along a path
        assert (found <= oracle("exactgeo_igl") + 1e-12 * found.max()).all()  # libigl is up to 1e-9 too long
        assert error(GeodesicDistance(laplacian, "dijkstra").from_sources(sources), oracle("dijkstra_scipy")) < 1e-12
        heat = GeodesicDistance(laplacian, "heat").from_sources(sources)
        exact = oracle("exactgeo_igl")
        # The heat method's own error on coarse meshes, with longer flows among thin faces.
        assert np.abs(heat - exact).mean() / exact.max() < 0.035


@needs_oracle
def test_every_pair_of_a_mesh_with_boundary():
    s = read_surface(ORACLE / "hand_lowres_boundary.off")
    oracle = np.load(ORACLE / "hand_lowres_boundary_rustamov_exact_allpairs.npy")
    distance = BiharmonicDistance(Laplacian(s, "barycentric"))
    assert error(distance.from_sources(np.arange(len(s.vertices))), oracle) < 1e-7
