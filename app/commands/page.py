"""`bihdist page`: an HTML file in which distances are computed anew wherever one clicks."""

import argparse
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING
from urllib.parse import quote

from bihdist_core.counts import counted
from bihdist_core.formats.mesh_names import mesh_name

from ..document.document import usual_specs
from ..web.options import USUAL, other_names, page_rows
from .figure import add_recipe, chosen_recipe
from .options import MESH, add_distance, add_output, add_rows, add_sources, count
from .terminal import Facts, Result, progress_line, tell

if TYPE_CHECKING:
    from ..web.export import Page

WORDS = "write a web page that computes distances from wherever its reader clicks"
EXAMPLES = (
    "bihdist page hand",
    "bihdist page figure --sources 12 --distance biharmonic,geodesic -o figure.html",
    "bihdist page --recipe hand.json --credit 'Scan: the anatomy lab'",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `page` to its parser."""
    parser.add_argument("mesh", metavar="MESH", nargs="?", help=MESH)
    add_sources(parser, "the vertex where distances start at first")
    add_output(parser, "a .html file", metavar="OUT.html", usual=".html")
    add_distance(parser, f"a panel each (default: {','.join(USUAL)})", is_field=True)
    add_recipe(parser, "the panels of this recipe or session; all other options change it")
    add_rows(parser, *page_rows())
    # What else there is of figures means nothing on a page.
    parser.set_defaults(beside=None, **dict.fromkeys(other_names()))
    parser.add_argument(
        "--bits",
        choices=("24", "float32"),
        default="24",
        help="precision of coordinates: 24 bits of the largest side, or single precision (default: 24)",
    )
    parser.add_argument(
        "--eigenpairs",
        type=lambda text: 0 if text == "0" else count(text),
        metavar="N",
        help="allow up to N eigenpairs in the file for each truncated distance of a panel, and none for one that "
        "readers can choose (default: as many as take 1 MB)",
    )
    parser.add_argument("--credit", default="", metavar="TEXT", help="a credit line for the mesh, shown on the page")


def run(options: argparse.Namespace) -> Result:
    """Write the page, and print what it holds."""
    from ..web.contents import Contents
    from ..web.export import size_words, write_page
    from ..web.html_file import embed_code

    if options.distance is None and options.recipe is None and options.mesh:
        usual = usual_specs(options.mesh)[: len(USUAL)]
        options.distance = [*map(str, usual), *(field.name for field in options.fields or ())]
    recipe = chosen_recipe(options)
    path = options.output or f"{mesh_name(recipe.document.surfaces[0].path)}.html"
    with progress_line() as progress:
        page, size = write_page(
            recipe,
            path,
            precision=options.bits,
            eigenpairs=options.eigenpairs,
            progress=progress,
            credit=options.credit,
        )
    for note in page.scene["notes"]:
        tell(note)
    contents = Contents.of(recipe.document)
    mesh, source = page.scene["mesh"], page.scene["source"]
    kept = "single precision" if options.bits == "float32" else f"{options.bits} bits of each coordinate"
    print(f"{path}: {size_words(size)}, opened by any browser, without a network")
    what, count = next(iter(mesh["counts"].items()))
    print(f"{mesh['name']}: {count:,} {what} with {kept}; {'; '.join(page.labels)}; from {source}")
    compared = mesh["sources"]
    measured = {name: spec for name, spec in contents.fields.items() if str(spec) in page.differs}
    if measured:
        words = f"from {counted(compared, 'source')} distances equal those on the original mesh within"
        print(f"{words} {_differences(page, map(str, measured.values()))}; from others they may differ more")
    if contents.own:
        print(f"fields equal those given within {_differences(page, (own.word for own in contents.own))}")
    print(f"to embed it: {embed_code(quote(os.path.basename(path)), page.scene['title'])}")
    distances = [
        {
            "distance": str(spec),
            "difference": page.differs[str(spec)],
            "difference_sources": compared,
            "n_eigenpairs": page.eigenpairs.get(name, 0),
        }
        for name, spec in measured.items()
    ]
    distances += [
        {"distance": own.word, "difference": page.differs[own.word], "difference_sources": None, "n_eigenpairs": 0}
        for own in contents.own
    ]
    facts: Facts = {
        "meshes": [{"mesh": each.path} for each in recipe.document.surfaces],
        "outputs": [path],
        "bytes": size,
        "n_vertices": count,
        "n_faces": mesh["counts"].get("faces", 0),
        "precision": options.bits,
        "source": source,
        "panels": [{"label": label} for label in page.labels],
        "distances": distances,
    }
    return Result(facts)


def _differences(page: "Page", names: Iterable[str]) -> str:
    shares = {name: page.differs[name] for name in names}
    each = [f"{name} {share:.1e}" for name, share in shares.items()]
    return f"{max(shares.values()):.1e} of the maximum" + (f" ({', '.join(each)})" if len(each) > 1 else "")
