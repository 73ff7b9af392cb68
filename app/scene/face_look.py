"""How faces look before light falls on them: whose side they show, and their edges; as pieces of VTK's shaders."""

from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper, vtkShaderProperty

EDGE_WIDTH = 0.8
"""Pixels of an edge of the mesh, at scale 1."""

EDGE_OPACITY = 0.55

CLOSEST, CLEAR = 1.5, 6.0
"""Pixels of a face's least height at which its edges are no longer drawn, and from where on they are drawn in full."""

_POSITION, _COLOUR, _NORMAL = "//VTK::PositionVC::Dec", "//VTK::Color::Impl", "//VTK::Normal::Impl"

_BACK = """//VTK::Color::Impl
  bool isBack = hasBacks > 0.5 && !gl_FrontFacing;
  if (isBack) {
    ambientColor = max(ambientIntensity, 0.55) * backColour;
    diffuseColor = min(diffuseIntensity, 0.45) * backColour;
  }
"""

# Of what has colours of its own instead of a field; elsewhere it stays as it is.
_CARRIED = """//VTK::Color::Impl
  ambientColor = (1.0 - coloursAt.a) * ambientColor + ambientIntensity * coloursAt.rgb;
  diffuseColor = (1.0 - coloursAt.a) * diffuseColor + diffuseIntensity * coloursAt.rgb;
"""

# Each corner has a label, and each place in the face that with most of the weight, which is in the colours: borders go
# straight from one side to another, and meet in a face with three.
_LABELS = """//VTK::Color::Impl
  vec4 own[3];
  vec3 weight;
  for (int i = 0; i < 3; i++) {
    vec4 of = coloursOf[i];
    weight[i] = max(abs(of.a), 1e-6);
    // Means of labels and none, in a stand-in, may be of neither.
    own[i] = of.a > max(max(of.r, of.g), of.b) - 1e-3 ? of / weight[i] : vec4(0.0);
  }
  mat3 alike;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) alike[i][j] = distance(own[i], own[j]) < 1e-3 ? weight[i] : 0.0;
  vec3 share = alike * cornersAt, shareX = alike * dFdx(cornersAt), shareY = alike * dFdy(cornersAt);
  int most = share.y > share.x ? 1 : 0;
  if (share.z > share[most]) most = 2;
  int next = most;
  float ahead = 0.5;  // pixels to a border, where it is near
  for (int k = 0; k < 3; k++) {
    vec2 steep = vec2(shareX[most] - shareX[k], shareY[most] - shareY[k]);
    float away = (share[most] - share[k]) / max(length(steep), 1e-9);
    if (alike[most][k] == 0.0 && away < ahead) {
      ahead = away;
      next = k;
    }
  }
  vec4 coloursAt = mix(own[next], own[most], 0.5 + ahead);
"""

# Greys under isolines.  The field's own colour is kept for these.
_BASE = """//VTK::Color::Impl
  vec3 fieldColour = ambientColor / max(ambientIntensity, 1e-3);
  float grey = baseIsOfTwo > 0.5 ? (baseAt - 0.5) / max(fwidth(baseAt), 1e-9) + 0.5 : baseAt;
  vec3 baseColour = mix(baseLight, baseDark, clamp(grey, 0.0, 1.0));
  ambientColor = ambientIntensity * baseColour;
  diffuseColor = diffuseIntensity * baseColour;
"""

# Where vertices' normals lean away from the eye although their face is seen, at silhouettes and on rough scans, light
# from the eye's side would miss it, and leave a dark speck.
_TOWARDS_THE_EYE = """//VTK::Normal::Impl
  vec3 toEye = cameraParallel != 0 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);
  float leaning = dot(normalVCVSOutput, toEye);
  if (leaning < 0.0) normalVCVSOutput -= 2.0 * leaning * toEye;
"""

# VTK's own geometry shader has the sides of the face as lines in the picture.  From their directions and the distances
# to them follow the heights of the face: a closed mesh far away is not to become a blot.
_EDGES = f"""
  vec3 along = vec3(edgeEqn[0].x, edgeEqn[1].x, edgeEqn[2].x), up = vec3(edgeEqn[0].y, edgeEqn[1].y, edgeEqn[2].y);
  vec3 offset = vec3(edgeEqn[0].w, edgeEqn[1].w, edgeEqn[2].w);
  vec3 fromSide = max(along * gl_FragCoord.x + up * gl_FragCoord.y + offset, 0.0);
  vec3 sines = max(abs(along.yzx * up.zxy - up.yzx * along.zxy), 1e-4);
  float across = dot(fromSide, sines) / (sines.x * sines.y * sines.z);
  float least = across * min(min(sines.y * sines.z, sines.z * sines.x), sines.x * sines.y) / edgeScale;
  float nearest = min(min(fromSide.x, fromSide.y), fromSide.z);
  float halfEdge = {EDGE_WIDTH / 2} * edgeScale;
  float edge = 1.0 - smoothstep(halfEdge - 0.5, halfEdge + 0.5, nearest);
  edge *= {EDGE_OPACITY} * smoothstep({CLOSEST}, {CLEAR}, least);
  float lightness = dot(ambientColor / max(ambientIntensity, 1e-3), vec3(0.2126, 0.7152, 0.0722));
  vec3 wire = mix(edgeOnDark, edgeColour, smoothstep(0.10, 0.22, lightness));
  ambientColor = mix(ambientColor, wire, edge);
  diffuseColor = mix(diffuseColor, vec3(0.0), edge);
"""


