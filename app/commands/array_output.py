"""Where arrays go that a command writes, and which other command writes their other formats."""

import os
from collections.abc import Sequence

from ..batch.work_order import ARRAYS


def check_array_output(path: str, formats: Sequence[str], work: str) -> str:
    """The extension of an output path, in lower case; OutputError for another than `formats`.

    work: of batches, which writes these arrays in more formats.
    """
    from bihdist_core.errors import OutputError
    from bihdist_core.whole_file import check_output

    extension = os.path.splitext(path)[1].lower()
    if extension not in formats and extension[1:] in ARRAYS:
        raise OutputError(
            f"{path}: {extension} files are written by `bihdist batch --do {work} --format {extension[1:]} -o FOLDER`; "
            f"here the formats are {', '.join(formats)}."
        )
    return check_output(path, formats)
