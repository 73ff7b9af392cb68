"""One HTML page that opens without a network: each picture with what the paper says, what was measured, and whether it
holds."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from urllib.parse import quote

from bihdist_core.experiments import Experiment, NotDone, Result, Table

from ..web.export import size_words
from . import verdicts
from .live import LivePage
from .pictures import FINER

LONGEST_TABLE = 24
"""Rows of a table that are shown; all are in its .csv file."""


@dataclass(frozen=True)
class Named:
    """The heading of a section that is not, or not only, an experiment."""

    id: str
    title: str
    shows: str = ""


@dataclass(frozen=True)
class Section:
    """An experiment on the page: its result, pictures (caption, PNG) and charts (SVG), or why there are none.

    `missing` are the parts that could not be done of a section without result, `live` the pages that compute, with
    their bytes, and `html` what else comes before the numbers.
    """

    experiment: "Experiment | Named"
    result: Result | None
    pictures: tuple[tuple[str, bytes], ...] = ()
    charts: tuple[str, ...] = ()
    failure: str = ""
    missing: tuple[NotDone, ...] = ()
    live: tuple[tuple[LivePage, int], ...] = ()
    html: str = ""

    @property
    def not_done(self) -> tuple[NotDone, ...]:
        """The parts that could not be done."""
        if self.failure:
            return (NotDone(self.experiment.title, self.failure),)
        return self.result.not_done if self.result else self.missing


def page(title: str, introduction: str, sections: Sequence[Section], note: str = "") -> str:
    """Return the whole page; `note` is a warning on all verdicts."""
    claims = [(section.experiment.id, section.result.claims if section.result else ()) for section in sections]
    every = [claim for _, those in claims for claim in those]
    missing = [section for section in sections if section.not_done]
    there = " ".join(f'<a href="#{s.experiment.id}">{s.experiment.id}</a>' for s in missing)
    missing_words = f'<p class="no">Some parts could not be done; the reasons are in {there}.</p>' if missing else ""
    links = " · ".join(f'<a href="#{s.experiment.id}">{s.experiment.id}</a>' for s in sections)
    body = "\n".join(_section(section) for section in sections)
    html = ""
    if every:
        how = f"<p>{escape(verdicts.HOW)}</p>" + (f"<p class=warning>⚠ {escape(note)}</p>" if note else "")
        html = f"<h2>Verdicts</h2>{verdicts.counts(every)}{verdicts.overview(claims)}{how}"
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>
<style>{STYLE}{verdicts.STYLE}</style></head><body>
<h1>{escape(title)}</h1>
<p>{escape(introduction)}</p>
{html}
<nav>{links}</nav>
{missing_words}
{body}
</body></html>
"""


def _section(section: Section) -> str:
    experiment, result = section.experiment, section.result
    parts = [f'<section id="{experiment.id}"><h2><span>{experiment.id}</span> {escape(experiment.title)}</h2>']
    parts += [f"<p>{escape(text)}</p>" for text in experiment.shows.split("\n\n")]
    if section.failure:
        return "\n".join([*parts, f'<p class="no">Not done: {escape(section.failure)}</p></section>'])
    if section.not_done:
        html = "".join(f"<li>{escape(str(each))}</li>" for each in section.not_done)
        parts.append(f'<p class="no">Not done:</p><ul class="no">{html}</ul>')
    for caption, picture in section.pictures:
        code = base64.b64encode(picture).decode()
        html = f"<figcaption>{escape(caption)}</figcaption>" if len(section.pictures) > 1 else ""
        # Drawn with more pixels than the page has: shown as wide as it is meant to be.
        wide = f'alt="{escape(caption)}" width="{_width(picture) // FINER}"'
        links = _links([each for each in section.live if each[0].row == caption])
        parts.append(f'<figure>{html}<img {wide} src="data:image/png;base64,{code}">{links}</figure>')
    drawn = [caption for caption, _ in section.pictures]
    parts.append(_links([each for each in section.live if each[0].row not in drawn]))
    parts.append(section.html)
    if section.charts:
        kind = "charts several" if len(section.charts) > 1 else "charts"
        parts.append(f'<div class="{kind}">' + "".join(section.charts) + "</div>")
    if result is None:
        return "\n".join([*parts, "</section>"])
    parts.append(verdicts.statements(experiment.id, result.claims))
    parts += [_table(table) for table in result.tables]
    seconds = f" {result.seconds:.1f} seconds." if result.seconds else ""
    parts.append(f"<p class=quiet>{escape(result.protocol)}{seconds}</p></section>")
    return "\n".join(parts)


