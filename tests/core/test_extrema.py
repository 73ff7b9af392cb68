"""Extrema of fields with their persistence, and the tips of shapes."""

import numpy as np
import pytest

from app.samples import mesh_path
from bihdist_core import (
    BiharmonicDistance,
    Laplacian,
    ParameterError,
    ShepardInterpolant,
    SourceSet,
    Surface,
    at_tips,
    extrema,
    other_extrema,
    read_surface,
    tips,
)
from tests.shapes import bumpy, components_apart, grid, torus, two_pieces


def slow_minima(surface, field):
    """{minimum: persistence} the obvious way: vertices one by one, lowest first, pieces as sets."""
    order = np.lexsort((np.arange(len(field)), field)).tolist()
    neighbours = [set() for _ in field]
    for a, b in surface.edges.tolist():
        neighbours[a].add(b)
        neighbours[b].add(a)
    pieces, result = {}, {}
    for v in order:
        met = sorted({id(pieces[w]): pieces[w] for w in neighbours[v] if w in pieces}.values(), key=lambda p: p["rank"])
        if not met:
            pieces[v] = {"root": v, "rank": order.index(v), "members": {v}}
            continue
        old = met[0]
        for young in met[1:]:
            result[young["root"]] = field[v] - field[young["root"]]
            old["members"] |= young["members"]
            for w in young["members"]:
                pieces[w] = old
        old["members"].add(v)
        pieces[v] = old
    for piece in {id(p): p for p in pieces.values()}.values():
        result[piece["root"]] = max(field[list(piece["members"])]) - field[piece["root"]]
    return result


@pytest.mark.parametrize("surface", [bumpy(150), grid(9, 7), torus(12, 8), two_pieces()], ids=lambda s: s.name)
@pytest.mark.parametrize("kind", ["random", "smooth", "whole numbers"])
def test_equals_the_slow_count(surface, kind):
    rng = np.random.default_rng(0)
    field = {
        "random": rng.standard_normal(len(surface.vertices)),
        "smooth": np.sin(3 * surface.vertices[:, 0]) + np.cos(2 * surface.vertices[:, 1]),
        "whole numbers": rng.integers(4, size=len(surface.vertices)).astype(float),
    }[kind]
    found = extrema(surface, field, fraction=0)
    used = surface.component_of_vertex >= 0
    for ids, persistence, sign in [
        (found.minima, found.minima_persistence, 1),
        (found.maxima, found.maxima_persistence, -1),
    ]:
        expected = {v: p for v, p in slow_minima(surface, sign * field).items() if used[v] and p > 0}
        assert dict(zip(ids.tolist(), persistence.tolist(), strict=True)) == pytest.approx(expected)
        assert (np.diff(persistence) <= 0).all()
    if kind != "whole numbers":
        assert (found.raw_minima, found.raw_maxima) == (len(found.minima), len(found.maxima))


def test_two_hills_and_the_saddle_between_them():
    s = grid(40, 20)
    x, y = s.vertices[:, 0], s.vertices[:, 1]
    field = 3 * np.exp(-((x - 10) ** 2 + (y - 10) ** 2) / 30) + 2 * np.exp(-((x - 30) ** 2 + (y - 10) ** 2) / 30)
    found = extrema(s, field, fraction=0.01)
    assert s.vertices[found.maxima, 0].tolist() == [10, 30]
    ridge = field[(y == 10) & (x > 10) & (x < 30)].min()
    assert found.maxima_persistence == pytest.approx([np.ptp(field), field[found.maxima[1]] - ridge])


def test_noise_does_not_count_above_its_height():
    s = bumpy(600)
    noise = 1e-5 * np.random.default_rng(0).standard_normal(600)
    found = extrema(s, s.vertices[:, 2] + noise)
    clean = extrema(s, s.vertices[:, 2])
    # The deepest hollow of this noise is about a tenth of a thousandth of the range.
    assert len(found.minima) == len(clean.minima)
    assert extrema(s, s.vertices[:, 2] + 1e4 * noise).raw_minima > 5


def test_negation_exchanges_minima_and_maxima():
    s, field = bumpy(300), np.random.default_rng(0).standard_normal(300)
    one, other = extrema(s, field), extrema(s, -field)
    assert one.minima.tolist() == other.maxima.tolist()
    assert one.minima_persistence.tolist() == other.maxima_persistence.tolist()
    assert one.raw_maxima == other.raw_minima


