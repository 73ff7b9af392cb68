/** The panels side by side: their heads, views and bars over one canvas with the surfaces, under one with the marks. */
import { element } from "./elements.js";
import { Drawing } from "./drawing.js";
import { themeOf, coloursOf } from "./theme.js";
import { reading } from "./fields.js";
import { paintBar, barWords } from "./colour_bar.js";
import { paintSource, paintPin, paintRing, paintCursor, paintLabel } from "./marks.js";

const NARROWEST = 280,
  LOWEST = 320,
  WITHOUT_VIEW = 100,
  HEAD = 36,
  PICTURE_SCALE = 2;

export class Stage {
  /** draw() needs `start`, which throws an Error with a sentence where the browser cannot draw. */
  constructor(root, scene) {
    this.root = root;
    this.scene = scene;
    this.surface = element("canvas", { class: "surface", "aria-hidden": true });
    this.over = element("canvas", { class: "over", "aria-hidden": true });
    this.bars = scene.panels.map(() => element("div", { class: "scale", role: "img" }));
    this.views = scene.panels.map(({ label }) =>
      element("div", {
        class: "view",
        tabindex: 0,
        role: "application",
        "aria-label": `${label}: a surface; press ? for the keys`,
      }),
    );
    this.grid = element(
      "div",
      { class: "grid" },
      ...scene.panels.map(({ label }, k) =>
        element(
          "section",
          { class: "panel", "aria-label": label },
          element("h2", { text: label, title: label }),
          this.views[k],
          this.bars[k],
        ),
      ),
    );
    this.sheet = element("div", { class: "sheet" }, this.surface, this.grid, this.over);
    this.element = element("div", { class: "stage" }, this.sheet);
    this.boxes = [];
  }

  start(shape) {
    this.drawing = new Drawing(this.surface, shape, this.scene.panels.length);
  }

  /** Take the theme anew, which the maps depend on. */
  dress() {
    this.theme = themeOf(this.root);
    this.colours = coloursOf(this.scene, this.theme);
    this.theme.line = `rgb(${this.scene.isolines.colour})`;
    for (const k of this.views.keys()) this.drawing?.setColours(k, this.mapOf(k));
  }

  mapOf(k) {
    return this.scene.panels[k].distance === "difference" ? this.colours.diverging : this.colours.map;
  }

  /** Rows and columns for the room there is. */
  fit() {
    const { clientWidth: width, clientHeight: height } = this.element,
      count = this.views.length;
    const columns = columnsFor(count, width, height),
      rows = Math.ceil(count / columns);
    const lowest = columns === 1 && count > 1 ? Math.min(width, 380) + WITHOUT_VIEW : LOWEST;
    this.grid.style.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
    this.grid.style.gridAutoRows = `${Math.max(Math.floor(height / rows), lowest)}px`;
    this.boxes = this.views.map(boxOf);
    this.barBoxes = this.bars.map(boxOf);
    this.#size(this.drawing?.isSoftware ? 1 : devicePixelRatio);
  }

