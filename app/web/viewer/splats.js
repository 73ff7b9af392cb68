/** Points as they are drawn: a hexagon about each, in the plane of its neighbours and as large as its spacing, over which
 * fields are continued by their slope; as app/scene/splats.py. */
import { entries } from "./unpack.js";
import { cross, unit } from "./vectors.js";

const CORNERS = 6, SIZE = 0.9;
const TURNS = Array.from({ length: CORNERS }, (_, k) => (2 * Math.PI * k) / CORNERS);

/**
 * @param {Float32Array} points (3 n)
 * @param {{normals: Int8Array, start: Int32Array, index: Int32Array}} mesh
 * @returns {object} `drawn` of a `Shape`, with what `continued` takes: the `ends` (2 e) of neighbours, and for each end
 *   the two `slopes` (4 e) that the change towards the other has there
 */
export function hexagons(points, mesh) {
  const n = points.length / 3, ends = Int32Array.from([...entries(mesh)].flat());
  const across = new Float32Array(3 * n), along = new Float32Array(3 * n), reach = new Float32Array(n);
  for (let v = 0; v < n; v++) putAxes(mesh.normals, across, along, 3 * v);
  const inner = (axes, i, j) => {
    let sum = 0;
    for (let x = 0; x < 3; x++) sum += axes[3 * i + x] * (points[3 * j + x] - points[3 * i + x]);
    return sum;
  };
  const count = new Int32Array(n), sums = new Float64Array(3 * n), slopes = new Float32Array(2 * ends.length);
  for (let k = 0; k < ends.length; k++) {
    const i = ends[k], j = ends[k ^ 1], p = inner(across, i, j), q = inner(along, i, j);
    slopes.set([p, q], 2 * k);
    reach[i] += Math.hypot(...[0, 1, 2].map((x) => points[3 * j + x] - points[3 * i + x]));
    count[i]++;
    [p * p, p * q, q * q].forEach((each, x) => (sums[3 * i + x] += each));
  }
  for (let v = 0; v < n; v++) reach[v] *= SIZE / Math.max(count[v], 1);
  // The slope of the plane that fits differences to all neighbours best.
  for (let k = 0; k < ends.length; k++) {
    const [pp, pq, qq] = sums.subarray(3 * ends[k], 3 * ends[k] + 3), area = pp * qq - pq ** 2;
    const factor = area > 1e-6 * (pp + qq) ** 2 ? reach[ends[k]] / area : 0, [p, q] = slopes.subarray(2 * k, 2 * k + 2);
    slopes.set([(qq * p - pq * q) * factor, (pp * q - pq * p) * factor], 2 * k);
  }
  const places = new Float32Array(3 * n * (1 + CORNERS)), normals = places.slice(), copies = new Int32Array(CORNERS * n);
  const corners = new Int32Array(3 * (CORNERS - 2) * n);
  places.set(points);
  for (let v = 0; v < n; v++) {
    for (const [k, turn] of TURNS.entries()) {
      const at = CORNERS * v + k, [p, q] = [reach[v] * Math.cos(turn), reach[v] * Math.sin(turn)];
      copies[at] = v;
      for (let x = 0; x < 3; x++) {
        places[3 * (n + at) + x] = points[3 * v + x] + p * across[3 * v + x] + q * along[3 * v + x];
        normals[3 * (n + at) + x] = mesh.normals[3 * v + x] / 127;
      }
    }
    const first = n + CORNERS * v;
    for (let k = 1; k < CORNERS - 1; k++) corners.set([first, first + k, first + k + 1], 3 * ((CORNERS - 2) * v + k - 1));
  }
  return { places, normals, corners, copies, ends, slopes };
}

/** Fill in the values of corners, which come after those of the n points; beside what is undefined nothing is known of
 * the slope. @param {Float32Array} values (n + 6 n) */
export function continued(values, n, { ends, slopes }, none) {
  const across = new Float64Array(n), along = new Float64Array(n), least = values.slice(0, n), most = values.slice(0, n);
  for (let k = 0; k < ends.length; k++) {
    const i = ends[k], here = values[i], there = values[ends[k ^ 1]];
    if (here === none || there === none) continue;
    across[i] += (there - here) * slopes[2 * k];
    along[i] += (there - here) * slopes[2 * k + 1];
    if (there < least[i]) least[i] = there;
    if (there > most[i]) most[i] = there;
  }
  for (const [k, turn] of TURNS.entries()) {
    const [p, q] = [Math.cos(turn), Math.sin(turn)];
    for (let v = 0; v < n; v++)
      values[n + CORNERS * v + k] = Math.min(Math.max(values[v] + across[v] * p + along[v] * q, least[v]), most[v]);
  }
}

/** Two unit vectors at right angles to the normal at `at` and to each other. */
function putAxes(normals, across, along, at) {
  const normal = unit([...normals.subarray(at, at + 3)]), sizes = normal.map(Math.abs), least = Math.min(...sizes);
  const first = unit(cross(normal, [0, 1, 2].map((axis) => Number(axis === sizes.indexOf(least)))));
  across.set(first, at);
  along.set(cross(normal, first), at);
}
