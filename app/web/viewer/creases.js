/** Vertices as they are drawn: several in one place where faces meet at a crease, each with the normal of its side. */

const MOST_AROUND = 500;

/**
 * @param {number | null} crease degrees from which on faces that meet are drawn with an edge between them
 * @returns {{corners: Int32Array, copies: number[]}} corners (3 m): what faces are drawn with, vertices and from n on
 *   copies of these (k)
 */
export function split({ places, faces }, crease) {
  const corners = Int32Array.from(faces), copies = [], n = places.length / 3;
  if (crease === null || crease === undefined) return { corners, copies };
  const normals = faceNormals(places, faces), least = Math.cos((crease * Math.PI) / 180);
  const first = new Int32Array(n + 1), around = new Int32Array(faces.length);
  for (const vertex of faces) first[vertex + 1]++;
  for (let v = 0; v < n; v++) first[v + 1] += first[v];
  const put = first.slice();
  faces.forEach((vertex, corner) => (around[put[vertex]++] = corner));
  const others = (corner) => [1, 2].map((k) => faces[corner - (corner % 3) + ((corner + k) % 3)]);
  const isSmooth = (a, b) => dotAt(normals, 3 * Math.floor(a / 3), 3 * Math.floor(b / 3)) >= least - 1e-9;
  for (let v = 0; v < n; v++) {
    const own = around.subarray(first[v], first[v + 1]), fan = Array.from(own, (_, k) => k);
    if (own.length > MOST_AROUND) continue;
    for (const [j, corner] of own.entries()) {
      const sides = others(corner);
      for (let k = 0; k < j; k++) {
        if (fan[k] === fan[j] || !others(own[k]).some((end) => sides.includes(end)) || !isSmooth(corner, own[k])) continue;
        const [kept, gone] = fan[j] < fan[k] ? [fan[j], fan[k]] : [fan[k], fan[j]];
        for (let i = 0; i <= j; i++) if (fan[i] === gone) fan[i] = kept;
      }
    }
    const ids = new Map([[0, v]]);
    for (const [k, corner] of own.entries()) {
      if (!ids.has(fan[k])) ids.set(fan[k], n - 1 + copies.push(v));
      corners[corner] = ids.get(fan[k]);
    }
  }
  return { corners, copies };
}

function faceNormals(places, faces) {
  const normals = new Float32Array(faces.length);
  for (let k = 0; k < faces.length; k += 3) {
    const a = 3 * faces[k], b = 3 * faces[k + 1], c = 3 * faces[k + 2];
    const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
    const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx], size = Math.hypot(...normal) || 1;
    normal.forEach((x, axis) => (normals[k + axis] = x / size));
  }
  return normals;
}

const dotAt = (x, a, b) => x[a] * x[b] + x[a + 1] * x[b + 1] + x[a + 2] * x[b + 2];
