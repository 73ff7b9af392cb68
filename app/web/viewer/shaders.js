/** How the surface is painted: lit like the window's, with isolines of constant width on the screen. */

/** Light is computed at vertices: where the processor draws, that is the cheapest place. */
export const VERTEX_SHADER = `#version 300 es
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;
uniform mat4 view, picture;
uniform float parallel;
uniform vec4 clip;
out float clipAt, valueAt, lightAt, shineAt;
#ifdef LABELS
layout(location = 3) in vec3 labels;
layout(location = 4) in vec3 shares;
flat out vec3 labelsAt;
out vec3 sharesAt;
#endif
const vec3 KEY = normalize(vec3(-0.5, 0.6, 1.0)), FILL = normalize(vec3(0.8, -0.2, 0.7));
void main() {
  vec4 local = view * vec4(place, 1.0);
  gl_Position = picture * local;
  vec3 toEye = parallel > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(-local.xyz), n = mat3(view) * normal;
  // Both sides are lit, and what has no normal as if it faced the eye.
  float agreed = length(n), leaning = dot(n, toEye);
  if (leaning < 0.0) n -= 2.0 * leaning * toEye;
  n = normalize(mix(toEye, n, smoothstep(0.02, 0.2, agreed)));
  lightAt = 0.26 + 0.8 * (0.85 * max(dot(n, KEY), 0.0) + 0.42 * max(dot(n, FILL), 0.0));
  shineAt = 0.05 * pow(max(dot(reflect(-KEY, n), toEye), 0.0), 20.0);
  valueAt = value;
#ifdef LABELS
  labelsAt = labels;
  sharesAt = shares;
#endif
  clipAt = dot(clip, vec4(place, 1.0));
}`;

/** Values go from 0 to 1 over the colours; below -900 they are undefined. */
export const FRAGMENT_SHADER = `#version 300 es
precision highp float;
in float clipAt, valueAt, lightAt, shineAt;
uniform sampler2D colours, levels;
uniform vec3 undefinedColour, backColour, lineColour, sectionColour;
uniform float hasBacks, opacity, lineFirst, lineStep, halfWidth, zeroAt;
uniform int lineCount;
out vec4 colour;
const vec3 INK = vec3(0.08, 0.085, 0.1);

float level(int k) { return lineStep > 0.0 ? lineFirst + float(k) * lineStep : texelFetch(levels, ivec2(k, 0), 0).r; }

int nearestLine() {
  if (lineStep > 0.0) return clamp(int(round((valueAt - lineFirst) / lineStep)), 0, lineCount - 1);
  int above = 0, end = lineCount;
  while (above < end) {
    int middle = (above + end) / 2;
    if (level(middle) < valueAt) above = middle + 1; else end = middle;
  }
  if (above == lineCount || (above > 0 && valueAt - level(above - 1) < level(above) - valueAt)) above--;
  return above;
}

#ifdef LABELS
uniform bool hasLabels;
flat in vec3 labelsAt;
in vec3 sharesAt;

vec3 labelColour(float label) {
  return label < 0.0 ? undefinedColour : texelFetch(colours, ivec2(int(label), 0), 0).rgb;
}

/** Each place in a face has the label with most of its share, blended where another is less than half a pixel away. */
vec3 labelled() {
  mat3 alike;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) alike[i][j] = float(labelsAt[i] == labelsAt[j]);
  vec3 share = alike * sharesAt, shareX = alike * dFdx(sharesAt), shareY = alike * dFdy(sharesAt);
  int most = share.y > share.x ? 1 : 0;
  if (share.z > share[most]) most = 2;
  int next = most;
  float ahead = 0.5;
  for (int k = 0; k < 3; k++) {
    float steep = length(vec2(shareX[most] - shareX[k], shareY[most] - shareY[k]));
    float away = (share[most] - share[k]) / max(steep, 1e-9);
    if (alike[most][k] == 0.0 && away < ahead) {
      ahead = away;
      next = k;
    }
  }
  return mix(labelColour(labelsAt[next]), labelColour(labelsAt[most]), 0.5 + ahead);
}
#endif

float painted(float fromLine, float reach) { return 1.0 - smoothstep(reach - 0.6, reach + 0.6, fromLine); }

void main() {
#ifdef CLIPPED
  if (clipAt < 0.0) discard;
#endif
  float perPixel = length(vec2(dFdx(valueAt), dFdy(valueAt)));
  bool isUndefined = valueAt < -900.0, isBack = hasBacks > 0.5 && !gl_FrontFacing;
  int along = int(0.5 + 255.0 * clamp(valueAt, 0.0, 1.0));
  vec3 shown = isUndefined ? undefinedColour : texelFetch(colours, ivec2(along, 0), 0).rgb;
#ifdef LABELS
  if (hasLabels) shown = labelled();
#endif
  shown = shown * lightAt + shineAt;
  if (isBack) shown = (0.4 + 0.56 * lightAt) * backColour;
  // None where all is of one value but for rounding, nor where the range passes in a few pixels.
  if (lineCount > 0 && !isUndefined && !isBack && perPixel > 5e-7) {
    int k = nearestLine();
    float at = level(k), room = lineStep, fromLine = abs(valueAt - at) / perPixel;
    if (fromLine < halfWidth + 2.0) {
      if (lineStep == 0.0) room = min(k > 0 ? at - level(k - 1) : 1e9, k + 1 < lineCount ? level(k + 1) - at : 1e9);
      bool isSigned = zeroAt >= 0.0, isZero = isSigned && abs(at - zeroAt) < 1e-6;
      float wide = isZero ? 1.1 * halfWidth : halfWidth;
      float seen = (1.0 - smoothstep(0.2, 0.4, perPixel)) * smoothstep(2.0, 4.0, room / perPixel);
      if (isSigned && !isZero) shown = mix(shown, INK, 0.6 * seen * painted(fromLine, wide + 0.8));
      shown = mix(shown, isZero ? INK : lineColour, seen * painted(fromLine, wide));
    }
  }
#ifdef CLIPPED
  float fromCut = clipAt / max(length(vec2(dFdx(clipAt), dFdy(clipAt))), 1e-9);
  shown = mix(shown, sectionColour, painted(fromCut, 2.4 * halfWidth));
#endif
  colour = vec4(shown, opacity);
}`;
