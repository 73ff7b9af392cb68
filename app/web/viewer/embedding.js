/** The page inside another one: what its address asks for, and messages between the two. */

export const isFramed = () => window.parent !== window;

/** Follow the address's query: ?controls=0 hides the tool bar, ?theme=light or ?theme=dark overrides the system's. */
export function followQuery(root) {
  const query = new URLSearchParams(location.search), theme = query.get("theme");
  root.classList.toggle("without-controls", query.get("controls") === "0");
  if (theme !== "light" && theme !== "dark") return;
  for (const rule of document.styleSheets[0].cssRules)
    if (rule.media?.mediaText.includes("prefers-color-scheme"))
      rule.media.mediaText = theme === "dark" ? "all" : "not all";
}

/**
 * Tell the page around this one of a vertex. Any page may know it, whatever its origin: it is nothing but a number.
 * @param {"ready" | "pick"} event
 */
export function tellParent(event, source) {
  if (isFramed()) window.parent.postMessage({ bihdist: { event, source } }, "*");
}

/** Let the page around this one, and no other, set the source by { bihdist: { source: 12 } }. */
export function followParent(viewer) {
  window.addEventListener("message", ({ source, data }) => {
    if (isFramed() && source === window.parent && Number.isInteger(data?.bihdist?.source))
      viewer.setSource(data.bihdist.source);
  });
  tellParent("ready", viewer.mesh.ids[viewer.source]);
}
