"""The same work on many meshes: what is wanted, the tasks it comes to, where they run and where results go.

From the bottom up: `storage`, folders here or elsewhere; `work_kinds`, a record for each kind of work; `work_order`,
what is to be done with each mesh; `results`, what is there already and files of arrays; `works`, one function each;
`task`, a mesh or a part of one; `execution`, doing it, anywhere; `engines`, processes here or a Dask cluster; `drive`,
from tasks to tables; `pages` and `curves`, all results at once.
"""
