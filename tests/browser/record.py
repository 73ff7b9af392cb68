"""`python -m tests.browser.record [MESH ...]`: pages in browsers beside the library, as a table.

Samples' names, files, "bumpy:N" and "sphere:N" are meshes; without any, eight samples and all that is shared.  What is
done is kept in `--results`, and the next run with them goes on from there.
"""

import argparse
import json
import sys
import tempfile
from collections.abc import Sequence
from datetime import date
from pathlib import Path

from bihdist_core import Surface
from tests import shapes
from tests.bench import machine
from tests.bench.guide_page import put

from .chromium import Chromium
from .firefox import Firefox
from .measured import Measured, grown, growth

BROWSERS = (Chromium, Firefox)

BEGIN, END = "<!-- pages: from the run -->", "<!-- end of pages -->"
"""Between them, in a page of the guide, is the table."""

SAMPLES = ("hand", "hare", "scan", "part", "domain", "genus3", "octopus", "elephant")
SHARED = (".obj", ".off")
COLUMNS = (
    "mesh", "vertices", "file", "biharmonic", "commute-time", "exact geodesic", "set-up, ms", "click: biharmonic, ms",
    "click: geodesic, ms", "click to picture, ms", "memory, MB",
)  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    results = Path(options.results)
    known = json.loads(results.read_text()) if results.exists() else {}
    browsers = {kind.NAME: kind for kind in BROWSERS if kind.program()}
    try:
        for name in options.meshes or _usual():
            label = Path(name).name
            if label in known.get("meshes", {}):
                continue
            print(label, file=sys.stderr, flush=True)
            known.setdefault("meshes", {})[label] = _measure(name, browsers, options.clicks)
            results.write_text(json.dumps(known))
        if "growth" not in known and options.growth:
            known["growth"] = _growth(browsers, options.growth)
            results.write_text(json.dumps(known))
    except KeyboardInterrupt:
        print(f"interrupted; what is done is in {results}, and a run goes on from there", file=sys.stderr)
    text = f"{date.today()}; {machine.describe()}; {', '.join(browsers)}\n\n{table(known.get('meshes', {}))}"
    text = "\n\n".join([text, *_growth_words(known.get("growth", {}))])
    print(text)
    if options.table:
        put(Path(options.table), text, BEGIN, END)
    return 0


def _usual() -> list[str]:
    shared = sorted(each for each in shapes.MESHES.glob("*") if each.suffix in SHARED)
    return [*SAMPLES, "bumpy:20000", "sphere:100000", *map(str, shared)]


def _mesh(name: str) -> str | Surface:
    kind, _, count = name.partition(":")
    return getattr(shapes, kind)(int(count)) if count.isdigit() else name


def _measure(name: str, browsers: dict, clicks: int) -> dict:
    with tempfile.TemporaryDirectory(prefix="record-") as folder:
        measured, within = Measured(_mesh(name), Path(folder)), {}
        for each, kind in browsers.items():
            browser = kind()
            try:
                browser.size(1280, 720)
                within[each] = measured.within(browser, clicks)
            finally:
                browser.close()
        return {**measured.facts(), "browsers": within}


def _growth(browsers: dict, clicks: int) -> dict[str, list[int]]:
    with tempfile.TemporaryDirectory(prefix="record-") as folder:
        measured, sizes = Measured("hand", Path(folder)), {}
        for each, kind in browsers.items():
            browser = kind()
            try:
                browser.size(1280, 720)
                sizes[each] = growth(browser, measured.pages[1], measured.library, clicks)
            finally:
                browser.close()
        return sizes


def table(meshes: dict) -> str:
    """In Markdown.  Where there are several figures in a cell, they are the library's, if it has one, and browsers'."""
    rows = [COLUMNS, ("---", *["---:"] * (len(COLUMNS) - 1)), *(_row(*each) for each in meshes.items())]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def _row(name: str, facts: dict) -> tuple[str, ...]:
    browsers = list(facts["browsers"].values())

    def worst(word: str) -> str:
        found = [each["worst"][word] for each in browsers if word in each["worst"]]
        return f"{max(found):.0e}" if found else ""

    def clicks(word: str) -> str:
        return _ms(each.get(word) for each in (facts["clicks"], *(each["clicks"] for each in browsers)))

    return (
        name,
        f"{facts['vertices']:,}",
        f"{facts['bytes'] / 1e3:,.0f} kB",
        *map(worst, ("biharmonic", "commute-time", "geodesic")),
        _ms([facts["set-up"], *(each["set-up"] for each in browsers)]),
        clicks("biharmonic"),
        clicks("geodesic"),
        _ms(each["picture"] for each in browsers),
        " / ".join(f"{each['memory'] / 1e6:.0f}" for each in browsers),
    )


def _ms(seconds) -> str:
    found = [each for each in seconds if each is not None]
    return " / ".join(f"{1e3 * each:,.{0 if each >= 0.01 else 1}f}" for each in found)


def _growth_words(sizes: dict[str, list[int]]) -> list[str]:
    return [
        f"{name}: {sizes_of[0] / 1e6:.0f} MB after 100 clicks on one mesh, {sizes_of[-1] / 1e6:.0f} MB after "
        f"{100 * len(sizes_of):,}; the minimum of the second half differs from the first's by "
        f"{grown(sizes_of) / 1e6:+.1f} MB."
        for name, sizes_of in sizes.items()
    ]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.browser.record", description=__doc__.split("\n\n")[1])
    parser.add_argument("meshes", nargs="*", metavar="MESH")
    parser.add_argument("--clicks", type=int, default=20, help="on each page (default: %(default)s)")
    parser.add_argument("--growth", type=int, default=1000, help="so many on one page, for its memory; 0 for none")
    parser.add_argument("--results", default="browser-results.json", help="where they are kept (default: %(default)s)")
    parser.add_argument("--table", metavar="PAGE", help="put the table into this page of the guide, too")
    return parser


if __name__ == "__main__":
    sys.exit(main())
