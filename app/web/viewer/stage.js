/** The panels side by side: their heads, views and bars over one canvas with the surfaces, under one with the marks. */
import { element } from "./elements.js";
import { Drawing } from "./drawing.js";
import { themeOf, coloursOf } from "./theme.js";
import { reading, functionOf } from "./fields.js";
import { paintBar, barWords } from "./colour_bar.js";
import { paintShapes, paintCursor, paintLabel, paintNote, cutAwayWords } from "./marks.js";

const NARROWEST = 180, LOWEST = 180, COMFORTABLE = 320, WITHOUT_VIEW = 100, HEAD = 36, PICTURE_SCALE = 2, PALE = 0.6;

export class Stage {
  /** draw() needs `start`, which throws an Error with a sentence where the browser cannot draw. */
  constructor(root, scene, choices, choose) {
    this.root = root;
    this.scene = scene;
    this.choices = choices;
    this.surface = element("canvas", { class: "surface", "aria-hidden": true });
    this.over = element("canvas", { class: "over", "aria-hidden": true });
    this.bars = scene.panels.map(() => element("div", { class: "scale", role: "img" }));
    const role = { class: "view", tabindex: 0, role: "application" };
    this.views = scene.panels.map(() => element("div", role));
    this.heads = scene.panels.map((_, k) => this.#head(k, choose));
    this.sliders = scene.panels.map((_, k) => this.#slider(k, choose));
    this.panels = scene.panels.map((_, k) => {
      const head = element("h2", {}, this.heads[k], this.sliders[k]);
      return element("section", { class: "panel" }, head, this.views[k], this.bars[k]);
    });
    for (const k of this.panels.keys()) this.relabel(k);
    this.grid = element("div", { class: "grid" }, ...this.panels);
    this.sheet = element("div", { class: "sheet" }, this.surface, this.grid, this.over);
    this.element = element("div", { class: "stage" }, this.sheet);
    this.boxes = [];
  }

  /** The name of what a panel shows, with a list where there is a choice. */
  #head(k, choose) {
    if (this.choices.length < 2) return element("span");
    const options = this.choices.map(({ label }) => element("option", { text: label }));
    const head = element("select", { "aria-label": `Panel ${k + 1} shows` }, ...options);
    head.addEventListener("change", () => choose(k, String(head.selectedIndex)));
    return head;
  }

  #slider(k, choose) {
    const slider = element("input", { type: "range", min: 0 });
    slider.addEventListener("input", () => {
      const panel = this.scene.panels[k], { value } = functionOf(this.scene, panel).steps[slider.value];
      choose(k, `${panel.choice}:${value}`);
    });
    return slider;
  }

  /** Name what a panel shows. */
  relabel(k) {
    const panel = this.scene.panels[k], { label, note, choice } = panel, head = this.heads[k], slider = this.sliders[k];
    for (const [j, each] of [...(head.options ?? [])].entries())
      each.textContent = j === choice ? label : this.choices[j].label;
    if (head.options) head.selectedIndex = choice;
    else head.textContent = label;
    const { steps, meaning } = functionOf(this.scene, panel) ?? {};
    slider.hidden = !steps;
    if (steps) {
      slider.max = steps.length - 1;
      slider.value = steps.findIndex((each) => each.label === label);
      slider.title = meaning;
      slider.setAttribute("aria-label", meaning);
      slider.setAttribute("aria-valuetext", label);
    }
    head.title = note ? `${label}; ${note}` : label;
    this.panels[k].setAttribute("aria-label", label);
    this.views[k].setAttribute("aria-label", `${label}: a surface; press ? for the keys`);
    if (this.theme) this.drawing?.setColours(k, this.mapOf(k));
  }

  start(shape) {
    this.drawing = new Drawing(this.surface, shape, this.scene.panels.length, this.choices.some(({ labels }) => labels));
  }

  /** Take the theme anew, which the maps depend on. */
  dress() {
    this.theme = themeOf(this.root);
    this.colours = coloursOf(this.scene, this.theme);
    this.theme.line = `rgb(${this.scene.isolines.colour})`;
    for (const k of this.views.keys()) this.drawing?.setColours(k, this.mapOf(k));
  }

  mapOf(k) {
    const { labels, signed } = this.scene.panels[k];
    return labels ? labels.map(({ colour }) => colour) : signed ? this.colours.diverging : this.colours.map;
  }

