/** Marks and the pointer's place, painted over the surface; the scene has their shapes. */
import { percentage } from "./numbers.js";
import { valueText } from "./fields.js";

const DARK = "#14161A", DIGITS = [1, 10 / 11, 8 / 11];

/**
 * Paint shapes about a place.
 * @param {CanvasRenderingContext2D} brush
 * @param {object[]} shapes paths and texts, as `app/drawing/painters/page.py` writes them
 * @param {{colour?: string, number?: number, font?: string}} own what stands for "own" colours, and for numbers
 */
export function paintShapes(brush, shapes, x, y, { colour = "", number = 0, font = "" } = {}) {
  const inked = (name) => (name === "own" ? colour : name);
  brush.save();
  brush.translate(x, y);
  for (const { path, text, fill, line, width, dashes, join, cap, ...words } of shapes) {
    if (text !== undefined) {
      const digits = String(number), size = words.size * DIGITS[Math.min(digits.length, 3) - 1];
      brush.font = `${words.weight} ${size}px ${font}`;
      brush.fillStyle = inked(words.colour);
      brush.textAlign = words.align;
      brush.textBaseline = words.level;
      brush.fillText(digits, words.x, words.y);
      continue;
    }
    const outline = new Path2D(path);
    if (fill) {
      brush.fillStyle = inked(fill);
      brush.fill(outline);
    }
    if (!line) continue;
    brush.setLineDash(dashes);
    [brush.lineJoin, brush.lineCap, brush.lineWidth, brush.strokeStyle] = [join, cap, width, inked(line)];
    brush.stroke(outline);
  }
  brush.restore();
}

/** The place that the arrow keys move. */
export function paintCursor(brush, x, y) {
  for (const [wide, colour] of [
    [4, DARK],
    [2, "#FFFFFF"],
  ]) {
    brush.beginPath();
    for (const [dx, dy] of [
      [1, 0],
      [-1, 0],
      [0, 1],
      [0, -1],
    ]) {
      brush.moveTo(x + 4 * dx, y + 4 * dy);
      brush.lineTo(x + 12 * dx, y + 12 * dy);
    }
    brush.lineWidth = wide;
    brush.strokeStyle = colour;
    brush.stroke();
  }
}

/** What the clip plane cuts away of source and pins, in the words of the window, from the longest to the shortest. */
export function cutAwayWords({ sight, mesh, source, pins }) {
  const isGone = (vertex) => sight.shape.depth(sight.shape.place(vertex)) < 0;
  const gone = pins.flatMap(({ vertex }, k) => (isGone(vertex) ? [`Pin ${k + 1}`] : []));
  if (isGone(source)) gone.unshift(`Vertex ${mesh.ids[source]}`);
  if (!gone.length) return [];
  const count = gone.length - 1, others = count ? ` and ${count} other mark${count > 1 ? "s" : ""} are` : " is";
  return [" by the clip plane", ""].map((plane) => `${gone[0]}${others} cut away${plane}.`);
}

/** The first words that have room, in the upper left corner of a view's box. */
export function paintNote(brush, box, notes, theme) {
  brush.font = `400 12.5px ${theme.font}`;
  const words = notes.find((text) => brush.measureText(text).width <= 0.85 * box.width - 14) ?? notes.at(-1);
  brush.beginPath();
  brush.roundRect(box.x + 4, box.y + 2, 20 + brush.measureText(words).width, 26, 4);
  brush.globalAlpha = 0.8;
  brush.fillStyle = theme.canvas;
  brush.fill();
  brush.globalAlpha = 1;
  brush.fillStyle = theme.quiet;
  brush.fillText(words, box.x + 14, box.y + 19.5);
}

/** Value and fraction of the maximum beside the pointer, inside the view's box. */
export function paintLabel(brush, x, y, box, { value, fraction }, answer, theme) {
  const bold = valueText(answer, value);
  const light = Number.isNaN(fraction) ? "" : percentage(fraction);
  brush.font = `600 13px ${theme.font}`;
  const boldWidth = brush.measureText(bold).width;
  brush.font = `400 13px ${theme.font}`;
  const width = boldWidth + (light ? brush.measureText(light).width + 7 : 0) + 16;
  const left = x + 16 + width > box.x + box.width ? x - 16 - width : x + 16;
  const top = y - 38 < box.y ? y + 14 : y - 38;
  brush.beginPath();
  brush.roundRect(Math.max(left, box.x), top, width, 24, 4);
  brush.fillStyle = theme.label;
  brush.fill();
  brush.fillStyle = theme.labelQuiet;
  brush.fillText(light, Math.max(left, box.x) + 15 + boldWidth, top + 16.5);
  brush.font = `600 13px ${theme.font}`;
  brush.fillStyle = theme.labelText;
  brush.fillText(bold, Math.max(left, box.x) + 8, top + 16.5);
}
