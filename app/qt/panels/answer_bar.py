"""What a panel's colour bar says of the answer that is shown."""

import numpy as np

from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer

from ...scene.bands import beyond
from ...scene.panel_scene import PanelScene
from ..look.numbers import number
from .colour_bar import ColourBar


def show_answer(bar: ColourBar, answer: Answer, scene: PanelScene, edges: FloatArray, in_shares: bool) -> None:
    """Show the range of an answer with a field as a scene draws it, and a remark.

    edges: (k,) fractions of the maximum at which bands of colour end; in_shares: ticks are fractions of the maximum.
    """
    top, style, signed, lines = scene.maximum, scene.style, answer.is_signed, scene.levels
    edges = edges if style.bands else np.empty(0)
    bar.show_range(
        style.band_colours(edges, signed) if len(edges) else style.colours(signed=signed),
        -top if signed else 0.0,
        top,
        lines.values,
        answer.unit,
        signed,
        style.line(signed),
        maximum=answer.maximum,
        rest=(style.line(signed, 1.0), style.rim(signed, 1.0)) if signed else None,
        bands=(edges + 1) / 2 if signed else edges,
        beyond=beyond(answer.field, top, signed),
        in_shares=in_shares,
        bold=lines.values[lines.is_bold],
        through=lines.values[lines.is_through],
        through_colours=(style.source, style.mark_edge),
    )
    bar.show_shares(not signed)
    if answer.signs:
        sentence = answer.largest_words
        bar.show_note(sentence, sentence.partition(" of its maximum" if " % " in sentence else " at vertex")[0])
    elif answer.field is not None and answer.largest is not None:
        value = float(answer.field[answer.largest])
        bar.show_note(f"largest {number(value, signed=True)} at vertex {answer.largest}")
    else:
        bar.show_note(f"no isolines: {lines.wanted:,} are too many" if scene.too_many else "")
