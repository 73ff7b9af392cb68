/** How numbers are written: four significant digits, a true minus. */

const signs = (text) => text.replace(/-/g, "−");

/** "0.3567", "12,345", "−0.02300", "1.200e−7"; signed: with a plus, too. */
export function written(value, signed = false) {
  if (!Number.isFinite(value)) return "–";
  if (!value) return "0";
  const size = Math.abs(value), plus = signed && value > 0 ? "+" : "";
  if (size < 1e-4 || size >= 1e7) return plus + signs(value.toExponential(3).replace("+", ""));
  const places = Math.max(3 - Number(value.toExponential(3).split("e")[1]), 0);
  return plus + signs(value.toLocaleString("en-US", { minimumFractionDigits: places, maximumFractionDigits: places }));
}

/** A fraction of the maximum: "77.6 %". */
export const percentage = (value) => (Number.isFinite(value) ? signs(`${(100 * value).toFixed(1)} %`) : "–");

/** A round number, as short as it goes. */
export const shortest = (value) => signs(String(Number(value.toPrecision(6))));

/** A count: "18,044". */
export const counted = (count) => count.toLocaleString("en-US");

/** Multiples of a round step (1, 2, 2.5, 5 times a power of ten) from low to high, at most so many or two. */
export function roundTicks(low, high, most) {
  if (!(high > low)) return [];
  const power = 10 ** Math.floor(Math.log10((high - low) / Math.max(most, 1)));
  for (const factor of [1, 2, 2.5, 5, 10, 20, 25, 50, 100]) {
    const step = factor * power;
    const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
    if (last - first < Math.max(most, 2)) return Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
  }
  return [];
}

/** The round step of which so many lead from 0 to the top as nearly as can be, in proportion. */
export function roundStep(top, steps) {
  const power = Math.floor(Math.log10(top / steps)), away = (step) => Math.abs(Math.log(top / steps / step));
  const found = [power, power + 1].flatMap((p) => [1, 2, 2.5, 5].map((digits) => Number(`${digits}e${p}`)));
  return found.reduce((best, step) => (away(step) < away(best) ? step : best));
}
