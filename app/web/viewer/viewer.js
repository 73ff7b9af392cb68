/** Distances on a surface in linked panels: what is shown, and what becomes of clicks and keys. */
import { element, dialog } from "./elements.js";
import { Shape } from "./shape.js";
import { Sight } from "./sight.js";
import { Stage } from "./stage.js";
import { ToolBar } from "./tool_bar.js";
import { PinTable } from "./pins.js";
import { Pointing } from "./pointing.js";
import { fieldNames, panelAnswer, isolineLevels, panelAt, partsOf } from "./fields.js";
import { addGestures } from "./gestures.js";
import { addKeys } from "./keys.js";
import { aboutBox, helpBox } from "./about.js";
import { Link } from "./link.js";
import { savePicture, copied, copyBox } from "./saving.js";

const NOTICED = 150, MOST_VISITED = 200, ROOM_FOR_PINS = { width: 600, height: 600 };

const HINTED = 1500, CONTROL = /^Mac/.test(navigator.platform) ? "⌘" : "Ctrl";
const HINTS = {
  mouse: `${CONTROL} + scroll, or click first, to zoom`,
  touch: "Two fingers turn and zoom the surface",
};

const timed = (words, took) => `${words} in ${took.toFixed(took < 10 ? 1 : 0)} ms`;

export class Viewer {
  /**
   * @param {HTMLElement} root of the class "bihdist"; all of the viewer is inside it
   * @param {{mesh: object, scene: object, solver: {field: Function}, isEmbedded?: boolean, hasAddress?: boolean,
   *   onsource?: (id: number) => void, onpins?: (pins: {id: number, name: string}[]) => void}} host
   *   isEmbedded: it is part of a page that scrolls; hasAddress: the page's address holds what is shown; onsource,
   *   onpins: the user has changed them
   */
  constructor(root, { mesh, scene, solver, isEmbedded = false, hasAddress = false, ...told }) {
    const { onsource = () => {}, onpins = () => {} } = told;
    /** What a panel can show: what panels show at first, and what else there is. */
    const all = new Map([...scene.panels, ...scene.offered].map((each) => [each.label, each]));
    this.choices = [...all.values()].map((each, choice) => ({ ...each, choice }));
    scene = { ...scene, panels: scene.panels.map(({ label }) => this.choices.find((each) => each.label === label)) };
    Object.assign(this, { root, mesh, scene, solver, isEmbedded, hasAddress, onsource, onpins });
    this.first = String(this.chosen);
    this.vertices = new Map(Array.from(mesh.ids, (id, vertex) => [id, vertex]));
    this.fields = {}; // by name, each with its source
    this.answers = scene.panels.map(() => null);
    this.isLate = this.hasFailed = false;
    this.levels = scene.panels.map(() => null);
    this.source = this.vertices.get(scene.source) ?? 0;
    this.pins = [];
    this.visited = [];
    this.at = -1;
    this.link = new Link(this);
    this.timers = {};
    this.ended = new AbortController();
    root.classList.toggle("embedded", isEmbedded);
    root.dataset.lmSuppressShortcuts = ""; // JupyterLab's, of the keys that views take
    const shape = new Shape(mesh, {
      crease: scene.crease,
      backs: scene.mesh.backs,
      clip: scene.clip,
      cut: scene.cut,
      opacity: scene.opacity,
    });
    this.#build();
    try {
      this.stage.start(shape);
    } catch (error) {
      this.say(error.message, true);
      root.replaceChildren(this.notice);
      return;
    }
    /** How panels see the shape; missing where the browser cannot draw. */
    this.sight = new Sight(shape, scene.camera, this.stage.boxes);
    this.#listen();
    this.setPins(scene.pins);
    if (!hasAddress || !this.link.follow()) this.visit(this.source);
    this.timers.tree = setTimeout(() => this.sight.tree, NOTICED);
  }

