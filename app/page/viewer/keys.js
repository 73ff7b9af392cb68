/** What keys mean in a view, and the list of all that can be done. */

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const STEP = 24,
  CURSOR_STEP = 8;

const ACTS = {
  "+": "nearer",
  "=": "nearer",
  "-": "farther",
  Home: "home",
  Enter: "source",
  "[": "back",
  "]": "forward",
  p: "pin",
  "?": "help",
};

export const HELP = [
  ["Click or tap", "set the source"],
  ["Shift+drag", "the source follows the pointer"],
  ["Drag, one finger, arrow keys", "turn"],
  ["Wheel, two fingers, + and −", "zoom"],
  ["Right drag, Ctrl+drag, two fingers", "move"],
  ["Home", "the first view"],
  ["Tab", "to the next panel"],
  ["Shift+arrow keys", "move the cursor, which stands in the middle at first"],
  ["Enter", "set the source at the cursor"],
  ["P", "pin the vertex at the pointer or cursor"],
  ["[ and ]", "to the source before, and after"],
  ["?", "this list"],
];

/**
 * Act on a key of a view.
 * @param {{turn, cursor: (dx: number, dy: number) => void} & Object<string, () => void>} acts
 */
export function act(event, acts) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const arrow = ARROWS[event.key],
    name = ACTS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (arrow && event.shiftKey) acts.cursor(CURSOR_STEP * arrow[0], CURSOR_STEP * arrow[1]);
  else if (arrow) acts.turn(STEP * arrow[0], STEP * arrow[1]);
  else if (name) acts[name]();
  if (arrow || name) event.preventDefault();
}
