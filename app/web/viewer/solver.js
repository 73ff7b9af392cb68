// Distances from a vertex, computed by the kernel in two workers: a column at a time, the latest question first.

/** The worker; its own text is all it knows. */
function work() {
  const [POINTS, FACES, WEIGHTS, AREAS, BIHARMONIC, COMMUTE_TIME, GEODESIC] = [0, 1, 2, 3, 4, 5, 6];
  const PLACE = { biharmonic: BIHARMONIC, commute_time: COMMUTE_TIME, geodesic: GEODESIC };
  const MOST_INSTANCES = 8, WINDOWS_PER_VERTEX = 2000, WINDOWS_AT_LEAST = 200000;
  let wasm, module, mesh, points, scene;
  const instances = new Map();

  // The kernel with one component in its memory.
  class Part {
    constructor(number) {
      const [first, end] = [mesh.components[number], mesh.components[number + 1]];
      const [firstFace, endFace] = [mesh.faceComponents[number], mesh.faceComponents[number + 1]];
      Object.assign(this, { first, firstFace, n: end - first, m: endFace - firstFace, near: scene.near[number] });
      this.kernel = new WebAssembly.Instance((module ??= new WebAssembly.Module(wasm)), {}).exports;
      this.kernel.page_begin(this.n, this.m);
      this.doubles(POINTS, 3 * this.n).set(mesh.positions.subarray(3 * first, 3 * end));
      const faces = new Int32Array(this.kernel.memory.buffer, this.kernel.page_array(FACES), 3 * this.m);
      for (let k = 0; k < faces.length; k++) faces[k] = mesh.faces[3 * firstFace + k] - first;
    }
    doubles(which, count) {
      return new Float64Array(this.kernel.memory.buffer, this.kernel.page_array(which), count);
    }
    correct() {
      const { first, n, firstFace, m } = this, weights = this.doubles(WEIGHTS, 3 * m), areas = this.doubles(AREAS, n);
      for (const [face, ...three] of scene.corrections.weights)
        if (face >= firstFace && face < firstFace + m)
          three.forEach((weight, k) => (weights[k * m + face - firstFace] = weight));
      for (const [vertex, area] of scene.corrections.areas)
        if (vertex >= first && vertex < first + n) areas[vertex - first] = area;
    }
    factor() {
      if (this.factored) return;
      this.kernel.page_measure(scene.areas === "barycentric" ? 1 : 0);
      this.correct();
      postMessage({ words: "Ordering the vertices" });
      if (this.kernel.page_order()) throw new Error("The mesh cannot be ordered for elimination.");
      postMessage({ words: "Factoring" });
      if (this.kernel.page_factor()) throw new Error("The faces of the mesh are too thin for the solver.");
      this.factored = true;
    }
    unfold() {
      if (this.unfolded) return;
      if (this.kernel.page_unfold()) throw new Error("Exact geodesic distance needs a mesh without flat faces here.");
      this.unfolded = true;
    }
    fill(field, name, vertex) {
      const source = vertex - this.first;
      if (name === "geodesic") {
        this.unfold();
        if (this.kernel.page_geodesic(source, WINDOWS_PER_VERTEX * this.n + WINDOWS_AT_LEAST))
          throw new Error("Exact geodesic distance was given up here: too many windows.");
      } else if (this.source !== source) {
        this.factor();
        this.kernel.page_field(source, this.near);
        this.source = source;
      }
      field.set(this.doubles(PLACE[name], this.n), this.first);
    }
  }

  function componentOf(vertex) {
    return mesh.components.findLastIndex((first) => first <= vertex);
  }
  function part(number) {
    const found = instances.get(number) ?? new Part(number);
    instances.delete(number);
    instances.set(number, found);
    if (instances.size > MOST_INSTANCES) instances.delete(instances.keys().next().value);
    return found;
  }

  function fromPoints({ k, at }, field, vertex, number) {
    const [first, end] = [mesh.components[number], mesh.components[number + 1]];
    field.fill(0, first, end);
    for (let c = 0; c < k; c++) {
      const own = at[c * mesh.n + vertex];
      for (let v = first; v < end; v++) field[v] += (at[c * mesh.n + v] - own) ** 2;
    }
    for (let v = first; v < end; v++) field[v] = Math.sqrt(field[v]);
  }

  // Each field is posted as soon as it is ready.
  function answer({ number, vertex, names }) {
    const start = performance.now(), component = componentOf(vertex);
    for (const name of names) {
      const field = new Float64Array(mesh.n).fill(NaN);
      if (name in points) fromPoints(points[name], field, vertex, component);
      else part(component).fill(field, name, vertex);
      postMessage({ number, name, field, took: performance.now() - start }, [field.buffer]);
    }
  }

  onmessage = ({ data }) => {
    try {
      if (data.wasm) ({ wasm, mesh, points, scene } = data);
      else answer(data);
    } catch (error) {
      instances.clear();
      const refused = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
      const words = refused ? "The browser gives this page no more memory." : error.message;
      postMessage({ number: data.number, error: words });
    }
  };
}

