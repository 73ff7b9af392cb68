/** Source, pins, camera and panels in the part of an address behind "#", read strictly: anybody may have written it. */
import { minus, cross } from "./vectors.js";

const NUMBER = /^-?\d{1,17}(\.\d{1,17})?(e[+-]?\d{1,2})?$/, ID = /^\d{1,10}$/, CHOICE = /^\d{1,10}(:\d[\d.e-]{0,20})?$/;
const MOST_PINS = 100, LONGEST_NAME = 80;

/**
 * @param {{source: number, pins: {id: number, name: string}[], camera: number[][], panels?: string[]}} state
 *   camera: position, focal, up; panels: places among the choices, where they are not the first ones, with the value of a
 *   slider that was moved ("3:0.25")
 */
export function addressOf({ source, pins, camera, panels = [] }) {
  const places = pins.map(({ id, name }) => (name ? `${id}:${encodeURIComponent(name)}` : id));
  const numbers = camera.flat().map((x) => String(Number(x.toPrecision(6))));
  const [pinned, shown] = [places.length ? `&pins=${places}` : "", panels.length ? `&panels=${panels}` : ""];
  return `#source=${source}${pinned}${shown}&camera=${numbers}`;
}

/**
 * @param {(id: number) => boolean} isVertex
 * @param {(panels: string[]) => boolean} isChoice
 * @returns {{source?: number, pins?: {id: number, name: string}[], camera?: number[][], panels?: string[],
 *   ignored: string[]}} what is valid, and the names of what is not
 */
export function readAddress(hash, isVertex, isChoice) {
  const read = {
    source: (text) => vertexOf(text, isVertex),
    pins: (text) => pinsOf(text, isVertex),
    panels: (text) => panelsOf(text, isChoice),
    camera: cameraOf,
  };
  const found = { ignored: [] };
  for (const part of hash
    .slice(1)
    .split("&")
    .filter((part) => part)) {
    const [name, text] = [part.split("=", 1)[0], part.slice(part.indexOf("=") + 1)];
    const value = Object.hasOwn(read, name) ? read[name](text) : null;
    if (value === null) found.ignored.push(Object.hasOwn(read, name) ? name : "an unknown part");
    else found[name] = value;
  }
  return found;
}

const vertexOf = (text, isVertex) => (ID.test(text) && isVertex(Number(text)) ? Number(text) : null);

function pinsOf(text, isVertex) {
  const pins = text.split(",").map((each) => {
    const [id, name = ""] = each.split(":");
    const read = vertexOf(id, isVertex);
    return read === null ? null : { id: read, name: nameOf(name) };
  });
  return pins.length > MOST_PINS || pins.some((pin) => pin === null || pin.name === null) ? null : pins;
}

function panelsOf(text, isChoice) {
  const panels = text.split(",");
  return panels.every((each) => CHOICE.test(each)) && isChoice(panels) ? panels : null;
}

function nameOf(text) {
  try {
    const name = decodeURIComponent(text);
    return name.length > LONGEST_NAME ? null : name;
  } catch {
    return null;
  }
}

function cameraOf(text) {
  const words = text.split(",");
  if (words.length !== 9 || !words.every((word) => NUMBER.test(word))) return null;
  const [position, focal, up] = [0, 3, 6].map((k) => words.slice(k, k + 3).map(Number));
  const across = cross(up, minus(position, focal));
  return Math.hypot(...across) > 0 && Number.isFinite(Math.hypot(...across)) ? [position, focal, up] : null;
}
