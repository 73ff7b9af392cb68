/** Where the clip plane cuts a solid: faces between places on edges, over which fields are continued from the edges' ends. */

/** How far the cut lies within what is left, so that it is not clipped itself. */
const INWARDS = 2e-4;

/** The points of a cut, as they are drawn. @returns {Float32Array} (3 k) */
export function cutPlaces(places, { ends, weights }, clip) {
  const at = new Float32Array(3 * weights.length);
  for (const [k, weight] of weights.entries())
    for (let x = 0; x < 3; x++) {
      const [a, b] = [places[3 * ends[2 * k] + x], places[3 * ends[2 * k + 1] + x]];
      at[3 * k + x] = a + weight * (b - a) + INWARDS * clip[x];
    }
  return at;
}

/** What is drawn of a shape, and its cut, whose points come last and stand for the first ends of their edges. */
export function withCut(drawn, at, { ends, weights, faces }, clip) {
  const first = drawn.places.length / 3, toward = Float32Array.from(at, (_, k) => -clip[k % 3]);
  return {
    places: joinedArrays(drawn.places, at),
    normals: joinedArrays(drawn.normals, toward),
    corners: joinedArrays(drawn.corners, faces.map((corner) => first + corner)),
    copies: [...drawn.copies, ...weights.map((_, k) => ends[2 * k])],
    cut: { ends, weights, first },
  };
}

/** Fill in the values at the points of a cut. */
export function putBetween(values, { ends, weights, first }, none) {
  for (const [k, weight] of weights.entries()) {
    const [a, b] = [values[ends[2 * k]], values[ends[2 * k + 1]]];
    values[first + k] = a === none || b === none ? none : a + weight * (b - a);
  }
}

/** Two arrays, of the type of the first. */
export function joinedArrays(one, other) {
  const both = new one.constructor(one.length + other.length);
  both.set(one);
  both.set(other, one.length);
  return both;
}
