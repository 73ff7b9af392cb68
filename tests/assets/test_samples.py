"""The committed sample meshes are what assets/README.md says they are."""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.spatial import cKDTree

from bihdist_core import Surface, read_surface
from tests.assets.crossings import crossing_faces

ASSETS = Path(__file__).resolve().parents[2] / "assets"


@dataclass(frozen=True)
class WorkOrder:
    """Limits of the vertex count, the topology, and what no angle is below, in degrees."""

    fewest: int
    most: int
    genus: int = 0
    loops: int = 0
    components: int = 1
    angle: float = 25


TABLE = {
    "figure": WorkOrder(9_000, 15_000),
    "figure_pose2": WorkOrder(9_000, 15_000),
    "animal": WorkOrder(8_000, 12_000),
    "beast": WorkOrder(8_000, 9_200),
    "beast_pose2": WorkOrder(8_000, 9_200, angle=20),
    "elephant": WorkOrder(8_000, 9_200, genus=1),
    "octopus": WorkOrder(8_000, 9_200),
    "hand": WorkOrder(6_000, 10_000, loops=1),
    "genus3": WorkOrder(5_000, 8_000, genus=3),
    "domain": WorkOrder(5_000, 8_000, loops=2),
    "part": WorkOrder(6_000, 8_000, genus=13, angle=0.5),
    "scan": WorkOrder(8_000, 12_000, loops=26),
    "hare": WorkOrder(7_500, 9_200, loops=20, components=7, angle=1),
}
CLOSED = ["figure", "figure_pose2", "animal", "beast", "beast_pose2", "elephant", "octopus", "genus3", "part"]

LARGEST_FILE = 400_000


@cache
def sample(name: str) -> Surface:
    return read_surface(ASSETS / f"{name}.ply")


def corner_angles(surface: Surface) -> np.ndarray:
    """(m, 3) degrees, by the law of cosines."""
    x = surface.vertices[surface.faces]
    a, b, c = (np.linalg.norm(x[:, (k + 1) % 3] - x[:, (k + 2) % 3], axis=1) for k in range(3))
    sides = [(a, b, c), (b, c, a), (c, a, b)]
    return np.degrees(np.stack([np.arccos((q**2 + r**2 - p**2) / (2 * q * r)) for p, q, r in sides], 1))


def edge_lengths(surface: Surface) -> np.ndarray:
    i, j = surface.edges.T
    return np.linalg.norm(surface.vertices[i] - surface.vertices[j], axis=1)


def volume(surface: Surface) -> float:
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6


def vertex_normals(surface: Surface) -> np.ndarray:
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    out = np.zeros_like(surface.vertices)
    for k in range(3):
        np.add.at(out, surface.faces[:, k], np.cross(b - a, c - a))
    return out / np.linalg.norm(out, axis=1, keepdims=True)


def test_no_sample_is_missing_or_unlisted() -> None:
    assert {path.stem for path in ASSETS.glob("*.ply")} == set(TABLE)
    assert {path.stem for path in (ASSETS / "thumbnails").glob("*.png")} == set(TABLE)


@pytest.mark.parametrize("name", TABLE)
def test_size(name: str) -> None:
    assert TABLE[name].fewest <= len(sample(name).vertices) <= TABLE[name].most
    assert (ASSETS / f"{name}.ply").stat().st_size < LARGEST_FILE
    assert (ASSETS / "thumbnails" / f"{name}.png").stat().st_size < 35_000


def test_all_of_them_together_are_small() -> None:
    assert sum(path.stat().st_size for path in ASSETS.glob("*.ply")) < 3_000_000


@pytest.mark.parametrize("name", TABLE)
def test_topology(name: str) -> None:
    surface = sample(name)
    assert surface.is_manifold
    assert surface.n_components == TABLE[name].components
    assert surface.unreferenced_count == 0
    assert not surface.repairs
    assert surface.genus == TABLE[name].genus
    assert surface.boundary_loop_count == TABLE[name].loops


@pytest.mark.parametrize("name", TABLE)
def test_triangles_are_well_shaped(name: str) -> None:
    assert corner_angles(sample(name)).min() > TABLE[name].angle


@pytest.mark.parametrize("name", CLOSED)
def test_closed_samples_face_outwards(name: str) -> None:
    assert volume(sample(name)) > 0


@pytest.mark.parametrize("name", [name for name in TABLE if name != "domain"])
def test_no_self_intersections(name: str) -> None:
    assert len(crossing_faces(sample(name))) == 0


def test_crossing_faces_are_found() -> None:
    flat, upright = [(0, 0, 0), (2, 0, 0), (0, 2, 0)], [(0.3, 0.3, -1), (0.3, 0.3, 1), (0.9, 0.4, 1)]
    surface = Surface(np.array([*flat, *upright], float), np.arange(6).reshape(2, 3))
    assert crossing_faces(surface).tolist() == [[0, 1]]


