"""The project's own sample meshes: sculptures described by named parts, and the steps that make meshes of them.

`python -m assets.modelling` rebuilds them all, `python -m assets.modelling.sheet` draws them.
"""
