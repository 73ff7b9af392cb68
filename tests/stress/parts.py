"""The parts of a run, each a module with its words for the table and a function `case(seed, number, folder)`.

SEEDS: how many blocks the recorded run has; BLOCK: the cases of a block; SECONDS: of processor time for a case.
"""

from types import ModuleType

from . import (
    accuracy,
    broken_meshes,
    cancellations,
    documents,
    field_files,
    fields,
    hands,
    interruptions,
    mesh_files,
    soak,
)

_MODULES: tuple[ModuleType, ...] = (mesh_files, field_files, documents, broken_meshes, accuracy, fields)
_MODULES += (interruptions, cancellations, hands, soak)
PARTS: dict[str, ModuleType] = {module.__name__.rpartition(".")[2]: module for module in _MODULES}
