/** The line above the panels: what is shown, the source's box, and buttons. */
import { element, iconButton } from "./elements.js";
import { counted } from "./numbers.js";

export class ToolBar {
  /** @param {import("./viewer.js").Viewer} viewer */
  constructor(viewer) {
    const { title, mesh } = viewer.scene;
    this.box = element("input", { class: "number", inputmode: "numeric", "aria-label": "Source: a vertex" });
    this.wrong = element("span", { class: "wrong", role: "alert" });
    const send = (event) => {
      event.preventDefault();
      this.say(viewer.typed(this.box.value, (vertex) => viewer.choose(vertex)));
    };
    const name = element("span", { class: "quiet", text: "Source", "aria-hidden": true });
    this.back = iconButton("back", "Source before", () => viewer.step(-1), { class: "bare" });
    this.forward = iconButton("forward", "Source after", () => viewer.step(1), { class: "bare" });
    this.pins = iconButton("pin", "Pins", () => viewer.showPins(), { "aria-expanded": "false" });
    this.element = element(
      "header",
      { class: "tools" },
      element("h1", { text: title, title }),
      element("span", {
        class: "quiet counts",
        text: Object.entries(mesh.counts).map(([name, count]) => `${counted(count)} ${name}`).join("  "),
      }),
      this.back,
      this.forward,
      element("form", { class: "source", submit: send }, name, this.box, this.wrong),
      element("span", { class: "gap" }),
      iconButton("home", "Home", () => viewer.move("home")),
      this.pins,
      ...(viewer.hasAddress ? [iconButton("link", "Copy link", () => viewer.copyLink())] : []),
      iconButton("picture", "Save picture", () => viewer.savePicture()),
      iconButton("about", "About", () => viewer.about.showModal()),
      iconButton("keys", "Keys", () => viewer.help.showModal()),
    );
  }

  say(wrong) {
    this.wrong.textContent = wrong;
    this.box.setAttribute("aria-invalid", String(wrong !== ""));
  }

  /** @param {number} id of the source */
  show(id, hasBack, hasForward) {
    this.say("");
    this.box.value = id;
    this.back.disabled = !hasBack;
    this.forward.disabled = !hasForward;
  }
}
