"""Names that people use elsewhere for our options, commands and colour maps: taken as ours, or answered by a hint."""

from collections.abc import Collection, Iterable, Mapping
from difflib import get_close_matches

NEAR = 0.8
"""How alike two names are, from 0 to 1, before one is suggested for the other: `figre` and `figure`, not `sphere` and
`hare`."""

OPTION_ALIASES = {
    "color": "cmap",
    "color-map": "cmap",
    "colormap": "cmap",
    "colors": "cmap",
    "colour": "cmap",
    "colour-map": "cmap",
    "colourmap": "cmap",
    "colours": "cmap",
    "distances": "distance",
    "normalize": "normalise",
    "source": "sources",
}
"""Options that are taken as others, both without their dashes."""

OPTION_HINTS = {
    "azimuth": "cpos top",
    "background": "transparent",
    "camera-position": "cpos top",
    "contours": "isolines 20",
    "crease": "feature-angle 40",
    "creases": "feature-edges",
    "dpi": "size 160mm@300dpi",
    "edges": "show-edges",
    "eigenvalues": "k 200",
    "elevation": "cpos top",
    "export": "output",
    "figsize": "size 160x80mm",
    "flip-cmap": "flip-scalars",
    "font": "font-family Arial",
    "fontsize": "font-size 8",
    "height": "size 160x80mm",
    "jobs": "workers",
    "level": "isoline-values 0.1,0.2",
    "levels": "isoline-values 0.1,0.2",
    "limits": "clim 0.8",
    "metric": "distance",
    "modes": "k 200",
    "orthographic": "parallel-projection",
    "processes": "workers",
    "projection": "parallel-projection",
    "range": "clim 0.8",
    "resolution": "size 160mm@300dpi",
    "reverse": "flip-scalars",
    "reversed": "flip-scalars",
    "save": "output",
    "screenshot": "output",
    "shading": "smooth-shading",
    "start": "sources 12",
    "targets": "pairs 12:40",
    "threads": "workers",
    "time": "t 1",
    "tolerance": "merge 1e-6",
    "vertex": "sources 12",
    "up": "viewup z",
    "vertices": "sources 12",
    "view": "cpos top",
    "vmax": "clim 0.8",
    "vmin": "clim 0.8",
    "weld": "merge 1e-6",
    "width": "size 160mm",
    "window-size": "size 1680x640",
    "wireframe": "show-edges",
    "zoom": "insets 12:3",
}
"""What to write instead of an option, where the command has it."""

COMMAND_HINTS = {
    "all-pairs": "pairs",
    "animate": "movie",
    "biharmonic": "field",
    "compare": "statistics",
    "compute": "field",
    "contour": "isolines",
    "contours": "isolines",
    "dist": "field",
    "distance": "field",
    "distances": "field",
    "docs": "guide",
    "draw": "figure",
    "embed": "page",
    "export": "figure",
    "fps": "samples",
    "geodesic": "field",
    "gui": "view",
    "html": "page",
    "image": "figure",
    "levels": "isolines",
    "match": "correspond",
    "matrix": "pairs",
    "nearest": "pairs",
    "open": "view",
    "path": "profile",
    "picture": "figure",
    "plot": "figure",
    "remesh": "perturb",
    "render": "figure",
    "save": "figure",
    "screenshot": "figure",
    "show": "view",
    "simplify": "perturb",
    "stats": "statistics",
    "video": "movie",
    "voronoi": "regions",
    "web": "page",
}
"""The command that does what another word asks for."""

COLOUR_MAPS = {
    "cividis": "safe",
    "coolwarm": "paper",
    "inferno": "ember",
    "magma": "ember",
    "plasma": "ember",
    "puor": "diverging",
    "viridis": "uniform",
}
"""The colour map that is one of Matplotlib's, or the most like it."""


def known_option(name: str, options: Collection[str]) -> str:
    """Return the name by which a command knows an option; names are without their dashes."""
    alias = OPTION_ALIASES.get(name, name)
    return alias if name not in options and alias in options else name


def option_hint(name: str, options: Collection[str]) -> str:
    """Return the option to write instead of an unknown one, perhaps with a value; "" if none is like it."""
    name = name.replace("_", "-")
    if name in OPTION_ALIASES or name in OPTION_HINTS:
        hint = OPTION_ALIASES.get(name) or OPTION_HINTS[name]
        return hint if hint.split()[0] in options else ""
    begun = [each for each in options if each.startswith(name)]
    aliases = (alias for alias, option in OPTION_ALIASES.items() if option in options)
    return begun[0] if begun else known_option(near(name, (*options, *aliases)), options)


def unknown_argument(function: str, name: str, known: Mapping[str, str], group: str = "") -> TypeError:
    """Return the error for an unknown keyword argument, or key of a group of them, with what is probably meant.

    Parameters
    ----------
    function, name, group : str
        The function, the argument or the key, and the argument that has the key.
    known : mapping
        How each argument is written, by the option of commands that means the same, without its dashes.
    """
    hint = known.get(option_hint(name, known).partition(" ")[0])
    end = f"; did you mean {hint}?" if hint else ""
    what = f"an unknown key {name!r} in {group}" if group else f"an unexpected keyword argument {name!r}"
    return TypeError(f"{function}() got {what}{end}")


def near(word: str, known: Iterable[str]) -> str:
    """Return the known word that is most like another, or has the same letters (`hnad`); "" if none is near enough."""
    words = list(dict.fromkeys(known))
    found = get_close_matches(word, words, 1, NEAR) or [each for each in words if sorted(each) == sorted(word)]
    return found[0] if found else ""
