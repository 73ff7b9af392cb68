"""A page that computes, open in a browser: clicks on it, and what it shows then."""

import base64
from pathlib import Path

import numpy as np

from app.document.document import comparison
from app.document.page import Recipe
from app.document.quantities import quantity
from app.web.export import Page, page_of
from bihdist_core import Laplacian
from bihdist_core.distances.answers import Distances

from .browser import Browser

VIEW = "document.querySelector('.bihdist').viewer"
READ = """(() => {
    const { answers, mesh, source } = VIEW, bytes = new Uint8Array(8 * mesh.n * answers.length), parts = [];
    answers.forEach(({ values }, k) => bytes.set(new Uint8Array(values.buffer), 8 * mesh.n * k));
    for (let k = 0; k < bytes.length; k += 32768) parts.push(String.fromCharCode(...bytes.subarray(k, k + 32768)));
    return { source: mesh.ids[source], fields: btoa(parts.join("")) };
})()""".replace("VIEW", VIEW)
AWAIT = """void (window.picture = new Promise((done) => VIEW.root.addEventListener("picture", ({ detail }) => {
    const { gl } = VIEW.stage.drawing, asked = performance.now();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    done({ ...detail, since: detail.since + performance.now() - asked });
}, { once: true })))""".replace("VIEW", VIEW)
"""Waits for the next picture until its pixels are there, which graphics do on their own time."""


def made(mesh: str, distances: tuple[str, ...], folder: Path, precision: str = "24") -> tuple[Page, Path]:
    """A page of a mesh, and its file."""
    document = comparison(mesh, tuple(map(quantity, distances)))
    page, path = page_of(Recipe(document), precision=precision), folder / "page.html"
    page.write(path)
    return page, path


class ShownPage:
    """The page in the browser, once it shows its first picture.  distances: the library's on the stored mesh."""

    def __init__(self, browser: Browser, page: Page, path: Path, distances: Distances | None = None) -> None:
        self.browser, self.page = browser, page
        browser.open(path)
        browser.until(f"{VIEW}?.answers.every(Boolean) && !{VIEW}.drawn", 100)
        self.box = browser.evaluate(f"{VIEW}.stage.views[0].getBoundingClientRect().toJSON()")
        self.distances = distances or Distances(Laplacian(page.mesh.surface))

    def at(self, x: float, y: float) -> tuple[int, int]:
        """The pixel of the page at shares of the first panel's sides."""
        return round(self.box["x"] + x * self.box["width"]), round(self.box["y"] + y * self.box["height"])

    def click(self, x: float, y: float) -> dict:
        """Click there with the mouse; what the page says of the picture then, which is waited for."""
        self.browser.evaluate(AWAIT)
        self.browser.click(*self.at(x, y))
        return self.browser.evaluate("window.picture", 100)

    def is_hit(self, x: float, y: float) -> bool:
        """Whether the surface is there."""
        across, down = self.at(x, y)
        return self.browser.evaluate(f"!!{VIEW}.sight.hit(0, {across - self.box['x']}, {down - self.box['y']})")

    def places(self, count: int, seed: int = 0) -> list[tuple[float, float]]:
        """So many on the surface, at random."""
        rng, found = np.random.default_rng(seed), []
        while len(found) < count:
            x, y = rng.uniform(0.02, 0.98, 2).tolist()
            if self.is_hit(x, y):
                found.append((x, y))
        return found

    @property
    def shown(self) -> tuple[int, list[np.ndarray]]:
        """The source, and what panels show at the stored vertices."""
        read = self.browser.evaluate(READ)
        values = np.frombuffer(base64.b64decode(read["fields"]), "<f8")
        return read["source"], list(values.reshape(-1, len(self.page.mesh.ids)))

    def worst(self, specs) -> list[float]:
        """By how much each panel differs from the library on the stored mesh, as a fraction of its maximum."""
        source, fields = self.shown
        (at,) = np.flatnonzero(self.page.mesh.ids == source)
        worst = []
        for spec, field in zip(specs, fields, strict=True):
            expected = self.distances.answer(spec, int(at)).field
            assert (np.isnan(field) == np.isnan(expected)).all()
            worst.append(float(np.nanmax(np.abs(field - expected)) / np.nanmax(expected)))
        return worst
