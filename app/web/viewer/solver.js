// Distances from a vertex, computed by the kernel in workers: a column at a time, the latest question first.

/** The worker; its own text is all it knows. */
function work() {
  const [POINTS, FACES, WEIGHTS, AREAS, BIHARMONIC, COMMUTE_TIME, GEODESIC, RESOLVENT, START, INDEX, VALUE] = Array(11).keys();
  const PLACE = { biharmonic: BIHARMONIC, commute_time: COMMUTE_TIME, geodesic: GEODESIC };
  const TOO_THIN = "The faces of the mesh are too thin for the solver.";
  const MOST_INSTANCES = 8, WINDOWS_PER_VERTEX = 2000, WINDOWS_AT_LEAST = 200000;
  let wasm, module, mesh, points, scene;
  const instances = new Map();

  // The kernel with one component in its memory.
  class Part {
    constructor(number) {
      const [first, end] = [mesh.components[number], mesh.components[number + 1]];
      const [firstFace, endFace] = [mesh.faceComponents[number], mesh.faceComponents[number + 1]];
      Object.assign(this, { first, firstFace, n: end - first, m: endFace - firstFace, near: scene.near[number], unit: scene.firsts[number] });
      this.kernel = new WebAssembly.Instance((module ??= new WebAssembly.Module(wasm)), {}).exports;
      this.kernel.page_begin(this.n, this.m);
      this.blocks = new Map(); // the factors at poles, those that were used last behind the others
      this.doubles(POINTS, 3 * this.n).set(mesh.positions.subarray(3 * first, 3 * end));
      const faces = this.ints(FACES, 3 * this.m);
      for (let k = 0; k < faces.length; k++) faces[k] = mesh.faces[3 * firstFace + k] - first;
    }
    doubles(which, count) {
      return new Float64Array(this.kernel.memory.buffer, this.kernel.page_array(which), count);
    }
    ints(which, count) {
      return new Int32Array(this.kernel.memory.buffer, this.kernel.page_array(which), count);
    }
    /** Rows of the matrix that the mesh comes with: what is below the diagonal, on it, and above it. */
    enter() {
      const { first, n } = this, from = mesh.start[first], end = mesh.start[first + n], sums = new Float64Array(n);
      this.kernel.page_matrix(n + 2 * (end - from));
      const start = this.ints(START, n + 1).fill(1, 1), index = this.ints(INDEX, n + 2 * (end - from));
      const value = this.doubles(VALUE, index.length);
      const each = (act) => {
        for (let i = 0, e = from; i < n; i++)
          for (; e < mesh.start[first + i + 1]; e++) act(i, mesh.index[e] - first, mesh.weights[e]);
      };
      each((i, j, weight) => [i, j].forEach((v) => (start[v + 1]++, (sums[v] += weight))));
      for (let v = 0; v < n; v++) start[v + 1] += start[v];
      const put = start.slice(), enterAt = (i, j, x) => ((index[put[i]] = j), (value[put[i]++] = x));
      each((i, j, weight) => enterAt(j, i, -weight));
      for (let v = 0; v < n; v++) enterAt(v, v, sums[v]);
      each((i, j, weight) => enterAt(i, j, -weight));
      this.doubles(AREAS, n).set(mesh.areas.subarray(first, first + n));
    }
    correct() {
      const { first, n, firstFace, m } = this, weights = this.doubles(WEIGHTS, 3 * m), areas = this.doubles(AREAS, n);
      for (const [face, ...three] of scene.corrections.weights)
        if (face >= firstFace && face < firstFace + m)
          three.forEach((weight, k) => (weights[k * m + face - firstFace] = weight));
      for (const [vertex, area] of scene.corrections.areas)
        if (vertex >= first && vertex < first + n) areas[vertex - first] = area;
    }
    order() {
      if (this.ordered) return;
      if (mesh.weights) this.enter();
      else {
        this.kernel.page_measure(scene.areas === "barycentric" ? 1 : 0);
        this.correct();
      }
      postMessage({ words: "Ordering the vertices" });
      if (this.kernel.page_order()) throw new Error("The mesh cannot be ordered for elimination.");
      this.ordered = true;
    }
    factor() {
      if (this.factored) return;
      this.order();
      postMessage({ words: "Factoring" });
      if (this.kernel.page_factor()) throw new Error(TOO_THIN);
      this.factored = true;
    }
    /** R_vv + R_ss - 2 R_vs for each v and the source s, R the resolvent at a pole in units of the first eigenvalue. */
    resolvent(name, [real, imaginary], vertex, names) {
      const isComplex = imaginary ? 1 : 0;
      this.order();
      let held = this.blocks.get(name);
      if (!held) {
        postMessage({ words: "Factoring" });
        const isFree = ([other, { isLarge }]) => isLarge >= isComplex && !names.includes(other);
        const isFull = this.kernel.memory.buffer.byteLength > scene.room;
        const [old, { block, isLarge }] = (isFull && [...this.blocks].find(isFree)) || ["", { block: 0, isLarge: isComplex }];
        this.blocks.delete(old);
        held = { block: this.kernel.page_shift(real * this.unit, imaginary * this.unit, block), isLarge };
        if (!held.block) throw new Error(TOO_THIN);
      }
      this.blocks.delete(name);
      this.blocks.set(name, held);
      this.kernel.page_resolvent(held.block, isComplex, vertex - this.first);
      return this.doubles(RESOLVENT, (1 + isComplex) * this.n).slice();
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
      let field = new Float64Array(mesh.n).fill(NaN);
      if (name in points) fromPoints(points[name], field, vertex, component);
      else if (name in scene.poles) field = part(component).resolvent(name, scene.poles[name], vertex, names);
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

const SLOW = "geodesic", MOST_WORKERS = 4, ROOM = 2.4e9; // bytes

/** A worker with one question at a time, of those that wait the latest. */
class Lane {
  /** @param {() => Worker} start a worker that has been given its mesh @param {(words: string) => void} onprogress */
  constructor(start, onprogress) {
    Object.assign(this, { start, onprogress });
    this.running = this.waiting = null;
    this.count = 0;
  }

  /** What is there by the time that the question is sent is not computed again.
   * @returns {Promise<number | null>} milliseconds to the last field; null if a later question has taken its place */
  ask({ vertex, names, isThere, onfield, isFinal }) {
    this.waiting?.resolve(null);
    this.waiting = null;
    if (!names.length) return Promise.resolve(0);
    return new Promise((resolve, reject) => {
      const question = { vertex, names, isThere, onfield, resolve, reject, left: names.length };
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
    const { vertex, isThere, resolve } = this.running, names = this.running.names.filter((name) => !isThere(name));
    this.running.left = names.length;
    if (!names.length) {
      this.running = null;
      return resolve(0);
    }
    if (!this.worker) {
      this.worker = this.start();
      this.worker.onmessage = ({ data }) => (data.words ? this.onprogress(data.words) : this.receive(data));
      const fail = ({ message }) => this.receive({ number: this.count, error: message || "The worker failed." });
      this.worker.onerror = fail;
    }
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
    const { near, corrections, areas, functions = {}, firsts = [] } = scene, poles = {};
    Object.assign(this, { given, mesh, functions, firsts });
    for (const [word, each] of Object.entries(functions))
      for (const [k, pole] of each.poles.entries()) poles[`${word} ${k}`] = pole;
    const workers = Math.min(MOST_WORKERS, Math.max((globalThis.navigator?.hardwareConcurrency ?? 1) - 1, 1));
    const start = () => {
      const url = URL.createObjectURL(new Blob([`(${work})()`], { type: "text/javascript" })), worker = new Worker(url);
      URL.revokeObjectURL(url);
      const needed = { near, corrections, areas, firsts, poles, room: ROOM / workers };
      worker.postMessage({ wasm, mesh, points, scene: needed });
      return worker;
    };
    // Exact geodesic distance takes a hundred times as long as the others, and factors at poles ten times; those do not
    // wait for either.
    [this.quick, this.slow] = [new Lane(start, onprogress), new Lane(start, onprogress)];
    this.shifted = Array.from({ length: workers }, () => new Lane(start, (words) => onprogress(words + this.count)));
    this.count = "";
  }

  /**
   * Compute distances from a stored vertex.
   * @param {number} vertex
   * @param {string[]} names of distances and of given fields; "diffusion@0.25" is a step of the slider of one
   * @param {(answer: Answer) => void} [onfield] called with each part of the answer as soon as it is ready
   * @param {boolean} [isFinal] whether the slow distance from an earlier vertex is given up; it is finished otherwise
   * @returns {Promise<Answer | null>} all of it; null if a later question has taken its place
   */
  async field(vertex, names, onfield = () => {}, isFinal = true) {
    const fields = {}, steps = Object.fromEntries(names.filter((name) => name.includes("@")).map((name) => [name, this.#step(name)]));
    // What is known from the source, of which others are sums.
    if (this.known?.source !== vertex) this.known = { source: vertex, values: { ...this.given } };
    const { values } = this.known, isThere = (name) => name in values;
    const needed = [...new Set(names.flatMap((name) => steps[name]?.terms ?? name))].filter((name) => !isThere(name));
    const poles = needed.filter((name) => name.includes(" "));
    const receive = ({ fields: found, took }) => {
      Object.assign(values, found);
      const start = performance.now(), ready = {};
      for (const name of names)
        if (!(name in fields) && (steps[name]?.terms ?? [name]).every(isThere))
          ready[name] = fields[name] = steps[name] ? this.#sum(steps[name], vertex, values) : values[name];
      this.count = `, ${poles.filter(isThere).length} of ${poles.length}`;
      const all = took + performance.now() - start;
      if (Object.keys(ready).length) onfield({ source: vertex, fields: ready, took: all });
      return all;
    };
    const sums = receive({ fields: {}, took: 0 });
    const ask = (lane, names) => lane.ask({ vertex, names, isThere, onfield: receive, isFinal });
    const took = await Promise.all([
      ask(this.quick, needed.filter((name) => name !== SLOW && !poles.includes(name))),
      ask(this.slow, needed.filter((name) => name === SLOW)),
      ...this.shifted.map((lane, k) => ask(lane, poles.filter((name) => name.split(" ")[1] % this.shifted.length === k))),
    ]);
    if (took.includes(null)) return null;
    receive({ fields: {}, took: 0 });
    return { source: vertex, fields, took: Math.max(sums, ...took) };
  }

  /** A step of a slider, with the names of the fields and of the resolvents that it is a sum of. */
  #step(name) {
    const [word, value] = name.split("@"), step = this.functions[word].steps.find((each) => each.value === Number(value));
    const terms = step.weights.map((_, k) => `${word} ${step.first + k}`), exact = step.power ? ["commute_time", "biharmonic"] : [];
    return { ...step, poles: terms, terms: [...terms, ...exact] };
  }

  /** d^2 = sum_j Re c_j (R_vv + R_ss - 2 R_vs) + c d_C^2 + d d_B^2, where eigenvalues are in units of the first one. */
  #sum({ poles, weights, inverse, inverse_square, power = 0, root = 1 }, vertex, values) {
    const { components, n } = this.mesh, number = components.findLastIndex((first) => first <= vertex);
    const [first, end] = [components[number], components[number + 1]], unit = this.firsts[number];
    const field = new Float64Array(n).fill(NaN), square = field.subarray(first, end).fill(0), m = end - first;
    for (const [k, name] of poles.entries()) {
      const x = values[name], pair = x.length > m, [real, imaginary] = weights[k].map((each) => (pair ? 2 : 1) * unit * each);
      if (pair) for (let v = 0; v < m; v++) square[v] += real * x[v] - imaginary * x[m + v];
      else for (let v = 0; v < m; v++) square[v] += real * x[v];
    }
    for (const [weight, name] of power ? [[unit * inverse, "commute_time"], [unit ** 2 * inverse_square, "biharmonic"]] : [])
      for (let v = 0, x = values[name].subarray(first, end); v < m; v++) square[v] += weight * x[v] * x[v];
    const scale = root * unit ** (-power / 2);
    for (let v = 0; v < m; v++) square[v] = scale * Math.sqrt(Math.max(square[v], 0));
    field[vertex] = 0;
    return field;
  }

  close() {
    for (const lane of [this.quick, this.slow, ...this.shifted]) {
      lane.waiting?.resolve(null);
      lane.close();
    }
  }
}
