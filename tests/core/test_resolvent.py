"""Shifted factors, and distances that are rational functions of the Laplacian, against dense inverses and spectra."""

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from bihdist_core import BiharmonicDistance, Laplacian, PowerDistance, Surface
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.diffusion import EXPONENTIAL, PoleDiffusion, next_time, served, sets_there
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import Cancelled
from bihdist_core.kernel.library import PLAIN, library
from bihdist_core.solver.shifted import ShiftedFactor
from tests.dense_reference import full_spectrum
from tests.shapes import bumpy, grid

SHIFTS = (-0.5, -40.0, 2 + 1.2j, -5 + 9j, 8 + 0.3j)
TIMES, POWERS = (1.9, 1.0, 0.3, 1 / 15, 1 / 240), (1.1, 1.5, 1.9, 2.0, 2.5, 3.0, 6.0)


@pytest.fixture(params=["compiled", "plain"])
def solver(request, monkeypatch):
    if request.param == "plain":
        monkeypatch.setenv(PLAIN, "1")
        library.cache_clear()
    yield
    library.cache_clear()


@pytest.mark.usefixtures("solver")
@pytest.mark.parametrize("surface", [bumpy(700), grid(13, 9)], ids=["bumpy", "grid"])
@pytest.mark.parametrize("shift", SHIFTS)
def test_a_shifted_factor_has_the_diagonal_columns_and_solutions_of_the_inverse(surface, shift):
    component = Laplacian(surface).components[0]
    shift *= component.spectrum(1).eigenvalues[0]
    n = len(component.areas)
    inverse = np.linalg.inv(component.stiffness.toarray() - shift * np.diag(component.areas))
    size = 1e-12 * np.abs(inverse).max()
    factor = ShiftedFactor(component.tree(), component.stiffness, component.areas, shift)
    assert np.abs(factor.diagonal - inverse.diagonal()).max() < size
    for index in ([3], [0, n - 1, 5], range(40)):
        assert np.abs(factor.columns(np.array(index)) - inverse[:, index]).max() < size
    b = np.random.default_rng(0).normal(size=(n, 5))
    for load in (b, b[:, :1], b + 1j * b[::-1]):
        assert np.abs(factor.solve(load) - inverse @ load).max() < size * np.abs(load).sum(axis=0).max()


def all_fields(distance):
    return distance.from_sources(np.arange(len(distance.surface.vertices)))


@pytest.mark.parametrize("surface", [bumpy(500), grid(13, 9)], ids=lambda s: s.name)
def test_diffusion_and_powers_are_those_of_the_whole_spectrum_to_what_they_say(surface):
    laplacian, (values, vectors) = Laplacian(surface), full_spectrum(surface)
    made = [(PoleDiffusion(laplacian, t), np.exp(-t * values / values[0])) for t in TIMES]
    made += [(PowerDistance(laplacian, alpha), values**-alpha) for alpha in POWERS]
    for distance, weights in made:
        points = vectors * np.sqrt(weights)
        expected = cdist(points, points)
        off = (np.abs(all_fields(distance) - expected) / expected.max(axis=0)).max()
        # The reference is rounded, too.
        assert off <= distance.accuracy + 1e-12, distance.label
        assert distance.accuracy < 2e-6, distance.label


def test_a_power_of_two_is_the_biharmonic_distance_and_takes_no_pole():
    laplacian = Laplacian(bumpy(500))
    power, biharmonic = PowerDistance(laplacian, 2), BiharmonicDistance(laplacian)
    assert not laplacian.components[0].resolvents.sets
    assert np.allclose(all_fields(power), all_fields(biharmonic), rtol=1e-9)


def test_poles_for_two_times_serve_those_between_and_one_more_set_is_added_at_a_time():
    laplacian = Laplacian(bumpy(500))
    component = laplacian.components[0]
    first = float(component.spectrum(1).eigenvalues[0])
    PoleDiffusion(laplacian, 1)
    assert list(sets_there(component)) == [pytest.approx(1 / first)]
    assert served(component, 0.4 / first) is None
    assert next_time(component, 0.4 / first) == pytest.approx(0.25 / first)
    assert next_time(component, 0.01 / first) == 0.01 / first
    PoleDiffusion(laplacian, 0.4)
    for t in (0.99, 0.6, 0.4, 0.3, 0.26):
        assert served(component, t / first) is not None
    assert len(sets_there(component)) == 2
    # In both directions.
    PoleDiffusion(laplacian, 1.5)
    assert sorted(sets_there(component)) == pytest.approx(np.array([0.25, 1, 4]) / first)


