/** The page: what it holds is read from its elements and handed to the viewer. */
import { inflated, unpackedMesh, unpackedPoints } from "./unpack.js";
import { Solver } from "./solver.js";
import { Viewer } from "./viewer.js";
import { lacking } from "./support.js";

const held = (id) => document.getElementById(id)?.textContent ?? "";

async function main() {
  const root = document.querySelector(".bihdist");
  const lack = lacking();
  if (lack) throw new Error(lack);
  const scene = JSON.parse(held("scene"));
  document.title = scene.title;
  const [wasm, mesh] = [await inflated(held("kernel")), unpackedMesh(await inflated(held("mesh")))];
  const points = {};
  for (const { id, textContent } of document.querySelectorAll("[id^=points-]"))
    points[id.slice("points-".length)] = unpackedPoints(await inflated(textContent), mesh);
  const solver = new Solver({ wasm, mesh, scene, points, onprogress: (words) => root.viewer.progress(words) });
  root.viewer = new Viewer(root, { mesh, scene, solver, hasAddress: true });
}

main().catch((error) => {
  const sentence = document.createElement("p");
  sentence.className = "notice";
  sentence.setAttribute("role", "alert");
  sentence.textContent = error.message;
  document.querySelector(".bihdist").replaceChildren(sentence);
});
