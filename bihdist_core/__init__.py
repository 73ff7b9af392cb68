"""Biharmonic distance on triangle meshes (Lipman, Rustamov, Funkhouser), beside the distances it is compared with.

Arrays in, arrays out; no picture is drawn here.  From the bottom up, each module using only what stands before it:
errors, progress, blas; surface, mesh_io; operators; ordering, elimination_tree, factor; spectrum; laplacian;
distance and one module per distance; sampling, interpolation, correspondence, isoline_tracing, persistence,
diagnostics.  `bihdist_core.experiments`, which has no name here, computes the paper's figures and tables.

The names that `__init__.pyi` lists are imported when they are first asked for, so that a program that needs one of
them does not wait for all.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
