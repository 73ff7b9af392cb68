/** The viewer in a notebook: what a page holds comes from a model, with which source and pins go both ways. */
import { unpackedContents } from "./unpack.js";
import { Solver } from "./solver.js";
import { Viewer } from "./viewer.js";
import { lacking } from "./support.js";

const bytesIn = (view) => new Uint8Array(view.buffer, view.byteOffset, view.byteLength);

/** Called by anywidget for each place where the widget is shown; what it returns is called when it is gone. */
async function render({ model, el }) {
  const root = document.createElement("div"), lack = lacking();
  root.className = "bihdist";
  el.append(root);
  if (lack) return void (root.textContent = lack);
  const scene = model.get("scene"), packed = Object.entries(model.get("contents"));
  const contents = await unpackedContents(Object.fromEntries(packed.map(([name, view]) => [name, bytesIn(view)])), scene);
  const solver = new Solver({ ...contents, scene, onprogress: (words) => viewer?.progress(words) });
  const changed = (name) => (value) => (model.set(name, value), model.save_changes());
  const viewer = root.viewer = new Viewer(root, {
    mesh: contents.mesh, scene: { ...scene, source: model.get("source"), pins: model.get("pins") }, solver,
    isEmbedded: true,
    onsource: (id) => (changed("source")(id), model.send({ picked: id })), onpins: changed("pins"),
  });
  const followed = {
    "change:source": () => viewer.setSource(model.get("source")),
    "change:pins": () => viewer.setPins(model.get("pins")),
  };
  for (const [event, follow] of Object.entries(followed)) model.on(event, follow);
  return () => {
    for (const [event, follow] of Object.entries(followed)) model.off(event, follow);
    viewer.destroy();
    solver.close();
  };
}
