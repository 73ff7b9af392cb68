"""What a page is measured by in a browser: its fields beside the library's, times, memory."""

import statistics
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from app.document.document import comparison
from app.document.page import Recipe
from app.document.quantities import quantity
from app.session.array_store import comparison_of_arrays
from app.web.export import Page, page_of
from bihdist_core import Laplacian, Surface
from bihdist_core.distances.answers import Answer, Distances
from bihdist_core.distances.distance_types import Spec
from tests.bench.timing import timed

from .browser import Browser
from .shown_page import VIEW, ShownPage

DISTANCES = ("biharmonic", "commute-time", "geodesic(method=exact)")
MOST_FOR_GEODESIC = 60_000
"""Vertices up to which exact geodesic distance is on the page, too: each takes seconds beyond."""


class Library(Distances):
    """Distances on a page's mesh as the library has them, each found once, with the seconds that took."""

    def __init__(self, surface: Surface) -> None:
        self.seconds: dict[str, list[float]] = {}
        self._answers: dict[tuple[Spec, int], Answer] = {}
        seconds, laplacian = timed(lambda: Laplacian(surface))
        super().__init__(laplacian)
        first, _ = timed(lambda: self.answer(quantity("biharmonic").specs[0], 0))
        self.set_up = seconds + first
        self.seconds.clear()

    def answer(self, spec: Spec, source: int, *more) -> Answer:
        if (spec, source) not in self._answers:
            seconds, self._answers[spec, source] = timed(lambda: super(Library, self).answer(spec, source))
            self.seconds.setdefault(spec.word, []).append(seconds)
        return self._answers[spec, source]


class Measured:
    """A mesh, a file or one made here, with its pages: one with all distances, and one with the biharmonic alone."""

    def __init__(self, mesh: str | Surface, folder: Path) -> None:
        count = len(mesh.vertices) if isinstance(mesh, Surface) else 0
        names = DISTANCES[:2] if count > MOST_FOR_GEODESIC else DISTANCES
        if isinstance(mesh, Surface):
            document, given = comparison_of_arrays(mesh, names, {}, (None,))
        else:
            document, given = comparison(mesh, tuple(map(quantity, names))), None
        self.specs = [quantity(each).specs[0] for each in names]
        self.page = page_of(Recipe(document), given)
        alone = replace(self.page, scene={**self.page.scene, "panels": self.page.scene["panels"][:1]})
        self.pages: list[tuple[Page, Path]] = [(self.page, folder / "all.html"), (alone, folder / "one.html")]
        self.size, _ = (page.write(path) for page, path in self.pages)
        self.library = Library(self.page.mesh.surface)

    def facts(self) -> dict:
        """What is to be said of mesh and library, once browsers have asked."""
        taken = {word: statistics.median(seconds) for word, seconds in self.library.seconds.items()}
        vertices = len(self.page.mesh.ids)
        return {"vertices": vertices, "bytes": self.size, "set-up": self.library.set_up, "clicks": taken}

    def within(self, browser: Browser, clicks: int) -> dict:
        """After so many clicks on each page: worst differences, seconds and bytes."""
        alone = ShownPage(browser, *self.pages[1], self.library)
        first = float(browser.evaluate(f"{VIEW}.message.textContent.match(/ in ([\\d.]+) ms/)[1]"))
        places = alone.places(clicks, seed=1)
        told = [alone.click(*each) for each in places]
        memory = browser.memory()
        shown = ShownPage(browser, *self.pages[0], self.library)
        worst = np.zeros(len(self.specs))
        for place in shown.places(clicks):
            shown.click(*place)
            worst = np.maximum(worst, shown.worst(self.specs))
        median = {key: statistics.median(each[key] for each in told) / 1e3 for key in ("took", "since")}
        return {
            "worst": dict(zip([spec.word for spec in self.specs], worst.tolist(), strict=True)),
            "set-up": first / 1e3,
            "clicks": {"biharmonic": median["took"], **self._geodesic(shown)},
            "picture": median["since"],
            "memory": memory,
            "errors": len(browser.errors) + len(browser.requests),
        }

    def _geodesic(self, shown: ShownPage) -> dict[str, float]:
        if len(self.specs) < len(DISTANCES):
            return {}
        n = len(self.page.mesh.ids)
        ask = f"{VIEW}.solver.field(VERTEX, ['geodesic']).then((answer) => answer.took)"
        took = [shown.browser.evaluate(ask.replace("VERTEX", str(k * n // 5)), 100) for k in range(5)]
        return {"geodesic": statistics.median(took) / 1e3}


def growth(browser: Browser, page: tuple[Page, Path], library: Distances, clicks: int) -> list[int]:
    """The page's memory in bytes after each hundred of so many clicks, the first hundred not counted."""
    shown = ShownPage(browser, *page, library)
    places, sizes = shown.places(50), []
    for k in range(1, clicks + 101):
        shown.click(*places[k % len(places)])
        if k % 100 == 0:
            browser.collect_garbage()
            sizes.append(browser.memory())
    return sizes


def grown(sizes: Sequence[int]) -> int:
    """From the least of the first half of these sizes to that of the second: what comes and goes is in neither."""
    half = len(sizes) // 2
    return min(sizes[half:]) - min(sizes[:half])
