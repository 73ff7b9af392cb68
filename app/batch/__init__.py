"""Batches: the same work on many meshes, as tasks, where they run and where their results go.

From the bottom up: `storage`, folders here or elsewhere; `work_order`, the kinds of work and
what is to be done with each mesh; `results`, files of arrays and their metadata; `jobs`, a function for each kind of
work; `task`, a mesh or a part of a large one; `execution`, running a task, anywhere; `engines`, processes here or a
Dask cluster; `mesh_files` and `scheduler`, from meshes to an outcome; `tables`, `pages` and `curves`, all results.
"""
