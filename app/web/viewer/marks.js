/** Source, pins and the pointer's place, painted over the surface. */
import { written, percentage } from "./numbers.js";

export const PIN_COLOURS = [
  "#1F7A3D",
  "#A84A00",
  "#6B3FC0",
  "#6B6400",
  "#8A3A78",
  "#4A5560",
  "#7A4B1E",
  "#00696B",
  "#3F4FA8",
  "#99621E",
];
const DARK = "#14161A";

function disc(brush, x, y, radius, fill, rim, wide) {
  brush.beginPath();
  brush.arc(x, y, radius, 0, 2 * Math.PI);
  brush.fillStyle = fill;
  brush.lineWidth = wide;
  brush.strokeStyle = rim;
  if (fill) brush.fill();
  brush.stroke();
}

export const paintSource = (brush, x, y) => disc(brush, x, y, 6, "#FFDB1A", "#1A1A1F", 1.5);

/** A pin with its tip at the place, and its number. */
export function paintPin(brush, x, y, number, font) {
  const head = y - 17;
  brush.beginPath();
  brush.arc(x, head, 8.5, 0.8 * Math.PI, 0.2 * Math.PI);
  brush.lineTo(x, y);
  brush.closePath();
  brush.lineJoin = "round";
  for (const [wide, colour] of [
    [5, DARK],
    [3, "#FFFFFF"],
  ]) {
    brush.lineWidth = wide;
    brush.strokeStyle = colour;
    brush.stroke();
  }
  brush.fillStyle = PIN_COLOURS[(number - 1) % PIN_COLOURS.length];
  brush.fill();
  brush.font = `600 11px ${font}`;
  brush.fillStyle = "#FFFFFF";
  brush.textAlign = "center";
  brush.fillText(String(number), x, head + 4);
  brush.textAlign = "start";
}

/** A ring around the vertex at the pointer; isHere: in the panel that the pointer is in. */
export function paintRing(brush, x, y, isHere) {
  const radius = isHere ? 8 : 6;
  disc(brush, x, y, radius, "", DARK, 4.5);
  disc(brush, x, y, radius, "", "#FFFFFF", 2);
  if (isHere) disc(brush, x, y, 1, "#FFFFFF", DARK, 1.5);
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

/** Value and fraction of the maximum beside the pointer, inside the view's box. */
export function paintLabel(brush, x, y, box, { value, fraction }, { gap, signed }, theme) {
  const bold = Number.isNaN(value) ? gap : written(value, signed);
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
