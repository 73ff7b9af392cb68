/** What leaves the page: a picture as a file, a link on the clipboard. */
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

/** @returns {Promise<string>} where the link is now */
export async function copyLink() {
  try {
    await navigator.clipboard.writeText(location.href);
    return "The link is copied.";
  } catch {
    return "The link is in the address bar.";
  }
}
