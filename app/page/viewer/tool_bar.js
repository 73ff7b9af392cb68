/** The line above the panels: what is shown, the source's box, and buttons. */
import { element, iconButton } from "./elements.js";
import { counted } from "./numbers.js";

export class ToolBar {
  /** @param {Object<string, () => void>} acts by the names of the buttons, and `source: (text) => string`: what is wrong */
  constructor({ title, mesh }, acts, hasAddress) {
    this.box = element("input", { class: "number", inputmode: "numeric", "aria-label": "Source: a vertex" });
    this.wrong = element("span", { class: "wrong", role: "alert" });
    const form = element(
      "form",
      {
        class: "source",
        submit: (event) => {
          event.preventDefault();
          this.say(acts.source(this.box.value));
        },
      },
      element("span", { class: "quiet", text: "Source", "aria-hidden": true }),
      this.box,
      this.wrong,
    );
    this.back = iconButton("back", "Source before", acts.back, { class: "bare" });
    this.forward = iconButton("forward", "Source after", acts.forward, { class: "bare" });
    this.pins = iconButton("pin", "Pins", acts.pins, { "aria-expanded": "false" });
    this.element = element(
      "header",
      { class: "tools" },
      element("h1", { text: title, title }),
      element("span", {
        class: "quiet counts",
        text: `${counted(mesh.vertices)} vertices  ${counted(mesh.faces)} faces`,
      }),
      this.back,
      this.forward,
      form,
      element("span", { class: "gap" }),
      iconButton("home", "Home", acts.home),
      this.pins,
      ...(hasAddress ? [iconButton("link", "Copy link", acts.link)] : []),
      iconButton("picture", "Save picture", acts.picture),
      iconButton("about", "About", acts.about),
      iconButton("keys", "Keys", acts.help),
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
