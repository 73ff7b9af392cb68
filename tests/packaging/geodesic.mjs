// Exact geodesic distances by the kernel as a WebAssembly module: node geodesic.mjs libbihdist.wasm < question.json
//
// Of positions x (n, 3) and faces (m, 3), from sources and at targets in faces: face (k,) and weights (k, 3) of the ends
// begin and end.  The distances of all vertices and targets, and the path to the last target, as faces and weights.
import { at, bytes, done, doubles, given, ints, kernel, longs } from "./wasm.mjs";

const NO_ROOM = -5;
const [SIDE, REACHED, QUEUE, WAITING, WINDOW, CROSSING] = [32, 40, 8, 16, 56, 8]; // bytes
const [n, m] = [given.x.length / 3, given.faces.length / 3];
const view = new DataView(kernel.memory.buffer);
const integer = (structure, offset, value) => view.setInt32(at(structure) + offset, value, true);
const long = (structure, offset, value) => view.setBigInt64(at(structure) + offset, BigInt(value), true);
const number = (structure, offset) => Number(view.getBigInt64(at(structure) + offset, true));

const mesh = bytes(40);
long(mesh, 0, n), long(mesh, 8, m);
[bytes(SIDE * 3 * m), ints(n + 1), ints(3 * m), ints(n), bytes(n)].forEach((a, k) => integer(mesh, 16 + 4 * k, at(a)));
kernel.bih_geodesic_mesh(at(mesh), at(doubles(given.x)), at(ints(given.faces)), 0, at(ints(3 * m)), at(ints(3 * m)),
  at(ints(n + 1)));

const run = bytes(200);
function setPlaces(offset, places) {
  long(run, offset, places.face.length);
  const arrays = [ints(places.face), doubles(places.begin), doubles(places.end)];
  arrays.forEach((a, k) => integer(run, offset + 8 + 4 * k, at(a)));
}
const targets = given.targets.face.length;
const [first, following] = [ints(m).fill(-1), ints(targets)];
given.targets.face.forEach((face, k) => ([following[k], first[face]] = [first[face], k]));
const reached = bytes(REACHED * (n + targets));
integer(run, 0, at(mesh)), setPlaces(8, given.sources), setPlaces(32, given.targets);
[doubles(given.sources.face.length).fill(0), first, following, reached, bytes(QUEUE * 3 * m),
  bytes(WAITING * (3 * m + n))].forEach((a, k) => integer(run, 56 + 4 * k, at(a)));
long(run, 168, 1e7), view.setFloat64(at(run) + 176, Infinity, true);

// Windows, and crossings of edges with three or more faces, in arrays that grow.
let [windows, crossings] = [bytes(0), bytes(0)];
function grow() {
  const [live, used, needed, more] = [112, 136, 144, 152].map((offset) => number(run, offset));
  const room = Math.max(2 * number(run, 96), live + needed), over = 2 * (used + more);
  windows = bytesOf(WINDOW * room, windows), crossings = bytesOf(CROSSING * over, crossings);
  [windows, ints(room), ints(room), crossings].forEach((a, k) => integer(run, 80 + 4 * k, at(a)));
  long(run, 96, room), long(run, 104, over);
}
function bytesOf(size, old) {
  const made = bytes(Math.max(size, old.length));
  made.set(old);
  return made;
}
let status;
while ((status = kernel.bih_geodesic_begin(at(run))) === NO_ROOM) grow();
done(status);
const watch = longs(2);
while ((status = kernel.bih_geodesic_run(at(run), at(watch))) === NO_ROOM) grow();
done(status);

const room = 2 * m;
const [face, begin, end] = [ints(room), doubles(3 * room), doubles(3 * room)];
const count = done(kernel.bih_geodesic_path(at(run), BigInt(n + targets - 1), BigInt(room), at(face), at(begin), at(end)));
const distances = Array.from({ length: n + targets }, (_, k) => view.getFloat64(at(reached) + REACHED * k, true));
console.log(JSON.stringify({
  distances, face: [...face.slice(0, count)], begin: [...begin.slice(0, 3 * count)],
  end: [...end.slice(0, 3 * count)],
}));
