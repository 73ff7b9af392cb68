"""All that takes a surface takes a mesh of any kind, and fields of other types are refused wherever they are taken."""

import dataclasses
import inspect

import numpy as np
import pytest

import bihdist_core as core
from tests.shapes import bumpy

BUMPY = bumpy(120)
V, F = BUMPY.vertices, BUMPY.faces
X, Y, Z = V.T
NEAR = core.GeodesicDistance(BUMPY, "dijkstra").from_source(3)
EDGE = BUMPY.mean_edge_length
COLUMNS = np.column_stack([np.linalg.norm(V - V[k], axis=1) for k in (3, 40, 77)])
REGIONS = core.voronoi_regions(BUMPY, COLUMNS)
PINS = core.Pins.of(BUMPY, [3, 40], ["one", "other"])
FAR = int(NEAR[F].min(axis=1).argmax())
FACE = int((F == 3).any(axis=1).argmax())

TAKES_A_SURFACE = {
    "BiharmonicDistance": lambda m: core.BiharmonicDistance(m).from_source(3),
    "Brush": lambda m: core.Brush(m).near(0, V[F[0]].mean(axis=0), 4 * EDGE),
    "CommuteTimeDistance": lambda m: core.CommuteTimeDistance(m).from_source(3),
    "DiffusionDistance": lambda m: core.DiffusionDistance(m).from_source(3),
    "GeodesicDistance": lambda m: core.GeodesicDistance(m, "dijkstra").from_source(3),
    "GeodesicPaths": lambda m: core.GeodesicPaths(m).path([3, 40], "edges").points,
    "Laplacian": lambda m: core.Laplacian(m).areas,
    "Pins.of": lambda m: core.Pins.of(m, [3, 40]),
    "Places.of": lambda m: core.Places.of(m, [3, "f7:0.2,0.3"]),
    "Places.split": lambda m: core.Places.of(BUMPY, ["f7:0.2,0.3"]).split(m).surface,
    "PowerDistance": lambda m: core.PowerDistance(m).from_source(3),
    "TruncatedBiharmonicDistance": lambda m: core.TruncatedBiharmonicDistance(m, k=20).from_source(3),
    "at_tips": lambda m: core.at_tips(m, [3, 40], [3]),
    "band": lambda m: core.band(m, Z, -0.5, 0.5),
    "biharmonic_kernel_signature": lambda m: core.biharmonic_kernel_signature(m),
    "centrality": lambda m: core.centrality(m),
    "cut_out": lambda m: core.cut_out(m, np.flatnonzero(Z > 0)),
    "difference_quality": lambda m: core.difference_quality(m, Z, NEAR, 3),
    "eigenpairs": lambda m: core.eigenpairs(m, 5).eigenvalues,
    "extrema": lambda m: core.extrema(m, Z),
    "field_agreement": lambda m: core.field_agreement(m, X, Z),
    "field_quality": lambda m: core.field_quality(m, NEAR, NEAR, 3),
    "field_scatter": lambda m: core.field_scatter(m, X, Z),
    "field_statistics": lambda m: core.field_statistics(m, Z),
    "geodesic_circles": lambda m: core.geodesic_circles(m, NEAR, NEAR, 3),
    "gradient_jumps": lambda m: core.gradient_jumps(m, Z),
    "heat_kernel_signature": lambda m: core.heat_kernel_signature(m),
    "isolines": lambda m: core.isolines(m, Z, [0.1, 0.2]),
    "isotropy_ratio": lambda m: core.isotropy_ratio(m, NEAR, NEAR, 4 * EDGE),
    "noisy": lambda m: core.noisy(m, 0.1),
    "other_extrema": lambda m: core.other_extrema(m, Z, 3),
    "plane_section": lambda m: core.plane_section(m, [3, 40], (V[3] + V[40]) / 2).points,
    "region_boundaries": lambda m: core.region_boundaries(m, REGIONS),
    "region_mesh": lambda m: core.region_mesh(m, COLUMNS),
    "simplified": lambda m: core.simplified(m, 60),
    "tips": lambda m: core.tips(m),
    "truncation_loss": lambda m: core.truncation_loss(m, 3, 10).means,
    "voronoi_regions": lambda m: core.voronoi_regions(m, COLUMNS),
    "welded": lambda m: core.welded(m, FACE, FAR),
    "with_handle": lambda m: core.with_handle(m, FACE, FAR),
    "with_holes": lambda m: core.with_holes(m, 1, 0.3),
    "wave_kernel_signature": lambda m: core.wave_kernel_signature(m),
}


