// The kernel as a WebAssembly module, and arrays in its memory, one after the other.
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]));
export const kernel = instance.exports;
export const given = JSON.parse(readFileSync(0, "utf8"));
kernel.memory.grow(1024);

let end = kernel.__heap_base.value;
export function array(Type, content) {
  const count = typeof content === "number" ? content : content.length;
  const made = new Type(kernel.memory.buffer, (end + 15) & ~15, count);
  end = made.byteOffset + made.byteLength;
  if (typeof content !== "number") made.set(content);
  return made;
}
export const ints = (content) => array(Int32Array, content);
export const longs = (content) => array(BigInt64Array, content);
export const doubles = (content) => array(Float64Array, content);
export const bytes = (content) => array(Uint8Array, content);
export const at = (a) => a.byteOffset;
export function done(status) {
  if (status < 0) throw new Error(`status ${status}`);
  return Number(status);
}
