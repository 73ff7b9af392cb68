"""Signatures of vertices, against the sums over all eigenpairs that they stand for."""

import numpy as np
import pytest

from app.samples import mesh_path
from bihdist_core import (
    BiharmonicDistance,
    DiffusionDistance,
    Laplacian,
    ParameterError,
    SolverError,
    Surface,
    biharmonic_kernel_signature,
    centrality,
    heat_kernel_signature,
    read_surface,
    wave_kernel_signature,
)
from bihdist_core.analysis.signature_types import SIGNATURES, SignatureSpec
from bihdist_core.errors import BihdistError
from tests.dense_reference import full_spectrum
from tests.programs import ROOT
from tests.shapes import bumpy, grid, torus, two_pieces

EXACT = 1e-9
"""Of the maximum: what the dense spectrum, and what the solver leave of the digits."""


def largest(found, wanted):
    return np.abs(found - wanted).max() / np.abs(wanted).max()


def sums(surface, weights):
    """(n,) sum_k w_k phi_k^2 over all eigenpairs but the constant; weights(lambda / lambda_1)."""
    values, vectors = full_spectrum(surface)
    return vectors**2 @ weights(values / values[0], values)


SHAPES = {"closed": lambda: bumpy(200), "open": lambda: grid(14, 11), "handle": torus}


@pytest.fixture(params=SHAPES, scope="module")
def surface(request):
    return SHAPES[request.param]()


def test_the_biharmonic_kernel_signature_is_the_sum_over_all_eigenpairs(surface):
    found = biharmonic_kernel_signature(surface)
    assert largest(found.values, sums(surface, lambda ratio, value: value**-2)) < min(EXACT, found.accuracy)


def test_centrality_is_the_mean_of_squared_distances(surface):
    laplacian = Laplacian(surface)
    found, areas = centrality(laplacian), laplacian.areas
    some = np.arange(0, len(areas), 7)
    fields = BiharmonicDistance(laplacian).from_sources(some)
    assert largest(found.values[some], areas @ fields**2 / areas.sum()) < min(EXACT, found.accuracy)


@pytest.mark.parametrize("t", [1e-6, 1 / 15, 1 / 4, 1, 4, 700])
def test_the_heat_kernel_signature_is_the_sum_over_all_eigenpairs(surface, t):
    found = heat_kernel_signature(surface, t)
    wanted = sums(surface, lambda ratio, value: np.exp(-t * ratio)) + 1 / Laplacian(surface).areas.sum()
    assert largest(found.values, wanted) < found.accuracy < 1e-7


@pytest.mark.parametrize(("energy", "sigma"), [(1, 0.4), (10, 0.4), (10, 0.1), (10, 1), (50, 0.4)])
def test_the_wave_kernel_signature_is_the_sum_over_all_eigenpairs(surface, energy, sigma):
    values, vectors = full_spectrum(surface)
    weights = np.exp(-(np.log(values / values[0] / energy) ** 2) / (2 * sigma**2))
    found = wave_kernel_signature(surface, energy, sigma)
    assert largest(found.values, vectors**2 @ weights / weights.sum()) < found.accuracy < 1e-3


def test_each_component_has_its_own():
    both = two_pieces()
    for spec in map(SignatureSpec.of, SIGNATURES):
        make, values = spec.load(), dict(spec.values)
        found = make(both, **values)
        for index in range(both.n_components):
            piece, ids = both.component(index)
            assert largest(found.values[ids], make(piece, **values).values) < 1e-6


def test_they_scale_as_they_say_and_do_not_change_with_pose_or_numbering(surface):
    rng = np.random.default_rng(0)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    order = rng.permutation(len(surface.vertices))
    moved = Surface((3 * surface.vertices @ turn)[order], np.argsort(order)[surface.faces])
    for word in SIGNATURES:
        make = SignatureSpec.of(word).load()
        found, other = make(surface), make(moved)
        # By rounding of the vertices, and the accuracy of waves.
        assert largest(other.values, 3**found.length_power * found.values[order]) < 1e-6
        assert f"mesh units^{abs(found.length_power):g}" in found.unit


def test_a_matrix_has_signatures_too():
    surface = bumpy(8)
    laplacian = Laplacian(surface)
    given = Laplacian.from_matrices(laplacian.stiffness, laplacian.areas)
    for word in SIGNATURES:
        make = SignatureSpec.of(word).load()
        assert largest(make(given).values, make(laplacian).values) < 1e-6
        assert make(given).unit == "the unit of the matrices"


def test_poles_are_shared_and_their_factors_freed():
    laplacian = Laplacian(bumpy(8))
    resolvents = laplacian.components[0].resolvents
    heat_kernel_signature(laplacian, 0.05)
    kept, sets = resolvents.nbytes, resolvents.sets
    DiffusionDistance(laplacian, 0.05)
    assert resolvents.sets == sets
    wave_kernel_signature(laplacian)
    # Of the poles of waves the diagonals alone are kept.
    poles = len(resolvents.sets[-1])
    assert kept < resolvents.nbytes <= kept + poles * 16 * len(laplacian.areas)


def test_what_is_left_of_a_vertex_without_faces_is_nothing():
    surface = bumpy(4)
    more = Surface(np.vstack([surface.vertices, [[9, 9, 9]]]), surface.faces)
    assert np.isnan(centrality(more).values[-1])
    assert np.isfinite(centrality(more).values[:-1]).all()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: heat_kernel_signature(s, 0), "diffusion time t is 0"),
        (lambda s: heat_kernel_signature(s, 701), "at most 700"),
        (lambda s: wave_kernel_signature(s, energy=0), "energy is 0"),
        (lambda s: wave_kernel_signature(s, sigma=2), "sigma is 2"),
        (lambda s: SignatureSpec.of("gks"), "no signature 'gks'; choose one of centrality, bks, hks, wks"),
        (lambda s: SignatureSpec.parse("hks(energy=2)"), "hks has no parameter 'energy'"),
        (lambda s: wave_kernel_signature(s, energy=1e9), "may be off by more than 1e-03"),
    ],
)
def test_what_there_is_not_is_refused(call, message):
    with pytest.raises(BihdistError, match=message) as raised:
        call(bumpy(4))
    assert isinstance(raised.value, ParameterError | SolverError)


@pytest.mark.parametrize("row", SIGNATURES.values(), ids=lambda row: row.word)
def test_each_is_in_the_guide_with_its_parameters(row):
    names = ", ".join(p.name for p in row.parameters)
    word = f"`{row.word}({names})`" if names else f"`{row.word}`"
    text = (ROOT / "assets/guide/reference/distances.md").read_text(encoding="utf-8")
    assert f"| {word} | {row.name} | {row.squares} | {row.scaling} |" in text


def test_the_hand_s_tips_are_least_central():
    hand = read_surface(mesh_path("hand"))
    values = centrality(hand).values
    # The middle finger's tip, and the palm.
    assert hand.vertices[values.argmax(), 1] > 0.9 * hand.vertices[:, 1].max()
    assert values.min() < values.max() / 3
