/** How panels see the shape: by one camera, with what is under a place of a view and what is hidden. */
import { Camera, FARTHEST } from "./camera.js";
import { FaceTree } from "./picking.js";
import { plus, dot } from "./vectors.js";

const TURN = 3.5;

export class Sight {
  /** @param {{x: number, y: number, width: number, height: number}[]} boxes of the views, in pixels, kept up to date */
  constructor(shape, view, boxes) {
    Object.assign(this, { shape, view, boxes, seen: new Map() });
    this.home();
  }

  /** The first view. */
  home() {
    const { position, focal, up, angle, parallel } = this.view, { shape } = this;
    this.camera = new Camera(
      {
        position: shape.inward(position),
        focal: shape.inward(focal),
        up,
        angle,
        parallel: parallel && parallel / shape.radius,
      },
      shape.places,
    );
    this.seen.clear();
  }

  /** Take a camera's position, focal point and way up. @returns {boolean} whether it is anywhere near the shape */
  look([position, focal, up]) {
    const places = [position, focal].map((point) => this.shape.inward(point));
    if (places.some((place) => Math.hypot(...place) > FARTHEST)) return false;
    this.camera.look(...places, up);
    this.seen.clear();
    return true;
  }

  /** Position, focal point and way up, in the file's coordinates. */
  get numbers() {
    return [this.shape.outward(this.camera.position), this.shape.outward(this.camera.focal), this.camera.up];
  }

  get tree() {
    return (this.faceTree ??= new FaceTree(this.shape.met));
  }

  #aspect(k) {
    return this.boxes[k].width / this.boxes[k].height;
  }

  #inView(k, x, y) {
    return [(2 * x) / this.boxes[k].width - 1, 1 - (2 * y) / this.boxes[k].height];
  }

  /** What is met at a place of a view, see `FaceTree.hit`; nothing on the cut through a solid. */
  hit(k, x, y) {
    const met = this.#met(this.camera.ray(...this.#inView(k, x, y), this.#aspect(k)));
    return met && met.vertex < this.shape.n ? met : null;
  }

  /** What a line of sight meets of what the clip plane leaves. */
  #met({ origin, direction }) {
    const { shape } = this, depth = shape.depth(origin);
    const gain = shape.clip ? dot(shape.clip, direction) : 0, start = depth < 0 ? -depth / gain : 0;
    if (!(start >= 0 && start < Infinity)) return null;
    const isLeft = (vertex) => shape.depth(shape.place(vertex)) >= 0;
    const hit = this.tree.hit({ origin: plus(origin, direction, start), direction }, isLeft);
    if (!hit || shape.depth(hit.point) <= -1e-6) return null;
    return { ...hit, away: hit.away + start, ...(shape.isOfPoints && { vertex: shape.nearest(hit.point) }) };
  }

  /** Whether the surface leaves a vertex in sight, as a translucent one does. */
  isSeen(vertex) {
    if (!this.seen.has(vertex)) {
      const place = this.shape.place(vertex), ray = this.camera.rayTo(place), hit = this.#met(ray);
      const isLeft = this.shape.depth(place) >= 0;
      this.seen.set(vertex, isLeft && (this.shape.opacity < 1 || !hit || hit.away > Math.hypot(...place.map((x, axis) => x - ray.origin[axis])) - 0.01));
    }
    return this.seen.get(vertex);
  }

  /** Where a vertex is, in pixels of what the boxes are in; null behind the eye. */
  placed(k, vertex) {
    const { x, y, width, height } = this.boxes[k], at = this.camera.project(this.shape.place(vertex), width / height);
    return at && [x + (width * (at[0] + 1)) / 2, y + (height * (1 - at[1])) / 2];
  }

  /** Of these three, lengths are in pixels of a view. */
  turn(k, dx, dy) {
    const { height } = this.boxes[k];
    this.camera.turn((TURN * dx) / height, (TURN * dy) / height);
    this.seen.clear();
  }

  pan(k, dx, dy) {
    this.camera.pan((2 * dx) / this.boxes[k].width, (-2 * dy) / this.boxes[k].height, this.#aspect(k));
    this.seen.clear();
  }

  zoom(k, factor, x, y) {
    this.camera.zoom(factor, ...this.#inView(k, x, y), this.#aspect(k));
    this.seen.clear();
  }
}
