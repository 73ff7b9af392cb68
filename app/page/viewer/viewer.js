/** Distances on a surface in linked panels: what is shown, and what becomes of clicks and keys. */
import { element } from "./elements.js";
import { Shape } from "./shape.js";
import { Camera, FARTHEST } from "./camera.js";
import { FaceTree } from "./picking.js";
import { Stage } from "./stage.js";
import { ToolBar } from "./tool_bar.js";
import { PinTable, valueWords } from "./pins.js";
import { fieldNames, panelAnswer, isolineLevels } from "./fields.js";
import { addGestures } from "./gestures.js";
import { act } from "./keys.js";
import { aboutBox, helpBox } from "./about.js";
import { addressOf, readAddress } from "./address.js";
import { savePicture, copyLink } from "./saving.js";
import { written } from "./numbers.js";

const NOTICED = 150,
  SPOKEN = 500,
  ADDRESSED = 400,
  MOST_VISITED = 200,
  TURN = 3.5,
  KEY_ZOOM = 1.15,
  ROOM_FOR_PINS = 600;

export class Viewer {
  /**
   * @param {HTMLElement} root of the class "bihdist"; all of the viewer is inside it
   * @param {{mesh: object, scene: object, solver: {field: Function}, hasAddress?: boolean,
   *   onsource?: (id: number) => void, onpins?: (pins: {id: number, name: string}[]) => void}} host
   *   hasAddress: the page's address holds what is shown; onsource, onpins: the user has changed them
   */
  constructor(root, { mesh, scene, solver, hasAddress = false, onsource = () => {}, onpins = () => {} }) {
    Object.assign(this, { root, mesh, scene, solver, hasAddress, onsource, onpins });
    this.vertices = new Map(Array.from(mesh.ids, (id, vertex) => [id, vertex]));
    this.names = [...new Set(scene.panels.flatMap(fieldNames))];
    this.answers = scene.panels.map(() => null);
    this.levels = scene.panels.map(() => null);
    this.shape = new Shape(mesh);
    this.source = this.vertices.get(scene.source) ?? 0;
    this.pins = [];
    this.pointed = this.cursor = null;
    this.visited = [];
    this.at = -1;
    this.seen = new Map();
    this.timers = {};
    this.ended = new AbortController();
    this.#build();
    this.#home();
    try {
      this.stage.start(this.shape);
    } catch (error) {
      this.say(error.message, true);
      root.replaceChildren(this.notice);
      return;
    }
    this.#listen();
    this.setPins(scene.pins);
    if (!hasAddress || !this.#follow(location.hash)) this.#visit(this.source);
    this.timers.tree = setTimeout(() => this.tree, NOTICED);
  }

  #build() {
    const { scene } = this;
    this.stage = new Stage(this.root, scene);
    this.bar = new ToolBar(
      scene,
      {
        source: (text) => this.#typed(text, (vertex) => this.#chosen(vertex)),
        back: () => this.#step(-1),
        forward: () => this.#step(1),
        home: () => {
          this.#home();
          this.#addressSoon();
        },
        pins: () => this.#showPins(this.table.element.hidden),
        link: async () => this.#address() || this.say(await copyLink()),
        picture: () => {
          savePicture(this.stage.picture(this), scene.title);
          this.redraw();
        },
        about: () => this.about.showModal(),
        help: () => this.help.showModal(),
      },
      this.hasAddress,
    );
    this.table = new PinTable(scene.panels, {
      add: (text) => this.#typed(text, (vertex) => this.#pin(vertex)),
      rename: (k, name) => this.#changePins(this.pins.map((pin, each) => (each === k ? { ...pin, name } : pin))),
      remove: (k) => this.#changePins(this.pins.filter((_, each) => each !== k)),
      choose: (id) => this.#chosen(this.vertices.get(id)),
    });
    this.notice = element("p", { class: "notice", role: "alert", hidden: true });
    this.message = element("span", { role: "status" });
    this.where = element("span", { class: "where" });
    this.spoken = element("div", { class: "spoken", "aria-live": "polite" });
    this.about = aboutBox(scene);
    this.help = helpBox();
    this.root.replaceChildren(
      this.bar.element,
      this.notice,
      this.stage.element,
      this.table.element,
      element("footer", { class: "status" }, this.message, this.where),
      this.spoken,
      this.about,
      this.help,
    );
  }