  #size(wanted) {
    const { offsetWidth: width, offsetHeight: height } = this.grid;
    this.scale = this.drawing && width ? this.drawing.resize(width, height, wanted) : wanted;
    const scale = Math.min(devicePixelRatio, this.scale === wanted ? Infinity : this.scale);
    this.over.width = Math.round(width * scale);
    this.over.height = Math.round(height * scale);
    for (const canvas of [this.surface, this.over])
      Object.assign(canvas.style, { width: `${width}px`, height: `${height}px` });
  }

  draw({ camera }) {
    const fraction = (colour) => colour.map((x) => x / 255),
      { isolines } = this.scene,
      { background, undefined: none } = this.colours;
    this.drawing.draw(camera, this.boxes, this.scale, {
      background: fraction(background),
      undefined: fraction(none),
      line: fraction(isolines.colour),
      width: isolines.width,
    });
  }

  /** Marks, bars and what they say to those who do not see them. @param {import("./viewer.js").Viewer} state */
  paint(state) {
    const brush = this.over.getContext("2d"),
      scale = this.over.width / this.grid.offsetWidth;
    brush.setTransform(scale, 0, 0, scale, 0, 0);
    brush.clearRect(0, 0, this.grid.offsetWidth, this.grid.offsetHeight);
    this.#paintAll(brush, state, state.pointed);
    for (const [k, bar] of this.bars.entries()) {
      const answer = state.answers[k],
        { left, right } = barWords(this.scene.panels[k], answer, null);
      bar.setAttribute("aria-label", answer ? `Colours: ${left}, ${right}` : "Computing");
    }
  }

  #paintAll(brush, state, pointed) {
    for (const [k, box] of this.boxes.entries()) {
      const answer = state.answers[k],
        look = { map: this.mapOf(k), levels: state.levels[k]?.values ?? [], theme: this.theme };
      const value = pointed && answer ? reading(answer, pointed.vertex).value : null;
      paintBar(brush, this.barBoxes[k], this.scene.panels[k], answer, value, look);
      brush.save();
      brush.beginPath();
      brush.rect(box.x, box.y, box.width, box.height);
      brush.clip();
      this.#paintMarks(brush, state, box);
      if (pointed) this.#paintPointed(brush, state, k, box, pointed);
      brush.restore();
    }
  }

  #paintMarks(brush, state, box) {
    for (const [k, { vertex }] of state.pins.entries()) {
      const at = this.#placed(state, vertex, box);
      if (at && state.isSeen(vertex)) paintPin(brush, ...at, k + 1, this.theme.font);
    }
    const at = this.#placed(state, state.source, box);
    if (at && state.isSeen(state.source)) paintSource(brush, ...at);
  }

  #paintPointed(brush, state, k, box, { vertex, panel, x, y, isCursor }) {
    const at = this.#placed(state, vertex, box),
      isHere = k === panel;
    if (at) paintRing(brush, ...at, isHere);
    if (isHere && isCursor) paintCursor(brush, box.x + x, box.y + y);
    const answer = state.answers[k];
    if (at && isHere && answer) paintLabel(brush, ...at, box, reading(answer, vertex), answer.signed, this.theme);
  }

  /** Where a vertex is in a view, in pixels of the sheet. */
  #placed(state, vertex, { x, y, width, height }) {
    const at = state.camera.project(state.shape.place(vertex), width / height);
    return at && [x + (width * (at[0] + 1)) / 2, y + (height * (1 - at[1])) / 2];
  }

  /** All panels with heads and bars, without the pointer. @returns {HTMLCanvasElement} */
  picture(state) {
    const { offsetWidth: width, offsetHeight: height } = this.grid;
    this.#size(Math.max(devicePixelRatio, PICTURE_SCALE));
    this.draw(state);
    const canvas = element("canvas"),
      brush = canvas.getContext("2d");
    canvas.width = this.surface.width;
    canvas.height = this.surface.height;
    brush.drawImage(this.surface, 0, 0);
    brush.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    this.#paintAll(brush, state, null);
    brush.font = `600 13px ${this.theme.font}`;
    brush.fillStyle = this.theme.text;
    for (const [k, { x, y, width: room }] of this.boxes.entries()) {
      brush.fillText(this.scene.panels[k].label, x + 14, y - HEAD / 2 + 5, room - 28);
    }
    brush.fillStyle = this.theme.border;
    for (const { x, y, height: high } of this.boxes) if (x > 0) brush.fillRect(x, y - HEAD, 1, high + WITHOUT_VIEW);
    this.fit();
    return canvas;
  }
}

const boxOf = (part) => ({ x: part.offsetLeft, y: part.offsetTop, width: part.offsetWidth, height: part.offsetHeight });

/** As many columns as make the views largest, none of them too narrow. */
function columnsFor(count, width, height) {
  let best = 1,
    largest = 0;
  for (let columns = 1; columns <= count && (columns === 1 || width / columns >= NARROWEST); columns++) {
    const side = Math.min(width / columns, Math.max(height / Math.ceil(count / columns), LOWEST) - WITHOUT_VIEW);
    const fits = height / Math.ceil(count / columns) >= LOWEST ? 1 : 0.5;
    if (side * fits > largest) [best, largest] = [columns, side * fits];
  }
  return best;
}