def map_attribute(mapper: vtkPolyDataMapper, attribute: str, array: str) -> None:
    """Hand an array of the points to the vertex shader under a name."""
    mapper.MapDataArrayToVertexAttribute(attribute, array, vtkDataObject.FIELD_ASSOCIATION_POINTS, -1)


def put_face_look(
    shader: vtkShaderProperty,
    has_edges: bool,
    has_colours: bool = False,
    has_base: bool = False,
    has_labels: bool = False,
) -> None:
    """Add the look of faces to a shader.

    Its uniforms are `hasBacks`, `backColour`, `edgeColour`, `edgeOnDark` and `edgeScale`, with a base also `baseLight`,
    `baseDark` and `baseIsOfTwo`.

    Parameters
    ----------
    has_edges
        Whether edges are drawn; the property needs EdgeVisibilityOn, and EdgeOpacity 0 to hide VTK's own edges.
    has_colours
        Whether there is an attribute `coloursAt`, of colours multiplied by alpha; with `has_labels`, `coloursOf` three
        corners, multiplied by a weight and with alpha -1 for none, and the shares of these, `cornersAt`.
    has_base
        Whether there is an attribute `baseAt`, of shares from light to dark; then `fieldColour` is that of the field.
    """
    pieces = [_BASE] * has_base + [_LABELS] * has_labels + [_CARRIED] * has_colours + [_BACK]
    own = f"{_COLOUR}\n" + "".join(piece.removeprefix(f"{_COLOUR}\n") for piece in pieces)
    shader.AddFragmentShaderReplacement(_COLOUR, True, own, False)
    shader.AddFragmentShaderReplacement(_NORMAL, False, _TOWARDS_THE_EYE + (_EDGES if has_edges else ""), False)


def pass_on(shader: vtkShaderProperty, *attributes: tuple[str, str, str]) -> None:
    """Hand vertex attributes to the fragment shader, also past a geometry shader, in one call, as the last one counts.

    Each attribute comes with its name there and its type in GLSL.  Of "corners vec4" the fragment shader has the values
    at the three corners of the face, and the weights `cornersAt` of these: that needs a geometry shader.  VTK renames
    what ends in VSOut where there is one.
    """
    lines: dict[str, list[str]] = {part: [] for part in ("vertex", "set", "geometry", "copy", "fragment")}
    for attribute, name, kind in attributes:
        has_corners, kind = kind.startswith("corners "), kind.removeprefix("corners ")
        lines["vertex"].append(f"in {kind} {attribute};\nout {kind} {name}VSOut;")
        lines["set"].append(f"{name}VSOut = {attribute};")
        if has_corners:
            lines["geometry"].append(
                f"in {kind} {name}VSOut[];\nflat out {kind} {name}GSOut[3];\nout vec3 cornersGSOut;"
            )
            lines["copy"].append(f"for (int k = 0; k < 3; k++) {name}GSOut[k] = {name}VSOut[k];")
            lines["copy"].append("cornersGSOut = vec3(i == 0, i == 1, i == 2);")
            lines["fragment"].append(f"flat in {kind} {name}VSOut[3];\nin vec3 cornersVSOut;")
            lines["fragment"].append(f"#define {name} {name}VSOut\n#define cornersAt cornersVSOut")
        else:
            lines["geometry"].append(f"in {kind} {name}VSOut[];\nout {kind} {name}GSOut;")
            lines["copy"].append(f"{name}GSOut = {name}VSOut[i];")
            lines["fragment"].append(f"in {kind} {name}VSOut;\n#define {name} {name}VSOut")
    for put, place, part in (
        (shader.AddVertexShaderReplacement, _POSITION, "vertex"),
        (shader.AddVertexShaderReplacement, "//VTK::PositionVC::Impl", "set"),
        (shader.AddGeometryShaderReplacement, "//VTK::Output::Dec", "geometry"),
        (shader.AddGeometryShaderReplacement, "//VTK::Clip::Impl", "copy"),
        (shader.AddFragmentShaderReplacement, _POSITION, "fragment"),
    ):
        put(place, True, "\n".join([place, *lines[part], ""]), False)
