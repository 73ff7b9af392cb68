"""Text meshes read by the compiled kernel: the numbers of Python, and what the other readers say of damaged files."""

import os
import random
import struct
from decimal import Decimal, getcontext
from pathlib import Path

import numpy as np
import pytest

from bihdist_core import coincident_points, surface
from bihdist_core.errors import MeshError
from bihdist_core.formats import mesh_text, obj, off, ply, stl
from bihdist_core.formats.mesh_io import surface_in
from bihdist_core.kernel.library import library
from tests.core import mesh_samples as samples

pytestmark = pytest.mark.skipif(library() is None, reason="there is no compiled kernel")

LIMITS = """
    0 -0 0e999 -0.0e-999 1. .5 +5 1e22 1e23 8.5e22 9007199254740993 9007199254740992.5 9223372036854775808
    18446744073709551615 18446744073709551616 9999999999999999999 99999999999999999999 1e308
    1.7976931348623157e308 1.7976931348623158e308 1.7976931348623159e308 1e309 4.9e-324 2.4703282292062327e-324
    2.4703282292062328e-324 2.2250738585072014e-308 2.2250738585072011e-308 1e-400 -1e99999999999999999999 nan
    -inf Infinity
"""
EDGES = LIMITS.split()


def between(x):
    """The exact decimal halfway from a float to the next."""
    return (Decimal(x) + Decimal(float(np.nextafter(x, np.inf)))) / 2


def words(rng, count):
    """Decimals of all kinds: shortest, rounded, of many digits, halfway between two floats or close to it."""
    getcontext().prec = 1200
    any_float = (abs(x) for x in iter(lambda: struct.unpack("d", rng.randbytes(8))[0], None) if abs(x) < np.inf)
    kinds = [
        lambda: repr(next(any_float)),
        lambda: repr(rng.random()),
        lambda: format(next(any_float), f".{rng.randint(1, 25)}g"),
        lambda: format(rng.random() * 10 ** rng.randint(-5, 8), f".{rng.randint(0, 30)}f"),
        lambda: format(rng.random() * 10.0 ** rng.randint(-300, 300), f".{rng.randint(0, 30)}e"),
        lambda: format(between(rng.random() * 10 ** rng.randint(-3, 3)), "f"),
        lambda: format(between(rng.random()), "f")[: rng.randint(3, 25)],
        lambda: str(between(next(any_float))),
        lambda: str((rng.getrandbits(53) | 1 << 53 | 1) << rng.randint(0, 12)),
        lambda: str(Decimal(rng.getrandbits(53) | 1 << 53 | 1) / 2 ** rng.randint(1, 4)),
        lambda: repr(rng.getrandbits(52) * 5e-324),
        lambda: f"0{'0' * rng.randint(0, 25)}{rng.getrandbits(64)}.{rng.getrandbits(30):020}e{rng.randint(-400, 400)}",
        lambda: rng.choice(EDGES),
    ]
    return [rng.choice(["", "-"]) * (kind > 0) + kinds[kind]().lstrip("+-") for kind in rng.choices(range(13), k=count)]


def test_numbers_are_those_of_python():
    text = words(random.Random(0), int(os.environ.get("BIHDIST_FUZZ", "60")) * 300) + EDGES
    text += ["1"] * (-len(text) % 3)
    lines = "".join(f"v {' '.join(text[k : k + 3])}\n" for k in range(0, len(text), 3))
    found = mesh_text.mesh_text("read_obj", (np.array([ord("v")], np.uint64), 1), lines.encode(), [3])
    # repr tells the zeros apart and takes one nan for another.
    assert list(map(repr, found.vertices.ravel().tolist())) == [repr(float(word)) for word in text]


# ---------------------------------------------------------------------- files
WIDE = np.hstack([samples.VERTICES, np.full((5, 4), 0.5)])
LATER_IDS = "vt 0 0\nvn 0 0 1\nusemtl a\\b\nf 1/1/1 2/2/1 3/1/1\nf -5/2 3//1 4/2/\nl 1 2\ng a\nf 4//1 5//1 1//1"
PLAIN = {
    "a.off": samples.off(),
    "polygons.off": samples.off(polygons=samples.QUAD_AND_TRIANGLE, line_end="\r\n"),
    "colours.off": "# c\n" + samples.off(WIDE, header="COFF").replace("3 0 1 2\n", "3 0 1 2\t.1 2. 3e-1 1 # c\n\n"),
    "a.obj": samples.obj(),
    "slashes.obj": "\ufeffo a\nmtllib a\n" + samples.obj(polygons=[]) + LATER_IDS,
    "a.ply": samples.ply("ascii"),
    "more.ply": samples.ply("ascii", samples.QUAD_AND_TRIANGLE)
    .replace(b"double z\n", b"double z\nproperty uchar red\nproperty float q\n")
    .replace(b" 0.0\n", b" 0.0 7 nan\n")
    .replace(b" 0.25\n", b" 0.25 7 1e400\n")
    .replace(b" 1.5\n", b" 1.5 0 .5\n"),
    "a.stl": samples.stl_text(),
    "tabs.stl": samples.stl_text().replace("\n", "\r\n").replace(" ", "\t"),
}
PLAIN = {name: text if isinstance(text, bytes) else text.encode() for name, text in PLAIN.items()}
OTHER = {
    "mac.off": samples.off(line_end="\r").encode(),
    "continued.obj": samples.obj().replace("f 1 2 3", "f 1 \\\n 2 3").encode(),
    "colours.ply": samples.ply("ascii", with_colour=True),
}
TOKENS = [
    *(
        b" ",
        b"\n",
        b"\r",
        b"\t",
        b"\x0b",
        b"\x0c",
        b"\x01",
        b"\x1c",
        b"\0",
        b"#",
        b"\\",
        b"\\\n",
        b"/",
        b"//",
        b"-",
        b"+",
    ),
    *(
        b".",
        b"e",
        b"E5",
        b"1e",
        b"nan",
        b"-inf",
        b"nan(1)",
        b"0x10",
        b"1_0",
        b"1-2",
        b"1e999",
        b"1e-999",
        b"0.1" + b"0" * 30,
    ),
    *(b"3000000000", b"99999999999999999999", b"00", b"2", b"-1", b"-0", b"3.0", b"v", b"f", b"p 1\n", b"vt 1\n"),
    *(
        b"vertex",
        b"endsolid",
        b"solid\n",
        b"endfacetX",
        b"\xef\xbb\xbf",
        b"\xff\xfe",
        b"\x80",
        b"\xa0",
        b"\x85",
        b",",
        b";",
    ),
]


