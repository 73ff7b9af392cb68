/** Labels of vertices as the shader takes them. */

/**
 * Give faces between labels corners of their own, each of which has the labels of all three.
 * @param {{places: Float32Array, normals: Float32Array, corners: Int32Array, copies: number[]}} drawn
 * @param {Float64Array} values of vertices, NaN for no label
 * @returns {{places: Float32Array, normals: Float32Array, corners: Int32Array, labels: Float32Array,
 *   shares: Float32Array}} labels: three for each point, -1 for none; shares: of these three there
 */
export function withLabels({ places, normals, corners, copies }, values) {
  const n = values.length, count = places.length / 3, between = [];
  const label = (point) => {
    const value = values[point < n ? point : copies[point - n]];
    return Number.isNaN(value) ? -1 : value;
  };
  for (let k = 0; k < corners.length; k += 3) {
    const [a, b, c] = [label(corners[k]), label(corners[k + 1]), label(corners[k + 2])];
    if (a !== b || b !== c) between.push(k);
  }
  const extended = (given) => {
    const made = new Float32Array(3 * (count + 3 * between.length));
    made.set(given);
    return made;
  };
  const found = { places: extended(places), normals: extended(normals), labels: extended([]), shares: extended([]) };
  for (let point = 0; point < count; point++) {
    found.labels.fill(label(point), 3 * point, 3 * point + 3);
    found.shares[3 * point] = 1;
  }
  found.corners = corners.slice();
  for (const [j, k] of between.entries())
    for (let i = 0; i < 3; i++) {
      const from = 3 * corners[k + i], to = 3 * (count + 3 * j + i);
      found.corners[k + i] = to / 3;
      found.shares[to + i] = 1;
      for (let axis = 0; axis < 3; axis++) {
        found.places[to + axis] = places[from + axis];
        found.normals[to + axis] = normals[from + axis];
        found.labels[to + axis] = label(corners[k + axis]);
      }
    }
  return found;
}
