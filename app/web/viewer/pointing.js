/** The vertex at the mouse or at the cursor that keys move: shown in all panels, and read out. */
import { element } from "./elements.js";
import { valueWords } from "./pins.js";
import { written } from "./numbers.js";

const SPOKEN = 500;

export class Pointing {
  /** @param {import("./viewer.js").Viewer} viewer */
  constructor(viewer) {
    this.viewer = viewer;
    this.place = this.cursor = null;
    this.where = element("span", { class: "where" });
    this.spoken = element("div", { class: "spoken", "aria-live": "polite" });
  }

  /** @param {{panel: number, x: number, y: number, isCursor?: boolean} | null} place in pixels of a view */
  at(place) {
    const { viewer } = this, hit = place && viewer.sight.hit(place.panel, place.x, place.y);
    this.place = hit ? { ...place, vertex: hit.vertex } : null;
    if (!place?.isCursor) this.cursor = null;
    viewer.redraw(false);
    if (hit || place?.isCursor) this.timer ??= setTimeout(() => this.#speak(), SPOKEN);
  }

  /** Move the cursor of a panel, which starts in the middle. */
  move(panel, dx, dy) {
    const { width, height } = this.viewer.sight.boxes[panel],
      { x, y } = this.cursor ?? { x: width / 2, y: height / 2 };
    this.cursor = { x: Math.min(Math.max(x + dx, 0), width), y: Math.min(Math.max(y + dy, 0), height) };
    this.at({ panel, ...this.cursor, isCursor: true });
  }

  /** The vertex there, or in a panel's middle; undefined off the surface. */
  vertex(panel) {
    if (!this.place) this.move(panel, 0, 0);
    return this.place?.vertex;
  }

  /** The line under the panels. */
  show() {
    const { mesh } = this.viewer, vertex = this.place?.vertex;
    const place = mesh.positions.subarray(3 * vertex, 3 * vertex + 3);
    const words = vertex === undefined ? [] : [`vertex ${mesh.ids[vertex]} `, ...Array.from(place, (x) => written(x))];
    this.where.textContent = words.join("  ");
  }

  #speak() {
    this.timer = null;
    const { scene, current, mesh } = this.viewer, vertex = this.place?.vertex;
    const values = scene.panels.map(({ label }, k) => `${label} ${this.place && valueWords(current[k], vertex)}`);
    this.spoken.textContent = this.place ? `Vertex ${mesh.ids[vertex]}: ${values.join("; ")}` : "No surface here.";
  }

  destroy() {
    clearTimeout(this.timer);
  }
}
