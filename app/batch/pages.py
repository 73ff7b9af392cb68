"""A contact sheet and a page of the figures of a set of meshes."""

import html
from collections.abc import Sequence
from typing import Any
from urllib.parse import quote

from bihdist_core.errors import OutputError, ParameterError

from ..document.json_values import Reader, listed, number, record, shown, text, whole
from ..figures.contact_sheet import SheetEntry, as_jpeg, as_png, contact_sheet, thumbnail
from .storage import Folder
from .task import Failure, ResultRow
from .work_order import OWN, result_name, thumbnail_name

SHEET, PAGE = "contact_sheet.png", "index.html"


_PANEL: dict[str, Reader] = {"shows": text, "maximum": number, "unit": text, "of_set": text}
_FIGURE: dict[str, Reader] = {
    "file": text,
    "range": text,
    "n_vertices": whole,
    "panels": listed(lambda panel, where: _known(panel, where, _PANEL)),
}
"""The metadata of a figure that the page shows."""


def write_pages(folder: Folder, rows: Sequence[ResultRow], failures: Sequence[Failure]) -> list[str]:
    """Write a contact sheet and a page of all figures, with reasons in place of those that are missing; return the
    files.

    Raises ParameterError or OutputError for a figure or metadata that are not as they were written.
    """
    drawn = {row.name: _facts(folder, row) for row in rows if row.work == "figure"}
    missing = {each.name: each.reason for each in failures if each.work == "figure"}
    if not drawn:
        return []
    cells = []
    for name in sorted({*drawn, *missing}):
        if name in missing:
            cells.append(SheetEntry(name, failure=missing[name]))
            continue
        cell = _cell(folder, name, thumbnail_name(name))
        if cell is None:
            cell = _cell(folder, name, drawn[name]["file"])
            if cell is None or cell.picture is None:
                place = f"{folder}/{drawn[name]['file']}"
                raise OutputError(f"{place} is not a picture; run the same command with --verify to draw it again.")
            folder.write(thumbnail_name(name), as_jpeg(cell.picture))
        cells.append(cell)
    words = ends_in_words(list(drawn.values()))
    folder.write(SHEET, as_png(contact_sheet(cells, words)))
    folder.write(PAGE, _page(cells, drawn, words).encode())
    return [SHEET, PAGE]


def _facts(folder: Folder, row: ResultRow) -> dict[str, Any]:
    """Return the metadata of a figure; ParameterError, with the file and the place in it, if they are not ours."""
    name = result_name(row.name, "figure", "")
    try:
        metadata = _known(row.metadata, "figure", _FIGURE)
        if metadata["file"] != f"{name}.png":
            raise ParameterError(f"figure.file must be {name}.png, not {shown(metadata['file'])}.")
        return metadata
    except ParameterError as error:
        reason = str(error).rstrip(".")
        raise ParameterError(
            f"{folder}/{name}.json: {reason}; delete it and run the same command to draw the figure again."
        ) from None


def _known(data: Any, where: str, readers: dict[str, Reader]) -> dict[str, Any]:
    """Return the known values of a record that has others, too."""
    known = {name: data[name] for name in readers if name in data} if isinstance(data, dict) else data
    return record(known, where, readers)


def _cell(folder: Folder, name: str, file: str) -> SheetEntry | None:
    """Return a file as a thumbnail; None if it is missing or not a picture."""
    content = folder.read(file)
    try:
        return None if content is None else SheetEntry(name, thumbnail(content))
    except Exception:  # of whatever reads what is damaged
        return None


def ends_in_words(drawn: Sequence[dict[str, Any]]) -> list[str]:
    """Describe the colour range of each panel, a line each, from the metadata of the figures."""
    metadata = drawn[0]
    if metadata["range"] == OWN:
        return ["Colours end at the maximum on each mesh."]
    return [f"{panel['shows']}: colours end at {panel['of_set']}" for panel in metadata["panels"]]


