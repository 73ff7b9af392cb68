/** What leaves the page: a picture as a file, texts on the clipboard. */
import { element } from "./elements.js";

/** @param {HTMLCanvasElement} canvas @param {string} title of the page, of which the file's name is made */
export function savePicture(canvas, title) {
  const name = title.replace(/[^\p{L}\p{N} ._-]+/gu, "_").slice(0, 80);
  canvas.toBlob((blob) => {
    const link = element("a", { href: URL.createObjectURL(blob), download: `${name || "picture"}.png` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
}

/** Put a text on the clipboard. @returns {Promise<boolean>} whether the browser let the page do that */
export async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/** A text with a button that copies it, or selects it where the browser does not let the page copy. */
export function copyBox(label, text) {
  const box = element("textarea", { readonly: true, rows: 3, "aria-label": label });
  const said = element("span", { role: "status", class: "quiet" });
  const copy = async () => {
    box.select();
    said.textContent = (await copied(text)) ? "Copied." : "Selected; copy it with Ctrl+C.";
  };
  box.value = text;
  const button = element("button", { type: "button", class: "plain", text: "Copy", click: copy });
  return element("div", { class: "copied" }, box, button, said);
}
