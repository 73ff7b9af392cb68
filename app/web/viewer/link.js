/** The address of the page, kept to what the viewer shows, and followed. */
import { addressOf, readAddress } from "./address.js";

const DELAY = 400;

export class Link {
  /** @param {import("./viewer.js").Viewer} viewer */
  constructor(viewer) {
    this.viewer = viewer;
  }

  write() {
    const { mesh, source, pins, sight } = this.viewer;
    try {
      history.replaceState(null, "", addressOf({ source: mesh.ids[source], pins, camera: sight.numbers }));
    } catch {
      // Browsers refuse where the page is part of another, or its address changes too often.
    }
  }

  writeSoon() {
    clearTimeout(this.timer);
    if (this.viewer.hasAddress) this.timer = setTimeout(() => this.write(), DELAY);
  }

  /** Show what the address holds. @returns {boolean} whether it had a source */
  follow() {
    const { viewer } = this, { vertices, sight } = viewer;
    const { source, pins, camera, ignored } = readAddress(location.hash, (id) => vertices.has(id));
    if (camera && !sight.look(camera)) ignored.push("camera");
    if (pins) viewer.setPins(pins);
    if (source !== undefined) viewer.visit(vertices.get(source));
    if (ignored.length) viewer.say(`The link was not understood in part, and left out: ${ignored.join(", ")}.`, true);
    viewer.redraw();
    return source !== undefined;
  }

  destroy() {
    clearTimeout(this.timer);
  }
}
