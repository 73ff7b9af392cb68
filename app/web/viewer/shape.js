/** A mesh as it is drawn: moved to the origin and of radius about 1, so that single precision is enough. */
import { split } from "./creases.js";
import { cutPlaces, withCut, joinedArrays } from "./cut.js";
import { hexagons } from "./splats.js";
import { dot } from "./vectors.js";

export class Shape {
  /**
   * drawn: `places` and `normals` of the vertices and, from n on, of their `copies` at creases, and the `corners` of faces
   * among these; of points without faces those of hexagons.  hasBacks: the faces turn counterclockwise outside, and their other side can be seen.
   * @param {import("./unpack.js").Mesh} mesh
   * @param {{crease: number | null, backs: boolean, clip: number[] | null, opacity: number,
   *   cut?: {ends: number[], weights: number[], faces: number[]} | null}} shading cut: of a solid, see cut.js; clip: x, y and z of a plane's normal,
   *   beyond which the surface is cut away, and its distance from the origin along that
   */
  constructor(mesh, { crease, backs, clip, cut, opacity } = { crease: null, backs: false, opacity: 1 }) {
    const { n, m, positions, faces, faceComponents } = mesh;
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let k = 0; k < 3 * n; k++) {
      low[k % 3] = Math.min(low[k % 3], positions[k]);
      high[k % 3] = Math.max(high[k % 3], positions[k]);
    }
    this.n = n;
    this.m = m;
    this.faces = faces;
    this.faceComponents = faceComponents;
    this.centre = low.map((x, axis) => (x + high[axis]) / 2);
    this.radius = Math.hypot(...low.map((x, axis) => high[axis] - x)) / 2 || 1;
    this.places = new Float32Array(3 * n);
    for (let k = 0; k < 3 * n; k++) this.places[k] = (positions[k] - this.centre[k % 3]) / this.radius;
    this.isOfPoints = mesh.normals !== undefined;
    this.drawn = this.isOfPoints ? hexagons(this.places, mesh) : this.#split(crease);
    this.hasBacks = backs;
    this.opacity = opacity;
    const normal = clip && clip.slice(0, 3), onPlane = clip && this.inward(normal.map((x) => clip[3] * x));
    this.clip = clip && [...normal.map((x) => -x), dot(normal, onPlane)];
    /** What lines of sight meet. */
    this.met = this.isOfPoints ? { ...this.drawn, faces: this.drawn.corners } : this;
    if (cut) {
      const at = cutPlaces(this.places, cut, this.clip), corners = cut.faces.map((corner) => n + corner);
      this.met = { places: joinedArrays(this.places, at), faces: joinedArrays(faces, corners) };
      this.drawn = withCut(this.drawn, at, cut, this.clip);
    }
  }

  #split(crease) {
    const { n } = this, { corners, copies } = split(this, crease), places = new Float32Array(3 * (n + copies.length));
    places.set(this.places);
    for (const [k, vertex] of copies.entries()) places.set(this.place(vertex), 3 * (n + k));
    return { places, normals: vertexNormals(places, corners), corners, copies };
  }

  /** The vertex nearest to a point of the picture, of those that the clip plane leaves. */
  nearest(point) {
    const { n, places, clip } = this, [x, y, z] = point;
    let best = 0, least = Infinity;
    for (let v = 0; v < n; v++) {
      const away = (places[3 * v] - x) ** 2 + (places[3 * v + 1] - y) ** 2 + (places[3 * v + 2] - z) ** 2;
      if (away < least && (!clip || this.depth(this.place(v)) >= 0)) [best, least] = [v, away];
    }
    return best;
  }

  /** How far a point of the picture is from the clip plane; negative where it is cut away. */
  depth(point) {
    return this.clip ? dot(this.clip, point) + this.clip[3] : 1;
  }

  place(vertex) {
    return [...this.places.subarray(3 * vertex, 3 * vertex + 3)];
  }

  /** A point of the file's coordinates in those of the picture, and back. */
  inward(point) {
    return point.map((x, axis) => (x - this.centre[axis]) / this.radius);
  }

  outward(point) {
    return point.map((x, axis) => x * this.radius + this.centre[axis]);
  }
}

/** Sums of the faces' normals by area, over the sum of areas: short where the faces around a vertex disagree. */
function vertexNormals(places, faces) {
  const sums = new Float32Array(places.length), areas = new Float32Array(places.length / 3);
  for (let k = 0; k < faces.length; k += 3) {
    const a = 3 * faces[k], b = 3 * faces[k + 1], c = 3 * faces[k + 2];
    const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
    const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx,
      area = Math.sqrt(x * x + y * y + z * z);
    for (let corner = k; corner < k + 3; corner++) {
      const at = 3 * faces[corner];
      sums[at] += x;
      sums[at + 1] += y;
      sums[at + 2] += z;
      areas[faces[corner]] += area;
    }
  }
  for (let k = 0; k < sums.length; k++) sums[k] /= areas[(k / 3) | 0] || 1;
  return sums;
}

/**
 * Which side of a closed surface is outside: 1 if the faces turn counterclockwise there, -1 if clockwise, 0 where it is
 * not closed or its components disagree.
 */
export function outside({ places, faces, faceComponents }) {
  let side = 0;
  for (let part = 1; part < faceComponents.length; part++) {
    // Each edge is to be there as often in one direction as in the other; then these sums of hashes are 0.
    let edges = 0, volume = 0;
    for (let k = 3 * faceComponents[part - 1]; k < 3 * faceComponents[part]; k += 3) {
      const [a, b, c] = [faces[k], faces[k + 1], faces[k + 2]];
      edges = (edges + hash(a, b) + hash(b, c) + hash(c, a)) | 0;
      volume += tripleProduct(places, 3 * a, 3 * b, 3 * c);
    }
    if (edges || !volume || side === -Math.sign(volume)) return 0;
    side = Math.sign(volume);
  }
  return side;
}

/** A number of an edge, negative in the other direction. */
function hash(a, b) {
  if (a > b) return -hash(b, a);
  const mixed = Math.imul(Math.imul(a, 0x9e3779b1) ^ b, 0x85ebca6b);
  return Math.imul(mixed ^ (mixed >>> 15), 0xc2b2ae35) ^ (mixed >>> 13);
}

const tripleProduct = (x, a, b, c) =>
  x[a] * (x[b + 1] * x[c + 2] - x[b + 2] * x[c + 1]) +
  x[a + 1] * (x[b + 2] * x[c] - x[b] * x[c + 2]) +
  x[a + 2] * (x[b] * x[c + 1] - x[b + 1] * x[c]);
