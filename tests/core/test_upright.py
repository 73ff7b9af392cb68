"""Which way is up: right on what has a way up, turned with the shape, and the same whatever the vertices' order."""

from pathlib import Path

import numpy as np
import pytest

from app.samples import mesh_path
from bihdist_core import Cancelled, Surface, read_surface
from bihdist_core.analysis.upright import DIRECTIONS, axis_of, guess_up
from tests.shapes import sphere

SAMPLES = {
    "animal": "y",
    "beast": "y",
    "beast_pose2": "y",
    "domain": "y",
    "elephant": "y",
    "figure": "y",
    "figure_pose2": "y",
    "genus3": "y",
    "hand": "y",
    "hare": "z",
    "octopus": "y",
    "part": "y",
    "scan": "y",
}
"""Seen from all sides.  Of `domain`, flat, of `genus3`, three rings, and of `part`, a wheel, other ways do as well."""

SHARED = {
    "3holes.off": "y",
    "armadillo_15k.obj": "y",
    "beetle.off": "y",
    "bunny_30k.obj": "y",
    "bunny_3k.obj": "y",
    "bunny_raw.obj": "y",
    "camelhead.off": "y",
    "fertility.off": "y",
    "hand_lowres.obj": "y",
    "human_man.obj": "y",
    "lion_pose05.obj": "y",
    "lion_ref.obj": "y",
    "plane.obj": "z",
    "plane_holes.obj": "z",
    "rocker-arm.obj": "y",
    "scorpion_50k.obj": "y",
    "scorpion_6k.obj": "y",
    "spot.obj": "y",
    "suzanne.obj": "y",
    "teapot.obj": "y",
}
"""Of `3holes` and `rocker-arm`, a part of an engine, other ways do as well; y is what the window used to show."""

MESHES = Path(__file__).resolve().parents[2].parent / "shared" / "meshes"

SHAPELY = [name for name in SAMPLES if name not in ("domain", "genus3", "part")]


def turn(start, stop):
    """(3, 3) a rotation that takes one direction to another, both along axes."""
    a, b = axis_of(start), axis_of(stop)
    aside = np.cross(a, b)
    if aside.any():
        return np.outer(b, a) - np.outer(a, b) + np.outer(aside, aside)
    other = np.roll(np.abs(a), 1)
    return np.eye(3) if a @ b > 0 else 2 * np.outer(other, other) - np.eye(3)


@pytest.mark.parametrize("name", SAMPLES)
def test_samples_stand(name):
    assert guess_up(read_surface(mesh_path(name)), ".ply") == SAMPLES[name]


@pytest.mark.skipif(not MESHES.is_dir(), reason="the shared meshes are not beside the checkout")
def test_eighteen_of_the_shared_meshes_stand():
    found = {name: guess_up(read_surface(MESHES / name), Path(name).suffix) for name in SHARED}
    wrong = {name: up for name, up in found.items() if up != SHARED[name]}
    assert len(wrong) <= 2, wrong


@pytest.mark.parametrize("name", SHAPELY)
def test_a_mesh_that_is_turned_from_y_to_z_still_stands(name):
    surface = read_surface(mesh_path(name))
    for stop in ("y", "z"):
        assert guess_up(Surface(surface.vertices @ turn(SAMPLES[name], stop).T, surface.faces), ".ply") == stop


@pytest.mark.parametrize("stop", ["x", "-x", "-y", "-z"])
def test_what_stands_well_is_found_on_its_head_and_on_its_side(stop):
    surface = read_surface(mesh_path("hare"))
    assert guess_up(Surface(surface.vertices @ turn("z", stop).T, surface.faces), ".obj") == stop


def test_a_landscape_lies():
    x, y = (a.ravel() for a in np.meshgrid(np.linspace(0, 1, 40), np.linspace(0, 1, 40)))
    ids = np.arange(1600).reshape(40, 40)
    a, b, c, d = (ids[rows, columns].ravel() for rows in (np.s_[:-1], np.s_[1:]) for columns in (np.s_[:-1], np.s_[1:]))
    faces = np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)])
    hills = 0.1 * np.sin(7 * x) * np.cos(5 * y)
    assert guess_up(Surface(np.stack([x, y, hills], 1), faces), ".obj") == "z"
    assert guess_up(Surface(np.stack([x, hills, y], 1), faces[:, ::-1]), ".ply") == "y"
    # In a plane of constant z it is a domain, which is looked at straight.
    assert guess_up(Surface(np.stack([x, y, 0 * x], 1), faces), ".obj") == "y"
    assert guess_up(Surface(np.stack([0 * x, x, y], 1), faces), ".obj") == "x"


def test_where_the_shape_says_nothing_files_do():
    ball = sphere(800)
    assert [guess_up(ball, extension) for extension in (".obj", ".off", ".ply", ".stl", "")] == [
        "y",
        "y",
        "y",
        "z",
        "y",
    ]


def test_the_order_of_the_vertices_and_the_size_do_not_matter():
    surface = read_surface(mesh_path("hare"))
    order = np.random.default_rng(0).permutation(len(surface.vertices))
    place = np.argsort(order)
    shuffled = Surface(1e-3 * surface.vertices[order] + 7, place[surface.faces])
    assert guess_up(shuffled, ".obj") == "z"


def test_degenerate_shapes_have_an_answer():
    triangle = Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    needle = Surface([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    point = Surface(np.zeros((3, 3)), [[0, 1, 2]])
    tetrahedron = Surface(np.vstack([np.zeros(3), np.eye(3)]), [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    for surface in (triangle, needle, point, tetrahedron):
        assert guess_up(surface) in ("y", "z", "x", "-y", "-z", "-x")


def test_a_guess_can_be_stopped_between_any_two_steps():
    surface, told = sphere(200), []
    guess_up(surface, progress=lambda share, _: told.append(share))
    assert told == sorted(told)
    assert len(told) > len(DIRECTIONS)
    for stop in range(len(told)):
        left = iter(range(stop))

        def count(share, text, left=left):
            if next(left, None) is None:
                raise Cancelled(text)

        with pytest.raises(Cancelled, match="which way is up"):
            guess_up(surface, progress=count)
