"""The statements of the paper, measured on a mesh, as a table of their numbers and verdicts."""

import csv
import io
from typing import Any

from bihdist_core.analysis.upright import guess_up
from bihdist_core.experiments import EXPERIMENTS, Parts, Shapes
from bihdist_core.experiments.result import CLAIM_COLUMNS

from .jobs import BatchMesh
from .storage import Folder


def write_statements(mesh: BatchMesh, folder: Folder, file: str) -> dict[str, Any]:
    """Measure the statements of the wanted experiments and write the table; return what could not be done."""
    wanted, parts = mesh.wanted, Parts()
    up = wanted.up or parts.do("which way is up", guess_up, mesh.surface, mesh.extension) or "y"
    shapes = Shapes(own=mesh.surface, up=up)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(CLAIM_COLUMNS)
    for id in wanted.experiments:
        result = parts.do(id, EXPERIMENTS[id].compute, shapes, wanted.quick)
        if result is not None:
            writer.writerows(row for claim in result.claims for row in claim.rows())
            for each in result.not_done:
                parts.note(f"{id}, {each.part}", each.reason)
    folder.write(file, text.getvalue().encode())
    return {"up": up, "not_done": [str(each) for each in parts.not_done]}