def _links(pages: Sequence[tuple[LivePage, int]]) -> str:
    """Return links to pages that compute.

    Frames would take five times the memory, and browsers draw sixteen at most.
    """
    if not pages:
        return ""
    links = " · ".join(
        f'<a href="{quote(page.file)}">{escape(page.mesh)}</a> <span class=quiet>{size_words(size)}</span>'
        for page, size in pages
    )
    left_out = list(dict.fromkeys(words for page, _ in pages for words in page.left_out))
    html = f" <span class=quiet>In the figure only: {escape(', '.join(left_out))}.</span>" if left_out else ""
    return f"<p class=live>Live, from any source that you click: {links}.{html}</p>"


def _width(picture: bytes) -> int:
    """Return the width of a PNG in pixels."""
    return int.from_bytes(picture[16:20], "big")


def _table(table: Table) -> str:
    head = "".join(f"<th>{escape(column)}</th>" for column in table.columns)
    rows = ["".join(_cell(cell) for cell in row) for row in table.rows[:LONGEST_TABLE]]
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    more = len(table.rows) - LONGEST_TABLE
    html = f"<p class=quiet>{more} more rows in the .csv file.</p>" if more > 0 else ""
    return f"<details><summary>{escape(table.heading)}</summary><table><tr>{head}</tr>{body}</table>{html}</details>"


def _cell(cell: str | int | float | None) -> str:
    if cell is None:
        return "<td></td>"
    if isinstance(cell, str):
        return f"<td>{escape(cell)}</td>"
    return f"<td class=number>{cell:,}</td>" if isinstance(cell, int) else f"<td class=number>{cell:.4g}</td>"


STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #21242a; max-width: 1180px; margin: 2em auto; padding: 0 1.5em; }
h1 { font-size: 1.9em; } h2 { margin-top: 2.4em; border-top: 1px solid #dcdfe3; padding-top: 1em; }
h2 span { color: #8a919b; font-weight: normal; margin-right: .4em; }
figure { margin: 1em 0; } img { max-width: 100%; height: auto; display: block; margin: 0 auto; }
figcaption { text-align: center; color: #55606e; }
.charts { display: flex; flex-wrap: wrap; gap: 1em; justify-content: center; } .charts svg { max-width: 100%; }
.several svg { width: 48%; height: auto; }
table { border-collapse: collapse; margin: .8em 0; } th { text-align: left; font-weight: 600; }
td, th { padding: .25em .7em; border-bottom: 1px solid #e8eaed; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
.meshes { display: flex; flex-wrap: wrap; gap: .8em; } .meshes figure { margin: 0; width: 128px; font-size: .8em; }
p.live { text-align: center; } p.live a { color: #1f4fbf; }
p.no { color: #b3261e; font-weight: 600; }
.quiet { color: #737880; font-size: .9em; } details { margin: .4em 0; } summary { cursor: pointer; color: #55606e; }
nav { margin-top: .3em; } nav a { color: #1f4fbf; text-decoration: none; }
@media print { body { max-width: none; font-size: 11px; } details, nav { display: none; } h2 { break-after: avoid; }
  .charts { display: block; text-align: center; } .charts svg { width: 48%; height: auto; }
  figure, .charts svg { break-inside: avoid; } .chip, .allowed { print-color-adjust: exact; } }
"""
