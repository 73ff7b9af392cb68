"""Options of `bihdist batch` that would have no effect are refused; those that have one are not."""

import argparse

import pytest

from app.commands import batch
from bihdist_core import write_mesh
from tests.commands import refused
from tests.shapes import torus

EVALUATE = "--do evaluate --maps maps --truth identity"
FROM_SOURCES = "needs --do fields, pairs, nearest or fps."
ALSO_FIGURES = "--sources needs --do fields, pairs, nearest, fps or figure."


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("meshes")
    write_mesh(place / "ring.off", torus(8, 6))
    return place


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--do fields --maps maps", "--maps needs --do evaluate."),
        ("--do fields --truth identity", "--truth needs --do evaluate."),
        ("--do fields --symmetry x.npy", "--symmetry needs --do evaluate."),
        ("--do fields --samples 5", "--samples needs --do evaluate."),
        ("--do fields --recipe x.json", "--recipe needs --do figure."),
        ("--do fields --clim own", "--clim needs --do figure."),
        ("--do fields --clim size", "--clim needs --do figure."),
        ("--do figure --dtype float32", "--dtype needs --do fields, pairs, nearest or eigen."),
        ("--do figure --format zarr", "--format needs --do fields, pairs, nearest, eigen, fps or evaluate."),
        (
            f"{EVALUATE} --k 10",
            "--k needs --do fields, pairs, nearest, eigen, fps or figure.",
        ),
        ("--do fields --k 100", "--k 100 is not a parameter of biharmonic."),
        ("--do nearest,eigen --sources 3,5 --k 10", "--k 10 could count for nearest or for eigen"),
        (
            "--do nearest --sources 3,5 --distance truncated --k 10",
            "say how many eigenpairs truncated has in its words",
        ),
        ("--do fields --layout dist", "--layout needs --do pairs."),
        ("--do figure --normalise area", "--normalise needs --do fields, pairs, nearest, eigen or fps."),
        ("--do fields --labels x.npy", "--labels needs --do pairs."),
        ("--do eigen,figure --mask x.npy", f"--mask {FROM_SOURCES}"),
        ("--do eigen --sources all", ALSO_FIGURES),
        ("--do eigen --sources 3", ALSO_FIGURES),
        ("--do figure --sources all", "Figures have one source"),
        ("--do figure --sources @x.txt", "Figures have one source"),
        ("--do figure --sources random:3", "Figures have one source"),
        ("--do figure --sources 3,5", "Figures have one source"),
        ("--do pairs,figure --labels x.npy --sources 3,5", "Figures have one source"),
        ("--do pairs --labels x.npy --sources all", "--sources has no effect on the means"),
        ("--do pairs --labels x.npy --sources 3", "--sources has no effect on the means"),
        ("--do eigen --format mat --one-based", f"--one-based {FROM_SOURCES}"),
        ("--do fields --one-based", "--one-based goes with --format mat; vertex ids in .npy files count from 0."),
        ("--do fields --format zarr --one-based", "vertex ids in .zarr files count from 0."),
        ("--do pairs --sources all --layout dist --one-based", "--one-based has no effect on --layout dist"),
        ("--do eigen --distance diffusion", "--distance needs"),
        ("--do eigen --method exact", "--method needs"),
        (f"{EVALUATE} --distance geodesic", "--distance needs"),
        ("--do figure --recipe x.json --distance geodesic", "--distance has no effect on figures drawn from a recipe"),
        ("--do figure --recipe x.json --areas barycentric", "--areas has no effect on figures drawn from a recipe"),
        (
            "--do eigen,figure --recipe x.json --distance geodesic",
            "--distance has no effect on figures drawn from a recipe",
        ),
    ],
)
def test_what_would_have_no_effect_is_refused(folder, tmp_path, capsys, words, said):
    assert said in refused(capsys, "batch", folder, "-o", tmp_path / "out", *words.split())
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "words",
    [
        "--do fields,pairs,eigen --sources farthest:400",
        "--do fields,eigen --format mat --one-based",
        "--do fields --sources @{name}.txt --mask {name}.npy",
        "--do nearest --sources all --k 10 --distance diffusion(t=1/4)",
        "--do pairs --labels {name}.npy --mask {name}.npy",
        "--do pairs --sources all --distance geodesic --layout dist --normalise area",
        "--do fields,pairs --labels {name}.npy --sources 3,5",
        "--do pairs,figure --labels {name}.npy --sources 3",
        "--do figure --clim shared --sources 3 --distance diffusion --t 1/4 --areas barycentric",
        "--do figure --recipe x.json --clim own --sources 3",
        "--do fields,figure --recipe x.json --sources 3,5 --distance geodesic",
        "--do eigen,figure --recipe x.json --areas barycentric --k 3",
        "--do fields --sources random:5:0",
        f"{EVALUATE} --symmetry x.npy --samples 10 --areas barycentric",
        f"{EVALUATE} --areas barycentric",
    ],
)
def test_what_has_an_effect_is_not(words):
    parser = argparse.ArgumentParser()
    batch.add_options(parser)
    batch._check_together(parser.parse_args(["meshes", "-o", "out", *words.split()]))


def test_what_is_not_given_is_what_the_help_says():
    parser = argparse.ArgumentParser()
    batch.add_options(parser)
    words = ["meshes", "-o", "out", "--do", "fields,nearest,eigen,figure", "--sources", "random:5"]
    wanted = batch._wanted(parser.parse_args(words))
    assert (wanted.nearest, wanted.eigenpairs, wanted.range, wanted.sources.seed) == (10, 100, "size", 0)
