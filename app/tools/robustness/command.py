"""`bihdist perturb`: a mesh with noise, fewer vertices, holes, parts grown together; how far distances change."""

import argparse
from itertools import product
from typing import TYPE_CHECKING

from bihdist_core.counts import counted

from ...commands.mesh import ids_beside, laplacian_of, name_output, outputs_of, sources_on
from ...commands.options import (
    add_distance,
    add_mesh,
    add_output,
    add_repairs,
    add_sources,
    count,
    pair,
    positive,
    repairs_of,
    specs,
)
from ...commands.terminal import Facts, Result, facts_of, progress_line

if TYPE_CHECKING:
    import numpy as np

    from bihdist_core.applications.changes import Runs
    from bihdist_core.distances.distance_types import Spec
    from bihdist_core.laplacian import Laplacian

WORDS = "change a mesh (noise, holes, fewer vertices, a weld, a handle), and see how distances change"
EXAMPLES = (
    "bihdist perturb hand --noise 0.4 -o noisy.ply",
    "bihdist perturb hand --holes 20 --distance biharmonic,geodesic -o holes.ply",
    "bihdist perturb hand --simplify 2000 -o small.ply",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `perturb` to its parser."""
    add_mesh(parser)
    add_sources(parser, "with --distance: where the fields start, one after another")
    add_output(parser, "a .off, .obj, .ply or .vtp file", usual="-perturbed.ply")
    add_distance(parser, "print how much each changes (default: none)")
    add_repairs(parser)
    parser.add_argument(
        "--pose",
        default="",
        metavar="FILE",
        help="move the vertices to another pose: a mesh with the same vertices and faces",
    )
    parser.add_argument("--faces", type=_faces, default=(), metavar="FACES", help="faces to remove, as in 3+10-20")
    parser.add_argument("--simplify", type=count, metavar="N", help="reduce the mesh to N of its vertices")
    parser.add_argument("--noise", type=positive, metavar="S", help="add Gaussian noise of S mean edge lengths")
    parser.add_argument(
        "--along", choices=("xyz", "normals"), default="xyz", help="the direction of --noise (default: xyz)"
    )
    parser.add_argument("--holes", type=count, metavar="N", help="cut N round holes at random vertices")
    parser.add_argument(
        "--radius",
        type=positive,
        default=0.05,
        metavar="R",
        help="the radius of holes, in square roots of the area (default: 0.05)",
    )
    parser.add_argument("--weld", type=pair, metavar="I:J", help="weld the surface at two vertices")
    parser.add_argument("--handle", type=pair, metavar="I:J", help="add a thin tube from one vertex to another")
    parser.add_argument(
        "--seed", type=_seed, default=0, metavar="N", help="the random seed of noise and holes (default: 0)"
    )


def run(options: argparse.Namespace) -> Result:
    """Write a changed mesh, and print how much a distance on it differs."""
    from bihdist_core.applications.changes import Perturbation
    from bihdist_core.applications.perturbation import perturbed
    from bihdist_core.errors import ParameterError
    from bihdist_core.file_output import check_output
    from bihdist_core.formats.surface_output import MESH_FORMATS, write_mesh
    from bihdist_core.laplacian import Laplacian

    from ...samples import mesh_path

    name_output(options)
    check_output(options.output, MESH_FORMATS)
    change = Perturbation(
        pose=mesh_path(options.pose) if options.pose else "",
        cut=options.faces,
        simplify=options.simplify,
        noise=options.noise or 0.0,
        along=options.along,
        holes=options.holes or 0,
        radius=options.radius,
        weld=options.weld,
        handle=options.handle,
        seed=options.seed,
    )
    if change.changes_nothing:
        options_named = "--pose, --faces, --simplify, --noise, --holes, --weld or --handle"
        raise ParameterError(f"Nothing would change; give one of {options_named}.")
    chosen = specs(options, list(dict.fromkeys(options.distance or [])))
    with progress_line() as progress:
        repairs = repairs_of(options, options.mesh)
        before = laplacian_of(options.mesh, repairs=repairs, ids_file=ids_beside(options))
        after, kept = perturbed(before.surface, change, progress)
    write_mesh(options.output, after)
    size = f"{counted(len(after.vertices), 'vertex', 'vertices')}, {counted(len(after.faces), 'face')}"
    print(f"{options.output}: {size}; {change}")
    facts: Facts = {
        "mesh": options.mesh, "outputs": outputs_of(options), "change": str(change), "n_vertices": after.n_vertices,
        "n_faces": after.n_faces,
    }  # fmt: skip
    if chosen:
        facts["fields"] = _print_changes(options, before, Laplacian(after, operator=before.operator), kept, chosen)
    return Result(facts)


def _print_changes(
    options: argparse.Namespace, before: "Laplacian", after: "Laplacian", kept: "np.ndarray", chosen: "list[Spec]"
) -> list[Facts]:
    """Print how far the fields from each source differ, at the vertices that both meshes have, as fractions of
    maxima."""
    from bihdist_core.analysis.diagnostics import field_change
    from bihdist_core.applications.perturbation import image_of
    from bihdist_core.distances.answers import Distances, percent, same_on

    from ...session.questions import vertex_at

    said = []
    with progress_line() as progress:
        one, two, common = Distances(before), Distances(after), kept >= 0
        sources = sources_on(options, before.surface, lambda: one.get(chosen[0], progress), progress).sources
        for source, asked in product(sources, chosen):
            there = image_of(before.surface, kept, vertex_at(source, before.surface), after.surface)
            start = int(kept[there])
            spec = same_on(asked, (one, two), progress)
            old = one.get(spec, progress).from_source(start, progress)[kept[common]]
            new = two.get(spec, progress).from_source(there, progress)[common]
            found = field_change(old, new)
            said.append({"distance": str(spec), "source": start, **facts_of(found)})
            print(
                f"{spec} from {start}: changes by {percent(found.normalised_mean)} of its maximum in the mean, at most "
                f"{percent(found.normalised_largest)}; before each is divided by its own, {percent(found.mean)} and "
                f"{percent(found.largest)}"
            )
    return said


def _faces(text: str) -> "Runs":
    from bihdist_core.applications.changes import runs_from_words

    try:
        return runs_from_words(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a face or a range of faces such as 3+10-20") from None


def _seed(text: str) -> int:
    try:
        seed = int(text)
    except ValueError:
        seed = -1
    if seed < 0:
        raise argparse.ArgumentTypeError(f"{text!r} is not a seed (a whole number from 0)")
    return seed
