"""The full map of the lion in two poses from ten pairs: its errors against a slow reference, and maps of others."""

import numpy as np
import pytest

from app.main import main
from bihdist_core import (
    BiharmonicDistance,
    Correspondence,
    GeodesicDistance,
    error_curve,
    map_errors,
    read_map,
    read_surface,
)
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from tests.shapes import MESHES, needs_meshes

PAIRS = (952, 4937, 4682, 4795, 4227, 1336, 85, 1821, 4835, 1119)
"""The same vertices of both poses."""

pytestmark = needs_meshes


@pytest.fixture(scope="module")
def lions():
    return read_surface(MESHES / "lion_ref.obj"), read_surface(MESHES / "lion_pose05.obj")


@pytest.fixture(scope="module")
def found(lions):
    distances = [BiharmonicDistance(lion) for lion in lions]
    return Correspondence(*distances, [(v, v) for v in PAIRS])


def test_the_full_map_is_the_least_misfit_of_each_vertex(found):
    full = found.map()
    for x in range(0, len(full), 7):
        misfit = found.misfit(x)
        assert misfit[full[x]] == pytest.approx(np.nanmin(misfit), rel=1e-9)


def test_the_error_curve_is_that_of_a_slow_reference(found, lions):
    """By paths along edges, which scipy finds alone; of every fifth vertex of the lion, each threshold counted."""
    import scipy.sparse
    import scipy.sparse.csgraph

    full, lion = found.map(), lions[1]
    ends = lion.vertices[lion.edges]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    n = len(lion.vertices)
    graph = scipy.sparse.csr_matrix((lengths, lion.edges.T), (n, n))
    area = sum(0.5 * np.linalg.norm(np.cross(b - a, c - a)) for a, b, c in lion.vertices[lion.faces])
    some = np.arange(0, n, 5)
    rows = scipy.sparse.csgraph.dijkstra(graph, directed=False, indices=some)
    slow = [rows[k, full[x]] / np.sqrt(area) for k, x in enumerate(some)]
    errors = map_errors(GeodesicDistance(lion, "dijkstra"), full[some], some)
    assert errors == pytest.approx(np.array(slow), abs=1e-9)
    curve = error_curve(errors)
    for threshold in (0.0, 0.02, 0.1, 0.25):
        assert curve.fractions(threshold) == sum(error <= threshold for error in slow) / len(some)
    assert curve.mean == pytest.approx(sum(slow) / len(some))


def test_maps_that_were_not_made_here_are_evaluated(lions, tmp_path, capsys):
    """Those of other programs: a column of floating numbers, ids of one line each, a map that leaves vertices out."""
    n = len(lions[0].vertices)
    ids = np.arange(n)
    np.save(tmp_path / "column.npy", ids.astype(float)[:, None])
    (tmp_path / "lines.txt").write_text("\r\n".join(map(str, np.roll(ids, 1).tolist())) + "\r\n")
    partial = ids.copy()
    partial[::2] = -1
    np.savetxt(tmp_path / "partial.txt", partial, "%d")
    names = ["column.npy", "lines.txt", "partial.txt"]
    meshes = [str(MESHES / name) for name in ("lion_ref.obj", "lion_pose05.obj")]
    words = ["--truth", "identity", "--samples", "60", "--method", "dijkstra", "-o", str(tmp_path / "curves.csv")]
    assert main(["evaluate", *meshes, *(str(tmp_path / name) for name in names), *words]) == 0
    said = capsys.readouterr().out.splitlines()
    assert "mean 0, median 0, area under the curve to 0.25 1;" in said[0]
    some = np.unique(np.linspace(0, n - 1, 60).astype(int))
    mapped = read_map(tmp_path / "lines.txt", *lions)
    slow = np.diag(EdgeGeodesic(lions[1]).distances(some)[mapped[some]]) / np.sqrt(lions[1].face_areas.sum())
    assert f"mean {slow.mean():.4g}" in said[1]
    assert f"{(some % 2 == 0).sum()} vertices mapped nowhere" in said[2]
    last = (tmp_path / "curves.csv").read_text().splitlines()[-1].split(",")
    assert float(last[1]) == 1
    assert float(last[3]) == pytest.approx((some % 2 == 1).mean())
