/** The viewer in a notebook: what a page holds comes from a model, with which source and pins go both ways. */
import { inflated, unpackedMesh, unpackedPoints } from "./unpack.js";
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
  const contents = model.get("contents"), scene = model.get("scene");
  const [wasm, mesh] = [await inflated(bytesIn(contents.kernel)), unpackedMesh(await inflated(bytesIn(contents.mesh)))];
  const points = {};
  for (const [name, view] of Object.entries(contents.points))
    points[name] = unpackedPoints(await inflated(bytesIn(view)), mesh);
  const solver = new Solver({ wasm, mesh, scene, points, onprogress: (words) => viewer?.progress(words) });
  const changed = (name) => (value) => (model.set(name, value), model.save_changes());
  const viewer = new Viewer(root, {
    mesh, scene: { ...scene, source: model.get("source"), pins: model.get("pins") }, solver,
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
