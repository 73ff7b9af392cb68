"""Many figures on one picture, each with its name."""

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass

from PIL import Image, ImageDraw, ImageFont, ImageOps

from .words import shortened

THUMBNAIL = (960, 480)
"""Pixels that a thumbnail fits into, across and down."""
LARGEST = 4000
"""Pixels across a sheet: of many figures each is smaller."""
SHAPE = 1.3
"""Across over down, of a sheet of many."""
LABEL, GAP, MARGIN = 26, 14, 28
"""Pixels for a name, between figures, and around all of them."""
TEXT, ERROR, GROUND = "#1D2125", "#B3261E", "#F6F7F8"


@dataclass(frozen=True, eq=False)
class SheetEntry:
    """A figure of a sheet: its name, and its thumbnail, or why there is none."""

    name: str
    picture: Image.Image | None = None
    failure: str = ""


def thumbnail(figure: bytes) -> Image.Image:
    """Return a figure (a PNG) as small as THUMBNAIL, on white where it is transparent."""
    picture = Image.open(io.BytesIO(figure)).convert("RGBA")
    picture.thumbnail(THUMBNAIL, Image.Resampling.LANCZOS)
    ground = Image.new("RGB", picture.size, "white")
    ground.paste(picture, mask=picture.getchannel("A"))
    return ground


def contact_sheet(cells: Sequence[SheetEntry], words: Sequence[str] = ()) -> Image.Image:
    """Return figures in rows under lines of words, with their names below them; at least one has a picture."""
    pictures = [cell.picture for cell in cells if cell.picture is not None]
    wide, high = (max(each.size[side] for each in pictures) for side in (0, 1))
    across = math.ceil(math.sqrt(SHAPE * len(cells) * (high + LABEL) / wide))
    across = min(len(cells), max(across, 2))
    small = min(1.0, ((LARGEST - 2 * MARGIN) / across - GAP) / wide)
    wide, high = round(wide * small), round(high * small)
    label = max(14, round(LABEL * small))
    head = MARGIN + 26 * len(words) + (8 if words else 0)
    down = -(-len(cells) // across)
    size = (2 * MARGIN - GAP + across * (wide + GAP), head + down * (high + label + GAP) + MARGIN - GAP)
    sheet = Image.new("RGB", size, "white")
    draw, font = ImageDraw.Draw(sheet), _font(max(9, round(17 * small)))
    for k, line in enumerate(words):
        draw.text((MARGIN, MARGIN + 26 * k), _cut(draw, line, _font(17), size[0] - 2 * MARGIN), TEXT, _font(17))
    for k, cell in enumerate(cells):
        x, y = MARGIN + k % across * (wide + GAP), head + k // across * (high + label + GAP)
        if cell.picture is None:
            draw.rectangle((x, y, x + wide - 1, y + high - 1), GROUND)
            lines = max(1, int(high / (2 * font.size)))
            parts = shortened(cell.failure, font.size, wide - 24, lines, lambda part, _: draw.textlength(part, font))
            draw.multiline_text((x + wide / 2, y + high / 2), "\n".join(parts), ERROR, font, "mm", align="center")
        else:
            picture = ImageOps.scale(cell.picture, small, Image.Resampling.LANCZOS) if small < 1 else cell.picture
            sheet.paste(picture, (x + (wide - picture.width) // 2, y + (high - picture.height) // 2))
        draw.text((x + wide / 2, y + high + label / 2), _cut(draw, cell.name, font, wide), TEXT, font, "mm")
    return sheet


def _font(size: int) -> ImageFont.FreeTypeFont:
    from matplotlib.font_manager import findfont

    from .fonts import FONT

    return ImageFont.truetype(findfont(FONT), size)


def _cut(draw: ImageDraw.ImageDraw, text: str, font: ImageFont.FreeTypeFont, wide: float) -> str:
    """Shorten a text in its middle to what there is room for, as names differ at their ends."""
    if draw.textlength(text, font) <= wide:
        return text
    kept = len(text)
    while kept > 2:
        kept -= 1
        shown = f"{text[: kept - kept // 2]}…{text[len(text) - kept // 2 :]}"
        if draw.textlength(shown, font) <= wide:
            return shown
    return text[:1]


def as_jpeg(picture: Image.Image) -> bytes:
    """Return the picture as the bytes of a small JPEG file, as a page may have hundreds."""
    return _bytes(picture, "JPEG", quality=85, optimize=True)


def as_png(picture: Image.Image) -> bytes:
    """Return the picture as the bytes of a PNG file."""
    return _bytes(picture, "PNG", optimize=True)


def _bytes(picture: Image.Image, format: str, **options: object) -> bytes:
    file = io.BytesIO()
    picture.save(file, format, **options)
    return file.getvalue()
