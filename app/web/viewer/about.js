/** What the page is: a box with the mesh, how exact it is, and notes. */
import { element, dialog } from "./elements.js";
import { counted, written } from "./numbers.js";
import { HELP } from "./keys.js";

const facts = (rows) =>
  element("dl", {}, ...rows.flatMap(([name, text]) => [element("dt", { text: name }), element("dd", { text })]));

export function aboutBox({ mesh, panels, areas, notes }) {
  const kept = mesh.bits === "float32" ? "single precision" : `${mesh.bits} bits of each coordinate`;
  const differs = Object.entries(mesh.differs ?? {}).map(([name, x]) => `${name} ${written(x)}`);
  return dialog(
    "What this page is",
    element("p", {
      text: "Distances on a surface, computed here, in this page, anew for each source. Nothing is asked of any server.",
    }),
    facts([
      ["Mesh", mesh.name],
      ["Vertices", counted(mesh.vertices)],
      ["Faces", counted(mesh.faces)],
      ["Stored with", kept],
      ...(differs.length ? [["Differs from the original, of the maximum", differs.join(", ")]] : []),
      ["Areas", areas === "voronoi" ? "Voronoi" : "barycentric"],
      ["Units", [...new Set(panels.map((panel) => `${panel.label}: ${panel.unit || "none"}`))].join("; ")],
    ]),
    ...notes.map((text) => element("p", { text })),
  );
}

export const helpBox = () => dialog("Mouse, fingers and keys", facts(HELP));