@pytest.mark.parametrize("name", ["figure", "beast"])
def test_poses_share_triangles_and_nearly_lengths_and_volume(name: str) -> None:
    standing, posed = sample(name), sample(f"{name}_pose2")
    assert np.array_equal(standing.faces, posed.faces)
    change = np.abs(edge_lengths(posed) / edge_lengths(standing) - 1)
    assert np.median(change) < 0.03
    assert abs(volume(posed) / volume(standing) - 1) < 0.02
    assert np.abs(posed.vertices - standing.vertices).max() > 0.5  # it is another pose


def test_domain_is_flat_and_not_folded() -> None:
    surface = sample("domain")
    assert np.all(surface.vertices[:, 2] == 0)
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    assert np.cross(b - a, c - a)[:, 2].min() > 0


def test_hare_is_one_large_piece_with_islands_and_specks() -> None:
    surface = sample("hare")
    piece, x = surface.component_of_vertex, surface.vertices
    sizes = np.bincount(piece)
    assert sizes.max() > 0.95 * len(x)
    assert sizes.min() > 5
    away = cKDTree(x[piece == sizes.argmax()]).query(x)[0]
    assert (np.sort([away[piece == k].min() for k in range(len(sizes))])[-2:] > 0.003).all()  # two float at least


def test_hare_has_z_up_and_no_underside() -> None:
    x = sample("hare").vertices
    width, length, height = np.ptp(x, axis=0)
    assert width < length < height
    assert x[:, 2].min() > -0.005  # noise may take the toes a little below the ground
    assert x[sample("hare").faces].mean(axis=1)[:, 2].min() > 0.001  # no sole


def test_hare_is_meshed_unevenly() -> None:
    fine, coarse = np.quantile(edge_lengths(sample("hare")), [0.05, 0.95])
    assert coarse > 2.5 * fine


def test_interior_of_the_domain_shows_no_lattice() -> None:
    surface = sample("domain")
    i, j = surface.edges[surface.faces_per_edge == 2].T
    direction = surface.vertices[j] - surface.vertices[i]
    # On a triangular lattice the sixfold mean is 1; of evenly spread directions it is 0.
    sixfold = np.exp(6j * np.arctan2(direction[:, 1], direction[:, 0]))
    assert abs(sixfold.mean()) < 0.25


FINGERS = {
    # The mesh that says which vertices are meant, and how.
    "figure": ("figure", lambda x: (np.abs(x[:, 0]) > 0.50) & (x[:, 1] < 0.93)),
    "figure_pose2": ("figure", lambda x: (np.abs(x[:, 0]) > 0.50) & (x[:, 1] < 0.93)),
    "beast": ("beast", lambda x: np.abs(x[:, 0]) > 0.45),
    "beast_pose2": ("beast", lambda x: np.abs(x[:, 0]) > 0.45),
    "hand": ("hand", lambda x: x[:, 1] > 0.4),
    "octopus": ("octopus", lambda x: np.hypot(x[:, 0], x[:, 2]) > 0.25),
}


@pytest.mark.parametrize("name", FINGERS)
def test_fingers_and_arms_are_more_than_two_edges_apart(name: str) -> None:
    """Vertices that face each other within two edges are five steps from each other: not on two fingers or arms."""
    surface = sample(name)
    standing, chosen = FINGERS[name]
    region = np.flatnonzero(chosen(sample(standing).vertices))
    assert len(region) > 500
    n, points = len(surface.vertices), surface.vertices[region]
    i, j = surface.edges.T
    step = sp.coo_matrix((np.ones(2 * len(i)), (np.r_[i, j], np.r_[j, i])), (n, n)).tocsr() + sp.eye_array(n)
    step = step.tocsr()[region][:, region]
    two = step @ step
    five = two @ two @ step
    lengths = edge_lengths(surface)[np.isin(surface.edges, region).all(axis=1)]
    pairs = cKDTree(points).query_pairs(2 * lengths.mean(), output_type="ndarray")
    apart = np.asarray(five[pairs[:, 0], pairs[:, 1]]).ravel() == 0
    # Across the thin web at a finger's root two vertices are close too, but look away from each other.
    across, normals = points[pairs[:, 1]] - points[pairs[:, 0]], vertex_normals(surface)[region][pairs[:, 0]]
    wrong = pairs[apart & ((across * normals).sum(axis=1) > 0)]
    assert not len(wrong), f"{len(wrong)} pairs, the first at {points[wrong[0, 0]]}"


def test_octopus_has_eight_arms_and_a_mantle_outside_its_web() -> None:
    surface = sample("octopus")
    outside = np.hypot(surface.vertices[:, 0], surface.vertices[:, 2]) > 0.25
    i, j = surface.edges[outside[surface.edges].all(axis=1)].T
    n = len(outside)
    graph = sp.coo_matrix((np.ones(len(i)), (i, j)), (n, n))
    part = sp.csgraph.connected_components(graph, directed=False)[1][outside]
    sizes = np.unique(part, return_counts=True)[1]
    assert len(sizes) == 9
    assert sizes.min() > 300


def test_the_elephant_s_trunk_leaves_a_hole_seen_from_the_side() -> None:
    surface = sample("elephant")
    middle = np.linalg.norm(surface.vertices[:, :2] - (1.155, 0.735), axis=1)
    assert middle.min() > 0.08
    assert edge_lengths(surface).max() < 0.08  # no triangle can span it
