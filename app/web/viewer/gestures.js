/** What mouse and fingers mean in a view. */

const STILL = { mouse: 4, pen: 4, touch: 10 }, WHEEL = 0.0015;

/**
 * @typedef {object} Intents places are in pixels from the view's upper left corner
 * @property {(x: number, y: number) => void} hover
 * @property {() => void} leave
 * @property {(x: number, y: number, since: number) => void} pick a click or a tap
 * @property {(x: number, y: number) => void} live the source follows
 * @property {() => void} settle it has arrived
 * @property {(dx: number, dy: number) => void} turn
 * @property {(dx: number, dy: number) => void} pan
 * @property {(factor: number, x: number, y: number) => void} zoom
 * @property {() => boolean} leavesWheel whether the wheel scrolls what is around the page
 * @property {(pointer: string) => void} scrolled a wheel or a finger has done so
 */

/**
 * Listen in a view until the signal. Embedded in another page, one finger scrolls that page.
 * @param {Intents} intents
 */
export function addGestures(view, intents, signal, isEmbedded) {
  const fingers = new Map();
  let moved = false, mode = "", start = null;

  const place = (event) => {
    const box = view.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const listen = (name, act) => view.addEventListener(name, act, { signal, passive: false });

  listen("pointerdown", (event) => {
    if (event.pointerType === "mouse" && event.button === 1) return;
    view.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    start = place(event);
    moved = fingers.size > 1;
    mode = event.button === 2 || event.ctrlKey ? "pan" : event.shiftKey ? "live" : "turn";
  });

  listen("pointermove", (event) => {
    const [x, y] = place(event), before = fingers.get(event.pointerId);
    if (!before) return event.pointerType === "mouse" && intents.hover(x, y);
    if (!moved && Math.hypot(x - start[0], y - start[1]) < STILL[event.pointerType]) return;
    if (!moved && isEmbedded && event.pointerType === "touch" && Math.abs(y - start[1]) > Math.abs(x - start[0]))
      mode = "scroll";
    if (fingers.size === 2) pinch(event.pointerId, [x, y]);
    else if (mode === "live") intents.live(x, y);
    else if (mode !== "scroll") intents[mode](x - (moved ? before[0] : start[0]), y - (moved ? before[1] : start[1]));
    moved = true;
    fingers.set(event.pointerId, [x, y]);
  });

  function pinch(id, place) {
    const other = [...fingers].find(([each]) => each !== id)[1], before = fingers.get(id);
    const away = ([x, y]) => Math.hypot(x - other[0], y - other[1]);
    const middle = [(place[0] + other[0]) / 2, (place[1] + other[1]) / 2];
    intents[isEmbedded ? "turn" : "pan"]((place[0] - before[0]) / 2, (place[1] - before[1]) / 2);
    if (away(before) > 0 && away(place) > 0) intents.zoom(away(place) / away(before), ...middle);
  }

  listen("pointerup", (event) => {
    if (!fingers.delete(event.pointerId) || fingers.size) return;
    if (!moved && mode !== "pan") intents.pick(...start, event.timeStamp);
    else if (mode === "live") intents.settle();
  });
  listen("pointercancel", (event) => {
    fingers.delete(event.pointerId);
    if (isEmbedded) intents.scrolled(event.pointerType);
  });
  listen("touchmove", (event) => event.touches.length > 1 && event.preventDefault());
  listen("pointerleave", (event) => event.pointerType === "mouse" && !fingers.size && intents.leave());
  listen("contextmenu", (event) => event.preventDefault());
  listen("wheel", (event) => {
    if (intents.leavesWheel() && !event.ctrlKey && !event.metaKey) return intents.scrolled("mouse");
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
    intents.zoom(Math.exp(-event.deltaY * lines * WHEEL * (event.ctrlKey ? 5 : 1)), ...place(event));
  });
}
