"""The paper's statements over many meshes, on one page with a strip of all of them."""

import base64
import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path

import numpy as np

from bihdist_core.errors import ParameterError
from bihdist_core.experiments import EXPERIMENTS, Claim, NotDone, Result
from bihdist_core.experiments.result import STATEMENTS
from bihdist_core.experiments.verdicts import FAILS, MOST, PARTLY, VERDICTS, BySource, Statement
from bihdist_core.file_output import atomic_write

from .page import Named, Section, page
from .verdicts import KINDS, SIGNS

PAGE = "index.html"
NAMED = 12
"""Meshes that are named at most, of those on which a statement does not hold, or partly."""


@dataclass(frozen=True)
class MeshStatements:
    """The rows of a mesh's table of statements, its thumbnail (JPEG, or b""), and what could not be done."""

    rows: Sequence[Mapping[str, str]]
    thumbnail: bytes
    not_done: Sequence[str] = ()

    @classmethod
    def from_table(cls, table: bytes, thumbnail: bytes, not_done: Sequence[str] = ()) -> "MeshStatements":
        """Return those of a table that a batch has written."""
        return cls([*csv.DictReader(io.StringIO(table.decode()))], thumbnail, not_done)

    @property
    def verdicts(self) -> dict[str, str]:
        """The verdicts, "" for none, by the statements' ids."""
        return {row["id"]: row["verdict"] for row in self.rows}


class ClaimOverMeshes(Claim):
    """A statement of which each mesh has one number of each part: a mesh counts as a source does on one mesh."""

    @property
    def statement(self) -> Statement:
        """The statement with the same limits, over meshes."""
        stated = STATEMENTS[self.id]
        parts = (replace(p, by="everywhere" if p.by == "everywhere" else "sources", of="meshes") for p in stated.parts)
        return replace(stated, parts=tuple(parts))


def over_meshes(ids: Sequence[str], meshes: Mapping[str, MeshStatements], quick: bool = False) -> list[Result]:
    """Return the experiments of these ids with their statements over all meshes, by their names."""
    return [
        Result(
            id,
            EXPERIMENTS[id].title,
            f"{len(meshes):,} meshes.",
            claims=tuple(_claim(each, meshes, quick) for each in STATEMENTS if each.partition("-")[0] == id),
        )
        for id in ids
    ]


def _claim(id: str, meshes: Mapping[str, MeshStatements], quick: bool) -> Claim:
    numbers: dict[str, BySource] = {}
    for part in STATEMENTS[id].parts:
        # The number from the picture's source, or the worst one of what a single source refutes.
        column = "high" if part.by == "everywhere" else "number"
        cells = [
            row[column] for mesh in meshes.values() for row in mesh.rows if (row["id"], row["part"]) == (id, part.name)
        ]
        if found := tuple(float(cell) for cell in cells if cell):
            numbers[part.name] = BySource((), found)
    judged = {name: mesh.verdicts.get(id, "") for name, mesh in meshes.items()}
    words = []
    for verdict in (*VERDICTS, ""):
        those = [name for name, each in judged.items() if each == verdict]
        if those:
            more = f" and {len(those) - NAMED} more" if len(those) > NAMED else ""
            named = f" ({', '.join(those[:NAMED])}{more})" if verdict in (PARTLY, FAILS) else ""
            words.append(f"{verdict or 'not judged'} on {len(those)}{named}")
    note, failure = f"Mesh by mesh: {'; '.join(words)}.", "" if numbers else "No mesh has it."
    return ClaimOverMeshes(id, numbers, note, failure=failure, quick=quick)


def write_page(folder: Path, about: str, ids: Sequence[str], meshes: Mapping[str, MeshStatements], quick: bool) -> Path:
    """Write index.html into a folder, with the experiments of these ids; `about` says whose meshes they are."""
    if not meshes:
        raise ParameterError("No mesh could be measured.")
    missing = tuple(NotDone(name, reason) for name, mesh in meshes.items() for reason in mesh.not_done)
    named = Named(
        "all", "All meshes", "Biharmonic distance from each mesh's highest vertex, and how many statements hold."
    )
    sections = [
        Section(named, None, missing=missing, html=strip(meshes)),
        *(Section(EXPERIMENTS[result.id], result) for result in over_meshes(ids, meshes, quick)),
    ]
    introduction = (
        "The statements of Lipman, Rustamov and Funkhouser, Biharmonic Distance (ACM Transactions on Graphics 29(3), "
        f"2010), measured on {about}. Meshes take the place of sources: each counts once, with its number from the "
        f"pictured source, and a statement holds if its limit is met on {100 * MOST:g} % of them. The numbers of each "
        "mesh are in NAME.statements.csv next to this page."
    )
    note = (
        "These are quick measurements; statements that depend on the sizes of the meshes are not judged."
        if quick
        else ""
    )
    with atomic_write(folder / PAGE) as temporary:
        temporary.write_text(
            page("Biharmonic Distance, on many meshes", introduction, sections, note if quick else ""), encoding="utf-8"
        )
    return folder / PAGE


def strip(meshes: Mapping[str, MeshStatements]) -> str:
    """Return all meshes side by side, each with the numbers of its verdicts."""
    figures = []
    for name, mesh in meshes.items():
        code = base64.b64encode(mesh.thumbnail).decode()
        image = f'<img alt="" src="data:image/jpeg;base64,{code}">' if code else ""
        counted = np.array([[each == verdict for verdict in VERDICTS] for each in mesh.verdicts.values()]).sum(axis=0)
        counts = " ".join(
            f'<span class="{KINDS[verdict]}">{SIGNS[verdict]} {count}</span>'
            for verdict, count in zip(VERDICTS, counted.tolist(), strict=True)
        )
        figures.append(f"<figure>{image}<figcaption>{escape(name)}<br>{counts}</figcaption></figure>")
    return f'<div class="meshes">{"".join(figures)}</div>'
