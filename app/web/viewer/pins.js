/** The table of pins: their values in each panel, their names, and a box for another one. */
import { element, iconButton } from "./elements.js";
import { percentage } from "./numbers.js";
import { reading, valueText } from "./fields.js";

export class PinTable {
  /** @param {import("./viewer.js").Viewer} viewer */
  constructor(viewer) {
    this.viewer = viewer;
    this.wrong = element("span", { class: "wrong", role: "alert" });
    const box = element("input", {
      class: "number",
      inputmode: "numeric",
      "aria-label": "Vertex to pin",
      placeholder: "vertex",
    });
    const form = element(
      "form",
      { class: "adding", submit: (event) => this.#add(event, box) },
      box,
      element("button", { class: "plain", text: "Pin it" }),
      this.wrong,
    );
    this.head = element("tr");
    this.relabel(viewer.scene.panels);
    this.body = element("tbody");
    const head = element("thead", {}, this.head);
    this.none = element("p", { class: "quiet", text: "No pins yet: press P at a place, or type a vertex." });
    this.element = element(
      "section",
      { class: "pins", "aria-label": "Pins", hidden: true },
      form,
      this.none,
      element("div", { class: "scrolled" }, element("table", {}, head, this.body)),
    );
  }

  /** Name the columns after what panels show. */
  relabel(panels) {
    const heads = ["Pin", "Name", ...panels.map(({ label }) => label)];
    const cells = heads.map((text) => element("th", { scope: "col", text }));
    this.head.replaceChildren(...cells, element("td")); // over the buttons
  }

  #add(event, box) {
    event.preventDefault();
    this.wrong.textContent = this.viewer.typed(box.value, (vertex) => this.viewer.pin(vertex));
    box.setAttribute("aria-invalid", String(this.wrong.textContent !== ""));
    if (!this.wrong.textContent) box.value = "";
  }

  /** @param {{id: number, vertex: number, name: string}[]} pins @param {(object | null)[]} answers of the panels */
  show(pins, answers) {
    this.none.hidden = pins.length > 0;
    this.body.closest("table").hidden = !pins.length;
    if (this.body.rows.length !== pins.length)
      this.body.replaceChildren(...pins.map((pin, k) => this.#row(k, answers)));
    for (const [k, pin] of pins.entries()) this.#fill(this.body.rows[k], pin, answers);
  }

  #row(k, answers) {
    const { colours } = this.viewer.scene.marks, badge = element("span", { class: "badge", text: k + 1 });
    badge.style.background = colours[k % colours.length];
    const id = element("button", {
      type: "button",
      class: "link",
      click: () => this.viewer.choose(this.viewer.pins[k].vertex),
    });
    const name = element("input", {
      "aria-label": `Name of pin ${k + 1}`,
      maxlength: 80,
      change: () => this.#rename(k, name.value),
    });
    const values = answers.map(() => element("td", { class: "value" }));
    return element(
      "tr",
      {},
      element("th", { scope: "row" }, badge, id),
      element("td", {}, name),
      ...values,
      element(
        "td",
        {},
        iconButton("remove", `Remove pin ${k + 1}`, () => this.#remove(k), { class: "bare" }),
      ),
    );
  }

  #rename(k, name) {
    this.viewer.changePins(this.viewer.pins.map((pin, each) => (each === k ? { ...pin, name } : pin)));
  }

  #remove(k) {
    this.viewer.changePins(this.viewer.pins.filter((_, each) => each !== k));
  }

  #fill(row, pin, answers) {
    row.querySelector(".link").textContent = pin.id;
    row.querySelector(".link").title = `Set the source at vertex ${pin.id}`;
    const box = row.querySelector("input");
    if (document.activeElement !== box) box.value = pin.name;
    for (const [k, cell] of [...row.querySelectorAll(".value")].entries())
      cell.textContent = valueWords(answers[k], pin.vertex);
  }
}

/** "0.3244 (46.8 %)" */
export function valueWords(answer, vertex) {
  if (!answer) return "…";
  const { value, fraction } = reading(answer, vertex);
  return valueText(answer, value) + (Number.isNaN(fraction) ? "" : ` (${percentage(fraction)})`);
}