def from_file(write, name):
    """What reads or writes a file, and then what is in it."""

    def call(mesh, folder):
        path = folder / name
        path.unlink(missing_ok=True)
        found = write(path, mesh)
        return path.read_bytes() if found is None else found

    return call


def read_pins(path, mesh):
    core.write_pins(path, BUMPY, PINS)
    return core.read_pins(path, mesh)


FILES = {
    "read_map": from_file(lambda path, m: core.read_map("identity", m, m), "none"),
    "read_pins": from_file(read_pins, "pins.csv"),
    "write_labels": from_file(lambda path, m: core.write_labels(path, m, REGIONS), "labels.csv"),
    "write_mesh": from_file(core.write_mesh, "again.off"),
    "write_pins": from_file(lambda path, m: core.write_pins(path, m, PINS), "pins.csv"),
    "write_samples": from_file(lambda path, m: core.write_samples(path, m, [3, 40]), "samples.txt"),
    "write_selection": from_file(lambda path, m: core.write_selection(path, m, [3, 40], "field"), "chosen.csv"),
}


def callables():
    """Public functions, constructors and methods, by name."""
    for name in core.__all__:
        found = getattr(core, name)
        if inspect.isclass(found):
            if not (dataclasses.is_dataclass(found) or issubclass(found, Exception)):
                yield name, found.__init__
            for method, its in vars(found).items():
                if not method.startswith("_") and inspect.isfunction(getattr(its, "__func__", its)):
                    yield f"{name}.{method}", getattr(its, "__func__", its)
        elif inspect.isfunction(found):
            yield name, found


def parameter_types(function):
    return [str(each.annotation) for each in inspect.signature(function).parameters.values()]


def test_nothing_public_takes_a_surface_only():
    assert [name for name, each in callables() if "Surface" in parameter_types(each)] == []
    takers = {name for name, each in callables() if any("MeshLike" in its for its in parameter_types(each))}
    assert takers - {"Distance", "Surface.of"} == TAKES_A_SURFACE.keys() | FILES.keys()


def same(one, other):
    if isinstance(one, core.Surface):
        return same((one.vertices, one.faces), (other.vertices, other.faces))
    if dataclasses.is_dataclass(one):
        return all(same(getattr(one, each.name), getattr(other, each.name)) for each in dataclasses.fields(one))
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(same, one, other))
    return np.array_equal(one, other, equal_nan=True) if isinstance(one, np.ndarray | float) else one == other


@pytest.fixture(scope="module", params=["a path", "arrays", "PyVista"])
def mesh(request, tmp_path_factory):
    if request.param == "a path":
        path = tmp_path_factory.mktemp("meshes") / "bumpy.ply"
        core.write_mesh(path, BUMPY)
        return str(path)
    if request.param == "arrays":
        return V, F
    pytest.importorskip("pyvista")
    return BUMPY.to_pyvista()


@pytest.mark.parametrize("name", TAKES_A_SURFACE)
def test_what_takes_a_surface_takes_any_mesh(name, mesh):
    assert same(TAKES_A_SURFACE[name](mesh), TAKES_A_SURFACE[name](BUMPY))


