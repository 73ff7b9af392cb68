/** What the page is: a box with the mesh, how exact it is, notes, who made it, and how to embed it. */
import { element, dialog } from "./elements.js";
import { counted, written } from "./numbers.js";
import { HELP } from "./keys.js";
import { copyBox } from "./saving.js";

const PAPER = "Lipman, Rustamov and Funkhouser: Biharmonic Distance. ACM Transactions on Graphics 29 (3), 2010. ";
const DOI = "10.1145/1805964.1805971";

const facts = (rows) =>
  element("dl", {}, ...rows.flatMap(([name, content]) => [element("dt", { text: name }), element("dd", {}, content)]));

/** The HTML that puts the page into another one. */
function embedCode({ embed }) {
  const { protocol, origin, pathname } = location;
  const src = protocol === "file:" ? pathname.split("/").pop() : origin + pathname;
  return embed.replace("PAGE", () => src.replace(/&/g, "&amp;"));
}

export function aboutBox(scene, hasAddress) {
  const { mesh, panels, areas, notes, credit, version } = scene;
  const doi = element("a", { href: `https://doi.org/${DOI}`, target: "_blank", rel: "noopener", text: `doi:${DOI}` });
  const coordinates = mesh.bits === "float32" ? "single precision" : `${mesh.bits} bits of each coordinate`;
  const kept = coordinates + (mesh.operator ? ", the operator in single precision" : "");
  const differs = Object.entries(mesh.differs ?? {}).map(([name, x]) => `${name} ${written(x)}`);
  const compared = `Differs from the original, from ${mesh.sources} sources, of the maximum`;
  return dialog(
    "What this page is",
    element("p", {
      text: `Distances ${mesh.counts.tetrahedra ? "through a solid" : "on a surface"}, computed in this page each time the source moves, without a server.`,
    }),
    facts([
      ["Mesh", mesh.name],
      ...Object.entries(mesh.counts).map(([name, count]) => [name[0].toUpperCase() + name.slice(1), counted(count)]),
      ["Stored with", kept],
      ...(differs.length ? [[compared, differs.join(", ")]] : []),
      mesh.operator ? ["Operator", mesh.operator] : ["Areas", areas === "voronoi" ? "Voronoi" : "barycentric"],
      ["Units", [...new Set(panels.map((panel) => `${panel.label}: ${panel.unit || "none"}`))].join("; ")],
    ]),
    ...notes.map((text) => element("p", { text })),
    facts([
      ...(credit ? [["Credit", credit]] : []),
      ["Made with", `bihdist ${version}`],
      ["Paper", element("span", {}, PAPER, doi)],
    ]),
    ...(hasAddress ? [element("h2", { text: "Embed this page" }), copyBox("HTML to embed", embedCode(scene))] : []),
    element("h2", { text: "Cite" }),
    copyBox("BibTeX to cite the paper and the program", scene.cite),
  );
}

export const helpBox = () => dialog("Mouse, fingers and keys", facts(HELP));
