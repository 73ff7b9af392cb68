/** Where the picture is seen from: one camera for all panels, in the coordinates of the shape. */
import { plus, minus, dot, cross, unit } from "./vectors.js";

const NEAREST = 1e-3;

export const FARTHEST = 100;

export class Camera {
  /**
   * @param {{position: number[], focal: number[], up: number[], angle: number, parallel: number | null}} view
   * @param {Float32Array} places of the vertices: where all of them are seen, they fill panels of any form
   */
  constructor({ position, focal, up, angle, parallel }, places) {
    this.look(position, focal, up);
    this.parallel = parallel !== null && parallel !== undefined;
    const slope = this.parallel ? parallel / this.distance : Math.tan((angle * Math.PI) / 360);
    const [wide, high] = this.#reach(places);
    this.extent = high <= 1.02 * slope ? [1.06 * wide, 1.06 * high] : [slope, slope];
  }

  /** Half of what is seen at distance 1, sideways and upwards: of any panel at least this. */
  #reach(places) {
    let wide = 0, high = 0;
    for (let k = 0; k < places.length; k += 3) {
      const [x, y, depth] = this.#local([places[k], places[k + 1], places[k + 2]]);
      if (depth <= 0) return [Infinity, Infinity];
      const scale = 1 / (this.parallel ? this.distance : depth);
      wide = Math.max(wide, Math.abs(x) * scale);
      high = Math.max(high, Math.abs(y) * scale);
    }
    return [wide, high];
  }

  look(position, focal, up) {
    const arm = minus(position, focal);
    this.focal = [...focal];
    this.distance = Math.hypot(...arm);
    this.back = unit(arm);
    this.right = unit(cross(up, this.back));
    this.up = cross(this.back, this.right);
  }

  get position() {
    return plus(this.focal, this.back, this.distance);
  }

  slope(aspect) {
    return Math.max(this.extent[1], this.extent[0] / aspect);
  }

  /** Right, up, and ahead of the eye. */
  #local(point) {
    const arm = minus(point, this.position);
    return [dot(arm, this.right), dot(arm, this.up), -dot(arm, this.back)];
  }

  /** -1 … 1 in a panel of width / height `aspect`; null for what is behind the eye. */
  project(point, aspect) {
    const [x, y, depth] = this.#local(point), high = this.slope(aspect) * (this.parallel ? this.distance : depth);
    return depth > 0 || this.parallel ? [x / (high * aspect), y / high] : null;
  }

  /** The line of sight through a place (-1 … 1) of a panel. */
  ray(x, y, aspect) {
    const high = this.slope(aspect), side = plus(plus([0, 0, 0], this.right, x * high * aspect), this.up, y * high);
    if (!this.parallel) return { origin: this.position, direction: unit(minus(side, this.back)) };
    const start = plus(plus(this.focal, side, this.distance), this.back, FARTHEST);
    return { origin: start, direction: plus([0, 0, 0], this.back, -1) };
  }

  /** The line of sight to a point. */
  rayTo(point) {
    if (this.parallel) return { origin: plus(point, this.back, FARTHEST), direction: plus([0, 0, 0], this.back, -1) };
    return { origin: this.position, direction: unit(minus(point, this.position)) };
  }

  /** Column-major matrices: of directions to those of the eye, of points to the eye's, and from there to the picture. */
  matrices(aspect) {
    const { right: r, up: u, back: b } = this, eye = this.position;
    const middle = dot(eye, b), far = Math.max(middle + 1.01, 0.02), near = Math.max(middle - 1.01, far * 1e-3);
    const high = this.slope(aspect), sizes = this.parallel ? high * this.distance : high;
    const view = new Float32Array([
      r[0],
      u[0],
      b[0],
      0,
      r[1],
      u[1],
      b[1],
      0,
      r[2],
      u[2],
      b[2],
      0,
      -dot(eye, r),
      -dot(eye, u),
      -middle,
      1,
    ]);
    const x = 1 / (sizes * aspect), y = 1 / sizes;
    const picture = this.parallel
      ? [x, 0, 0, 0, 0, y, 0, 0, 0, 0, -1 / 1.01, 0, 0, 0, -middle / 1.01, 1]
      : [x, 0, 0, 0, 0, y, 0, 0, 0, 0, -(far + near) / (far - near), -1, 0, 0, (-2 * far * near) / (far - near), 0];
    return { view, picture: new Float32Array(picture) };
  }

  /** Go round the focal point, by angles to the right and up. */
  turn(across, upwards) {
    const spin = (a, b, angle) => [
      plus(plus([0, 0, 0], a, Math.cos(angle)), b, Math.sin(angle)),
      plus(plus([0, 0, 0], b, Math.cos(angle)), a, -Math.sin(angle)),
    ];
    [this.back, this.right] = spin(this.back, this.right, -across);
    [this.back, this.up] = spin(this.back, this.up, upwards);
    this.back = unit(this.back);
    this.right = unit(cross(this.up, this.back));
    this.up = cross(this.back, this.right);
  }

  /** Move what is seen by parts (of 2) of a panel. */
  pan(x, y, aspect) {
    const high = this.slope(aspect) * this.distance;
    this.focal = plus(plus(this.focal, this.right, -x * high * aspect), this.up, -y * high);
  }

  /** Come nearer by a factor; what is at a place of a panel, in the focal point's plane, stays there. */
  zoom(factor, x, y, aspect) {
    const distance = Math.min(Math.max(this.distance / factor, NEAREST), FARTHEST),
      left = 1 - distance / this.distance;
    this.pan(-x * left, -y * left, aspect);
    this.distance = distance;
  }
}
