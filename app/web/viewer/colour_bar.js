/** A panel's colour bar: range, unit, round ticks, isolines, and the value at the pointer. */
import { written, percentage, shortest, roundTicks } from "./numbers.js";

const WIDEST = 440, MARGIN = 16, TICK_ROOM = 72, LINE_ROOM = 5, NARROW = 200, LEGEND_ROWS = 3;

/** The words above a bar: left, bold and quiet, and right. */
export function barWords({ unit, note }, answer, value) {
  if (!answer) return { bold: "", left: "", right: "" };
  if (answer.labels) return { bold: "", left: answer.labels.map(({ name }) => name).join(", "), right: "labels" };
  const most = `max ${answer.signed ? "±" : ""}${written(answer.own)}`;
  if (value === null) return { bold: "", left: unit || note, right: most };
  if (Number.isNaN(value)) return { bold: "", left: answer.gap, right: "" };
  const share =
    answer.signed || !(answer.own > 0) ? most : `${percentage(value / answer.own)} of ${written(answer.own)}`;
  return { bold: written(value, answer.signed), left: unit, right: share };
}

/**
 * Paint a bar into a box of the page.
 * @param {CanvasRenderingContext2D} brush
 * @param {{x: number, y: number, width: number}} box
 * @param {number | null} value at the pointer
 * @param {{map: number[][], levels: number[], theme: object}} look
 */
export function paintBar(brush, box, panel, answer, value, { map, levels, theme }) {
  const width = Math.min(box.width - 2 * MARGIN, WIDEST), x = Math.round(box.x + (box.width - width) / 2), y = box.y;
  const { bold, left, right } = barWords(panel, answer, value), isNarrow = width < NARROW;
  brush.textBaseline = "alphabetic";
  if (answer?.labels) return paintLegend(brush, box, answer.labels, value, theme);
  paintWords(brush, theme, x, y + 16, width, bold, isNarrow && bold ? "" : left, right);
  brush.save();
  brush.beginPath();
  brush.roundRect(x, y + 25, width, 10, 2);
  brush.clip();
  paintColours(brush, x, y + 25, width, answer ? map : null, theme);
  brush.restore();
  if (!answer || !(answer.high > answer.low)) return;
  const place = (v) => x + width * Math.min(Math.max((v - answer.low) / (answer.high - answer.low), 0), 1);
  paintLines(brush, levels.map(place), answer, theme, place(0), [x + 2, x + width - 2], y + 25);
  paintTicks(brush, panel, answer, theme, place, [x, x + width], y + 52);
  if (value !== null && !Number.isNaN(value)) {
    brush.fillStyle = theme.canvas;
    brush.fillRect(place(value) - 3, y + 22, 6, 16);
    brush.fillStyle = theme.text;
    brush.fillRect(place(value) - 1, y + 22, 2, 16);
  }
}

function paintWords(brush, theme, x, y, width, bold, left, right) {
  const write = (text, weight, colour, at) => {
    brush.font = `${weight} 13px ${theme.font}`;
    brush.fillStyle = colour;
    brush.fillText(text, at, y);
  };
  brush.font = `600 13px ${theme.font}`;
  const boldWidth = bold ? brush.measureText(bold).width + 4 : 0;
  brush.font = `400 13px ${theme.font}`;
  const rightWidth = brush.measureText(right).width,
    hasRoom = boldWidth + brush.measureText(left).width + rightWidth + 12 <= width;
  write(bold, 600, theme.text, x);
  if (hasRoom || !bold) write(left, 400, theme.quiet, x + boldWidth);
  if (hasRoom || bold) write(right, 400, theme.quiet, x + width - rightWidth);
}

/** Names and colours in rows in the middle, that at the pointer bold, and how many have no room. */
function paintLegend(brush, box, labels, value, theme) {
  const room = box.width - 2 * MARGIN, rows = [];
  brush.font = `600 12px ${theme.font}`;
  for (const [k, { name, colour }] of labels.entries()) {
    const wide = brush.measureText(name).width + 32, row = rows.at(-1), isLast = rows.length === LEGEND_ROWS;
    if (row && row.wide + wide <= room - (isLast ? 64 : 0)) row.wide += wide;
    else if (isLast) {
      row.labels.push({ name: `${labels.length - k} more` });
      row.wide += 64;
      break;
    } else rows.push({ wide, labels: [] });
    rows.at(-1).labels.push({ name, colour, wide, isPointed: k === value });
  }
  for (const [k, row] of rows.entries()) {
    let x = box.x + (box.width - row.wide + 16) / 2;
    for (const { name, colour, wide, isPointed } of row.labels) {
      brush.fillStyle = colour ? `rgb(${colour})` : "transparent";
      brush.fillRect(x, box.y + 18 * k + 7, 10, 10);
      brush.font = `${isPointed ? 600 : 400} 12px ${theme.font}`;
      brush.fillStyle = colour ? theme.text : theme.quiet;
      brush.fillText(name, x + (colour ? 16 : 0), box.y + 18 * k + 16);
      x += wide;
    }
  }
}

function paintColours(brush, x, y, width, map, theme) {
  brush.fillStyle = theme.border;
  if (map) {
    brush.fillStyle = brush.createLinearGradient(x, 0, x + width, 0);
    for (const [k, colour] of map.entries())
      if (k % 5 === 0) brush.fillStyle.addColorStop(k / (map.length - 1), `rgb(${colour})`);
  }
  brush.fillRect(x, y, width, 10);
}

function paintLines(brush, places, { signed }, theme, zero, [start, end], y) {
  const inside = places.filter((at) => at >= start && at <= end);
  if (inside.every((at, k) => k === 0 || at - inside[k - 1] >= LINE_ROOM)) {
    brush.fillStyle = theme.line;
    for (const at of inside) brush.fillRect(Math.round(at - 0.5), y, 1, 10);
  }
  if (!signed) return;
  brush.fillStyle = "#14161A";
  brush.fillRect(zero - 0.8, y, 1.6, 10);
}

function paintTicks(brush, { shares }, answer, theme, place, [start, end], y) {
  const scale = shares ? 100 / answer.high : 1, unit = shares ? " %" : "";
  const most = Math.floor((end - start) / TICK_ROOM);
  brush.font = `400 12px ${theme.font}`;
  brush.fillStyle = theme.quiet;
  let free = -Infinity;
  for (const value of roundTicks(answer.low * scale, answer.high * scale, most)) {
    const text = shortest(value) + unit, wide = brush.measureText(text).width;
    const at = Math.min(Math.max(place(value / scale) - wide / 2, start), end - wide);
    if (at < free) continue;
    brush.fillText(text, at, y);
    free = at + wide + 8;
  }
}