def _page(cells: Sequence[SheetEntry], drawn: dict[str, dict[str, Any]], words: Sequence[str]) -> str:
    wide = max(cell.picture.width for cell in cells if cell.picture is not None)
    missing = sum(cell.picture is None for cell in cells)
    count = f"{len(cells):,} meshes" + (f", {missing} without a figure" if missing else "")
    parts = {
        "count": count,
        "words": "<br>".join(map(html.escape, words)),
        "figures": "\n".join(_figure(cell, drawn) for cell in cells),
        "wide": f"{round(wide * 0.62)}px",
    }
    text = _HTML
    for name, part in parts.items():
        text = text.replace(f"<!-- {name} -->", part)
    return text


def _figure(cell: SheetEntry, drawn: dict[str, dict[str, Any]]) -> str:
    name = html.escape(cell.name)
    if cell.picture is None:
        return (
            f'<figure><p class="missing">{html.escape(cell.failure)}</p><figcaption><b>{name}</b></figcaption></figure>'
        )
    metadata = drawn[cell.name]
    parts = [
        f"{panel['shows'] if len(metadata['panels']) > 1 else ''} max {panel['maximum']:.4g} {panel['unit']}".strip()
        for panel in metadata["panels"]
    ]
    file, beside = quote(metadata["file"]), quote(f"{result_name(cell.name, 'figure', '')}.json")
    wide, high = cell.picture.size
    return (
        f'<figure><a href="{file}"><img src="{quote(thumbnail_name(cell.name))}" alt="{name}" loading="lazy" '
        f'width="{wide}" height="{high}"></a><figcaption><b>{name}</b> <a href="{beside}">JSON</a><br>'
        f"{metadata['n_vertices']:,} vertices · {html.escape(' · '.join(parts))}</figcaption></figure>"
    )


_HTML = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Distances on <!-- count --></title>
<style>
  :root { color-scheme: light dark; --text: #1D2125; --quiet: #5B626B; --line: #DFE3E7; --accent: #0A7358;
    --error: #B3261E; --error-ground: #FDECEA; --ground: #F6F7F8; }
  body { font: 14px/1.45 system-ui, sans-serif; margin: 0; background: var(--ground); color: var(--text); }
  header { position: sticky; top: 0; background: var(--ground); border-bottom: 1px solid var(--line);
    padding: 12px 24px; display: flex; gap: 8px 24px; align-items: center; flex-wrap: wrap; }
  h1 { font-size: 16px; margin: 0; }
  header p { margin: 0; color: var(--quiet); flex: 1 1 20rem; }
  input { font: inherit; padding: 4px 8px; border: 1px solid var(--line); border-radius: 5px; width: 14rem; }
  main { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(<!-- wide -->, 100%), 1fr)); gap: 16px;
    padding: 24px; }
  figure { margin: 0; display: flex; flex-direction: column; background: #fff; border: 1px solid var(--line);
    border-radius: 6px; overflow: hidden; content-visibility: auto; contain-intrinsic-size: auto 400px; }
  figure[hidden] { display: none; }
  figure > a { flex: 1; display: flex; align-items: center; justify-content: center; background: #fff; padding: 8px; }
  img { max-width: 100%; height: auto; }
  .missing { flex: 1; display: flex; align-items: center; min-height: 8rem; margin: 0; padding: 16px;
    color: var(--error); background: var(--error-ground); }
  figcaption { color: var(--quiet); padding: 8px 12px; border-top: 1px solid var(--line); background: var(--ground);
    overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
  figcaption b { color: var(--text); }
  a { color: var(--accent); }
  @media (prefers-color-scheme: dark) {
    :root { --text: #E8EAED; --quiet: #A6AEB7; --line: #30353B; --accent: #52CFA6; --error: #FF8F86;
      --error-ground: #402322; --ground: #1E2125; }
  }
</style>
<header><h1><!-- count --></h1><p><!-- words --></p>
<input type="search" placeholder="Name contains…" aria-label="Name contains"></header>
<main>
<!-- figures -->
</main>
<script>
  document.querySelector("input").addEventListener("input", (event) => {
    const word = event.target.value.toLowerCase();
    for (const each of document.querySelectorAll("figure"))
      each.hidden = !each.querySelector("b").textContent.toLowerCase().includes(word);
  });
</script>
</html>
"""
