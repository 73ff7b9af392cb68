// What a page holds, from base64 of raw deflate to arrays; app/web/stored_mesh.py and stored_values.py pack it.

/**
 * What the solver takes of a page or of a widget.
 * @param {Object<string, Uint8Array | string>} packed the kernel, the mesh, given fields, points, and of a mesh with
 *   matrices of its own weights and areas, of one without faces normals
 * @param {{given: string[]}} scene
 */
export async function unpackedContents(packed, scene) {
  const [wasm, mesh] = [await inflated(packed.kernel), unpackedMesh(await inflated(packed.mesh))];
  const given = unpackedFields(await inflated(packed.given), mesh, scene.given), points = {};
  for (const [name, count] of packed.weights ? [["weights", mesh.index.length], ["areas", mesh.n]] : [])
    Object.assign(mesh, unpackedFields(await inflated(packed[name]), { n: count }, [name]));
  if (packed.normals) mesh.normals = new Int8Array((await inflated(packed.normals)).buffer);
  for (const [name, content] of Object.entries(packed))
    if (name.startsWith("points-")) points[name.slice("points-".length)] = unpackedPoints(await inflated(content), mesh);
  return { wasm, mesh, given, points };
}

/** Bytes of raw deflate, or base64 of them. @param {Uint8Array | string} packed @returns {Promise<Uint8Array>} */
export async function inflated(packed) {
  const isText = typeof packed === "string";
  const bytes = isText ? Uint8Array.from(atob(packed.trim()), (c) => c.charCodeAt(0)) : packed;
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Whole numbers of 7 bits a byte, least first, with the sign in the lowest bit.
function* varints(bytes) {
  for (let p = 0; p < bytes.length; ) {
    let x = 0, shift = 1, byte;
    do (byte = bytes[p++]), (x += (byte & 127) * shift), (shift *= 128);
    while (byte > 127);
    yield x % 2 ? -(x + 1) / 2 : x / 2;
  }
}

/**
 * @typedef {object} Mesh
 * @property {number} n vertices that faces have
 * @property {number} m faces
 * @property {Float64Array} positions (3 n)
 * @property {Int32Array} faces (3 m)
 * @property {Int32Array} ids (n) the file's number of each vertex
 * @property {Int32Array} components (c + 1) the first vertex of each, and n
 * @property {Int32Array} faceComponents (c + 1) the first face of each, and m
 * @property {Int32Array} start (n + 1) where the entries of each row of the stiffness matrix above its diagonal begin, if
 *   that does not follow from the faces
 * @property {Int32Array} index (e) the columns of these
 * @property {Float64Array} [weights] (e) these entries, without their sign
 * @property {Float64Array} [areas] (n)
 * @property {Int8Array} [normals] (3 n) of points without faces, 127 times as long as 1
 */

/** @param {Uint8Array} bytes @returns {Mesh} */
export function unpackedMesh(bytes) {
  const [lowX, lowY, lowZ, step] = new Float64Array(bytes.slice(0, 32).buffer);
  const numbers = varints(bytes.subarray(32)), next = () => numbers.next().value;
  const [n, m, count, floats, e] = [next(), next(), next(), next(), next()];
  const sums = (array, stride, first) => {
    for (let k = first, sum = 0; k < array.length; k += stride) array[k] = sum += next();
    return array;
  };
  const components = sums(new Int32Array(count + 1), 1, 0), faceComponents = sums(new Int32Array(count + 1), 1, 0);
  const faces = sums(new Int32Array(3 * m), 3, 0);
  for (let k = 0; k < 3 * m; k += 3) (faces[k + 1] = faces[k] + next()), (faces[k + 2] = faces[k] + next());
  const ids = sums(new Int32Array(n), 1, 0);
  const start = new Int32Array(n + 1), index = new Int32Array(e);
  if (e) sums(start, 1, 1), sums(index, 1, 0);
  const words = fromPlanes(bytes.subarray(bytes.length - 12 * n), 3 * n);
  const positions = floats ? new Float64Array(new Float32Array(words.buffer)) : predicted(words, e ? () => entries({ start, index }) : () => sides(faces));
  if (!floats) for (let k = 0; k < 3 * n; k++) positions[k] = positions[k] * step + [lowX, lowY, lowZ][k % 3];
  return { n, m, positions, faces, ids, components, faceComponents, start, index };
}

// Words of 4 bytes, of which all first bytes come first, then all second ones: alike bytes are beside each other.
function fromPlanes(planes, count) {
  const words = new Uint32Array(count);
  for (let b = 0; b < 4; b++) for (let k = 0; k < count; k++) words[k] |= planes[b * count + k] << (8 * b);
  return words;
}

// Of each side of a face, and of each entry of a matrix above its diagonal, the greater number and the lesser.
function* sides(faces) {
  for (let k = 0; k < faces.length; k++) {
    const [a, b] = [faces[k], faces[k % 3 === 2 ? k - 2 : k + 1]];
    yield a < b ? [b, a] : [a, b];
  }
}
export function* entries({ start, index }) {
  for (let v = 0; v + 1 < start.length; v++) for (let e = start[v]; e < start[v + 1]; e++) yield [index[e], v];
}

// Each vertex is where it differs by so much from the mean of its neighbours with lesser numbers, once for each pair.
function predicted(differences, pairs) {
  const n = differences.length / 3, first = new Int32Array(n + 1);
  for (const [v] of pairs()) first[v + 1]++;
  for (let v = 0; v < n; v++) first[v + 1] += first[v];
  const put = first.slice(), lesser = new Int32Array(first[n]);
  for (const [v, neighbour] of pairs()) lesser[put[v]++] = neighbour;
  const at = new Float64Array(3 * n);
  for (let v = 0; v < n; v++)
    for (let axis = 0, count = first[v + 1] - first[v]; axis < 3; axis++) {
      const word = differences[3 * v + axis];
      let sum = 0;
      for (let k = first[v]; k < first[v + 1]; k++) sum += at[3 * lesser[k] + axis];
      const mean = count ? Math.floor((2 * sum + count) / (2 * count)) : 0;
      at[3 * v + axis] = mean + ((word >>> 1) ^ -(word & 1));
    }
  return at;
}

/** Fields by name, each a scale and multiples of it. @param {Uint8Array} bytes @param {Mesh} mesh
 * @param {string[]} names @returns {Object<string, Float64Array>} NaN where undefined */
export function unpackedFields(bytes, { n }, names) {
  const each = (k) => bytes.slice(k * (8 + 4 * n), (k + 1) * (8 + 4 * n));
  const fields = names.map((_, k) => {
    const [scale] = new Float64Array(each(k).buffer, 0, 1);
    return Float64Array.from(new Float32Array(fromPlanes(each(k).subarray(8), n).buffer), (value) => value * scale);
  });
  return Object.fromEntries(names.map((name, k) => [name, fields[k]]));
}

/**
 * Points that stand for vertices, so that their distances are those of the vertices.
 * @typedef {object} Points
 * @property {number} k coordinates
 * @property {Float32Array} at (k, n)
 */

/** Each coordinate has a scale for each component, and 16 bits.
 * @param {Uint8Array} bytes @param {Mesh} mesh @returns {Points} */
export function unpackedPoints(bytes, mesh) {
  const { n, components } = mesh, parts = components.length - 1, k = bytes.length / (2 * n + 8 * parts);
  const scales = new Float64Array(bytes.slice(0, 8 * k * parts).buffer);
  const planes = bytes.subarray(8 * k * parts), at = new Float32Array(k * n);
  for (let c = 0; c < k; c++)
    for (let part = 0; part < parts; part++)
      for (let v = components[part]; v < components[part + 1]; v++) {
        const j = c * n + v;
        at[j] = (((planes[j] | (planes[k * n + j] << 8)) << 16) >> 16) * scales[c * parts + part];
      }
  return { k, at };
}
