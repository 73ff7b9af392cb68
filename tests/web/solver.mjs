// What the page's solver answers, in node: node solver.mjs VIEWER < question.json
//
// Of the contents of a page's elements (kernel, mesh, given, points), and what it knows of its scene: the unpacked mesh, and for
// each source the distances by names, NaN as null.
import { resolveObjectURL } from "node:buffer";
import { readFileSync } from "node:fs";
import vm from "node:vm";

// What node lacks: a worker whose text is a blob, and which ends with the question.
globalThis.Worker = class {
  constructor(url) {
    const send = (data) => setTimeout(() => this.onmessage({ data }));
    const scope = vm.createContext({ postMessage: send, performance, WebAssembly, RangeError });
    this.scope = resolveObjectURL(url).text().then((text) => (vm.runInContext(text, scope), scope));
  }
  postMessage(data) {
    this.scope.then((scope) => scope.onmessage({ data }));
  }
  terminate() {}
};

Object.defineProperty(globalThis, "navigator", { value: { hardwareConcurrency: 4 } });

const { unpackedContents } = await import(`${process.argv[2]}/unpack.js`);
const { Solver } = await import(`${process.argv[2]}/solver.js`);
const { contents, scene, sources, names } = JSON.parse(readFileSync(0, "utf8"));

const unpacked = await unpackedContents(contents, scene), { mesh } = unpacked, said = [];
const solver = new Solver({ ...unpacked, scene, onprogress: (words) => said.push(words) });
const answers = [];
for (const source of sources) {
  try {
    const { fields } = await solver.field(source, names);
    answers.push(Object.fromEntries(Object.entries(fields).map(([name, field]) => [name, [...field]])));
  } catch (error) {
    answers.push({ error: error.message });
  }
}
// Of many at a time, the first and the last are answered.
const both = await Promise.all(sources.map((source) => solver.field(source, ["biharmonic"]).catch(() => 1)));
const content = Object.fromEntries(Object.entries(mesh).map(([name, a]) => [name, typeof a === "number" ? a : [...a]]));
console.log(JSON.stringify({ mesh: content, said, answers, dropped: both.filter((answer) => answer === null).length }));