  #listen() {
    const { signal } = this.ended,
      { stage } = this;
    stage.dress();
    const theme = matchMedia("(prefers-color-scheme: dark)");
    theme.addEventListener(
      "change",
      () => {
        stage.dress();
        this.redraw();
      },
      { signal },
    );
    this.resized = new ResizeObserver(() => {
      stage.fit();
      this.#frame();
    });
    this.resized.observe(stage.element);
    stage.surface.addEventListener("webglcontextlost", (event) => event.preventDefault(), { signal });
    stage.surface.addEventListener("webglcontextrestored", () => this.#restore(), { signal });
    if (this.hasAddress) addEventListener("hashchange", () => this.#follow(location.hash), { signal });
    for (const [k, view] of stage.views.entries()) {
      addGestures(view, this.#intents(k), signal);
      view.addEventListener("keydown", (event) => act(event, this.#keys(k)), { signal });
      view.addEventListener("focus", () => view.matches(":focus-visible") && this.#moveCursor(k, 0, 0), { signal });
      view.addEventListener(
        "blur",
        () => {
          this.cursor = null;
          this.#point(null);
        },
        { signal },
      );
    }
  }

  // ------------------------------------------------------------ from outside
  /** Show distances from a vertex of the file. */
  setSource(id) {
    const vertex = this.vertices.get(id);
    if (vertex !== undefined && vertex !== this.source) this.#visit(vertex);
  }

  /** @param {{id: number, name: string}[]} pins */
  setPins(pins) {
    this.pins = pins
      .filter(({ id }) => this.vertices.has(id))
      .map(({ id, name }) => ({ id, name, vertex: this.vertices.get(id) }));
    if (this.pins.length && this.root.clientWidth > ROOM_FOR_PINS) this.#showPins(true);
    this.redraw(false);
  }

  /** What the solver is at. */
  progress(words) {
    this.message.textContent = words;
  }

  /** A sentence for the user. */
  say(words, isWrong = false) {
    if (!isWrong) return void (this.message.textContent = words);
    this.notice.textContent = words;
    this.notice.hidden = false;
  }

  destroy() {
    this.ended.abort();
    this.resized?.disconnect();
    Object.values(this.timers).forEach(clearTimeout);
    cancelAnimationFrame(this.asked);
    this.stage.drawing?.destroy();
    this.root.replaceChildren();
  }

  // ------------------------------------------------------------ source and fields
  /** The user chose a source. */
  #chosen(vertex, since = performance.now()) {
    this.notice.hidden = true;
    this.#visit(vertex, since);
    this.#addressSoon();
    this.onsource(this.mesh.ids[vertex]);
  }

  #visit(vertex, since) {
    if (this.visited[this.at] !== vertex) {
      this.visited = [...this.visited.slice(0, this.at + 1), vertex].slice(-MOST_VISITED);
      this.at = this.visited.length - 1;
    }
    this.#compute(vertex, since);
  }

  #step(by) {
    if (!(this.at + by in this.visited)) return;
    this.at += by;
    this.#chosen(this.visited[this.at]);
  }

  async #compute(vertex, since = performance.now()) {
    this.source = vertex;
    this.bar.show(this.mesh.ids[vertex], this.at > 0, this.at + 1 < this.visited.length);
    this.redraw(false);
    const { root, timers, ended } = this;
    clearTimeout(timers.busy);
    timers.busy = setTimeout(() => root.classList.add("computing"), NOTICED);
    try {
      const answer = await this.solver.field(vertex, this.names);
      if (!answer || ended.signal.aborted) return;
      this.#show(answer, since);
    } catch (error) {
      this.hasFailed = true;
      this.say(error.message, true);
    }
    if (vertex === this.source) {
      clearTimeout(timers.busy);
      root.classList.remove("computing");
    }
  }

  #show({ source, fields, took }, since) {
    if (this.hasFailed) this.notice.hidden = true;
    this.hasFailed = false;
    for (const [k, panel] of this.scene.panels.entries()) {
      this.answers[k] = panelAnswer(panel, fields);
      this.levels[k] = isolineLevels(this.scene.isolines, this.answers[k]);
      this.stage.drawing.setAnswer(k, this.answers[k], this.levels[k]);
    }
    this.redraw();
    const count = this.names.length === 1 ? "1 field" : `${this.names.length} fields`;
    this.say(`${count} in ${took.toFixed(took < 10 ? 1 : 0)} ms`);
    this.drawn = () =>
      this.root.dispatchEvent(
        new CustomEvent("picture", {
          detail: { source: this.mesh.ids[source], took, since: performance.now() - since },
        }),
      );
  }