def test_the_source_is_the_only_minimum_on_a_round_shape():
    s = torus(48, 24)
    found = extrema(s, BiharmonicDistance(s).from_source(7))
    assert found.minima.tolist() == [7]


def test_components_and_missing_values():
    s = two_pieces()
    large, small = components_apart(s)
    field = BiharmonicDistance(s).from_source(large[0])
    found = extrema(s, field)
    assert found.minima[0] == large[0]
    assert np.isin(found.maxima, large).all()
    assert len(extrema(s, np.zeros(65)).minima) == 0
    # On the smaller component the four values 2 to 5 have one minimum and one maximum of their own.
    field = np.zeros(65)
    field[small] = [2, 3, 4, 5]
    assert extrema(s, field).minima.tolist() == [small[0]]
    nothing = extrema(s, np.full(65, np.nan))
    assert len(nothing.minima) == len(nothing.maxima) == nothing.raw_minima == 0


def test_a_plateau_has_one_extremum():
    s = grid(10, 10)
    found = extrema(s, np.maximum(2, np.abs(s.vertices[:, :2] - 5).max(axis=1)))
    assert len(found.minima) == 1


@pytest.mark.parametrize(
    ("field", "fraction", "words"),
    [
        (np.zeros(3), 0.1, r"each of 9 vertices, not an array of shape \(3,\)"),
        (np.zeros(9), 2, "from 0 to 1, not 2"),
    ],
)
def test_refused(field, fraction, words):
    with pytest.raises(ParameterError, match=words):
        extrema(grid(2, 2), field, fraction)


def test_does_not_depend_on_the_numbering():
    s = bumpy(300)
    field = np.random.default_rng(0).standard_normal(300)
    order = np.random.default_rng(1).permutation(300)
    other = Surface(s.vertices[order], np.argsort(order)[s.faces])
    assert order[extrema(other, field[order]).minima].tolist() == extrema(s, field).minima.tolist()


# ---------------------------------------------------------------------- tips
def test_the_eccentricity_is_the_mean_of_squared_distances():
    laplacian = Laplacian(bumpy(150))
    (component,) = laplacian.components
    distances = BiharmonicDistance(laplacian).from_sources(np.arange(150))
    mean = component.areas @ distances**2 / component.areas.sum()
    assert component.biharmonic_eccentricity == pytest.approx(np.sqrt(mean), rel=1e-9)


@pytest.mark.parametrize(("sample", "count"), [("hand", 6), ("figure", 5), ("octopus", 9)])
def test_tips_are_the_ends_of_limbs(sample, count):
    """Five fingers and the wrist; head, hands and feet; eight arms and the head."""
    surface = read_surface(mesh_path(sample))
    found = tips(Laplacian(surface))
    assert len(found) == count
    away = np.linalg.norm(surface.vertices[found][:, None] - surface.vertices[found], axis=2)
    assert away[~np.eye(count, dtype=bool)].min() > 0.1 * np.sqrt(surface.face_areas.sum())


def test_tips_are_found_on_each_component():
    s = two_pieces()
    found = tips(Laplacian(s))
    assert all(np.isin(found, part).any() for part in components_apart(s))


def test_extrema_at_tips_are_told_from_others():
    """The interpolant of two anchors in the palm has one extremum at most of the fingers."""
    surface = read_surface(mesh_path("hand"))
    laplacian = Laplacian(surface)
    ends = tips(laplacian)
    middle = np.argsort(laplacian.components[0].biharmonic_eccentricity)[[0, 400]]
    field = ShepardInterpolant(BiharmonicDistance(laplacian), middle, [0.0, 1.0]).evaluate()
    stray = other_extrema(surface, field, SourceSet(tuple(middle))).vertices
    assert not np.isin(stray, middle).any()
    assert at_tips(surface, stray, ends).sum() >= 4
    assert at_tips(surface, ends, ends).all()
    assert not at_tips(surface, middle, ends).any()


def test_a_single_vertex_has_no_tip():
    s = bumpy(60)
    lonely = Surface(np.concatenate([s.vertices, [[9.0, 9, 9]]]), s.faces)
    assert 60 not in tips(Laplacian(lonely))
