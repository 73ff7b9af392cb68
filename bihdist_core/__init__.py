"""Biharmonic distance on triangle meshes (Lipman, Rustamov, Funkhouser), beside the distances it is compared with.

Arrays in, arrays out; no picture is drawn here.  From the bottom up, each using only what stands before it: `errors`,
`progress`, `file_content`, `file_output`; `solver/`, linear algebra; `surface`; `sources/`, what distances start from;
`formats/`, files; `degenerate_faces`, `operators`, `laplacian`; `distances/`, one each; `analysis/`, what is measured
of them; `applications/`, what is done with them; `experiments/`, the paper's figures and tables, which have no name
here.

The names that `__init__.pyi` lists are imported when they are first asked for, so that a program that needs one of
them does not wait for all.
"""

import lazy_loader

from .version import VERSION as __version__  # noqa: F401

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
