"""`bihdist graph`: biharmonic and resistance distance between the nodes of a graph."""

import argparse
import csv
import re
import sys
from typing import TYPE_CHECKING

from bihdist_core.counts import counted
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import ParameterError

from ..document.lists import split_list
from .options import add_output, as_argument
from .terminal import Facts, Result, accuracy, distance_facts, progress_line, tell

if TYPE_CHECKING:
    from bihdist_core import Distance, Graph
    from bihdist_core.arrays import FloatArray, IntArray

WORDS = "compute biharmonic and resistance distance between nodes of a graph"
EXAMPLES = (
    "bihdist graph roads.csv",
    "bihdist graph roads.csv --pairs Bern:Basel,Bern:Chur --lengths",
    "bihdist graph roads.mtx --edges -o edges.csv",
)
TEXT = ".csv"
RESISTANCE = "resistance"
"""The square of the commute-time distance."""
USUAL = ["biharmonic", RESISTANCE]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `graph` to its parser."""
    formats = "edge list (.csv, .tsv, .txt) with weights if it has a third column, .mtx, .graph, .graphml or .npz"
    parser.add_argument("graph", metavar="GRAPH", help=f"file of a graph: {formats}")
    which = parser.add_mutually_exclusive_group()
    pairs = "pairs of nodes by their names; or a file with a line for each, @FILE"
    which.add_argument("--pairs", metavar="I:J,…|@FILE", type=as_argument(_pairs), help=pairs)
    which.add_argument(
        "--sources",
        metavar="SOURCES",
        type=as_argument(split_list),
        help="the distances of all nodes from these",
    )
    which.add_argument("--edges", action="store_true", help="the distances between the ends of all edges")
    add_output(parser, "a .csv file of the distances (default: standard output)", required=False)
    parser.add_argument(
        "--distance",
        metavar="NAME,…",
        type=as_argument(split_list),
        help="biharmonic, resistance, power(alpha=3) for the k-harmonic one with k = 3, diffusion(t=1/4), "
        "commute-time, truncated(k=50); with commas: a column each (default: biharmonic,resistance)",
    )
    parser.add_argument(
        "--lengths", action="store_true", help="weights are lengths: an edge counts by 1 / weight (default: by weight)"
    )


def run(options: argparse.Namespace) -> Result:
    """Print what the graph is, and write the distances that are asked for."""
    from scipy.sparse.csgraph import connected_components

    from bihdist_core import biharmonic_index, kirchhoff_index, read_graph
    from bihdist_core.distances.answers import Distances
    from bihdist_core.file_output import check_outputs

    check_outputs((options.output if options.output != "-" else None, (TEXT,)))
    graph = read_graph(options.graph)
    for note in graph.notes:
        tell(f"{graph.name}: {note}.")
    graph = graph.with_inverse_weights() if options.lengths else graph
    words = list(dict.fromkeys(options.distance or USUAL))
    chosen = [Spec.parse("commute-time" if word == RESISTANCE else word) for word in words]
    if wrong := next((spec for spec in chosen if spec.word == "geodesic"), None):
        raise ParameterError(f"--distance {wrong} needs faces; a graph has nodes and edges only.")
    with progress_line() as progress:
        laplacian = graph.laplacian()
        size = f"{counted(len(graph.nodes), 'node')}, {counted(graph.n_edges, 'edge')}"
        n_components = int(connected_components(graph.weights)[0])  # with nodes that are joined to no other
        parts = counted(n_components, "component")
        facts: Facts = {"n_nodes": len(graph.nodes), "n_edges": graph.n_edges}
        facts |= {"n_components": n_components, "outputs": [options.output] if options.output else []}
        facts["kirchhoff_index"] = kirchhoff_index(laplacian, progress)
        facts["biharmonic_index"] = biharmonic_index(laplacian, progress)
        distances = Distances(laplacian)
        is_asked = bool(options.pairs or options.sources or options.edges)
        made = [distances.get(spec, progress) for spec in chosen] if is_asked else []
        header, rows = _table(options, graph, made, words) if is_asked else ([], [])
        facts["distances"] = [distance_facts(each, word) for each, word in zip(made, words, strict=is_asked)]
    print(f"{graph.name}: {size}, {parts}")
    print(f"Kirchhoff index {facts['kirchhoff_index']:.10g}, biharmonic index {facts['biharmonic_index']:.10g}")
    for word, each in zip(words, made, strict=is_asked):
        print(f"{word}: {counted(len(rows), 'row')}{accuracy(each)}")
    facts["n_rows"] = len(rows)
    if is_asked:
        _write(options.output, header, rows)
    return Result(facts)


def _table(
    options: argparse.Namespace, graph: "Graph", made: "list[Distance]", words: list[str]
) -> tuple[list[str], list[list[object]]]:
    """Return the header and the rows of what is asked for."""
    import numpy as np

    from bihdist_core.distances.distance import FactoredDistance

    def shown(word: str, values: "FloatArray") -> "FloatArray":
        return values**2 if word == RESISTANCE else values

    if options.sources:
        numbers = [_number(graph, each) for each in options.sources]
        fields = [(word, each.from_sources(numbers)) for word, each in zip(words, made, strict=True)]
        header = [f"{word} from {name}" for word, _ in fields for name in options.sources]
        columns = [column for word, field in fields for column in shown(word, field).T]
        return ["node", *header], [
            [name, *row] for name, row in zip(graph.nodes, zip(*columns, strict=True), strict=True)
        ]
    pairs: IntArray
    if options.edges:
        found = [each.edge_distances() for each in made if isinstance(each, FactoredDistance)]
        if len(found) < len(made):
            raise ParameterError("--edges goes with biharmonic, resistance and commute-time.")
        pairs, columns = found[0][0], [shown(word, values) for word, (_, values) in zip(words, found, strict=True)]
    else:
        pairs = np.array([[_number(graph, end) for end in each] for each in options.pairs])
        columns = [shown(word, each.of_pairs(pairs, digits="all")) for word, each in zip(words, made, strict=True)]
    names = [(graph.nodes[i], graph.nodes[j]) for i, j in pairs.tolist()]
    return ["a", "b", *words], [[*name, *row] for name, row in zip(names, zip(*columns, strict=True), strict=True)]


def _pairs(text: str) -> list[list[str]]:
    """Return the names of both nodes of pairs, A:B,C:D, or those on the lines of a file, A,B or A:B."""
    from bihdist_core.file_content import file_text

    each = file_text(text[1:], "file of pairs").split("\n") if text.startswith("@") else split_list(text)
    found = [re.split("[:,\t]", word.strip()) for word in each if word.strip()]
    if wrong := next((pair for pair in found if len(pair) != 2), None):
        raise ParameterError(f"a pair is two nodes with a colon between, A:B, not {':'.join(wrong)!r}.")
    return found


def _number(graph: "Graph", word: str) -> int:
    """Return the row of a node by its name as a word."""
    is_whole = graph.nodes and isinstance(graph.nodes[0], int) and word.strip().lstrip("-").isdigit()
    number = graph.number(int(word) if is_whole else word)
    if not graph.weights[[number]].nnz:
        raise ParameterError(f"{graph.name}: node {word} is joined to no other, so no distance is defined from it.")
    return number


def _write(output: str | None, header: list[str], rows: list[list[object]]) -> None:
    from bihdist_core.file_output import atomic_write

    if not output:
        csv.writer(sys.stdout, lineterminator="\n").writerows([header, *rows])
        return
    with atomic_write(output) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])
    print(f"{output}: {counted(len(rows), 'row')}")