@pytest.mark.parametrize("name", FILES)
def test_what_takes_a_file_and_a_surface_takes_any_mesh(name, mesh, tmp_path):
    assert same(FILES[name](mesh, tmp_path), FILES[name](BUMPY, tmp_path))


D = core.BiharmonicDistance(BUMPY)
TAKES_A_FIELD = {
    "apparent_source": core.apparent_source,
    "band": lambda f: core.band(BUMPY, f, 0.1, 0.5),
    "difference": lambda f: core.difference(f, Z),
    "difference_quality": lambda f: core.difference_quality(BUMPY, f, NEAR, 3),
    "difference_quality, near": lambda f: core.difference_quality(BUMPY, Z, f, 3),
    "error_curve": core.error_curve,
    "extrema": lambda f: core.extrema(BUMPY, f),
    "field_agreement": lambda f: core.field_agreement(BUMPY, f, Z),
    "field_change": lambda f: core.field_change(f, Z),
    "field_quality": lambda f: core.field_quality(BUMPY, f, NEAR, 3),
    "field_quality, geodesic": lambda f: core.field_quality(BUMPY, NEAR, f, 3),
    "field_scatter": lambda f: core.field_scatter(BUMPY, Z, f),
    "field_statistics": lambda f: core.field_statistics(BUMPY, f),
    "geodesic_circles": lambda f: core.geodesic_circles(BUMPY, f, NEAR, 3),
    "geodesic_circles, geodesic": lambda f: core.geodesic_circles(BUMPY, NEAR, f, 3),
    "gradient_jumps": lambda f: core.gradient_jumps(BUMPY, f),
    "isolines": lambda f: core.isolines(BUMPY, f, [0.1]),
    "isotropy_ratio": lambda f: core.isotropy_ratio(BUMPY, f, NEAR, 4 * EDGE),
    "map_errors": lambda f: core.map_errors(D, f, np.arange(120)),
    "nearest, mask": lambda f: core.nearest(D, [3], mask=f),
    "other_extrema": lambda f: core.other_extrema(BUMPY, f, 3),
    "parcel_means": lambda f: core.parcel_means(D, f, weights="area", reduce="min"),
    "rank_correlation": lambda f: core.rank_correlation(f, Z),
    "region_mesh": lambda f: core.region_mesh(BUMPY, f),
    "triangle_violations": core.triangle_violations,
    "voronoi_regions": lambda f: core.voronoi_regions(BUMPY, f),
    "ShepardInterpolant": lambda f: core.ShepardInterpolant(D, np.arange(120), f),
    "Correspondence, weights": lambda f: core.Correspondence(D, D, np.column_stack([np.arange(120)] * 2), f),
    "write_profile": lambda f: core.write_profile("none.csv", core.GeodesicPaths(BUMPY).path([3, 40]), {"f": f}),
}
BAD = {
    "complex": Z + 1j,
    "ragged": [[1.0], [1.0, 2.0]],
    "of words": np.full(120, "far"),
    "of objects": np.full(120, {}),
}


@pytest.mark.parametrize("bad", BAD.values(), ids=BAD)
@pytest.mark.parametrize("name", TAKES_A_FIELD)
def test_fields_of_other_types_are_refused_in_a_sentence(name, bad):
    if name == "parcel_means" and bad is BAD["of words"]:
        pytest.skip("labels may be words")
    with pytest.raises(core.ParameterError) as caught:
        TAKES_A_FIELD[name](bad)
    assert str(caught.value).endswith(".")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("order", [np.asfortranarray, lambda x: np.repeat(x, 2, axis=0)[::2], lambda x: x.T.copy().T])
def test_arrays_lie_in_memory_in_any_way(order):
    surface = bumpy(60)
    other = core.Surface(order(surface.vertices), order(surface.faces))
    np.testing.assert_array_equal(
        core.BiharmonicDistance(other).from_source(3), core.BiharmonicDistance(surface).from_source(3)
    )
