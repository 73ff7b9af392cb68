"""The verdicts on the page: each statement with its numbers, spread and rule, and an overview."""

from collections.abc import Sequence
from html import escape

import numpy as np

from bihdist_core.experiments import Claim
from bihdist_core.experiments.verdicts import (
    CONFIDENCE,
    FAILS,
    HOLDS,
    MOST,
    PARTLY,
    SPREAD,
    BySource,
    Estimate,
    Limit,
    Numbers,
    Part,
    Verdict,
)

KINDS = {HOLDS: "yes", PARTLY: "partly", FAILS: "no", None: "none"}
"""The style of a verdict."""
SIGNS = {HOLDS: "●", PARTLY: "◐", FAILS: "○", None: "–"}
WORDS = {"paper": "the paper's words", "ours": "our words"}
UNJUDGED = "not judged"
STRIP = (190, 26)
"""Width and height of the picture of a spread."""

HOW = (
    "Each statement has a rule whose limits were set before anything was measured. A number that depends on the "
    "source is taken from the sources in the pictures and from random ones. The statement holds if the limit is met "
    f"from all pictured sources and from at least {100 * MOST:g} % of the random ones, and partly if it is met from "
    "the pictured ones only, or from more than half of the random ones. A statement about all sources (“everywhere”) "
    f"is refuted by one counterexample. Means, ratios and differences are judged with their {100 * CONFIDENCE:g} % "
    f"intervals. A number within {100 * SPREAD:g} % of its limit, and an interval with the limit in it, count as "
    "partly. A statement with several numbers holds if it holds by all of them, and partly if it does by some; it "
    "does not hold if a number marked as needed fails. What is undefined, such as 0/0, is not judged. Times are "
    "processor times. In the last column but one, diamonds are pictured sources, dots are random ones, bars are "
    "intervals, and the shaded range is what the rule allows."
)
QUICK = (
    "These are quick measurements, on smaller meshes and from fewer sources. A verdict is given only where all numbers "
    "are clearly on one side of their limits; timings and other statements that depend on the size are not judged."
)


def chip(verdict: Verdict | None, words: str = "") -> str:
    """Return a verdict as a sign, its words and a colour."""
    return f'<b class="chip {KINDS[verdict]}">{SIGNS[verdict]} {words or verdict or UNJUDGED}</b>'


def counts(claims: Sequence[Claim]) -> str:
    """Count the statements that hold, hold partly and do not hold, in a line."""
    html = []
    for verdict in (HOLDS, PARTLY, FAILS, None):
        count = sum(claim.verdict == verdict for claim in claims)
        if count or verdict is not None:
            html.append(f"<span class=count>{chip(verdict)} <span class=big>{count}</span></span>")
    return f"<p class=counts>{''.join(html)}<span>of {len(claims)} statements</span></p>"


def overview(sections: Sequence[tuple[str, Sequence[Claim]]]) -> str:
    """Return all statements by section, as links with their verdicts."""
    groups = []
    for section, claims in sections:
        if claims:
            items = "".join(
                f'<li><a href="#{_place(section, claim)}"><span class="{KINDS[claim.verdict]}" '
                f'title="{claim.verdict_words}">{SIGNS[claim.verdict]}</span> {escape(claim.text)}</a></li>'
                for claim in claims
            )
            groups.append(f'<div><a href="#{section}">{escape(section)}</a><ul>{items}</ul></div>')
    return f'<div class="overview">{"".join(groups)}</div>' if groups else ""


def statements(section: str, claims: Sequence[Claim]) -> str:
    """Return the statements of a section, each with its verdict, numbers and rule."""
    return "".join(_statement(section, claim) for claim in claims)


def _statement(section: str, claim: Claim) -> str:
    stated = claim.statement
    rows = "".join(_part(part, claim.numbers.get(part.name), claim.quick) for part in stated.parts)
    notes = [escape(claim.note)] if claim.note else []
    if claim.failure:
        notes.insert(0, f"Not measured: {escape(claim.failure)}")
    html = f"<p class=quiet>{' '.join(notes)}</p>" if notes else ""
    if claim.warning:
        html = f"<p class=warning>⚠ {escape(claim.warning)}</p>{html}"
    verdict = chip(claim.verdict, claim.verdict_words)
    return (
        f'<div class="statement {KINDS[claim.verdict]}" id="{_place(section, claim)}"><p>{verdict} '
        f"<span class=text>{escape(claim.text)}</span> <span class=quiet><span class=id>{claim.id}</span>: "
        f"{WORDS[stated.words]}, {escape(stated.where)}</span></p>"
        "<table><tr><th class=what>measured</th><th class=numbers>numbers</th><th class=spread>spread</th>"
        "<th>rule</th></tr>"
        f"{rows}</table>{html}</div>"
    )