  #build() {
    const choose = (k, choice) => this.choosePanel(k, choice);
    this.stage = new Stage(this.root, this.scene, this.choices, choose);
    this.bar = new ToolBar(this);
    this.table = new PinTable(this);
    this.pointing = new Pointing(this);
    this.notice = element("p", { class: "notice", role: "alert", hidden: true });
    this.message = element("span", { role: "status" });
    this.about = aboutBox(this.scene, this.hasAddress);
    this.help = helpBox();
    this.hint = element("p", { class: "hint", "aria-hidden": true });
    this.stage.sheet.append(this.hint);
    const { credit, version } = this.scene, open = () => this.about.showModal();
    const made = [credit && `${credit} ·`, `bihdist ${version}`].map((text) => element("span", { text }));
    const signature = element("button", { type: "button", class: "signature", title: "About", click: open }, ...made);
    const { bar, notice, stage, table, message, pointing, about, help } = this;
    const footer = element("footer", { class: "status" }, message, pointing.where, signature);
    this.root.replaceChildren(bar.element, notice, stage.element, table.element, footer, pointing.spoken, about, help);
  }

  #listen() {
    const { signal } = this.ended, { stage, pointing } = this;
    const listen = (what, name, then) => what.addEventListener(name, then, { signal });
    listen(matchMedia("(prefers-color-scheme: dark)"), "change", () => this.#dress());
    this.resized = new ResizeObserver(() => this.#fit());
    this.resized.observe(stage.element);
    listen(stage.surface, "webglcontextlost", (event) => event.preventDefault());
    listen(stage.surface, "webglcontextrestored", () => this.#restore());
    if (this.hasAddress) listen(window, "hashchange", () => this.link.follow());
    // In a page that scrolls, the wheel zooms from a click on until the mouse leaves.
    listen(stage.element, "pointerdown", ({ pointerType }) => (this.hasWheel = pointerType !== "touch"));
    listen(this.root, "pointerleave", () => (this.hasWheel = false));
    for (const [k, view] of stage.views.entries()) {
      addGestures(view, this.#intents(k), signal, this.isEmbedded);
      addKeys(view, k, this, signal);
      listen(view, "focus", () => view.matches(":focus-visible") && pointing.move(k, 0, 0));
      listen(view, "blur", () => pointing.at(null));
    }
  }

  // ------------------------------------------------------------ from outside
  /** Show distances from a vertex of the file. */
  setSource(id) {
    const vertex = this.vertices.get(id);
    if (vertex !== undefined && vertex !== this.source) this.visit(vertex);
  }

  /** @param {{id: number, name: string}[]} pins */
  setPins(pins) {
    const known = pins.filter(({ id }) => this.vertices.has(id));
    this.pins = known.map(({ id, name }) => ({ id, name, vertex: this.vertices.get(id) }));
    const { clientWidth: width, clientHeight: height } = this.root;
    if (known.length && width > ROOM_FOR_PINS.width && height > ROOM_FOR_PINS.height) this.showPins(true);
    this.redraw(false);
  }

  /** What the solver is at. */
  progress(words) {
    this.message.textContent = words;
  }

  /** A sentence for the user. */
  say(words, isWrong = false) {
    if (!isWrong) return this.progress(words);
    this.notice.textContent = words;
    this.notice.hidden = false;
  }

  destroy() {
    this.ended.abort();
    this.resized?.disconnect();
    this.pointing.destroy();
    this.link.destroy();
    for (const timer of Object.values(this.timers)) clearTimeout(timer);
    cancelAnimationFrame(this.asked);
    this.stage.drawing?.destroy();
    this.root.replaceChildren();
  }

  // ------------------------------------------------------------ source and fields
  /** The user chose a source. */
  choose(vertex, since) {
    this.notice.hidden = true;
    this.visit(vertex, since);
    this.link.writeSoon();
    this.onsource(this.mesh.ids[vertex]);
  }

  /** Show distances from a stored vertex. */
  visit(vertex, since) {
    if (this.visited[this.at] !== vertex) {
      this.visited = [...this.visited.slice(0, this.at + 1), vertex].slice(-MOST_VISITED);
      this.at = this.visited.length - 1;
    }
    this.#compute(vertex, since);
  }

  /** To the source before (-1) or after (1). */
  step(by) {
    if (!(this.at + by in this.visited)) return;
    this.at += by;
    this.choose(this.visited[this.at]);
  }

  /** isPassing: another source follows at once, as in a drag. */
  async #compute(vertex, since = performance.now(), isPassing = false) {
    this.source = vertex;
    this.bar.show(this.mesh.ids[vertex], this.at > 0, this.at + 1 < this.visited.length);
    this.redraw(false);
    const { timers, ended } = this, all = [...new Set(this.scene.panels.flatMap(fieldNames))];
    const latest = (this.latest = {});
    this.fields = Object.fromEntries(Object.entries(this.fields).filter(([name]) => all.includes(name)));
    const names = all.filter((name) => this.fields[name]?.source !== vertex);
    timers.late ??= setTimeout(() => this.#setLate(true), NOTICED);
    const receive = (answer) => ended.signal.aborted || this.#receive(answer, names);
    try {
      const answer = await this.solver.field(vertex, names, receive, !isPassing);
      if (!answer || ended.signal.aborted) return;
      if (this.hasFailed) this.notice.hidden = true;
      this.hasFailed = false;
      this.#tell(answer, since);
    } catch (error) {
      this.hasFailed = true;
      this.say(error.message, true);
    }
    if (latest !== this.latest) return;
    clearTimeout(timers.late);
    timers.late = null;
    this.#setLate(this.hasFailed);
  }

  /** Show the panels whose fields are all there with this part of an answer. */
  #receive({ source, fields, took }, names) {
    for (const [name, values] of Object.entries(fields)) this.fields[name] = { source, values };
    for (const [k, panel] of this.scene.panels.entries())
      if (fieldNames(panel).some((name) => name in fields)) this.#show(k);
    const done = names.filter((name) => this.fields[name]?.source === source).length;
    if (source === this.source) this.say(timed(`${done} of ${names.length} fields`, took));
  }

  /** What panels show, by their places among the choices, with the value of a slider that was moved: "2", "3:0.25". */
  get chosen() {
    const value = ({ choice, distance }) => (distance === this.choices[choice].distance ? [] : partsOf(distance)[1]);
    return this.scene.panels.map((panel) => [panel.choice].concat(value(panel)).join(":"));
  }

  /** What a panel shows by such a text; undefined if there is no such choice. */
  panelOf(text) {
    const [choice, value] = text.split(":"), made = this.choices[choice];
    return value === undefined || !made ? made : panelAt(this.scene, made, Number(value));
  }

  /** Let panels show these of the choices, once the source is visited. */
  setPanels(chosen) {
    for (const [k, text] of chosen.entries()) {
      if (text === this.chosen[k]) continue;
      const panel = this.panelOf(text), isMoved = this.answers[k] && panel.choice === this.scene.panels[k].choice;
      this.scene.panels[k] = panel;
      // Where the slider moves, what is there is shown until the next field is.
      this.answers[k] = isMoved ? { ...this.answers[k], source: null } : null;
      if (!isMoved) this.levels[k] = null;
      this.stage.relabel(k);
      this.#show(k);
    }
    this.table.relabel(this.scene.panels);
  }

  /** The user chose what a panel shows. */
  choosePanel(k, text) {
    this.setPanels(Object.assign(this.chosen, { [k]: text }));
    this.#compute(this.source);
    this.link.writeSoon();
  }

  #show(k) {
    const panel = this.scene.panels[k], found = fieldNames(panel).map((name) => [name, this.fields[name]]);
    const source = found[0][1]?.source;
    if (source === undefined || found.some(([, field]) => field?.source !== source)) return;
    const fields = Object.fromEntries(found.map(([name, { values }]) => [name, values]));
    this.answers[k] = { source, ...panelAnswer(panel, fields) };
    this.levels[k] = isolineLevels(panel.isolines ?? this.scene.isolines, this.answers[k]);
    this.stage.drawing.setAnswer(k, this.answers[k], this.levels[k]);
    this.redraw();
  }

  /** The picture of a whole answer is told of, for those who measure: `since` is the time from the click to it. */
  #tell({ source, fields, took }, since) {
    const { length } = Object.keys(fields), id = this.mesh.ids[source];
    if (length) this.say(timed(`${length} ${length === 1 ? "field" : "fields"}`, took));
    const detail = () => ({ source: id, took, since: performance.now() - since });
    this.drawn = () => this.root.dispatchEvent(new CustomEvent("picture", { detail: detail() }));
    this.redraw();
  }

  #setLate(isLate) {
    this.isLate = isLate;
    this.redraw(false);
  }

  /** Whether a panel has not shown the distances from the source for long enough to be noticed. */
  isStale(k) {
    return this.isLate && this.answers[k]?.source !== this.source;
  }

  /** What panels show, null where that is yet to come. */
  get current() {
    return this.answers.map((answer, k) => (this.isStale(k) ? null : answer));
  }

  /** Do something with a typed vertex. @returns {string} what is wrong, or "" */
  typed(text, then) {
    const vertex = /^\d{1,10}$/.test(text.trim()) ? this.vertices.get(Number(text)) : undefined;
    const last = this.mesh.ids.reduce((most, id) => Math.max(most, id));
    if (vertex === undefined) return `No vertex ${text.trim().slice(0, 12)} here: 0 to ${last}`;
    then(vertex);
    return "";
  }

  // ------------------------------------------------------------ pins
  pin(vertex) {
    if (this.pins.some((pin) => pin.vertex === vertex)) return;
    this.changePins([...this.pins, { id: this.mesh.ids[vertex], name: "", vertex }]);
    this.showPins(true);
  }

  changePins(pins) {
    this.pins = pins;
    this.onpins(pins.map(({ id, name }) => ({ id, name })));
    this.link.writeSoon();
    this.redraw(false);
  }

  showPins(isShown = this.table.element.hidden) {
    this.table.element.hidden = !isShown;
    this.bar.pins.setAttribute("aria-expanded", String(isShown));
  }

  // ------------------------------------------------------------ camera
  /** Change the camera by one of the acts of `Sight`. */
  move(act, ...given) {
    this.sight[act](...given);
    if (!this.pointing.cursor) this.pointing.place = null;
    this.link.writeSoon();
    this.redraw();
  }

  /** @returns {import("./gestures.js").Intents} */
  #intents(k) {
    const onSurface = (then) => (x, y, since) => {
      const hit = this.sight.hit(k, x, y);
      if (hit) then(hit.vertex, since);
    };
    return {
      hover: (x, y) => this.pointing.at({ panel: k, x, y }),
      leave: () => this.pointing.at(null),
      pick: onSurface((vertex, since) => this.choose(vertex, since)),
      live: onSurface((vertex) => vertex !== this.source && this.#compute(vertex, undefined, true)),
      settle: () => this.choose(this.source),
      turn: (...by) => this.move("turn", k, ...by),
      pan: (...by) => this.move("pan", k, ...by),
      zoom: (...by) => this.move("zoom", k, ...by),
      leavesWheel: () => this.isEmbedded && !this.hasWheel,
      scrolled: (pointer) => this.#showHint(pointer),
    };
  }

  #showHint(pointer) {
    this.hint.textContent = HINTS[pointer] ?? HINTS.touch;
    this.hint.classList.add("shown");
    clearTimeout(this.timers.hint);
    this.timers.hint = setTimeout(() => this.hint.classList.remove("shown"), HINTED);
  }

  // ------------------------------------------------------------ what leaves the page
  savePicture() {
    savePicture(this.stage.picture(this), this.scene.title);
    this.redraw();
  }

  async copyLink() {
    const { url } = this.link;
    this.link.write();
    if (await copied(url)) return this.say("The link to this view is copied.");
    const box = dialog("Link to this view", copyBox("Link", url));
    box.addEventListener("close", () => box.remove());
    this.root.append(box);
    box.showModal();
  }

  // ------------------------------------------------------------ drawing
  /** Draw in the next frame; isSurface: not the marks alone. */
  redraw(isSurface = true) {
    this.stale ||= isSurface;
    this.asked ??= requestAnimationFrame(() => this.#frame());
  }

  #frame() {
    cancelAnimationFrame(this.asked);
    this.asked = null;
    const { stage, sight, pointing } = this;
    if (!sight || !stage.boxes.length || !stage.grid.offsetWidth) return;
    if (this.stale) stage.draw(sight.camera);
    this.stale = false;
    stage.paint(this);
    this.table.show(this.pins, this.current);
    pointing.show();
    this.drawn?.();
    this.drawn = null;
  }

  #fit() {
    if (!this.root.isConnected) return; // without a style
    if (!this.stage.theme) this.stage.dress();
    this.stage.fit();
    this.stale = true;
    this.#frame();
  }

  #dress() {
    if (!this.stage.theme) return;
    this.stage.dress();
    this.redraw();
  }

  #restore() {
    this.stage.drawing.restore();
    for (const [k, answer] of this.answers.entries())
      if (answer) this.stage.drawing.setAnswer(k, answer, this.levels[k]);
    this.#dress();
  }
}
