/** The page: what it holds is read from its elements and handed to the viewer. */
import { unpackedContents } from "./unpack.js";
import { Solver } from "./solver.js";
import { Viewer } from "./viewer.js";
import { lacking } from "./support.js";

async function main() {
  const root = document.querySelector(".bihdist");
  const lack = lacking();
  if (lack) throw new Error(lack);
  const scene = JSON.parse(document.getElementById("scene").textContent);
  document.title = scene.title;
  const packed = [...document.querySelectorAll("script[type='text/plain']")].map((each) => [each.id, each.textContent]);
  const contents = await unpackedContents(Object.fromEntries(packed), scene);
  const solver = new Solver({ ...contents, scene, onprogress: (words) => root.viewer.progress(words) });
  root.viewer = new Viewer(root, { mesh: contents.mesh, scene, solver, hasAddress: true });
}

main().catch((error) => {
  const sentence = document.createElement("p");
  sentence.className = "notice";
  sentence.setAttribute("role", "alert");
  sentence.textContent = error.message;
  document.querySelector(".bihdist").replaceChildren(sentence);
});
