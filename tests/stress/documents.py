"""Documents with damage: recipes, sessions, pins, anchors, maps, labels, masks, colours, tables of batches.

Each is read as the program reads it: what opens is used, what does not is refused in one sentence.
"""

import json
import os
import random
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from app.document.document import comparison
from app.document.file import read_recipe, recipe_text, with_meshes_from
from app.document.page import Recipe
from app.document.quantities import quantity
from app.document.shared_parts.pins import add_pins
from app.figures.export import compute, open_document
from app.main import main
from app.scene.colour_file import colours_named
from app.scene.colour_maps import colours_at
from app.session.array_store import ArrayStore, comparison_of_arrays
from app.session.recipe_file import recipe_written
from app.tools.interpolation.part import add_anchor
from bihdist_core import BihdistError, write_mesh
from bihdist_core.analysis.parcels import checked_mask
from bihdist_core.formats.anchors import read_anchors
from bihdist_core.formats.landmarks import written_pp
from bihdist_core.formats.pins import read_pins
from bihdist_core.formats.vertex_maps import read_map, read_pairs
from bihdist_core.formats.whole_numbers import read_whole_numbers
from bihdist_core.sources.words import read_curve
from bihdist_core.surface import Surface
from tests.core.damage import damaged, damaged_json
from tests.core.mesh_samples import gifti, gifti_array
from tests.core.test_freesurfer import annotation, values
from tests.shapes import bumpy

from .outcome import LOST, OPENED, REFUSED, WRONG, Outcome
from .sentences import fault_of

WORDS = "damaged documents: recipes, sessions, pins, anchors, maps, labels, masks, colours, tables"
SEEDS, BLOCK, SECONDS = 100, 500, 30.0
TABLES = 0.01
"""The share of cases that run a batch, which takes a process of its own."""
COUNT = 60


@dataclass(frozen=True)
class Document:
    """content: of a sound one.  read: uses the file at a path.  names_file: whether each refusal names it; what a
    recipe says of a mesh may be refused by what is said of the mesh."""

    content: bytes
    read: Callable[[Path], object]
    names_file: bool = True


@cache
def surface() -> Surface:
    return bumpy(COUNT)


def case(seed: int, number: int, folder: Path) -> Outcome:
    """A document with one or two damages, read and used."""
    rng = random.Random(f"documents {seed} {number}")
    mesh = folder / "m.off"
    if not mesh.exists():
        write_mesh(mesh, surface())
    if rng.random() < TABLES:
        return _batch(folder, mesh, rng)
    known = _documents(folder)
    name = rng.choice(sorted(known))
    document, path = known[name], folder / name
    path.write_bytes(_damaged(document.content, name, rng))
    return _read(document, path)


def _damaged(content: bytes, name: str, rng: random.Random) -> bytes:
    for _ in range(rng.choice((1, 1, 2))):
        if name.endswith(".json") and rng.random() < 0.6:
            try:
                content = damaged_json(content.decode(), rng).encode()
            except (ValueError, IndexError, OverflowError):
                return content  # it is no JSON any more, or has nothing in it
        else:
            content = damaged(content, rng) or b" "
    return content


def _read(document: Document, path: Path) -> Outcome:
    beside = {each.name for each in path.parent.iterdir()}
    try:
        with np.errstate(all="ignore"):
            document.read(path)
    except BihdistError as error:
        fault = fault_of(str(error), path.name if document.names_file else "")
        return Outcome(WRONG, f"{path.name}: {fault}") if fault else Outcome(REFUSED)
    finally:
        path.unlink()
    more = {each.name for each in path.parent.iterdir()} - beside
    return Outcome(WRONG, f"{path.name}: reading it has written {sorted(more)}") if more else Outcome(OPENED)


