"""The modelling script: laws of its fields, and small shapes rebuilt from start to finish."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from bihdist_core import Surface
from tests.assets.test_samples import corner_angles, edge_lengths, volume

pytest.importorskip("pyvista", reason="the modelling script needs pyvista")

from assets.modelling import beast_bones, skeleton
from assets.modelling.build import SAMPLES
from assets.modelling.domain import domain
from assets.modelling.fields import Field, ellipsoid, tube
from assets.modelling.joins import both_sides, carve, join, placed, standing_on
from assets.modelling.plates import plated, saw, smooth_step
from assets.modelling.polygonise import polygonise
from assets.modelling.pose import posed
from assets.modelling.scanner import Scanners
from assets.modelling.sculpture import Sculpture, facing_front, facing_right
from assets.modelling.skeleton import Bone, motions
from tests.assets.test_samples import TABLE

POINTS = np.random.default_rng(0).uniform(-1, 1, (400, 3))


def test_every_sample_has_a_recipe() -> None:
    assert set(SAMPLES) == set(TABLE)


def test_ball_and_capsule_have_exact_distances() -> None:
    ball = ellipsoid((0.1, 0, 0), (0.3, 0.3, 0.3), reach=5)
    assert ball(POINTS) == pytest.approx(np.linalg.norm(POINTS - (0.1, 0, 0), axis=1) - 0.3, abs=1e-7)
    capsule = tube([(0, 0, -0.4, 0.2), (0, 0, 0.4, 0.2)], reach=5)
    beyond = POINTS - np.clip(POINTS[:, 2:], -0.4, 0.4) * (0, 0, 1)
    assert capsule(POINTS) == pytest.approx(np.linalg.norm(beyond, axis=1) - 0.2, abs=1e-7)


def test_out_of_reach_a_part_is_a_lower_bound() -> None:
    near, whole = (ellipsoid((0, 0, 0), (0.2, 0.2, 0.2), reach=reach)(POINTS) for reach in (0.1, 5))
    assert np.all(near <= whole + 1e-7)
    assert np.array_equal(near < 0, whole < 0)


def test_joining_only_adds_and_carving_only_removes() -> None:
    a = ellipsoid((-0.2, 0, 0), (0.4, 0.3, 0.3), reach=5)
    b = ellipsoid((0.3, 0.1, 0), (0.3, 0.3, 0.4), reach=5)
    least = np.minimum(a(POINTS), b(POINTS))
    assert np.array_equal(join(0, a, b)(POINTS), least)
    joined = join(0.2, a, b)(POINTS)
    assert np.all(joined <= least)
    assert np.all(joined >= least - 0.2 / 6 - 1e-12)  # the cubic blend is deepest where both are equal: width / 6
    assert np.all(carve(0.2, a, b)(POINTS) >= a(POINTS))
    assert np.all(standing_on(0, a, 0.1)(POINTS) >= -POINTS[:, 2])


def test_mirrored_and_placed_parts() -> None:
    part = ellipsoid((0.3, 0.2, 0.1), (0.3, 0.2, 0.1), reach=5)
    assert both_sides(part)(POINTS) == pytest.approx(both_sides(part)(POINTS * (-1, 1, 1)))
    moved = placed(part, (1, 2, 3), right=(1, 0, 0), up=(0, 0, 1), scale=2)
    assert moved(2 * POINTS + (1, 2, 3)) == pytest.approx(2 * part(POINTS))


def test_every_turned_bone_exists() -> None:
    assert set(skeleton.SECOND_POSE) <= set(skeleton.BONES)
    assert set(beast_bones.SECOND_POSE) <= set(beast_bones.BONES)


def test_plates_raise_the_back_and_leave_the_front() -> None:
    body = tube([(0, 0, -0.8, 0.3), (0, 0, 0.8, 0.3)], reach=5)
    stations = [(0, 0, -0.8, 0, 0.02, 90), (0, 0, 0.8, 8, 0.02, 90)]
    armour = plated(body, stations, back=(0, 1, 0), lift=0.02)
    count = np.linspace(1, 7, 600)
    back = np.c_[np.zeros(600), np.full(600, 0.3), count / 5 - 0.8]
    raised = body(back) - armour(back)
    # The axis is blurred, which takes a little off the plates.
    assert raised == pytest.approx(0.02 + 0.02 * saw(count), abs=4e-3)
    assert armour(back * (1, -1, 1)) == pytest.approx(body(back * (1, -1, 1)), abs=1e-12)
    # Plates rise slowly and end in a step.
    assert np.gradient(saw(count), count).min() < -1.4 * np.gradient(saw(count), count).max()
    far = 3 * POINTS[np.abs(body(3 * POINTS)) > 0.2]
    far = far[np.abs(body(far)) > 0.1]
    assert np.array_equal(armour(far), body(far))


def test_smooth_steps_run_from_none_to_all() -> None:
    assert smooth_step(np.array([-1, 0, 0.5, 1, 2])).tolist() == [0, 0, 0.5, 1, 1]


@pytest.mark.parametrize(("turn", "ahead"), [(facing_front, (0, 0, 1)), (facing_right, (1, 0, 0))])
def test_turned_shapes_stand_up_and_are_not_mirrored(turn, ahead) -> None:
    right, face, up = turn(np.array([(1, 0, 0), (0, -1, 0), (0, 0, 1.0)]))
    assert tuple(up) == (0, 1, 0)
    assert tuple(face) == ahead
    assert np.cross(right, face) == pytest.approx(-up)


def bar() -> Sculpture:
    return Sculpture(
        field=tube([(0, 0, -0.6, 0.15), (0, 0, 0.6, 0.15)]),
        low=(-0.3, -0.3, -0.9),
        high=(0.3, 0.3, 0.9),
        grid=0.05,
        edge=0.07,
        wanted=lambda p: np.full(len(p), 0.07),
    )


@pytest.fixture(scope="module")
def bar_mesh() -> tuple[np.ndarray, np.ndarray]:
    return bar().mesh()


def test_a_small_sculpture_is_rebuilt_alike_and_well(bar_mesh) -> None:
    points, faces = bar_mesh
    again, faces_again = bar().mesh()
    assert np.array_equal(points, again)
    assert np.array_equal(faces, faces_again)
    surface = Surface(points, faces)
    assert (surface.is_manifold, surface.genus, surface.boundary_loop_count) == (True, 0, 0)
    assert corner_angles(surface).min() > 30
    assert np.abs(bar().field(points)).max() < 1e-5
    assert np.median(edge_lengths(surface)) == pytest.approx(0.07, rel=0.15)
    assert volume(surface) > 0


def test_a_bent_bar_keeps_lengths_and_volume(bar_mesh) -> None:
    points, faces = bar_mesh
    bones = {"low": Bone(None, (0, 0, -0.6), (0, 0, 0), 0.15), "high": Bone("low", (0, 0, 0), (0, 0, 0.6), 0.15)}
    turn = Rotation.from_euler("x", 45, degrees=True).as_matrix()
    motion = {"low": (np.eye(3), np.zeros(3)), "high": (turn, np.zeros(3))}
    bent = posed(points, faces, bar().field, bones, motion, spacing=0.04)
    before, after = Surface(points, faces), Surface(bent, faces)
    assert bent[points[:, 2].argmax()] == pytest.approx(turn @ points[points[:, 2].argmax()], abs=0.03)
    assert np.median(np.abs(edge_lengths(after) / edge_lengths(before) - 1)) < 0.03
    assert volume(after) == pytest.approx(volume(before), rel=0.03)


@pytest.mark.parametrize("bones", [skeleton.BONES, beast_bones.BONES], ids=["person", "beast"])
def test_bones_hang_together_in_any_pose(bones) -> None:
    motion = motions({"left upper arm": (0, -40, 10), "left forearm": (20, -80, 0)}, bones)
    for name, bone in bones.items():
        if bone.parent:
            (rotation, shift), (parent_rotation, parent_shift) = motion[name], motion[bone.parent]
            joint = np.array(bone.start)
            assert rotation @ joint + shift == pytest.approx(parent_rotation @ joint + parent_shift)
    assert motion["right hand"][0] == pytest.approx(np.eye(3))


def balls() -> tuple[Field, np.ndarray, np.ndarray]:
    """A ball on z = 0 and a smaller one beside it, in its shadow from the side of +x; the field and a fine mesh."""
    large, small = ellipsoid((0, 0, 0.2), (0.2, 0.2, 0.2)), ellipsoid((-0.24, 0, 0.2), (0.1, 0.1, 0.1))
    field = join(0.02, large, small)
    return field, *polygonise(field, (-0.4, -0.25, -0.05), (0.25, 0.25, 0.45), 0.012)


def test_scanners_see_what_faces_them_and_is_not_hidden() -> None:
    _, points, faces = balls()
    scanners = Scanners([(2, 0, 0.2), (-2, 0, 0.2)], points, faces)
    places = np.array([(0.2, 0, 0.2), (0, 0, 0.4), (-0.34, 0, 0.2), (-0.24, 0, 0.3)])
    normals = np.array([(1, 0, 0), (0, 0, 1), (-1, 0, 0), (0.6, 0, 0.8)])
    views = scanners.views(places, normals, lift=0.005)
    assert views.cosine[0] == pytest.approx([1, 0, 0, 0])  # the last one looks its way, but lies in the shadow
    assert views.cosine[1] == pytest.approx([0, 0, 1, 0])
    assert views.distance[0, 0] == pytest.approx(1.8)
    assert views.best()[[0, 2]].tolist() == [0, 1]


def test_scanners_want_longer_edges_where_they_see_badly() -> None:
    _, points, faces = balls()
    wanted = Scanners([(2, 0, 0.2)], points, faces).wanted(step=0.01, finest=0.01, coarsest=0.05)
    straight, slanted, unseen = wanted(np.array([(0.2, 0, 0.2), (0.07, 0, 0.387), (-0.34, 0, 0.2)]))
    assert straight == pytest.approx(0.018, rel=0.05)
    assert straight < slanted < unseen
    assert unseen == pytest.approx(0.05)


def test_a_scan_keeps_what_is_seen_and_is_made_alike() -> None:
    field, points, faces = balls()
    scanners = Scanners([(2, 0, 0.3), (0.3, 2, 0.5)], points, faces)
    scanned, kept = scanners.scan(points, faces, field, seed=1)
    again, kept_again = scanners.scan(points, faces, field, seed=1)
    assert np.array_equal(scanned, again)
    assert np.array_equal(kept, kept_again)
    surface = Surface(scanned, kept)
    assert surface.is_manifold
    assert surface.boundary_loop_count > 0
    assert 0.3 * len(points) < len(scanned) < 0.75 * len(points)
    assert scanned[:, 1].min() > -0.195  # the side away from both is not there
    assert 0 < np.abs(field(scanned)).max() < 0.012  # noise of less than an edge


def test_the_domain_is_rebuilt_alike() -> None:
    points, faces = domain(edge=0.05)
    again, faces_again = domain(edge=0.05)
    assert np.array_equal(points, again)
    assert np.array_equal(faces, faces_again)
    surface = Surface(points, faces)
    assert (surface.is_manifold, surface.genus, surface.boundary_loop_count) == (True, 0, 2)
    assert corner_angles(surface).min() > 25
