/** Elements of the page. Text reaches it by `textContent` only: names may be anything. */

/** An element with attributes and children; `text` is its text, a function is a listener ("click"). */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") made.textContent = value;
    else if (typeof value === "function") made.addEventListener(name, value);
    else if (value !== null && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children);
  return made;
}

const ICONS = {
  back: "M6.75 3.75 3.25 7.25l3.5 3.5M3.5 7.25h8.25a4.5 4.5 0 0 1 0 9H7.5",
  forward: "m13.25 3.75 3.5 3.5-3.5 3.5M16.5 7.25H8.25a4.5 4.5 0 0 0 0 9h4.25",
  home: "M3.5 9 10 3.25 16.5 9M5.25 7.75v8.5h9.5v-8.5",
  pin: "M10 17.75s5.25-5 5.25-9.25a5.25 5.25 0 0 0-10.5 0c0 4.25 5.25 9.25 5.25 9.25zM8.1 8.4a1.9 1.9 0 1 0 3.8 0a1.9 1.9 0 1 0-3.8 0",
  link: "M8.25 11.75a3.25 3.25 0 0 0 4.6 0l2.9-2.9a3.25 3.25 0 0 0-4.6-4.6l-.9.9M11.75 8.25a3.25 3.25 0 0 0-4.6 0l-2.9 2.9a3.25 3.25 0 0 0 4.6 4.6l.9-.9",
  picture:
    "M11.25 3.25h-6.5a1.5 1.5 0 0 0-1.5 1.5v10.5a1.5 1.5 0 0 0 1.5 1.5h10.5a1.5 1.5 0 0 0 1.5-1.5v-5.5M9.25 10.75 17 3M12.5 2.75h4.75v4.75",
  about: "M3.25 10a6.75 6.75 0 1 0 13.5 0a6.75 6.75 0 1 0-13.5 0M10 9.25v4.25M10 6.6v.2",
  keys: "M7.25 7.5a2.75 2.75 0 1 1 4 2.45c-.8.45-1.25.9-1.25 1.8v.5M10 15.2v.2",
  remove: "m5.5 5.5 9 9M14.5 5.5l-9 9",
};

function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS(svg.namespaceURI, "path");
  path.setAttribute("d", ICONS[name]);
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("aria-hidden", "true");
  svg.append(path);
  return svg;
}

/** A button with an icon; its words are seen where there is room, and always heard. */
export function iconButton(name, words, onclick, attributes = {}) {
  const shown = element("span", { class: "words", text: words });
  return element(
    "button",
    { type: "button", title: words, "aria-label": words, click: onclick, ...attributes },
    icon(name),
    shown,
  );
}

/** A dialog with a heading and a button that closes it. */
export function dialog(heading, ...children) {
  const close = element("button", { type: "button", class: "plain", text: "Close", click: () => box.close() });
  const box = element("dialog", { "aria-label": heading }, element("h2", { text: heading }), ...children, close);
  box.addEventListener("click", (event) => event.target === box && box.close());
  return box;
}
