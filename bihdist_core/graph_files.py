"""Files of graphs: edge lists as CSV, TSV or text, Matrix Market, METIS, GraphML, and SciPy's sparse .npz."""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Callable, Hashable, Sequence
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import scipy.io
import scipy.sparse as sp

from .arrays import FloatArray, IntArray
from .counts import counted
from .errors import ParameterError
from .file_content import file_text
from .formats.whole_numbers import numbered_lines
from .graphs import Graph, joined
from .sentences import shortened

Edges = tuple[Sequence[Hashable], IntArray, IntArray, FloatArray]
"""The nodes, and of each edge the numbers of its ends, and its weight."""

_COMMENT = re.compile(r"^[ \t]*[#%].*\n?", re.MULTILINE)


def read_graph(path: str | os.PathLike[str]) -> Graph:
    """Read an undirected graph.

    Parameters
    ----------
    path : path
        An edge list (``.csv``, ``.tsv``, ``.txt``, ``.edges``, ``.edgelist``): two names of nodes on each line and, if
        there is a third column, the weight; a first line of headings is left out, and so are lines that begin with # or
        %.  Matrix Market (``.mtx``), METIS (``.graph``, ``.metis``), GraphML (``.graphml``), or a sparse matrix of
        weights by SciPy (``.npz``).

    Returns
    -------
    Graph
        Nodes of an edge list have the names there, as whole numbers if all are; those of other files are numbered as
        their format does, from 1, or by the names in GraphML.

    Raises
    ------
    ParameterError
        For a file that cannot be read; the message names the line or the edge.

    Examples
    --------
    >>> import bihdist, pathlib
    >>> _ = pathlib.Path("roads.csv").write_text("from,to,weight\\nA,B,2\\nB,C,1\\n")
    >>> graph = bihdist.read_graph("roads.csv")
    >>> graph.nodes, graph.n_edges
    (['A', 'B', 'C'], 2)
    """
    path = Path(path)
    reader = GRAPH_READERS.get(path.suffix.lower())
    if reader is None:
        raise ParameterError(f"{path} is not a file of a graph; such files are {', '.join(GRAPH_READERS)}.")
    nodes, i, j, weight = reader(path)
    if not len(i):
        raise ParameterError(f"{path} has no edge.")
    loops = int((np.asarray(i) == np.asarray(j)).sum())
    notes = [f"{counted(loops, 'loop')} left out"] if loops else []
    return Graph(joined(i, j, weight, nodes, path.name), nodes, path.name, notes)


def _read_list(path: Path) -> Edges:
    text = file_text(path, "graph")
    bare = _COMMENT.sub("", text).lstrip()
    first, _, rest = bare.partition("\n")
    mark = next((mark for mark in ";\t," if mark in first), None)  # a comma last, as it may be a decimal one
    table = _numbers(bare, mark)
    if table is None and _numbers(first, mark) is None:
        table = _numbers(rest, mark)  # the first line may be headings
    if table is None or table.shape[1] < 2 or (table[:, :2] != np.rint(table[:, :2])).any():
        return _named(text, mark, path)
    nodes, ends = np.unique(table[:, :2].astype(np.int64), return_inverse=True)
    i, j = ends.reshape(-1, 2).T
    return nodes.tolist(), i, j, table[:, 2] if table.shape[1] > 2 else np.ones(len(table))


def _numbers(text: str, mark: str | None) -> FloatArray | None:
    """Return the lines (e, k) of numbers; None for any other text."""
    try:
        return np.loadtxt(io.StringIO(text), delimiter=mark, ndmin=2) if text.strip() else None
    except ValueError:
        return None


def _named(text: str, mark: str | None, path: Path) -> Edges:
    number: dict[str, int] = {}
    rows: list[tuple[int, int, float]] = []
    is_first, has_weights = True, False
    for place, line in numbered_lines(text):
        if line.startswith(("#", "%")):
            continue
        words = [word.strip() for word in (next(csv.reader([line], delimiter=mark)) if mark else line.split())]
        has_headings, is_first = is_first and {word.lower() for word in words[:2]} <= HEADINGS, False
        if has_headings:
            continue
        if len(words) < 2 or not all(words[:2]):
            raise ParameterError(f"{path}, line {place}: an edge has two nodes, and here is {shortened(line, 40)!r}.")
        try:
            weight = float(words[2]) if len(words) > 2 else 1.0
        except ValueError:
            shown = shortened(repr(words[2]), 40)
            raise ParameterError(f"{path}, line {place}: the weight {shown} is not a number.") from None
        has_weights = len(words) > 2 if not rows else has_weights
        if has_weights != (len(words) > 2):
            raise ParameterError(
                f"{path}, line {place} has {'no' if has_weights else 'a'} weight, unlike lines before."
            )
        i, j = (number.setdefault(word, len(number)) for word in words[:2])
        rows.append((i, j, weight))
    return list(number), *_columns(rows)


