// The kernel as a WebAssembly module: node kernel.mjs libbihdist.wasm < matrix.json
//
// Of a symmetric matrix by rows (start, index, value), positions (n, 3) within [-1, 1] and areas (n,), with G its
// inverse: the diagonal and one column of G A G, and G A 1.
import { array, at, done, doubles, given, ints, kernel, longs } from "./wasm.mjs";

const structure = (...words) => at(ints(words));

// The matrix, and the order of elimination.
const n = given.start.length - 1;
const N = BigInt(n);
const [start, index, value] = [ints(given.start), ints(given.index), doubles(given.value)];
const matrix = structure(n, 0, at(start), at(index), at(value), 0);
const watch = structure(0, 0, 0, 0);
const dissection = at(array(Uint8Array, Number(kernel.bih_dissection_room(N, BigInt(index.length)))));
const edges = kernel.bih_begin_dissection(matrix, at(doubles(given.x)), dissection);
const whole = longs([0n, N, 0n, BigInt(done(edges))]);
const [last, subtrees] = [ints(2 * n + 1), ints(4 * n + 2)];
const fronts = done(kernel.bih_dissect(dissection, at(whole), 0n, at(last), at(subtrees), watch));
const [vertices, place] = [ints(n), ints(n)];
kernel.bih_end_dissection(dissection, at(vertices), at(place));

// The elimination tree, as one task.
const root = BigInt(fronts - 1);
const [first, children, parent] = [ints(fronts + 1), ints(2 * fronts), ints(fronts)];
kernel.bih_link(root + 1n, at(last), at(subtrees), at(first), at(children), at(parent));
const [bound, pivotBlock, rowBlock, stack, inverse] = Array.from({ length: 5 }, () => longs(fronts + 1));
const room = 64 * n;
const [rows, up, rank] = [ints(room), ints(room), ints(n)];
const top = array(Uint8Array, fronts);
const tree = structure(n, 0, fronts, 0, ...[vertices, place, first, children, parent, bound, rows, up, pivotBlock,
  rowBlock, stack, inverse, top, rank].map(at), 0);
done(kernel.bih_boundaries(matrix, tree, at(bound), at(rows), BigInt(room), at(ints(3 * n))));
const totals = longs(4);
kernel.bih_lay_out(tree, 0n, ...[pivotBlock, rowBlock, stack, inverse, top, rank, up, ints(n), totals].map(at));
const [pivots, boundaries] = [Number(totals[0]), Number(totals[1])];

// The factor with its derivatives.
const factor = structure(tree, 1, at(doubles(2 * pivots + 8)), at(doubles(2 * boundaries + 8)));
const areas = doubles(given.areas);
const blocks = ints(fronts); // one task hands nothing on
const sizes = longs(3);
kernel.bih_elimination_room(tree, 1, 0n, root, at(sizes));
done(kernel.bih_eliminate(factor, matrix, at(areas), 0n, root, at(blocks), at(doubles(Number(sizes[2]))), at(longs(2)),
  watch));
const [diagonal, sandwich] = [doubles(n), doubles(n)];
kernel.bih_inversion_room(tree, 0n, root, at(sizes));
const inverted = at(doubles(Number(sizes[1])));
done(kernel.bih_invert(factor, 0n, root, at(blocks), inverted, at(diagonal), at(sandwich), watch));

// Solves.
const work = at(doubles(done(kernel.bih_sweep_room(tree, 0n, root, 2n))));
const mean = doubles(Array.from(vertices, (v) => areas[v]));
done(kernel.bih_sweep_up(factor, 0n, root, N, 1n, at(mean), 0, work, watch));
done(kernel.bih_sweep_down(factor, 0n, root, 1n, at(mean), work, watch));
const unit = place[given.column];
const front = ints([first.findIndex((p) => p > unit) - 1]);
const [xy, count] = [doubles(2 * n), ints(fronts)];
kernel.bih_send_units(factor, at(front), at(ints([unit])), 1n, 1n, at(xy), at(count), work);
done(kernel.bih_sweep_down_both(factor, 0n, root, 1n, at(xy), at(count), work, watch));

const inOrder = (a) => Array.from(place, (p) => a[p]);
console.log(JSON.stringify({ sandwich: [...sandwich], column: inOrder(xy.filter((_, k) => k % 2)), mean: inOrder(mean) }));