  /** Do something with a typed vertex; what is wrong, or "". */
  #typed(text, then) {
    const vertex = /^\d{1,10}$/.test(text.trim()) ? this.vertices.get(Number(text)) : undefined;
    if (vertex !== undefined) return then(vertex) ?? "";
    let last = 0;
    for (const id of this.mesh.ids) last = Math.max(last, id);
    return `No vertex ${text.trim().slice(0, 12) || "without a number"} here: 0 to ${last}`;
  }

  // ------------------------------------------------------------ pins
  #pin(vertex) {
    if (this.pins.some((pin) => pin.vertex === vertex)) return;
    this.#changePins([...this.pins, { id: this.mesh.ids[vertex], name: "", vertex }]);
    this.#showPins(true);
  }

  #changePins(pins) {
    this.pins = pins;
    this.onpins(pins.map(({ id, name }) => ({ id, name })));
    this.#addressSoon();
    this.redraw(false);
  }

  #showPins(isShown) {
    this.table.element.hidden = !isShown;
    this.bar.pins.setAttribute("aria-expanded", String(isShown));
  }

  // ------------------------------------------------------------ camera
  #home() {
    const { position, focal, ...rest } = this.scene.camera,
      { shape } = this;
    const parallel = rest.parallel === null || rest.parallel === undefined ? null : rest.parallel / shape.radius;
    this.camera = new Camera(
      { ...rest, position: shape.inward(position), focal: shape.inward(focal), parallel },
      shape.places,
    );
    this.#moved();
  }

  #moved() {
    this.seen.clear();
    this.redraw();
  }

  #aspect(k) {
    const { width, height } = this.stage.boxes[k];
    return width / height;
  }

  /** A place in pixels of a view as -1 … 1. */
  #inView(k, x, y) {
    const { width, height } = this.stage.boxes[k];
    return [(2 * x) / width - 1, 1 - (2 * y) / height];
  }

  get tree() {
    return (this.faceTree ??= new FaceTree(this.shape));
  }

  #hit(k, x, y) {
    return this.tree.hit(this.camera.ray(...this.#inView(k, x, y), this.#aspect(k)));
  }

  /** Whether the surface leaves a vertex in sight. */
  isSeen(vertex) {
    if (!this.seen.has(vertex)) {
      const ray = this.camera.rayTo(this.shape.place(vertex)),
        hit = this.tree.hit(ray);
      const away = Math.hypot(...this.shape.place(vertex).map((x, axis) => x - ray.origin[axis]));
      this.seen.set(vertex, !hit || hit.away > away - 0.01);
    }
    return this.seen.get(vertex);
  }

  // ------------------------------------------------------------ gestures and keys
  /** @returns {import("./gestures.js").Intents} */
  #intents(k) {
    const moved =
      (change) =>
      (...given) => {
        change(...given);
        this.pointed = null;
        this.#moved();
        this.#addressSoon();
      };
    const size = () => this.stage.boxes[k];
    return {
      hover: (x, y) => {
        this.cursor = null;
        this.#point({ panel: k, x, y });
      },
      leave: () => this.#point(null),
      pick: (x, y, since) => this.#pick(k, x, y, since),
      live: (x, y) => this.#follows(k, x, y),
      settle: () => this.#chosen(this.source),
      turn: moved((dx, dy) => this.camera.turn((TURN * dx) / size().height, (TURN * dy) / size().height)),
      pan: moved((dx, dy) => this.camera.pan((2 * dx) / size().width, (-2 * dy) / size().height, this.#aspect(k))),
      zoom: moved((factor, x, y) => this.camera.zoom(factor, ...this.#inView(k, x, y), this.#aspect(k))),
    };
  }

  #keys(k) {
    const intents = this.#intents(k),
      { width, height } = this.stage.boxes[k];
    const zoom = (factor) => {
      intents.zoom(factor, width / 2, height / 2);
      this.#moveCursor(k, 0, 0);
    };
    const here = (then) => {
      if (!this.pointed) this.#moveCursor(k, 0, 0);
      if (this.pointed) then(this.pointed.vertex);
    };
    return {
      turn: (dx, dy) => {
        intents.turn(dx, dy);
        if (this.cursor) this.#moveCursor(k, 0, 0);
      },
      cursor: (dx, dy) => this.#moveCursor(k, dx, dy),
      nearer: () => zoom(KEY_ZOOM),
      farther: () => zoom(1 / KEY_ZOOM),
      home: () => this.#home(),
      source: () => here((vertex) => this.#chosen(vertex)),
      pin: () => here((vertex) => this.#pin(vertex)),
      back: () => this.#step(-1),
      forward: () => this.#step(1),
      help: () => this.help.showModal(),
    };
  }

  #pick(k, x, y, since) {
    const hit = this.#hit(k, x, y);
    if (hit) this.#chosen(hit.vertex, since);
  }

  #follows(k, x, y) {
    const hit = this.#hit(k, x, y);
    if (hit && hit.vertex !== this.source) this.#compute(hit.vertex);
  }

  #moveCursor(k, dx, dy) {
    const { width, height } = this.stage.boxes[k],
      { x, y } = this.cursor ?? { x: width / 2, y: height / 2 };
    this.cursor = { x: Math.min(Math.max(x + dx, 0), width), y: Math.min(Math.max(y + dy, 0), height) };
    this.#point({ panel: k, ...this.cursor, isCursor: true });
  }

  /** Show the values at a place of a view. */
  #point(place) {
    const hit = place && this.#hit(place.panel, place.x, place.y);
    this.pointed = hit ? { ...place, vertex: hit.vertex } : null;
    this.redraw(false);
    if (hit || place?.isCursor) this.timers.speak ??= setTimeout(() => this.#speak(), SPOKEN);
  }

  #speak() {
    delete this.timers.speak;
    const values = (vertex) =>
      this.scene.panels.map(({ label }, k) => `${label} ${valueWords(this.answers[k], vertex)}`);
    this.spoken.textContent = this.pointed
      ? `Vertex ${this.mesh.ids[this.pointed.vertex]}: ${values(this.pointed.vertex).join("; ")}`
      : "No surface here.";
  }

  // ------------------------------------------------------------ address
  #address() {
    if (!this.hasAddress) return;
    const { camera, shape } = this;
    const numbers = [shape.outward(camera.position), shape.outward(camera.focal), camera.up];
    try {
      history.replaceState(
        null,
        "",
        addressOf({ source: this.mesh.ids[this.source], pins: this.pins, camera: numbers }),
      );
    } catch {
      this.hasAddress = false;
    }
  }

  #addressSoon() {
    if (!this.hasAddress) return;
    clearTimeout(this.timers.address);
    this.timers.address = setTimeout(() => this.#address(), ADDRESSED);
  }

  /** Take a camera's position, focal point and way up. @returns {boolean} whether it is anywhere near the surface */
  #look([position, focal, up]) {
    const places = [position, focal].map((point) => this.shape.inward(point));
    if (places.some((place) => Math.hypot(...place) > FARTHEST)) return false;
    this.camera.look(...places, up);
    this.#moved();
    return true;
  }

  /** Show what an address holds. @returns {boolean} whether it had a source */
  #follow(hash) {
    const { source, pins, camera, ignored } = readAddress(hash, (id) => this.vertices.has(id));
    if (camera) this.#look(camera) || ignored.push("camera");
    if (pins) this.setPins(pins);
    if (source !== undefined) this.#visit(this.vertices.get(source));
    if (ignored.length) this.say(`The link was not understood in part, and left out: ${ignored.join(", ")}.`, true);
    return source !== undefined;
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
    const { stage } = this;
    if (!stage.drawing || !stage.boxes.length || !stage.grid.offsetWidth) return;
    if (this.stale) stage.draw(this);
    this.stale = false;
    stage.paint(this);
    this.table.show(this.pins, this.answers);
    this.#showWhere();
    this.drawn?.();
    this.drawn = null;
  }

  #showWhere() {
    const vertex = this.pointed?.vertex;
    const place = vertex === undefined ? [] : this.mesh.positions.subarray(3 * vertex, 3 * vertex + 3);
    this.where.textContent =
      vertex === undefined
        ? ""
        : `vertex ${this.mesh.ids[vertex]}   ${Array.from(place, (x) => written(x)).join("  ")}`;
  }

  #restore() {
    this.stage.drawing.restore();
    this.stage.dress();
    for (const [k, answer] of this.answers.entries())
      if (answer) this.stage.drawing.setAnswer(k, answer, this.levels[k]);
    this.redraw();
  }
}