def _columns(rows: list[tuple[int, int, float]]) -> tuple[IntArray, IntArray, FloatArray]:
    i, j, weights = zip(*rows, strict=True) if rows else ([], [], [])
    return np.array(i, np.int64), np.array(j, np.int64), np.array(weights, float)


HEADINGS = {"source", "target", "from", "to", "i", "j", "u", "v", "node1", "node2", "start", "end"}
"""Words that head the columns of nodes, both in a first line."""


def _read_market(path: Path) -> Edges:
    try:
        matrix = sp.coo_matrix(scipy.io.mmread(path))
    except (ValueError, OSError, TypeError) as error:
        raise ParameterError(f"{path} cannot be read as Matrix Market: {error}") from None
    return _of_matrix(matrix, path, 1)


def _read_npz(path: Path) -> Edges:
    try:
        matrix = sp.coo_matrix(sp.load_npz(path))
    except (ValueError, OSError, KeyError) as error:
        raise ParameterError(f"{path} is not a sparse matrix of SciPy: {error}") from None
    return _of_matrix(matrix, path, 0)


def _of_matrix(matrix: sp.coo_matrix, path: Path, first: int) -> Edges:
    n, columns = matrix.shape
    if n != columns or matrix.dtype.kind not in "biuf":
        raise ParameterError(f"{path}: the weights of a graph are a real (n, n) matrix, not {matrix.shape}.")
    there = matrix.data != 0
    return range(first, n + first), matrix.row[there], matrix.col[there], matrix.data[there].astype(float)


def _read_metis(path: Path) -> Edges:
    lines = [line.split() for line in _COMMENT.sub("", file_text(path, "graph")).split("\n")]
    if not any(lines):
        raise ParameterError(f"{path} has no edge.")
    try:
        n, count, *form = map(int, lines[0])
        kind = f"{form[0] if form else 0:03d}"
        skipped = (kind[0] == "1") + (kind[1] == "1") * (form[1] if len(form) > 1 else 1)
        step = 2 if kind[2] == "1" else 1
        rows = [np.array(line, float)[skipped:] for line in lines[1 : n + 1]]
        j = np.concatenate([row[::step] for row in rows]).astype(np.int64) - 1
        weight = np.concatenate([row[1::step] if step == 2 else np.ones(len(row)) for row in rows])
    except (ValueError, IndexError) as error:
        raise ParameterError(f"{path} is not a graph of METIS: {error}") from None
    i = np.repeat(np.arange(n), [len(row) // step for row in rows] + [0] * (n - len(rows)))
    wrong = j[(j < 0) | (j >= n)]
    if len(wrong):
        raise ParameterError(f"{path}: an edge ends at node {wrong[0] + 1}; nodes are numbered from 1 to {n}.")
    if len(j) != 2 * count:
        raise ParameterError(
            f"{path} says that it has {counted(n, 'node')} and {counted(count, 'edge')}, and lists {len(j) / 2:,g}."
        )
    return range(1, n + 1), i, j, weight


def _read_graphml(path: Path) -> Edges:
    text = file_text(path, "graph")
    if "<!ENTITY" in text:
        raise ParameterError(f"{path} defines XML entities, which files of graphs do not.")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise ParameterError(f"{path}, line {error.position[0]}: this is not XML ({error}).") from None
    space = root.tag.partition("}")[0] + "}" if root.tag.startswith("{") else ""
    keys = {each.get("id") for each in root.iter(f"{space}key") if each.get("attr.name") == "weight"}
    number = {each.get("id", ""): k for k, each in enumerate(root.iter(f"{space}node"))}
    rows = []
    for edge in root.iter(f"{space}edge"):
        ends = [edge.get(name, "") for name in ("source", "target")]
        if missing := next((end for end in ends if end not in number), None):
            raise ParameterError(f"{path}: an edge ends at {missing!r}, which is no node.")
        words = [data.text or "" for data in edge.iter(f"{space}data") if data.get("key") in keys]
        try:
            rows.append((number[ends[0]], number[ends[1]], float(words[0]) if words else 1.0))
        except ValueError:
            raise ParameterError(f"{path}: the weight {words[0]!r} from {ends[0]} to {ends[1]} is no number.") from None
    return list(number), *_columns(rows)


GRAPH_READERS: dict[str, Callable[[Path], Edges]] = {
    **dict.fromkeys((".csv", ".tsv", ".txt", ".edges", ".edgelist"), _read_list),
    ".mtx": _read_market,
    **dict.fromkeys((".graph", ".metis"), _read_metis),
    ".graphml": _read_graphml,
    ".npz": _read_npz,
}
"""The readers by extension."""
