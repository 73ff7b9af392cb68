"""The files of movies: MP4 and WebM by ffmpeg, GIF, and a PNG file for each frame."""

from __future__ import annotations

import os
import re
from collections.abc import Generator, Iterator
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from bihdist_core import BihdistError, OutputError
from bihdist_core.arrays import AnyArray, ByteArray
from bihdist_core.file_output import atomic_write, check_output

from ..version import install_command

if TYPE_CHECKING:
    from PIL.Image import Image

BT709 = ["-vf", "scale=out_color_matrix=bt709"]
BT709 += [word for tag in ("colorspace", "color_primaries", "color_trc") for word in (f"-{tag}", "bt709")]
"""Players take the matrix of a film without one to depend on its size, and show other colours."""

ENCODED: dict[str, dict[str, Any]] = {
    ".mp4": {"quality": 8, "output_params": BT709},
    ".webm": {
        "codec": "libvpx-vp9",
        "quality": None,
        # Without bitexact a random number is written, too.
        "output_params": [*BT709, "-crf", "20", "-b:v", "0", "-cpu-used", "4", "-row-mt", "1", "-fflags", "+bitexact"],
    },
}
"""Formats that ffmpeg encodes, with their arguments of imageio-ffmpeg."""

MOVIE_FORMATS = (*ENCODED, ".gif", ".png")

NUMBER = re.compile(r"%(?:0([1-9]))?d")
"""The place of a frame's number in the name of its file: %d, or %04d with at least so many digits."""


def check_movie(path: str | os.PathLike[str], frames: int = 0) -> None:
    """Raise BihdistError, with what to install, before long work if a movie of so many frames cannot be written."""
    extension = check_output(path, MOVIE_FORMATS)
    if extension in ENCODED and (lack := encoder_lack()):
        raise BihdistError(f"A GIF needs no further package. {lack}")
    if extension != ".png":
        return
    path = Path(path)
    if len(NUMBER.findall(path.name)) != 1 or path.name.count("%") != 1:
        raise OutputError(f"{path} is one file; put %04d where frames have their numbers: {path.stem}-%04d.png.")
    before, digits, after = NUMBER.split(path.name)
    is_frame = re.compile(rf"{re.escape(before)}(\d{{{digits or 1},}}){re.escape(after)}")
    found = filter(None, map(is_frame.fullmatch, sorted(os.listdir(path.parent))))
    if frames and (other := next((each[0] for each in found if not 1 <= int(each[1]) <= frames), None)):
        raise OutputError(f"{path.parent / other} would stay among the {frames:,} new frames; choose another name.")


def encoder_lack() -> str:
    """Return a sentence on the package that MP4 and WebM lack, with the line that installs it; "" if none does."""
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        get_ffmpeg_exe()
    except ImportError:
        return f"MP4 and WebM need the package imageio-ffmpeg: {install_command('imageio-ffmpeg')}"
    except RuntimeError:  # the package has come without it
        return "MP4 and WebM need the program ffmpeg, which was not found."
    return ""


def picture_mode(path: str | os.PathLike[str]) -> str:
    """Return the mode of the pictures that a movie file takes, "P" with a palette or "RGB"."""
    return "P" if os.fspath(path).lower().endswith(".gif") else "RGB"


def write_frames(path: str | os.PathLike[str], frames: Iterator[Any], fps: float) -> None:
    """Write the frames of a movie, all or none; OutputError if they cannot be written."""
    extension = check_output(path, MOVIE_FORMATS)
    if extension == ".png":
        _write_png(Path(path), frames)
        return
    with atomic_write(path) as temporary:
        if extension == ".gif":
            _write_gif(temporary, frames, fps)
        else:
            _encode(temporary, frames, fps, ENCODED[extension])


def _write_png(path: Path, frames: Iterator[AnyArray]) -> None:
    from PIL import Image

    try:
        with TemporaryDirectory(prefix=f".{NUMBER.sub('', path.stem)}", dir=path.parent) as folder:
            names = []
            for number, frame in enumerate(frames, 1):
                names.append(path.name % number)
                Image.fromarray(frame).save(Path(folder, names[-1]))
            for name in names:
                os.replace(Path(folder, name), path.with_name(name))
    except OSError as error:
        raise OutputError(f"{path} could not be written: {error.strerror or error}.") from error


def _write_gif(path: Path, frames: Iterator[Image], fps: float) -> None:
    first = next(frames)
    first.save(path, save_all=True, append_images=frames, duration=round(1000 / fps), loop=0)


def _encode(path: Path, frames: Iterator[AnyArray], fps: float, arguments: dict[str, Any]) -> None:
    import imageio_ffmpeg

    first = next(frames)
    height, width, _ = first.shape
    writer = imageio_ffmpeg.write_frames(str(path), (width, height), fps=fps, macro_block_size=2, **arguments)
    try:
        _send(writer, None)
        for frame in chain([first], frames):
            _send(writer, np.ascontiguousarray(frame))
    finally:
        writer.close()


def _send(writer: Generator[None, ByteArray | None, None], frame: ByteArray | None) -> None:
    try:
        writer.send(frame)
    except (OSError, StopIteration) as error:
        words = next((line for line in reversed(str(error).splitlines()) if line.strip()), type(error).__name__)
        raise OutputError(f"The movie could not be encoded: {words.strip()[:200]}") from error