def test_another_time_costs_no_solve_from_the_source_that_is_shown(monkeypatch):
    laplacian = Laplacian(bumpy(500))
    PoleDiffusion(laplacian, 0.5).from_source(7)
    monkeypatch.setattr(ShiftedFactor, "columns", lambda *_: pytest.fail("it is solved"))
    assert PoleDiffusion(laplacian, 0.495).from_source(7).max() > 0


def test_what_a_cancelled_factorization_has_left_is_used_by_the_next(monkeypatch):
    laplacian, made = Laplacian(bumpy(500)), []
    component = laplacian.components[0]
    init = ShiftedFactor.__init__
    monkeypatch.setattr(
        ShiftedFactor, "__init__", lambda self, *given, **named: (made.append(given[3]), init(self, *given, **named))[0]
    )

    def stop_late(fraction, text):
        if fraction > 0.5:
            raise Cancelled

    with pytest.raises(Cancelled):
        PoleDiffusion(laplacian, 0.5, stop_late)
    assert not component.resolvents.sets
    assert 1 < len(made) <= len(EXPONENTIAL)
    PoleDiffusion(laplacian, 0.5)
    assert len(set(made)) == len(EXPONENTIAL) <= len(made) <= len(EXPONENTIAL) + 1


def test_without_room_factors_are_made_again_and_fields_are_the_same(monkeypatch):
    surface = bumpy(500)
    expected = PoleDiffusion(Laplacian(surface), 0.5).from_source(7)
    monkeypatch.setattr("bihdist_core.solver.resolvents.SHARE_KEPT", 0)
    laplacian = Laplacian(surface)
    distance = PoleDiffusion(laplacian, 0.5)
    assert laplacian.components[0].resolvents.nbytes < 1e6
    assert np.allclose(distance.from_source(7), expected, rtol=1e-12)


def test_a_coarse_field_is_there_at_once_and_only_where_the_exact_one_is_not():
    surface = bumpy(2000)
    distances = Distances(Laplacian(surface))
    spec = Spec.of("diffusion", t=0.2)
    assert distances.meanwhile(spec) is None  # there is nothing to begin with
    distances.laplacian.components[0].spectrum(16)
    few = distances.meanwhile(spec)
    assert few is not None
    coarse = distances.answer(few, 3, at_once=lambda answer: True)
    assert coarse.label == "diffusion, t = 0.2, coarse"
    exact = distances.answer(spec, 3)
    assert distances.meanwhile(spec) is None
    assert 1e-6 < np.abs(coarse.field - exact.field).max() / exact.maximum < 0.5
    distances.get(Spec.of("diffusion", t=0.8))
    near = distances.meanwhile(Spec.of("diffusion", t=0.1))
    assert near is not None
    field = distances.get(near).from_source(3)
    exact = distances.get(Spec.of("diffusion", t=0.1)).from_source(3)
    assert np.abs(field - exact).max() < 1e-2 * exact.max()


def test_a_vertex_without_an_area_is_where_its_neighbours_put_it():
    """Its eigenvalue is infinite, and every eigenvector is harmonic there."""
    surface = bumpy(300)
    x = np.vstack([surface.vertices, surface.vertices[surface.faces[0]].mean(axis=0)])
    a, b, c = surface.faces[0]
    faces = np.vstack([surface.faces[1:], [[a, b, 300], [b, c, 300], [c, a, 300]]])
    split = Laplacian(Surface(x, faces))
    component = split.components[0]
    component.areas.flags.writeable = True
    component.areas[300] = 0
    for distance in (PoleDiffusion(split, 0.5), PowerDistance(split, 1.5)):
        squares, sides = distance.from_source(5) ** 2, distance.pairwise([a, b, c]) ** 2
        assert squares[300] == pytest.approx(squares[[a, b, c]].mean() - sides.sum() / 18, rel=1e-7)
