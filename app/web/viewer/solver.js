// Distances from a vertex, computed by the kernel in a worker: a column at a time, the latest question first.

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

  function answer({ number, vertex, names }) {
    const start = performance.now(), component = componentOf(vertex), fields = {};
    for (const name of names) {
      const field = (fields[name] = new Float64Array(mesh.n).fill(NaN));
      if (name in points) fromPoints(points[name], field, vertex, component);
      else part(component).fill(field, name, vertex);
    }
    const memory = [...instances.values()].reduce((sum, { kernel }) => sum + kernel.memory.buffer.byteLength, 0);
    const buffers = Object.values(fields).map((field) => field.buffer);
    postMessage({ number, source: vertex, fields, took: performance.now() - start, memory }, buffers);
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

/**
 * @typedef {object} Answer
 * @property {number} source
 * @property {Object<string, Float64Array>} fields NaN where undefined
 * @property {number} took milliseconds
 * @property {number} memory bytes of the kernel
 */

export class Solver {
  /** points: by the names that questions have for them; given: fields that are the same from every vertex.
   * @param {{wasm: Uint8Array, mesh: import("./unpack.js").Mesh, points: object, scene: object,
   *   given?: Object<string, Float64Array>, onprogress?: (words: string) => void}} given */
  constructor({ wasm, mesh, points, scene, given = {}, onprogress = () => {} }) {
    this.given = given;
    const url = URL.createObjectURL(new Blob([`(${work})()`], { type: "text/javascript" }));
    this.worker = new Worker(url);
    this.running = this.waiting = null;
    this.count = 0;
    this.worker.onmessage = ({ data }) => (data.words ? onprogress(data.words) : this.receive(data));
    this.worker.onerror = (event) => this.receive({ number: this.count, error: event.message || "The worker failed." });
    const { near, corrections, areas } = scene;
    this.worker.postMessage({ wasm, mesh, points, scene: { near, corrections, areas } });
    URL.revokeObjectURL(url);
  }

  /** Distances by name from a stored vertex, and given fields; null if a later question has taken its place.
   * @param {number} vertex @param {string[]} names @returns {Promise<Answer | null>} */
  field(vertex, names) {
    this.waiting?.resolve(null);
    return new Promise((resolve, reject) => {
      this.waiting = { vertex, names, resolve, reject };
      if (!this.running) this.send();
    });
  }

  send() {
    this.running = this.waiting;
    this.waiting = null;
    if (!this.running) return;
    const { vertex, names } = this.running;
    const computed = names.filter((name) => !(name in this.given));
    this.worker.postMessage({ number: ++this.count, vertex, names: computed });
  }

  receive({ number, error, ...answer }) {
    if (number !== this.count || !this.running) return;
    const { resolve, reject } = this.running;
    this.send();
    if (error) reject(new Error(error));
    else resolve({ ...answer, fields: { ...this.given, ...answer.fields } });
  }

  close() {
    this.worker.terminate();
    this.waiting?.resolve(null);
    this.running?.resolve(null);
  }
}
