/** What the page needs of a browser. */

/** A module with one SIMD instruction. */
const SIMD = [
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
];

/** A sentence on what the browser lacks, or "". */
export function lacking() {
  const isHere = {
    "WebAssembly with SIMD": () => WebAssembly.validate(Uint8Array.from(SIMD)),
    "DecompressionStream (deflate-raw)": () => new DecompressionStream("deflate-raw"),
    "web workers": () => Worker,
  };
  const missing = Object.keys(isHere).filter((name) => {
    try {
      return !isHere[name]();
    } catch {
      return true;
    }
  });
  return missing.length
    ? `This browser has no ${missing.join(", no ")}, which the page computes with; a newer one has.`
    : "";
}