def _part(part: Part, numbers: Numbers | None, quick: bool) -> str:
    verdict = part.judge(numbers, quick)
    html = "not measured" if numbers is None else escape(part.formatted(numbers))
    if isinstance(numbers, BySource) and numbers.random:
        html += f" ({part.counts(numbers)[1]} within)"
    strip = "" if numbers is None else _strip(part.limit, numbers)
    needed = " (needed)" if part.needed else ""
    if part.is_close(numbers):
        html += "; within its spread of the limit"
    return (
        f'<tr><td><span class="{KINDS[verdict]}" title="{verdict or UNJUDGED}">{SIGNS[verdict]}</span> '
        f"{escape(part.name)}{needed}</td><td>{_unbroken(html)}</td><td>{strip}</td>"
        f"<td>{_unbroken(escape(part.rule))}</td></tr>"
    )


def _unbroken(text: str) -> str:
    return text.replace(" %", "&nbsp;%")


def _strip(limit: Limit, numbers: Numbers) -> str:
    """Return all numbers along a line with the limit shaded; "" for a single number."""
    if isinstance(numbers, Estimate):
        spots = [numbers.low, numbers.value, numbers.high]
        if len({*spots}) == 1:
            return ""
    else:
        numbers = numbers.known
        spots = [*numbers.pictured, *numbers.random]
        if len(spots) < 2:
            return ""
    shown = [x for x in (*spots, limit.low, limit.high) if np.isfinite(x)]
    if not shown:
        return ""
    # Nearly to scale up to the limit and a little beyond; what is far beyond is drawn together.
    scale = max((abs(x) for x in (limit.low, limit.high) if np.isfinite(x)), default=0) or max(map(abs, shown)) or 1.0
    low, high = (float(np.arcsinh(x / scale)) for x in (min(shown), max(shown)))
    margin = 0.08 * (high - low) or 1.0
    low, high = low - margin, high + margin
    width, height = STRIP
    y = height / 2

    def at(x: float) -> float:
        return round(float(np.clip((np.arcsinh(x / scale) - low) / (high - low), 0, 1)) * width, 1)

    left, right = at(limit.low), at(limit.high)
    drawn = [f'<rect class=allowed x="{left}" y="2" width="{max(right - left, 1.5):g}" height="{height - 4}"/>']
    drawn.append(f'<line class=axis x1="0" x2="{width}" y1="{y:g}" y2="{y:g}"/>')
    if isinstance(numbers, Estimate):
        drawn.append(f'<line class=bar x1="{at(numbers.low)}" x2="{at(numbers.high)}" y1="{y:g}" y2="{y:g}"/>')
        drawn.append(f'<circle class=shown cx="{at(numbers.value)}" cy="{y:g}" r="4"/>')
    else:
        drawn += [f'<circle class=random cx="{at(x)}" cy="{y:g}" r="3"/>' for x in numbers.random]
        drawn += [f'<path class=shown d="M{at(x)} {y - 6:g}l5 6l-5 6l-5 -6z"/>' for x in numbers.pictured]
    return f'<svg class=strip width="{width}" height="{height}" viewBox="0 0 {width} {height}">{"".join(drawn)}</svg>'


def _place(section: str, claim: Claim) -> str:
    return f"{section}--{claim.id}"


STYLE = """
.chip { white-space: nowrap; border-radius: 4px; padding: .1em .5em; font-size: .9em; }
.chip.yes { color: #0a5a45; background: #dff1ea; } .chip.partly { color: #6b4500; background: #fff0cc; }
.chip.no { color: #a01f18; background: #fde6e3; } .chip.none { color: #55606e; background: #eceef1; }
span.yes, a.yes { color: #0a7358; } span.partly, a.partly { color: #7a4f00; } span.no, a.no { color: #b3261e; }
.counts { display: flex; flex-wrap: wrap; gap: 1.6em; align-items: baseline; } .big { font-size: 1.5em; }
.overview { columns: 2; column-gap: 2.5em; font-size: .86em; line-height: 1.35; }
.overview div { break-inside: avoid; margin-bottom: .7em; } .overview a { color: inherit; text-decoration: none; }
.overview div > a { font-weight: 600; } .overview ul { list-style: none; margin: .15em 0; padding: 0; }
.overview li { padding-left: 1.3em; text-indent: -1.3em; margin: .12em 0; }
.overview li a:hover { text-decoration: underline; } @media (max-width: 800px) { .overview { columns: 1; } }
.statement { border-left: 4px solid #c2c8cf; padding: .1em 0 .1em 1em; margin: 1.2em 0; break-inside: avoid; }
.statement.yes { border-color: #0a7358; } .statement.partly { border-color: #d99a00; }
.statement.no { border-color: #b3261e; } .statement p { margin: .3em 0; } .text { font-weight: 600; }
span.id { white-space: nowrap; }
.statement table { font-size: .9em; margin: .2em 0; width: 100%; table-layout: fixed; }
.statement th { font-weight: 400; color: #5b626b; } .statement td:nth-child(4) { color: #5b626b; }
.what { width: 29%; } .numbers { width: 27%; } .spread { width: 205px; }
.warning { color: #7a4f00; }
.strip { display: block; } .strip .allowed { fill: #dff1ea; } .strip .axis { stroke: #c2c8cf; }
.strip .bar { stroke: #1d2125; stroke-width: 2; } .strip .random { fill: #5b626b; fill-opacity: .45; }
.strip .shown { fill: #1d2125; }
"""
