"""What the gallery shows of an example: pictures that it has saved in its folder, then figures of matplotlib."""

import shutil
from pathlib import Path
from typing import Any

from sphinx_gallery.scrapers import figure_rst, matplotlib_scraper

from .blocks import PICTURES

_seen: dict[Path, int] = {}
"""Pictures that have been shown, with their times; examples run one after the other, and none is there before."""


def saved_pictures(block: Any, variables: dict[str, Any], conf: dict[str, Any]) -> str:
    """The directives that show what a block of an example has drawn."""
    folder, rst = Path(variables["src_file"]).parent, ""
    times = {path: path.stat().st_mtime_ns for path in folder.iterdir() if path.suffix.lower() in PICTURES}
    for path in sorted((path for path in times if _seen.get(path) != times[path]), key=lambda path: times[path]):
        _seen[path] = times[path]
        place = Path(next(variables["image_path_iterator"])).with_suffix(path.suffix.lower())
        shutil.copyfile(path, place)
        rst += figure_rst([str(place)], conf["src_dir"], path.stem)
    return rst + str(matplotlib_scraper(block, variables, conf))