const SLOW = "geodesic";

/** A worker with one question at a time, of those that wait the latest. */
class Lane {
  /** @param {() => Worker} start a worker that has been given its mesh @param {(words: string) => void} onprogress */
  constructor(start, onprogress) {
    Object.assign(this, { start, onprogress });
    this.running = this.waiting = null;
    this.count = 0;
  }

  /** @returns {Promise<number | null>} milliseconds to the last field; null if a later question has taken its place */
  ask({ vertex, names, onfield, isFinal }) {
    this.waiting?.resolve(null);
    this.waiting = null;
    if (!names.length) return Promise.resolve(0);
    return new Promise((resolve, reject) => {
      const question = { vertex, names, onfield, resolve, reject, left: names.length };
      if (names[0] === SLOW && this.running?.vertex === vertex) {
        this.running.resolve(null);
        this.running = question;
        return;
      }
      this.waiting = question;
      if (names[0] === SLOW && isFinal && this.running) this.close();
      if (!this.running) this.send();
    });
  }

  send() {
    this.running = this.waiting;
    this.waiting = null;
    if (!this.running) return;
    if (!this.worker) {
      this.worker = this.start();
      this.worker.onmessage = ({ data }) => (data.words ? this.onprogress(data.words) : this.receive(data));
      const fail = ({ message }) => this.receive({ number: this.count, error: message || "The worker failed." });
      this.worker.onerror = fail;
    }
    const { vertex, names } = this.running;
    this.worker.postMessage({ number: ++this.count, vertex, names });
  }

  receive({ number, error, name, field, took }) {
    if (number !== this.count || !this.running) return;
    const { vertex, onfield, resolve, reject } = this.running;
    if (!error) onfield({ source: vertex, fields: { [name]: field }, took });
    if (!error && --this.running.left) return;
    this.send();
    if (error) reject(new Error(error));
    else resolve(took);
  }

  /** Give up what is computed. */
  close() {
    this.worker?.terminate();
    this.running?.resolve(null);
    this.worker = this.running = null;
  }
}

/**
 * @typedef {object} Answer
 * @property {number} source
 * @property {Object<string, Float64Array>} fields NaN where undefined
 * @property {number} took milliseconds
 */

export class Solver {
  /** points: by the names that questions have for them; given: fields that are the same from every vertex.
   * @param {{wasm: Uint8Array, mesh: import("./unpack.js").Mesh, points: object, scene: object,
   *   given?: Object<string, Float64Array>, onprogress?: (words: string) => void}} given */
  constructor({ wasm, mesh, points, scene, given = {}, onprogress = () => {} }) {
    this.given = given;
    const { near, corrections, areas } = scene;
    const start = () => {
      const url = URL.createObjectURL(new Blob([`(${work})()`], { type: "text/javascript" })), worker = new Worker(url);
      URL.revokeObjectURL(url);
      worker.postMessage({ wasm, mesh, points, scene: { near, corrections, areas } });
      return worker;
    };
    // Exact geodesic distance takes a hundred times as long as the others, which do not wait for it.
    [this.quick, this.slow] = [new Lane(start, onprogress), new Lane(start, onprogress)];
  }

  /**
   * Compute distances from a stored vertex.
   * @param {number} vertex
   * @param {string[]} names of distances and of given fields
   * @param {(answer: Answer) => void} [onfield] called with each part of the answer as soon as it is ready
   * @param {boolean} [isFinal] whether the slow distance from an earlier vertex is given up; it is finished otherwise
   * @returns {Promise<Answer | null>} all of it; null if a later question has taken its place
   */
  async field(vertex, names, onfield = () => {}, isFinal = true) {
    const fields = {};
    const receive = (answer) => {
      Object.assign(fields, answer.fields);
      onfield(answer);
    };
    const given = names.filter((name) => name in this.given);
    if (given.length)
      receive({ source: vertex, fields: Object.fromEntries(given.map((name) => [name, this.given[name]])), took: 0 });
    const computed = names.filter((name) => !given.includes(name));
    const ask = (lane, names) => lane.ask({ vertex, names, onfield: receive, isFinal });
    const took = await Promise.all([
      ask(this.quick, computed.filter((name) => name !== SLOW)),
      ask(this.slow, computed.filter((name) => name === SLOW)),
    ]);
    return took.includes(null) ? null : { source: vertex, fields, took: Math.max(...took) };
  }

  close() {
    for (const lane of [this.quick, this.slow]) {
      lane.waiting?.resolve(null);
      lane.close();
    }
  }
}
