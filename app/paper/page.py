"""One HTML page that opens without a network: each picture with what the paper claims, what was measured, and whether
it holds."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from bihdist_core.experiments import Claim, Experiment, Result, Table

LONGEST_TABLE = 24
"""Rows of a table that are shown; all are in its .csv file."""


@dataclass(frozen=True)
class Named:
    """What stands over a section that is not, or not only, an experiment."""

    id: str
    title: str
    shows: str = ""


@dataclass(frozen=True)
class Section:
    """One experiment on the page: its result, pictures (caption, PNG) and charts (SVG), or why there are none."""

    experiment: "Experiment | Named"
    result: Result | None
    pictures: tuple[tuple[str, bytes], ...] = ()
    charts: tuple[str, ...] = ()
    failure: str = ""


def page(title: str, introduction: str, sections: Sequence[Section]) -> str:
    """The whole page."""
    claims = [claim for section in sections if section.result for claim in section.result.claims]
    held = sum(claim.holds is True for claim in claims)
    judged = sum(claim.holds is not None for claim in claims)
    links = " · ".join(f'<a href="#{s.experiment.id}">{s.experiment.id}</a>' for s in sections)
    body = "\n".join(_section(section) for section in sections)
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style></head><body>
<h1>{escape(title)}</h1>
<p>{escape(introduction)}</p>
<p>Of {judged} statements that a number can judge, {held} hold here. <nav>{links}</nav></p>
{body}
</body></html>
"""


def _section(section: Section) -> str:
    experiment, result = section.experiment, section.result
    parts = [f'<section id="{experiment.id}"><h2><span>{experiment.id}</span> {escape(experiment.title)}</h2>']
    parts += [f"<p>{escape(text)}</p>" for text in experiment.shows.split("\n\n")]
    if section.failure:
        return "\n".join([*parts, f'<p class="no">Not done: {escape(section.failure)}</p></section>'])
    for caption, picture in section.pictures:
        code = base64.b64encode(picture).decode()
        said = f"<figcaption>{escape(caption)}</figcaption>" if len(section.pictures) > 1 else ""
        parts.append(f'<figure>{said}<img alt="{escape(caption)}" src="data:image/png;base64,{code}"></figure>')
    if section.charts:
        parts.append('<div class="charts">' + "".join(section.charts) + "</div>")
    if result is None:
        return "\n".join([*parts, "</section>"])
    if result.claims:
        parts.append("<table class=claims><tr><th>the paper</th><th>measured here</th><th>holds</th></tr>")
        parts += [_claim(claim) for claim in result.claims]
        parts.append("</table>")
    parts += [_table(table) for table in result.tables]
    parts.append(f"<p class=quiet>{escape(result.protocol)} {result.seconds:.1f} seconds.</p></section>")
    return "\n".join(parts)


def _claim(claim: Claim) -> str:
    kind, word = {True: ("yes", "yes"), False: ("no", "no"), None: ("", "–")}[claim.holds]
    return f"<tr><td>{escape(claim.text)}</td><td>{escape(claim.measured)}</td><td class='{kind}'>{word}</td></tr>"


def _table(table: Table) -> str:
    head = "".join(f"<th>{escape(column)}</th>" for column in table.columns)
    rows = ["".join(_cell(cell) for cell in row) for row in table.rows[:LONGEST_TABLE]]
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    more = len(table.rows) - LONGEST_TABLE
    said = f"<p class=quiet>{more} more rows in the .csv file.</p>" if more > 0 else ""
    return f"<details><summary>{escape(table.heading)}</summary><table><tr>{head}</tr>{body}</table>{said}</details>"


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
figure { margin: 1em 0; } img { max-width: 100%; display: block; margin: 0 auto; }
figcaption { text-align: center; color: #55606e; }
.charts { display: flex; flex-wrap: wrap; gap: 1em; justify-content: center; } .charts svg { max-width: 100%; }
table { border-collapse: collapse; margin: .8em 0; } th { text-align: left; font-weight: 600; }
td, th { padding: .25em .7em; border-bottom: 1px solid #e8eaed; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
.yes { color: #1d7a3c; font-weight: 600; } .no { color: #b3261e; font-weight: 600; }
.quiet { color: #737880; font-size: .9em; } details { margin: .4em 0; } summary { cursor: pointer; color: #55606e; }
nav { margin-top: .3em; } nav a { color: #1f4fbf; text-decoration: none; }
@media print { details { display: none; } section { break-inside: avoid; } }
"""
