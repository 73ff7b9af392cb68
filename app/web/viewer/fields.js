/** What panels show of the solver's fields. */
import { roundStep, written } from "./numbers.js";

const PERCENTAGE_POINTS = "percentage points";

/** The names of the fields that a panel is made of. @returns {string[]} */
export const fieldNames = (panel) => (panel.distance === "difference" ? panel.of : [panel.distance]);

/** The word and the parameter of a distance with a slider, "diffusion@0.25". */
export const partsOf = (distance) => distance.split("@");

/** The function of the Laplacian that a panel's slider moves; undefined without one. */
export const functionOf = (scene, { distance }) => scene.functions?.[partsOf(distance)[0]];

/** A panel at another value of its slider; undefined if there is none. */
export function panelAt(scene, panel, value) {
  const [word, own] = partsOf(panel.distance), step = functionOf(scene, panel)?.steps.find((each) => each.value === value);
  if (!step || value === Number(own)) return step && panel;
  return { ...panel, distance: `${word}@${value}`, label: step.label, unit: step.unit, range: null };
}

/**
 * A panel's values and range.
 * @returns {{values: Float64Array, own: number, low: number, high: number, signed: boolean, gap: string,
 *   labels?: {name: string, colour: number[]}[]}} own: the largest value, of a signed field in size; gap: what a vertex
 *   without a value is; labels: of which values are the places
 */
export function panelAnswer(panel, fields) {
  const { signed, note, labels } = panel;
  const values = panel.distance === "difference" ? difference(panel, fields) : fields[panel.distance];
  const own = largest(values), [low, high] = panel.range ?? [signed ? -own : 0, own];
  return { values, own, low, high, signed, labels, gap: labels ? "no label" : note ? "undefined" : "not connected" };
}

function difference({ of, unit }, fields) {
  const [a, b] = of.map((name) => fields[name]);
  const [p, q] = unit === PERCENTAGE_POINTS ? [a, b].map((field) => 100 / (largest(field) || 1)) : [1, 1];
  return a.map((value, k) => p * value - q * b[k]);
}

/** The largest size of a value; NaN is none. */
function largest(values) {
  let most = 0;
  for (const value of values) if (Math.abs(value) > most) most = Math.abs(value);
  return most;
}

/**
 * The values that have an isoline, from small to large: none at a distance's 0 nor at the farthest point, where a line
 * would be a blot; a difference has one at 0.
 * @param {{count: number | null, values: number[] | null, equal?: boolean}} isolines about so many at round values, or
 *   values; equal: so many equal steps to the end of the colour bar
 * @returns {{values: number[], step: number}} step: from one to the next, 0 where they are given
 */
export function isolineLevels({ count, values, equal }, { own, high, signed }) {
  const least = signed ? -own : 0, room = 1e-6 * own;
  if (values)
    return { values: values.filter((v) => v > least + room && v < own - room).sort((a, b) => a - b), step: 0 };
  if (!count || !(high > 0 && own > 0)) return { values: [], step: 0 };
  const steps = signed ? Math.max(Math.round(count / 2), 1) : count;
  const step = equal ? high / steps : roundStep(high, steps);
  const last = Math.min(Math.ceil(own / step - 1e-6) - 1, 1000), first = signed ? -last : 1;
  return { values: Array.from({ length: Math.max(last - first + 1, 0) }, (_, k) => (first + k) * step), step };
}

/** A value as it stands in tables and is read out, with its fraction of the maximum. */
export const reading = (answer, vertex) => {
  const value = answer.values[vertex];
  return { value, fraction: answer.labels || answer.signed || !(answer.own > 0) ? NaN : value / answer.own };
};

/** A value or a label in words. */
export const valueText = ({ labels, signed, gap }, value) =>
  Number.isNaN(value) ? gap : labels ? labels[value].name : written(value, signed);
