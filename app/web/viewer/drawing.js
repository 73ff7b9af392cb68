/** The surface in WebGL: one context for all panels, drawn when asked. */
import { outside } from "./shape.js";
import { withLabels } from "./labels.js";
import { continued } from "./splats.js";
import { putBetween } from "./cut.js";
import { VERTEX_SHADER, FRAGMENT_SHADER } from "./shaders.js";

const UNDEFINED = -1000, MOST_PIXELS = 2 ** 24;

export class Drawing {
  /** Throws an Error with a sentence where the browser cannot draw. */
  constructor(canvas, shape, panels, hasLabels) {
    this.canvas = canvas;
    this.hasLabels = hasLabels;
    this.shape = shape;
    this.isSoftware = isSoftware();
    const gl = (this.gl = canvas.getContext("webgl2", { antialias: !this.isSoftware, alpha: false }));
    if (!gl)
      throw new Error(
        "This browser has no WebGL 2, which draws the surface. Switch on hardware acceleration, or try another.",
      );
    this.#prepare(panels);
  }

  /** All that the graphics hold; anew where they were lost. */
  #prepare(panels) {
    const { gl, shape } = this;
    const program = linked(gl, { CLIPPED: shape.clip !== null, LABELS: this.hasLabels });
    gl.useProgram(program);
    this.at = new Proxy({}, { get: (known, name) => (known[name] ??= gl.getUniformLocation(program, name)) });
    gl.uniform1i(this.at.levels, 1);
    gl.uniform1f(this.at.opacity, shape.opacity);
    // As much of the ground shows through; the picture itself is opaque.
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);
    gl.uniform4fv(this.at.clip, shape.clip ?? [0, 0, 0, 1]);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.SCISSOR_TEST);
    // What is behind a closed surface costs as much as the rest.
    const side = this.isSoftware && !shape.clip && shape.opacity === 1 ? outside(shape) : 0;
    gl.cullFace(side < 0 ? gl.FRONT : gl.BACK);
    if (side) gl.enable(gl.CULL_FACE);
    const { places, normals, corners: drawn } = shape.drawn;
    const shared = [buffered(gl, gl.ARRAY_BUFFER, places), buffered(gl, gl.ARRAY_BUFFER, normals)];
    const corners = buffered(gl, gl.ELEMENT_ARRAY_BUFFER, drawn);
    this.panels = Array.from({ length: panels }, () => {
      const values = buffered(gl, gl.ARRAY_BUFFER, new Float32Array(places.length / 3).fill(UNDEFINED));
      return {
        held: vertexArray(gl, [...shared, values], corners),
        labels: null,
        values,
        colours: gl.createTexture(),
        levels: gl.createTexture(),
        lines: { first: 0, step: 0, count: 0 },
        zero: -1,
      };
    });
  }

  restore() {
    this.#prepare(this.panels.length);
  }

  /** Colours (256 of r, g, b from 0 to 255) of a panel. */
  setColours(panel, map) {
    const { gl } = this, bytes = Uint8Array.from(map.flat());
    gl.bindTexture(gl.TEXTURE_2D, this.panels[panel].colours);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, map.length, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, bytes);
    sampled(gl);
  }

  /** Values of a panel, see `panelAnswer`, and its isolines, see `isolineLevels`. */
  setAnswer(panel, { values, low, high, signed, labels }, { values: levels, step }) {
    const { gl } = this, held = this.panels[panel], scale = high > low ? 1 / (high - low) : 0;
    if (!labels) held.labels = null;
    else if (held.labels?.values !== values) held.labels = { values, held: this.#labelled(values) };
    const { drawn, isOfPoints } = this.shape, { copies, cut } = drawn, shares = new Float32Array(values.length + copies.length);
    const share = (value) => (value === value ? (value - low) * scale : UNDEFINED);
    for (let k = 0; k < values.length; k++) shares[k] = share(values[k]);
    if (isOfPoints) continued(shares, values.length, drawn, UNDEFINED);
    else for (let k = 0; k < copies.length; k++) shares[values.length + k] = shares[copies[k]];
    if (cut) putBetween(shares, cut, UNDEFINED);
    gl.bindBuffer(gl.ARRAY_BUFFER, held.values);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, shares);
    const at = Float32Array.from(levels, (value) => (value - low) * scale);
    held.lines = { first: at[0] ?? 0, step: step * scale, count: at.length };
    held.zero = signed ? -low * scale : -1;
    gl.bindTexture(gl.TEXTURE_2D, held.levels);
    gl.texImage2D(
      gl.TEXTURE_2D,
      0,
      gl.R32F,
      Math.max(at.length, 1),
      1,
      0,
      gl.RED,
      gl.FLOAT,
      at.length ? at : new Float32Array(1),
    );
    sampled(gl);
  }

  /** The faces with their labels, see `withLabels`. */
  #labelled(values) {
    const { gl } = this, { places, normals, labels, shares, corners } = withLabels(this.shape.drawn, values);
    const none = new Float32Array(places.length / 3).fill(UNDEFINED);
    const buffers = [places, normals, none, labels, shares].map((each) => buffered(gl, gl.ARRAY_BUFFER, each));
    return vertexArray(gl, buffers, buffered(gl, gl.ELEMENT_ARRAY_BUFFER, corners));
  }

  /** Let the picture have this size in CSS pixels. @returns {number} pixels of the screen for each, at most `wanted` */
  resize(width, height, wanted) {
    const { gl } = this, [widest, highest] = gl.getParameter(gl.MAX_VIEWPORT_DIMS);
    const most = Math.min(widest / width, highest / height, Math.sqrt(MOST_PIXELS / (width * height)));
    const scale = Math.min(wanted, most);
    this.canvas.width = Math.max(Math.round(width * scale), 1);
    this.canvas.height = Math.max(Math.round(height * scale), 1);
    return scale;
  }

  /**
   * Draw all panels.
   * @param {{x, y, width, height}[]} boxes of the views, in CSS pixels from the upper left
   * @param {{background: number[], undefined: number[], back: number[], line: number[], section: number[],
   *   width: number}} look colours from 0 to 1
   */
  draw(camera, boxes, scale, look) {
    const { gl, at, canvas } = this;
    gl.scissor(0, 0, canvas.width, canvas.height);
    gl.clearColor(...look.background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniform3fv(at.undefinedColour, look.undefined);
    gl.uniform3fv(at.backColour, look.back);
    gl.uniform1f(at.hasBacks, Number(this.shape.hasBacks));
    gl.uniform3fv(at.lineColour, look.line);
    gl.uniform3fv(at.sectionColour, look.section);
    gl.uniform1f(at.halfWidth, Math.max(look.width * scale, 1) / 2);
    gl.uniform1f(at.parallel, Number(camera.parallel));
    for (const [k, { x, y, width, height }] of boxes.entries()) {
      const panel = this.panels[k],
        box = [x, canvas.height / scale - y - height, width, height].map((v) => Math.round(v * scale));
      if (!(width > 0 && height > 0)) continue;
      const { view, picture } = camera.matrices(width / height);
      gl.viewport(...box);
      gl.scissor(...box);
      gl.uniformMatrix4fv(at.view, false, view);
      gl.uniformMatrix4fv(at.picture, false, picture);
      gl.uniform1f(at.lineFirst, panel.lines.first);
      gl.uniform1f(at.lineStep, panel.lines.step);
      gl.uniform1i(at.lineCount, panel.lines.count);
      gl.uniform1f(at.zeroAt, panel.zero);
      gl.activeTexture(gl.TEXTURE1);
      gl.bindTexture(gl.TEXTURE_2D, panel.levels);
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, panel.colours);
      gl.uniform1i(at.hasLabels, Number(panel.labels !== null));
      gl.bindVertexArray((panel.labels ?? panel).held);
      if (this.shape.opacity < 1) this.#drawLayers();
      else this.#drawFaces();
    }
    gl.bindVertexArray(null);
  }

  #drawFaces() {
    this.gl.drawElements(this.gl.TRIANGLES, this.shape.drawn.corners.length, this.gl.UNSIGNED_INT, 0);
  }

  /** The nearest back faces, and before them the nearest front faces; each where it is nearest, which is found first. */
  #drawLayers() {
    const { gl } = this;
    gl.enable(gl.CULL_FACE);
    gl.depthFunc(gl.LEQUAL);
    for (const hidden of [gl.FRONT, gl.BACK]) {
      gl.cullFace(hidden);
      gl.clear(gl.DEPTH_BUFFER_BIT);
      gl.colorMask(false, false, false, false);
      this.#drawFaces();
      gl.colorMask(true, true, true, true);
      gl.enable(gl.BLEND);
      this.#drawFaces();
      gl.disable(gl.BLEND);
    }
  }

  destroy() {
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }
}

