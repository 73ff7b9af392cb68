"""The viewer, the figures, the command line, and the library under one name: `import bihdist`.

From the bottom up, each folder using only what stands before it: `document` (what is shown, as data), `session` (what
is open, asked and answered), `scene` (VTK and PyVista), `figures` (and movies), `web` (pages that compute),
`paper` (the paper's figures on one page), `qt` (the window), `commands` (the command line).

In a checkout this folder is called `app`; installed it is the package `bihdist`.  The library's names are those of
`bihdist_core`, imported when they are first asked for, with `figure` and `figure_again`, which draw, `page`, which
writes a page that computes, `widget`, which shows one in a notebook, `show`, which opens the window, and `sample`, a
mesh to try all of it on.
"""

TYPE_CHECKING = False
if TYPE_CHECKING:
    import bihdist_core as _library
    from bihdist_core import *  # noqa: F403

    from .figures.arguments import (
        IsolineOptions as IsolineOptions,
        LayoutOptions as LayoutOptions,
        LookOptions as LookOptions,
        MarkOptions as MarkOptions,
        ViewOptions as ViewOptions,
    )
    from .figures.picture import figure as figure, figure_again as figure_again
    from .qt.show import show as show
    from .samples import sample as sample
    from .web.page import page as page
    from .web.widget import widget as widget

    __version__: str

    # In two steps, which type checkers follow.
    __all__ = ["IsolineOptions", "LayoutOptions", "LookOptions", "MarkOptions", "ViewOptions"]
    __all__ += ["figure", "figure_again", "page", "sample", "show", "widget"]
    __all__ += _library.__all__

_OWN = {
    **dict.fromkeys(
        ("IsolineOptions", "LayoutOptions", "LookOptions", "MarkOptions", "ViewOptions"), "figures.arguments"
    ),
    "figure": "figures.picture",
    "figure_again": "figures.picture",
    "page": "web.page",
    "sample": "samples",
    "show": "qt.show",
    "widget": "web.widget",
}
"""Where the program's own names are defined."""


def __getattr__(name: str) -> object:
    # Nothing is imported above: before the program listens for Ctrl-C, that would be answered by a page of code.
    from importlib import import_module

    if name == "show":
        from .qt.screen import check_libraries

        check_libraries()
    if name in _OWN:
        return getattr(import_module(f".{_OWN[name]}", __name__), name)
    if name == "__version__":
        from .version import version

        return version()
    import bihdist_core

    if name == "__all__":
        return __dir__()
    if name in bihdist_core.__all__:
        from .version import warn_of_disagreement

        warn_of_disagreement()
        return getattr(bihdist_core, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    import bihdist_core

    return sorted([*_OWN, *bihdist_core.__all__])
