"""LaTeX snippets that include a figure at its width, with a caption that says what it shows."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from bihdist_core.distances.answers import Answer, with_unit
from bihdist_core.sentences import with_and
from bihdist_core.sources.source import BoundaryLoop, Curve, Member, Source, SurfacePoint
from bihdist_core.sources.words import short_words_of

from ..document.page import Recipe
from ..document.source_edits import members_of
from ..scene.levels import round_step, steps_to_top
from ..session.questions import source_at
from .description import Figure
from .layout import lay_out
from .size import MM_PER_INCH, UNITS_PER_INCH

MOST_NAMED = 6
"""Most sources of each kind that are named."""

_SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    **{sign: f"\\{sign}" for sign in "&%$#_{}"},
    "−": "$-$",
    "…": r"\dots{}",
    "α": r"$\alpha$",
    "λ": r"$\lambda$",
    "×": r"$\times$",
}


def tex_path(figure: Path) -> Path:
    """Return the path of a figure's snippet."""
    return figure.with_suffix(".tex")


def tex_snippet(figure: Figure, recipe: Recipe, answers: Sequence[Answer], file: Path) -> str:
    """Return a figure environment for a file, to be read with \\input; it needs the package graphicx."""
    layout = lay_out(figure)
    width = layout.width / UNITS_PER_INCH * MM_PER_INCH
    # LaTeX has no way to read SVG; the same name may be there as PDF.
    name = file.stem if file.suffix == ".svg" else file.name
    return (
        "\\begin{figure}\n"
        "  \\centering\n"
        f"  \\includegraphics[width={round(width, 1):g}mm]{{\\detokenize{{{name}}}}}\n"
        f"  \\caption{{{caption(figure, recipe, answers)}}}\n"
        f"  \\label{{fig:{re.sub(r'[^A-Za-z0-9]+', '-', file.stem).strip('-').lower()}}}\n"
        "\\end{figure}\n"
    )


def caption(figure: Figure, recipe: Recipe, answers: Sequence[Answer]) -> str:
    """Return the mesh, the source, and each panel's quantity, unit and range, in LaTeX."""
    document, tops = recipe.document, figure.upper_limits()
    meshes = dict.fromkeys(panel.surface.name for panel in figure.panels)
    surface = figure.panels[0].surface
    sources = [source_at(at, surface) for at in document.sources]
    sentences = [f"{'Distances' if sources else 'Fields'} on {with_and(meshes)}"]
    if sources:
        sentences[0] += f" from {sources_in_words(sources)}"
    parts = []
    for k, shown, top in zip(figure.order, figure.panels, tops, strict=True):
        answer = answers[k]
        if shown.field is None:
            # What is plain, or has colours of its own, is shown as it is meant.
            note = "not shown" if shown.failure else shown.hint
            parts.append(": ".join(words for words in (shown.heading or answer.label, note) if words))
            continue
        low = -top if shown.signed else 0.0
        parts.append(
            f"{shown.heading or answer.label}, {low:.4g} to {top:.4g}{with_unit(shown.unit)}".replace("-", "−")
        )
    sentences.append("; ".join(parts))
    ranges = {"shared": "Panels of one unit share a range", "fraction": "Colours are fractions of each maximum"}
    if figure.range in ranges:
        sentences.append(ranges[figure.range])
    sentences.append(_isolines(figure))
    return escaped(". ".join(sentence[0].upper() + sentence[1:] for sentence in sentences if sentence) + ".")


def _isolines(figure: Figure) -> str:
    """Return the isolines of the panels in words, "" for none and for values that were given."""
    every: dict[str, None] = {}
    equal: dict[str, None] = {}
    for panel, top in zip(figure.panels, figure.upper_limits(), strict=True):
        isolines = panel.isolines
        if panel.field is None or not top > 0 or isolines.values:
            continue
        if isolines.spacing is not None:
            every[f"{isolines.spacing:.4g}{with_unit(panel.unit)}"] = None
        elif isolines.count and isolines.round:
            every[f"{round_step(top, steps_to_top(isolines, panel.signed)):g}{with_unit(panel.unit)}"] = None
        elif isolines.count:
            equal[f"{isolines.count}"] = None
    parts = [f"every {with_and(every)}"] if every else []
    parts += [f"at {with_and(equal)} equal steps"] if equal else []
    return f"Isolines {' and '.join(parts)}" if parts else ""


def sources_in_words(sources: Sequence[Source]) -> str:
    """Return such as "vertices 3 and 7", or "the nearest of vertices 3 and 7 and boundary loop 0"."""
    if all(isinstance(each, int) for each in sources):
        return _members_in_words([each for each in sources if isinstance(each, int)])
    return "; from ".join(
        ("the nearest of " if len(members_of(each)) > 1 else "") + _members_in_words(members_of(each))
        for each in sources
    )


def _members_in_words(members: Sequence[Member]) -> str:
    vertices = [str(each) for each in members if isinstance(each, int)]
    words = [f"{'vertex' if len(vertices) == 1 else 'vertices'} {with_and(_some(vertices))}"] if vertices else []
    return with_and(words + _some([_in_words(each) for each in members if not isinstance(each, int)]))


def _in_words(member: Member) -> str:
    if isinstance(member, SurfacePoint):
        return f"the place {short_words_of(member)}"
    if isinstance(member, BoundaryLoop):
        return f"boundary loop {member.number}"
    if isinstance(member, Curve):
        return short_words_of(member)
    return str(member)


def _some(words: list[str]) -> list[str]:
    """Return a few of them, and how many more there are."""
    return words if len(words) <= MOST_NAMED else [*words[: MOST_NAMED - 1], f"{len(words) - MOST_NAMED + 1} more"]


def escaped(text: str) -> str:
    """Return a text as LaTeX sets it."""
    return "".join(_SPECIAL.get(sign, sign) for sign in text)
