/** What a line of sight meets: a tree of boxes over faces that lie near each other. */

const LEAF = 8, AXIS_BITS = 10;

export class FaceTree {
  /** @param {{places: Float32Array, faces: Int32Array}} shape */
  constructor({ places, faces }) {
    const m = faces.length / 3;
    this.places = places;
    this.faces = faces;
    this.order = nearInOrder(m, places, faces);
    this.leaves = 2 ** Math.ceil(Math.log2(Math.max(Math.ceil(m / LEAF), 1)));
    this.boxes = new Float32Array(12 * this.leaves).fill(Infinity);
    for (let node = 2 * this.leaves - 1; node > 0; node--) this.#fit(node);
  }

  /** Node k has the children 2k and 2k + 1; a box is low and negated high, so that the least is taken of all six. */
  #fit(node) {
    const { boxes, faces, places } = this, box = 6 * node;
    if (node < this.leaves) {
      for (let i = 0; i < 6; i++) boxes[box + i] = Math.min(boxes[2 * box + i], boxes[2 * box + 6 + i]);
      return;
    }
    for (let at = this.#first(node); at < this.#first(node + 1); at++) {
      const face = this.order[at];
      for (let corner = 3 * face; corner < 3 * face + 3; corner++) {
        for (let axis = 0; axis < 3; axis++) {
          const x = places[3 * faces[corner] + axis];
          boxes[box + axis] = Math.min(boxes[box + axis], x);
          boxes[box + 3 + axis] = Math.min(boxes[box + 3 + axis], -x);
        }
      }
    }
  }

  /** Where the faces of a leaf begin in their order. */
  #first(leaf) {
    return Math.min((leaf - this.leaves) * LEAF, this.order.length);
  }

  /**
   * The first face met and its corner nearest to the point, of those that are left if there are any; or null.
   * @returns {{vertex: number, point: number[], away: number} | null}
   */
  hit({ origin, direction }, isLeft = () => true) {
    const inverse = direction.map((x) => 1 / (x || 1e-30)), waiting = [1];
    let away = Infinity, face = -1;
    while (waiting.length) {
      const node = waiting.pop();
      if (this.#enters(node, origin, inverse) >= away) continue;
      if (node >= this.leaves) {
        for (let k = this.#first(node); k < this.#first(node + 1); k++) {
          const at = this.#meets(this.order[k], origin, direction);
          if (at >= away) continue;
          away = at;
          face = this.order[k];
        }
        continue;
      }
      const [a, b] = [this.#enters(2 * node, origin, inverse), this.#enters(2 * node + 1, origin, inverse)];
      if (a < b) waiting.push(2 * node + 1, 2 * node);
      else waiting.push(2 * node, 2 * node + 1);
    }
    if (face < 0) return null;
    const point = origin.map((x, axis) => x + away * direction[axis]);
    return { vertex: this.#nearest(face, point, isLeft), point, away };
  }

  /** How far off the box of a node is entered; Infinity if it is missed. */
  #enters(node, origin, inverse) {
    let near = 0, far = Infinity;
    for (let axis = 0; axis < 3; axis++) {
      const a = (this.boxes[6 * node + axis] - origin[axis]) * inverse[axis];
      const b = (-this.boxes[6 * node + 3 + axis] - origin[axis]) * inverse[axis];
      near = Math.max(near, Math.min(a, b));
      far = Math.min(far, Math.max(a, b));
    }
    return near <= far + 1e-6 ? near : Infinity;
  }

  /** How far off a face is met, by Möller and Trumbore, on either side; Infinity if it is missed. */
  #meets(face, o, d) {
    const { places, faces } = this, a = 3 * faces[3 * face], b = 3 * faces[3 * face + 1], c = 3 * faces[3 * face + 2];
    const ax = places[a], ay = places[a + 1], az = places[a + 2];
    const ux = places[b] - ax, uy = places[b + 1] - ay, uz = places[b + 2] - az;
    const vx = places[c] - ax, vy = places[c + 1] - ay, vz = places[c + 2] - az;
    const px = d[1] * vz - d[2] * vy, py = d[2] * vx - d[0] * vz, pz = d[0] * vy - d[1] * vx;
    const size = ux * px + uy * py + uz * pz;
    if (!size) return Infinity;
    const x = o[0] - ax, y = o[1] - ay, z = o[2] - az, s = (x * px + y * py + z * pz) / size;
    const qx = y * uz - z * uy, qy = z * ux - x * uz, qz = x * uy - y * ux,
      t = (d[0] * qx + d[1] * qy + d[2] * qz) / size;
    const away = (vx * qx + vy * qy + vz * qz) / size;
    return s >= -1e-9 && t >= -1e-9 && s + t <= 1 + 1e-9 && away > 0 ? away : Infinity;
  }

  #nearest(face, point, isLeft) {
    const off = (vertex) => Math.hypot(...point.map((x, axis) => x - this.places[3 * vertex + axis]));
    const corners = [...this.faces.subarray(3 * face, 3 * face + 3)], left = corners.filter(isLeft);
    return (left.length ? left : corners).reduce((best, v) => (off(v) < off(best) ? v : best));
  }
}

/** The faces by their middles along a Morton curve. */
function nearInOrder(m, places, faces) {
  const keys = new Uint32Array(m), most = 2 ** AXIS_BITS - 1;
  for (let k = 0; k < m; k++) {
    for (let axis = 0; axis < 3; axis++) {
      let middle = 0;
      for (let corner = 3 * k; corner < 3 * k + 3; corner++) middle += places[3 * faces[corner] + axis];
      keys[k] |= spread(Math.min(Math.max(((middle / 3 + 1) / 2) * most, 0), most)) << axis;
    }
  }
  let order = Uint32Array.from(keys, (_, k) => k), next = new Uint32Array(m);
  for (let shift = 0; shift < 3 * AXIS_BITS; shift += AXIS_BITS) {
    const starts = new Uint32Array(most + 2);
    for (const key of keys) starts[((key >>> shift) & most) + 1]++;
    for (let k = 1; k <= most; k++) starts[k] += starts[k - 1];
    for (const face of order) next[starts[(keys[face] >>> shift) & most]++] = face;
    [order, next] = [next, order];
  }
  return order;
}

/** Ten bits, two places apart. */
function spread(x) {
  x = (x | (x << 16)) & 0x30000ff;
  x = (x | (x << 8)) & 0x300f00f;
  x = (x | (x << 4)) & 0x30c30c3;
  return (x | (x << 2)) & 0x9249249;
}
