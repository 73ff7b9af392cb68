// What the viewer's modules make of a question, as JSON: node tests/web/viewer.mjs FOLDER < question > answer
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { tmpdir } from "node:os";

// Copies that node takes for modules.
const folder = mkdtempSync(join(tmpdir(), "viewer-"));
writeFileSync(join(folder, "package.json"), '{"type": "module"}');
for (const name of readdirSync(process.argv[2]).filter((name) => name.endsWith(".js")))
  writeFileSync(join(folder, name), readFileSync(join(process.argv[2], name)));
const use = (name) => import(join(folder, name));

const shapeOf = async ({ vertices, faces = [], components, crease = null, clip = null, cut = null, normals, start, index }) => {
  const { Shape } = await use("shape.js"), [positions, corners] = [vertices.flat(), faces.flat()];
  const ofPoints = normals && {
    normals: Int8Array.from(normals.flat()), start: Int32Array.from(start), index: Int32Array.from(index),
  };
  return new Shape({
    n: vertices.length, m: faces.length, positions: Float64Array.from(positions), faces: Int32Array.from(corners),
    faceComponents: Int32Array.from(components ?? [0, faces.length]), ...ofPoints,
  }, { crease, backs: false, clip, cut });
};

const answers = {
  async numbers({ values }) {
    const { written } = await use("numbers.js");
    return values.map((value) => written(value));
  },
  async ticks({ low, high, most }) {
    const { roundTicks } = await use("numbers.js");
    return roundTicks(low, high, most);
  },
  async levels({ isolines, own, high, signed }) {
    const { isolineLevels } = await use("fields.js");
    return isolineLevels(isolines, { own, high, signed }).values;
  },
  async panel({ panel, fields }) {
    const { panelAnswer } = await use("fields.js");
    const arrays = Object.entries(fields).map(([name, field]) => [name, Float64Array.from(field, (x) => x ?? NaN)]);
    const { values, ...rest } = panelAnswer(panel, Object.fromEntries(arrays));
    return { ...rest, values: Array.from(values, (x) => (Number.isNaN(x) ? null : x)) };
  },
  async address({ hash, ids, choices = 0 }) {
    const { readAddress } = await use("address.js");
    return readAddress(hash, (id) => ids.includes(id), (panels) => panels.every((each) => each.split(":")[0] < choices));
  },
  async written_address({ state }) {
    const { addressOf } = await use("address.js");
    return addressOf(state);
  },
  async hits({ mesh, rays }) {
    const { FaceTree } = await use("picking.js"), shape = await shapeOf(mesh), tree = new FaceTree(shape.met);
    return rays.map(([origin, direction]) => {
      const hit = tree.hit({ origin: shape.inward(origin), direction });
      return hit && { vertex: hit.vertex, point: shape.outward(hit.point) };
    });
  },
  async projected({ mesh, view, aspect, acts }) {
    const { Sight } = await use("sight.js"), shape = await shapeOf(mesh);
    const sight = new Sight(shape, view, [{ x: 0, y: 0, width: 100 * aspect, height: 100 }]);
    for (const [act, ...given] of acts) sight[act](...given);
    const { view: turned, picture } = sight.camera.matrices(aspect), place = (v) => [...shape.place(v), 1];
    const times = (m, x) => [0, 1, 2, 3].map((row) => x.reduce((sum, each, k) => sum + m[4 * k + row] * each, 0));
    return mesh.vertices.map((_, v) => {
      const clip = times(picture, times(turned, place(v))), [x, y] = sight.placed(0, v), hit = sight.hit(0, x, y);
      const drawn = clip.slice(0, 3).map((c) => c / clip[3]);
      return { drawn, placed: [x, y], hit: hit?.vertex ?? null, seen: sight.isSeen(v) };
    });
  },
  async drawn({ mesh }) {
    const { corners, copies, places, normals } = (await shapeOf(mesh)).drawn;
    return { corners: [...corners], copies: [...copies], places: [...places], normals: [...normals] };
  },
  async continued({ mesh, values, none }) {
    const { continued } = await use("splats.js"), { n, drawn } = await shapeOf(mesh);
    const all = new Float32Array(7 * n);
    all.set(values);
    continued(all, n, drawn, none);
    return [...all.subarray(n)];
  },
  async between({ mesh, values, none }) {
    const { putBetween } = await use("cut.js"), { drawn } = await shapeOf(mesh), all = new Float32Array(drawn.places.length / 3);
    all.set(values);
    putBetween(all, drawn.cut, none);
    return [...all.subarray(drawn.cut.first)];
  },
  async cut_away({ mesh, source, pins }) {
    const { cutAwayWords } = await use("marks.js"), shape = await shapeOf(mesh), ids = mesh.vertices.map((_, k) => k);
    return cutAwayWords({ sight: { shape }, mesh: { ids }, source, pins: pins.map((vertex) => ({ vertex })) });
  },
  async labels({ mesh, values }) {
    const { withLabels } = await use("labels.js"), { drawn } = await shapeOf(mesh);
    const found = withLabels(drawn, Float64Array.from(values, (x) => x ?? NaN));
    return Object.fromEntries(Object.entries(found).map(([name, array]) => [name, [...array]]));
  },
  async words({ panel, fields, vertex }) {
    const [{ panelAnswer }, { valueWords }, { barWords }] = [await use("fields.js"), await use("pins.js"), await use("colour_bar.js")];
    const answer = panelAnswer(panel, { [panel.distance]: Float64Array.from(fields, (x) => x ?? NaN) });
    return [...fields.map((_, k) => valueWords(answer, k)), barWords(panel, answer, null).left];
  },
  async outside({ mesh }) {
    const { outside } = await use("shape.js");
    return outside(await shapeOf(mesh));
  },
  // What becomes of questions whose geodesic distance the test answers itself, and the others are answered at once.
  async lanes({ questions, answered }) {
    const workers = [], told = [];
    globalThis.Worker = class {
      constructor() {
        workers.push(this);
      }
      postMessage({ number, names }) {
        this.asked = number;
        for (const name of names ?? []) if (name !== "geodesic") this.onmessage({ data: { number, name, took: 1 } });
      }
      terminate() {
        this.isGone = true;
      }
    };
    const { Solver } = await use("solver.js"), solver = new Solver({ scene: {} });
    const tell = ({ source, fields }) => told.push([source, ...Object.keys(fields)]);
    const outcomes = questions.map(({ vertex, isFinal }) =>
      solver.field(vertex, ["geodesic", "biharmonic"], tell, isFinal),
    );
    for (const k of answered) workers[k].onmessage({ data: { number: workers[k].asked, name: "geodesic", took: 2 } });
    solver.close();
    const resolved = await Promise.all(outcomes);
    return { told, workers: workers.length, resolved: resolved.map((answer) => answer && Object.keys(answer.fields)) };
  },
  async columns({ count, width, height }) {
    return (await use("stage.js")).columnsFor(count, width, height);
  },
  async help() {
    return (await use("keys.js")).HELP;
  },
  async colours({ scene, isDark }) {
    const { coloursOf } = await use("theme.js");
    return coloursOf(scene, { isDark, canvas: "#16181b" });
  },
};

const { question, ...given } = JSON.parse(readFileSync(0, "utf8"));
process.stdout.write(JSON.stringify(await answers[question](given)));
rmSync(folder, { recursive: true });
