// The kernel as a WebAssembly module: node kernel.mjs libbihdist.wasm < matrix.json
//
// Of a symmetric matrix by rows (start, index, value), positions (n, 3) and areas (n,), with G its inverse: the diagonal
// and one column of G A G, and G A 1.
import { array, at, done, doubles, given, ints, kernel, longs } from "./wasm.mjs";

const structure = (...words) => at(ints(words));

// The matrix, and the order of elimination.
const n = given.start.length - 1;
const N = BigInt(n);
const [start, index, value] = [ints(given.start), ints(given.index), doubles(given.value)];
const matrix = structure(n, 0, at(start), at(index), at(value), 0);
const watch = structure(0, 0, 0, 0);
const dissection = at(array(Uint8Array, Number(kernel.bih_dissection_room(N, BigInt(index.length)))));
const [vertices, place] = [ints(n), ints(n)];
const [last, subtrees] = [ints(2 * n + 1), ints(4 * n + 2)];
const found = [vertices, place, last, subtrees].map(at);
const fronts = done(kernel.bih_order(matrix, at(doubles(given.x)), dissection, ...found));

// The elimination tree, as one task.
const root = BigInt(fronts - 1);
const [first, children, parent] = [ints(fronts + 1), ints(2 * fronts), ints(fronts)];
const [bound, pivotBlock, rowBlock, stack, inverse] = Array.from({ length: 5 }, () => longs(fronts + 1));
const room = 64 * n;
const [rows, up, rank] = [ints(room), ints(room), ints(n)];
const top = array(Uint8Array, fronts);
const tree = structure(n, 0, fronts, 0, ...[vertices, place, first, children, parent, bound, rows, up, pivotBlock,
  rowBlock, stack, inverse, top, rank].map(at), 0);
const totals = longs(5);
done(kernel.bih_lay_out(matrix, tree, at(last), at(subtrees), 0n, BigInt(room), at(ints(3 * n)), at(totals)));
const [pivots, boundaries, , , longest] = Array.from(totals, Number);

// The factor with its derivatives.
const areas = doubles(Array.from(vertices, (v) => given.areas[v]));
const factor = structure(tree, at(areas), at(doubles(2 * pivots + 8)), at(doubles(2 * boundaries + 8)));
const [diagonal, sandwich] = [doubles(n), doubles(n)];
const factorWork = at(doubles(Number(kernel.bih_factor_room(tree, 1))));
done(kernel.bih_factor(factor, matrix, factorWork, at(diagonal), at(sandwich), at(longs(2))));

// Solves.
const work = at(doubles(2 * (longest + 8) + 8));
const mean = doubles(n);
kernel.bih_solve(factor, 1n, 1n, at(doubles(given.areas)), 1n, at(mean), 1n, at(doubles(n)), work);
const unit = place[given.column];
const [xy, count] = [doubles(2 * n), ints(fronts)];
kernel.bih_send_units(factor, at(ints([unit])), 1n, 1n, at(xy), at(count), work);
done(kernel.bih_sweep_down_both(factor, 0n, root, 1n, at(xy), at(count), work, watch));

const inOrder = (a) => Array.from(place, (p) => a[p]);
console.log(JSON.stringify({ sandwich: [...sandwich], column: inOrder(xy.filter((_, k) => k % 2)), mean: [...mean] }));