def changed(content, rng):
    """The content, cut off, or with other bytes, words or lines in some places."""
    for _ in range(rng.choice((1, 1, 2, 3))):
        at = rng.randrange(len(content) + 1)
        kind = rng.randrange(10)
        if kind == 0:
            content = content[:at]
        elif kind < 6:
            content = content[:at] + rng.choice(TOKENS) + content[at + rng.randint(0, 3) :]
        elif kind < 8:
            parts = content.split(b" ")
            parts[rng.randrange(len(parts))] = rng.choice(TOKENS)
            content = b" ".join(parts)
        else:
            parts = content.split(b"\n")
            line = parts.pop(rng.randrange(len(parts)))
            for _ in range(rng.randint(0, 2)):
                parts.insert(rng.randint(0, len(parts)), line)
            content = b"\n".join(parts)
    return content


def outcome(content, name):
    """What is read, as bytes and words, or the message."""
    reader = {".off": off.read_off, ".obj": obj.read_obj, ".ply": ply.read_ply, ".stl": stl.read_stl}[Path(name).suffix]
    try:
        with np.errstate(all="ignore"):
            found = reader(content, name)
        surface_in(content, name)
    except MeshError as error:
        return str(error)
    arrays = [found.vertices, found.sizes, found.corners]
    return [(a.dtype, a.shape, a.tobytes()) for a in arrays], found.repairs, found.facts


@pytest.fixture
def without_kernel(monkeypatch):
    """`outcome` by the readers that do without the kernel."""

    def without(content, name):
        with monkeypatch.context() as patch:
            for module in (mesh_text, coincident_points):
                patch.setattr(module, "library", lambda: None)
            return outcome(content, name)

    return without


@pytest.mark.parametrize("name", PLAIN)
def test_plain_files_are_read_by_the_kernel_alone(name, without_kernel, monkeypatch):
    found = []

    def watched(*arguments, **options):
        found.append(mesh_text.mesh_text(*arguments, **options))
        return found[-1]

    expected = without_kernel(PLAIN[name], name)
    assert not isinstance(expected, str)
    for module in (off, obj, ply, stl):
        monkeypatch.setattr(module, "mesh_text", watched)
    assert outcome(PLAIN[name], name) == expected
    assert None not in found
    assert found


def test_damaged_files_have_one_outcome_with_and_without_the_kernel(without_kernel):
    rng = random.Random(1)
    files = PLAIN | OTHER
    read = 0
    for name, content in files.items():
        for _ in range(int(os.environ.get("BIHDIST_FUZZ", "60"))):
            damaged = changed(content, rng)
            found = outcome(damaged, name)
            assert found == without_kernel(damaged, name), damaged
            read += not isinstance(found, str)
    assert read > len(files)


def test_corners_in_one_place_are_found_as_by_sorting():
    rng = np.random.default_rng(0)
    for count, sides in [(0, 2), (1, 2), (2, 1), (50, 1), (1000, 3), (1000, 1000)]:
        points = rng.integers(-sides, sides, (count, 3)) * rng.choice([0.1, -0.1], (count, 3))
        for a, b in zip(coincident_points.merged(points), coincident_points._merged_by_sorting(points), strict=True):
            assert (a.dtype, a.shape, a.tobytes()) == (b.dtype, b.shape, b.tobytes())


def test_faces_are_proper_as_without_the_kernel(monkeypatch):
    rng = np.random.default_rng(0)
    vertices = rng.random((9, 3))
    found = []
    for count in rng.integers(1, 9, 500):
        # Now and then an id that there is not, and often a vertex or a face twice.
        faces = rng.integers(0, rng.choice([6, 9, 9, 9, 10]), (count, 3)) - rng.choice([0, 0, 0, 1])
        results = []
        for kernel in (library(), None):
            monkeypatch.setattr(surface, "library", lambda kernel=kernel: kernel)
            try:
                made = surface.Surface(vertices, faces)
                results.append((made.faces.tolist(), made.repairs))
            except MeshError as error:
                results.append(str(error))
        assert results[0] == results[1]
        found.append(results[0][1] == ())
    assert 50 < sum(found) < 450
