"""Nearest vertices written to files that other programs read."""

import json
import os
from collections.abc import Mapping

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..formats.field_output import write_array
from ..whole_file import check_output, whole_file

NEIGHBOUR_FORMATS = (".csv", ".npy", ".npz", ".json")


def write_nearest(
    path: str | os.PathLike[str],
    sources: IntArray,
    indices: IntArray,
    distances: FloatArray,
    facts: Mapping[str, object],
) -> None:
    """Write the neighbours (s, k) of vertices (s,) and how far they are (s, k); the extension names the format.

    .csv: a line `i,j,distance` for each neighbour j of a vertex i, nearest first; those that are not there are left
          out.  .npy: these lines as (q, 3) float64.
    .npz: `sources`, `indices` (-1 for none), `distances` (NaN for none), and the texts of `facts`.
    .json: {facts, "neighbours": [{"vertex", "indices", "distances"}, ...]}.

    Raises OutputError if the file cannot be written; what was there then stays.
    """
    extension = check_output(path, NEIGHBOUR_FORMATS)
    if not len(sources) == len(indices) == len(distances):
        raise ParameterError(f"{len(sources):,} vertices have neighbours of {len(indices):,}; they need as many.")
    is_there = indices >= 0
    if extension in (".csv", ".npy"):
        of_each = np.broadcast_to(np.asarray(sources)[:, None], indices.shape)
        table = np.column_stack([of_each[is_there], indices[is_there], distances[is_there]])
        write_array(path, table, ["i", "j", "distance"])
        return
    with whole_file(path) as temporary, temporary.open("wb") as file:
        if extension == ".npz":
            texts = {name: np.array(str(fact)) for name, fact in facts.items()}
            np.savez(file, **{**texts, "sources": sources, "indices": indices, "distances": distances})  # type: ignore[arg-type]
            return
        lines = ",\n".join(
            json.dumps({"vertex": vertex, "indices": found[there].tolist(), "distances": away[there].tolist()})
            for vertex, found, away, there in zip(sources.tolist(), indices, distances, is_there, strict=True)
        )
        text = json.dumps(dict(facts), indent=1, ensure_ascii=False)
        file.write(f'{text.removesuffix("}").rstrip()},\n "neighbours": [\n{lines}\n]}}\n'.encode())
