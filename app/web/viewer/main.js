/** The page: what it holds is read from its elements and handed to the viewer. */
import { element } from "./elements.js";
import { unpackedContents } from "./unpack.js";
import { Solver } from "./solver.js";
import { Viewer } from "./viewer.js";
import { lacking } from "./support.js";
import { isFramed, followQuery, followParent, tellParent } from "./embedding.js";

async function main() {
  const root = document.querySelector(".bihdist");
  followQuery(root);
  showNotice("Preparing the surface…");
  const lack = lacking();
  if (lack) throw new Error(lack);
  const scene = JSON.parse(document.getElementById("scene").textContent);
  document.title = scene.title;
  const packed = [...document.querySelectorAll("script[type='text/plain']")].map((each) => [each.id, each.textContent]);
  const contents = await unpackedContents(Object.fromEntries(packed), scene);
  const solver = new Solver({ ...contents, scene, onprogress: (words) => root.viewer.progress(words) });
  root.viewer = new Viewer(root, {
    mesh: contents.mesh,
    scene,
    solver,
    isEmbedded: isFramed(),
    hasAddress: /^(https?|file):$/.test(location.protocol),
    onsource: (id) => tellParent("pick", id),
  });
  if (root.viewer.sight) followParent(root.viewer);
}

function showNotice(words, role = "status") {
  document.querySelector(".bihdist").replaceChildren(element("p", { class: "notice", role, text: words }));
}

main().catch((error) => showNotice(error.message, "alert"));