  /** Rows and columns for the room there is. */
  fit() {
    const { clientWidth: width, clientHeight: height } = this.element, count = this.views.length;
    const columns = columnsFor(count, width, height), high = Math.floor(height / Math.ceil(count / columns));
    // Where not all have room, each row is as high as can be seen at a time.
    const scrolled = Math.max(Math.min(COMFORTABLE, height), LOWEST);
    this.grid.style.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
    this.grid.style.gridAutoRows = `${high >= LOWEST ? high : scrolled}px`;
    this.boxes.splice(0, this.boxes.length, ...this.views.map(boxOf));
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

  draw(camera) {
    const fraction = (colour) => colour.map((x) => x / 255), { background, undefined: none, back, section } = this.colours;
    const { colour, width } = this.scene.isolines;
    const [ground, nothing, inside, line, cut] = [background, none, back, colour, section].map(fraction);
    const look = { background: ground, undefined: nothing, back: inside, line, section: cut, width };
    this.drawing.draw(camera, this.boxes, this.scale, look);
  }

  /** Marks, bars and what they say to those who do not see them. @param {import("./viewer.js").Viewer} viewer */
  paint(viewer) {
    const brush = this.over.getContext("2d"), scale = this.over.width / this.grid.offsetWidth;
    brush.setTransform(scale, 0, 0, scale, 0, 0);
    brush.clearRect(0, 0, this.grid.offsetWidth, this.grid.offsetHeight);
    this.#paintAll(brush, viewer, viewer.pointing.place);
    const [gone = ""] = cutAwayWords(viewer);
    for (const [k, bar] of this.bars.entries()) {
      const { left, right } = barWords(this.scene.panels[k], viewer.current[k], null);
      this.panels[k].classList.toggle("computing", viewer.isStale(k));
      this.views[k].setAttribute("aria-description", gone);
      bar.setAttribute("aria-label", right ? `Colours: ${left}, ${right}` : "Computing");
    }
  }

  #paintAll(brush, viewer, pointed) {
    const notes = cutAwayWords(viewer);
    for (const [k, { x, y, width, height }] of this.boxes.entries()) {
      const answer = viewer.current[k], levels = viewer.levels[k]?.values ?? [];
      const value = pointed && answer ? reading(answer, pointed.vertex).value : null;
      const look = { map: this.mapOf(k), levels, theme: this.theme };
      paintBar(brush, this.barBoxes[k], this.scene.panels[k], answer, value, look);
      brush.save();
      brush.beginPath();
      brush.rect(x, y, width, height);
      brush.clip();
      if (viewer.isStale(k)) this.#pale(brush, this.boxes[k]);
      this.#paintMarks(brush, viewer, k);
      if (notes.length) paintNote(brush, this.boxes[k], notes, this.theme);
      if (pointed) this.#paintPointed(brush, viewer, k, pointed);
      brush.restore();
    }
  }

  #pale(brush, { x, y, width, height }) {
    brush.globalAlpha = PALE;
    brush.fillStyle = this.theme.canvas;
    brush.fillRect(x, y, width, height);
    brush.globalAlpha = 1;
  }

  #paintMarks(brush, { sight, pins, source }, k) {
    const { marks } = this.scene;
    const seen = (vertex) => (sight.isSeen(vertex) ? sight.placed(k, vertex) : null);
    for (const [number, { vertex }] of pins.entries()) {
      const at = seen(vertex);
      if (!at) continue;
      const colour = marks.colours[number % marks.colours.length];
      paintShapes(brush, marks.pin, ...at, { colour, number: number + 1, font: this.theme.font });
    }
    const at = seen(source);
    if (at) paintShapes(brush, marks.source, ...at);
  }

  #paintPointed(brush, { sight, current }, k, { vertex, panel, x, y, isCursor }) {
    const at = sight.placed(k, vertex), box = this.boxes[k], answer = current[k];
    if (!at) return;
    paintShapes(brush, k === panel ? this.scene.marks.ring : this.scene.marks.echo, ...at);
    if (k !== panel) return;
    if (isCursor) paintCursor(brush, box.x + x, box.y + y);
    if (answer) paintLabel(brush, ...at, box, reading(answer, vertex), answer, this.theme);
  }

  /** All panels with heads and bars, without the pointer. @returns {HTMLCanvasElement} */
  picture(viewer) {
    this.#size(Math.max(devicePixelRatio, PICTURE_SCALE));
    this.draw(viewer.sight.camera);
    const canvas = element("canvas", { width: this.surface.width, height: this.surface.height });
    const brush = canvas.getContext("2d"), { font, text, border } = this.theme;
    brush.drawImage(this.surface, 0, 0);
    brush.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    this.#paintAll(brush, viewer, null);
    for (const [k, { x, y, width, height }] of this.boxes.entries()) {
      brush.font = `600 13px ${font}`;
      brush.fillStyle = text;
      brush.fillText(this.scene.panels[k].label, x + 14, y - HEAD / 2 + 5, width - 28);
      brush.fillStyle = border;
      if (x > 0) brush.fillRect(x, y - HEAD, 1, height + WITHOUT_VIEW);
      if (y > HEAD) brush.fillRect(x, y - HEAD, width, 1);
    }
    this.fit();
    return canvas;
  }
}

const boxOf = (part) => ({ x: part.offsetLeft, y: part.offsetTop, width: part.offsetWidth, height: part.offsetHeight });

/** The number of columns that makes the views largest, none of them too narrow. */
export function columnsFor(count, width, height) {
  let best = 1, largest = -Infinity;
  for (let columns = 1; columns <= count && (columns === 1 || width / columns >= NARROWEST); columns++) {
    const side = Math.min(width / columns, height / Math.ceil(count / columns) - WITHOUT_VIEW);
    if (side > largest) [best, largest] = [columns, side];
  }
  return best;
}