function buffered(gl, kind, data) {
  const made = gl.createBuffer();
  gl.bindBuffer(kind, made);
  gl.bufferData(kind, data, gl.STATIC_DRAW);
  return made;
}

const SIZES = [3, 3, 1, 3, 3];

/** Buffers of attributes, in the order of their places in the shader, and of faces. */
function vertexArray(gl, buffers, corners) {
  const made = gl.createVertexArray();
  gl.bindVertexArray(made);
  for (const [k, buffer] of buffers.entries()) {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(k);
    gl.vertexAttribPointer(k, SIZES[k], gl.FLOAT, false, 0, 0);
  }
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, corners);
  gl.bindVertexArray(null);
  return made;
}

function sampled(gl) {
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
}

function linked(gl, defined) {
  const program = gl.createProgram(), names = Object.keys(defined).filter((name) => defined[name]);
  const head = names.map((name) => `\n#define ${name}`).join("");
  for (const [kind, text] of [
    [gl.VERTEX_SHADER, VERTEX_SHADER],
    [gl.FRAGMENT_SHADER, FRAGMENT_SHADER],
  ]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text.replace("\n", `${head}\n`));
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error("The graphics driver refused the program that draws the surface; try another browser.");
  }
  return program;
}

/** Whether the processor draws: multisampling would then cost three times as much. */
function isSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2"),
    named = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl?.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : gl.RENDERER) ?? "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
