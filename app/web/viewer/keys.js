/** What keys mean in a view, and the list of all that can be done. */

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const STEP = 24, CURSOR_STEP = 8, KEY_ZOOM = 1.15;

const KEYS = {
  "+": (viewer, panel, middle) => viewer.move("zoom", panel, KEY_ZOOM, ...middle),
  "-": (viewer, panel, middle) => viewer.move("zoom", panel, 1 / KEY_ZOOM, ...middle),
  Home: (viewer) => viewer.move("home"),
  Enter: (viewer, panel) => at(viewer, panel, (vertex) => viewer.choose(vertex)),
  p: (viewer, panel) => at(viewer, panel, (vertex) => viewer.pin(vertex)),
  "[": (viewer) => viewer.step(-1),
  "]": (viewer) => viewer.step(1),
  "?": (viewer) => viewer.help.showModal(),
};

function at(viewer, panel, then) {
  const vertex = viewer.pointing.vertex(panel);
  if (vertex !== undefined) then(vertex);
}

export const HELP = [
  ["Click or tap", "set the source"],
  ["Shift+drag", "the source follows the pointer"],
  ["Drag, one finger, arrow keys", "turn"],
  ["Wheel, two fingers, + and −", "zoom"],
  ["Right drag, Ctrl+drag, two fingers", "move"],
  ["Embedded in a page: Ctrl+wheel, or the wheel after a click", "zoom"],
  ["Embedded in a page: two fingers", "turn and zoom"],
  ["Home", "the first view"],
  ["Tab", "to the next panel"],
  ["Shift+arrow keys", "move the cursor, which starts in the middle"],
  ["Enter", "set the source at the cursor"],
  ["P", "pin the vertex at the pointer or cursor"],
  ["[ and ]", "to the previous and the next source"],
  ["?", "this list"],
];

/** Listen to the keys of a panel's view until the signal. @param {import("./viewer.js").Viewer} viewer */
export function addKeys(view, panel, viewer, signal) {
  const listener = (event) => {
    const { key, shiftKey, ctrlKey, metaKey, altKey } = event, arrow = ARROWS[key];
    const then = KEYS[key === "=" ? "+" : key.length === 1 ? key.toLowerCase() : key];
    if (ctrlKey || metaKey || altKey || !(arrow || then)) return;
    event.preventDefault();
    event.stopPropagation();
    if (arrow && shiftKey) return viewer.pointing.move(panel, CURSOR_STEP * arrow[0], CURSOR_STEP * arrow[1]);
    if (arrow) viewer.move("turn", panel, STEP * arrow[0], STEP * arrow[1]);
    else then(viewer, panel, [view.clientWidth / 2, view.clientHeight / 2]);
    if (viewer.pointing.cursor) viewer.pointing.move(panel, 0, 0);
  };
  view.addEventListener("keydown", listener, { signal });
}
