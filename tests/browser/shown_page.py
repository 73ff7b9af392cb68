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
    const { answers, mesh, source } = VIEW, bytes = (a) => new Uint8Array(a.values.buffer).reduce(
        (text, byte) => text + String.fromCharCode(byte), "");
    return { source: mesh.ids[source], fields: answers.map((a) => btoa(bytes(a))) };
})()""".replace("VIEW", VIEW)
CLICK = """(async ([x, y]) => {
    const drawn = new Promise((done) => VIEW.root.addEventListener("picture", (e) => done(e.detail), { once: true }));
    const view = VIEW.stage.views[0], box = view.getBoundingClientRect();
    const at = { clientX: box.x + x * box.width, clientY: box.y + y * box.height, pointerId: 1, isPrimary: true,
        button: 0, pointerType: "mouse", bubbles: true };
    view.dispatchEvent(new PointerEvent("pointerdown", { ...at, buttons: 1 }));
    view.dispatchEvent(new PointerEvent("pointerup", at));
    return await drawn;
})""".replace("VIEW", VIEW)


def made(mesh: str, distances: tuple[str, ...], folder: Path, precision: str = "24") -> tuple[Page, Path]:
    """A page of a mesh, and its file."""
    document = comparison(mesh, tuple(map(quantity, distances)))
    page, path = page_of(Recipe(document), precision=precision), folder / "page.html"
    page.write(path)
    return page, path


class ShownPage:
    """The page in the browser, once it shows its first picture."""

    def __init__(self, browser: Browser, page: Page, path: Path) -> None:
        self.browser, self.page = browser, page
        browser.open(path)
        browser.until(f"{VIEW}?.answers.every(Boolean) && !{VIEW}.drawn", 100)
        self.distances = Distances(Laplacian(page.mesh.surface))

    def click(self, x: float, y: float) -> dict:
        """Click at shares of the first panel's sides; what the page says of the picture then, which is waited for."""
        return self.browser.evaluate(f"{CLICK}([{x}, {y}])", 100)

    def is_hit(self, x: float, y: float) -> bool:
        """Whether the surface is there."""
        ask = f"(() => {{ const v = {VIEW}; return !!v.sight.tree.hit(v.sight.camera.ray(2 * {x} - 1, 1 - 2 * {y}, "
        box = "v.stage.boxes[0].width / v.stage.boxes[0].height)); })()"
        return self.browser.evaluate(ask + box)

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
        return read["source"], [np.frombuffer(base64.b64decode(field), "<f8") for field in read["fields"]]

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
