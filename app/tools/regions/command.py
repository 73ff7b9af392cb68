"""`bihdist regions`: which part of a mesh is nearest to each of some vertices, into files."""

import argparse

from bihdist_core.counts import counted

from ...commands.mesh import ids_beside, read_laplacian, sources_on
from ...commands.options import add_areas, add_distance, add_mesh, add_output, add_sources, specs
from ...commands.terminal import Result, accuracy, distance_facts, progress_line

WORDS = "divide a mesh into the parts nearest to each of some vertices"
EXAMPLES = (
    "bihdist regions hand --sources 12,400,900 -o labels.npy",
    "bihdist regions hand --sources farthest:12 -o labels.csv --boundaries lines.obj",
    "bihdist regions hand --sources farthest:12 --region-mesh parts.ply",
)
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `regions` to its parser."""
    add_mesh(parser)
    what = "vertices that get a region each, numbered from 1 or by the ids of pins"
    add_sources(parser, what, default="", required=True, are_vertices=True)
    add_output(parser, "write the number of each vertex's region: a .npy, .csv, .ply or .vtp file", required=False)
    parser.add_argument(
        "--boundaries", metavar="OUT", help="write the boundaries of the regions: a .csv, .obj, .vtp or .json file"
    )
    parser.add_argument(
        "--region-mesh", metavar="OUT", help="write the mesh cut along the boundaries: a .ply or .vtp file"
    )
    add_distance(parser)
    add_areas(parser)


def run(options: argparse.Namespace) -> Result:
    """Write which of some vertices each vertex is nearest to, and print the areas of the regions."""
    from bihdist_core.analysis.region_boundaries import region_boundaries, write_boundaries
    from bihdist_core.analysis.region_mesh import (
        LABEL_FORMATS,
        REGION_MESH_FORMATS,
        region_mesh,
        write_labels,
        write_region_mesh,
    )
    from bihdist_core.analysis.regions import voronoi_regions
    from bihdist_core.distances.answers import Distances
    from bihdist_core.errors import ParameterError
    from bihdist_core.file_output import check_outputs
    from bihdist_core.formats.curve_output import CURVE_FORMATS
    from bihdist_core.formats.pins import Pins

    if not check_outputs(
        (options.output, LABEL_FORMATS),
        (options.region_mesh, REGION_MESH_FORMATS),
        (options.boundaries, CURVE_FORMATS),
    ):
        raise ParameterError("There is nothing to write; name a file with -o, --boundaries or --region-mesh.")
    (chosen,) = specs(options, [options.distance])
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        surface = laplacian.surface
        distance = Distances(laplacian).get(chosen, progress)
        found = sources_on(options, surface, lambda: distance, progress)
        pins = found.pins or Pins.of(surface, found.vertices("Regions"))
        columns = distance.from_sources(pins.vertices, progress)
        regions = voronoi_regions(surface, columns)
        estimate = accuracy(distance)
    ids = pins.ids.tolist()
    if options.output:
        write_labels(options.output, surface, regions, ids)
        print(f"{options.output}: {counted(len(pins), 'region')} by {distance.label}{estimate}")
    if options.region_mesh:
        mesh = region_mesh(surface, columns)
        write_region_mesh(options.region_mesh, mesh, ids)
        print(f"{options.region_mesh}: {counted(len(mesh.surface.faces), 'face')}")
    if options.boundaries:
        curves = region_boundaries(surface, regions)
        write_boundaries(options.boundaries, curves, ids)
        print(f"{options.boundaries}: {counted(len(curves), 'curve')}, together {regions.lengths.sum():.6g} long")
    total = surface.face_areas.sum()
    parts = []
    for id, name, vertex, area in zip(ids, pins.names, pins.vertices.tolist(), regions.areas.tolist(), strict=True):
        parts.append({"pin": id, "name": name, "vertex": vertex, "area": area, "area_fraction": area / total})
        print(f"pin {id}{f', {name}' if name else ''}, vertex {vertex}: area {area:.6g}, {area / total:.1%}")
    files = (options.output, ids_beside(options), options.region_mesh, options.boundaries)
    facts = {
        "mesh": options.mesh,
        **distance_facts(distance, chosen),
        "outputs": [file for file in files if file],
        "boundary_length": regions.lengths.sum(),
        "regions": parts,
    }
    return Result(facts)