# ---------------------------------------------------------------------- sound documents
@cache
def _documents(folder: Path) -> dict[str, Document]:
    """By the names of their files, in a folder with the mesh `m.off`; what sessions name is left there."""
    s, rng = surface(), np.random.default_rng(0)
    known: dict[str, Document] = {}

    def labelled(path: Path) -> object:
        return read_whole_numbers(path, "labels")

    def masked(path: Path) -> object:
        return checked_mask(s, read_whole_numbers(path, "mask"))

    pins = "name,vertex,id\none,3,1\ntwo,7,2\n"
    known["pins.csv"] = Document(pins.encode(), lambda path: read_pins(path, s))
    entries = {"pins": [{"name": "one", "vertex": 3, "id": 1}, {"name": "two", "position": [0, 0, 1]}]}
    known["pins.json"] = Document(json.dumps(entries).encode(), lambda path: read_pins(path, s))
    picked = written_pp([([0.0, 0.0, 1.0], "a"), ([1.0, 0.0, 0.0], "b")], "m.off")
    known["pins.pp"] = Document(picked.encode(), lambda path: read_pins(path, s))
    known["anchors.csv"] = Document(b"vertex,value\n3,0.5\n7,-1e3\n", lambda path: read_anchors(path, s))
    valued = {"pins": [{"vertex": 3, "value": 0.5}, {"position": [0, 0, 1], "value": 2}]}
    known["anchors.json"] = Document(json.dumps(valued).encode(), lambda path: read_anchors(path, s))
    ids = rng.permutation(COUNT)
    known["map.txt"] = Document("\n".join(map(str, ids)).encode(), lambda path: read_map(path, s, s))
    known["map.npy"] = Document(_npy(ids), lambda path: read_map(path, s, s))
    known["pairs.csv"] = Document(b"i,j\n1,2\n3,4\n", lambda path: read_pairs(path, (s, s)))
    labels = rng.integers(-1, 4, COUNT)
    known["labels.npy"] = Document(_npy(labels.astype(float)), labelled)
    known["labels.txt"] = Document("\n".join(map(str, labels)).encode(), labelled)
    of_gifti = gifti(gifti_array("LABEL", labels.astype("i4")))
    known["a.label.gii"] = Document(of_gifti, labelled)
    known["lh.annot"] = Document(annotation(), labelled)
    known["lh.thickness"] = Document(values(), labelled)
    mask = (labels > 0).astype(int)
    known["mask.npy"] = Document(_npy(mask), masked, False)
    known["mask.txt"] = Document("\n".join(map(str, mask)).encode(), masked, False)
    known["colours.txt"] = Document(b"# mine\n0 0 0 0\n0.5 1 0 0\n1 1 1 1\n", _colours)
    stops = [{"Name": "mine", "ColorSpace": "Lab", "RGBPoints": [0, 0, 0, 0, 0.5, 1, 0, 0, 1, 1, 1, 1]}]
    known["colours.json"] = Document(json.dumps(stops).encode(), _colours)
    curve = {"points": [[0, 0.2, 0.3], [0, 0.5, 0.3]], "closed": False}
    known["curve.json"] = Document(json.dumps(curve).encode(), read_curve)
    known["recipe.json"] = Document(_recipe(folder), _draw, False)
    known["session.json"], known["arrays.npz"] = _session(folder)
    return known


def _npy(array: np.ndarray) -> bytes:
    from io import BytesIO

    file = BytesIO()
    np.save(file, array)
    return file.getvalue()


def _colours(path: Path) -> object:
    return colours_at(colours_named(str(path)).stops, np.linspace(0, 1, 5))


def _recipe(folder: Path) -> bytes:
    shows = tuple(map(quantity, ("biharmonic", "geodesic", "biharmonic - commute-time")))
    document = add_pins(comparison(str(folder / "m.off"), shows, (5,)), [3, 7])
    document = add_anchor(document, 9, 1.0)[0]
    return recipe_text(with_meshes_from(Recipe(document), folder / "recipe.json"), "0").encode()


def _session(folder: Path) -> tuple[Document, Document]:
    """A session of arrays from Python, damaged in its JSON and in its archive; the other stays sound."""
    document, given = comparison_of_arrays(surface(), ["biharmonic", "mine"], {"mine": surface().vertices[:, 0]}, (5,))
    with recipe_written(Recipe(document), given, folder / "arrays.json", "0"):
        pass
    archive = Path(read_recipe(folder / "arrays.json").arrays)
    content, arrays = (folder / "arrays.json").read_bytes(), archive.read_bytes()
    # Each session is read with its own archive: the one that is tried is removed after its case.
    sound = folder / "sound.npz"
    sound.write_bytes(arrays)
    content = content.replace(archive.name.encode(), b"sound.npz")
    (folder / "of_archive.json").write_bytes(content.replace(b"sound.npz", b"arrays.npz"))
    return Document(content, _draw, False), Document(arrays, lambda _: _draw(folder / "of_archive.json"), False)


def _draw(path: Path) -> None:
    recipe = read_recipe(path)
    document, surfaces = open_document(recipe, ArrayStore.read(recipe))
    compute(document, surfaces)


# ---------------------------------------------------------------------- tables of a batch
def _batch(folder: Path, mesh: Path, rng: random.Random) -> Outcome:
    """A folder of results one of whose tables is damaged: the next run says so, or has the results again."""
    sound, out = folder / "batch", folder / "damaged"
    words = ["batch", str(mesh), "--do", "fields", "--sources", "3,7", "--workers", "1", "--quiet", "-o"]
    if not sound.exists() and main([*words, str(sound)]):
        return Outcome(WRONG, "a batch of a sound mesh fails")
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(sound, out)
    table = rng.choice(sorted(each for each in out.iterdir() if each.suffix in (".json", ".csv")))
    table.write_bytes(_damaged(table.read_bytes(), table.name, rng))
    if main([*words, str(out)]):
        return Outcome(REFUSED)
    for each in sound.glob("*.npy"):
        if not os.path.exists(out / each.name) or (out / each.name).read_bytes() != each.read_bytes():
            return Outcome(LOST, f"{each.name} after damage to {table.name}")
    return Outcome(OPENED)
