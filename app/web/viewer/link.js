/** The address of the page, kept to what the viewer shows, and followed. */
import { addressOf, readAddress } from "./address.js";

const DELAY = 400;

export class Link {
  /** @param {import("./viewer.js").Viewer} viewer */
  constructor(viewer) {
    this.viewer = viewer;
  }

  /** The page's address with what is shown. */
  get url() {
    const { mesh, source, pins, sight, chosen, first } = this.viewer;
    const panels = String(chosen) === first ? [] : chosen;
    return new URL(addressOf({ source: mesh.ids[source], pins, camera: sight.numbers, panels }), location.href).href;
  }

  write() {
    try {
      history.replaceState(null, "", this.url);
    } catch {
      // Browsers refuse where the page is part of another, or its address changes too often.
    }
  }

  writeSoon() {
    clearTimeout(this.timer);
    if (this.viewer.hasAddress) this.timer = setTimeout(() => this.write(), DELAY);
  }

  /** Show what the address holds. @returns {boolean} whether distances are computed for that */
  follow() {
    const { viewer } = this, { vertices, sight, chosen } = viewer;
    const isChoice = (panels) => panels.length === chosen.length && panels.every((each) => viewer.panelOf(each));
    const { source, pins, camera, panels, ignored } = readAddress(location.hash, (id) => vertices.has(id), isChoice);
    if (camera && !sight.look(camera)) ignored.push("camera");
    if (pins) viewer.setPins(pins);
    if (panels) viewer.setPanels(panels);
    const visits = source !== undefined || panels !== undefined;
    if (visits) viewer.visit(vertices.get(source) ?? viewer.source);
    if (ignored.length) viewer.say(`The link was not understood in part, and left out: ${ignored.join(", ")}.`, true);
    viewer.redraw();
    return visits;
  }

  destroy() {
    clearTimeout(this.timer);
  }
}
