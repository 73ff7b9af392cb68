"""Selections on a surface: a rim around them and hatching in them, between whose lines the field can be read."""

from collections.abc import Sequence

import numpy as np

from bihdist_core.arrays import ByteArray

from ..marks.primitives import AreaMark

RIM, CASING = 2.2, 1.1
"""Pixels, at scale 1, that the rim is wide, and the light line along it."""

HATCH, STEP = 1.6, 7.5
"""The same of the lines of the hatching, and of their distance."""

LIGHT = 0.85
"""How much of a light line is seen."""

PAINT_SELECTED = f"""
  float chosen = selectedAt.a;
  float chosenSlope = max(length(vec2(dFdx(chosen), dFdy(chosen))), 1e-6);
  if (chosen > 0.001 && !isBack) {{
    // Halfway between a vertex that is selected and one that is not.
    float fromRim = (chosen - 0.5) / chosenSlope;
    vec3 chosenColour = selectedAt.rgb / chosen;
    float along = mod((gl_FragCoord.x + hatchOrigin.x + gl_FragCoord.y + hatchOrigin.y) * 0.70711, {STEP} * edgeScale);
    float fromHatch = abs(along - {STEP / 2} * edgeScale);
    float halfHatch = {HATCH / 2} * edgeScale, halfRim = {RIM / 2} * edgeScale, casing = {CASING} * edgeScale;
    float within = smoothstep(-0.6, 0.6, fromRim);
    float light = within * (1.0 - smoothstep(halfHatch + casing - 0.6, halfHatch + casing + 0.6, fromHatch));
    light = max(0.3 * light, 1.0 - smoothstep(halfRim + casing - 0.6, halfRim + casing + 0.6, abs(fromRim)));
    fragOutput0.rgb = mix(fragOutput0.rgb, vec3(1.0), {LIGHT} * light);
    float dark = within * (1.0 - smoothstep(halfHatch - 0.6, halfHatch + 0.6, fromHatch));
    dark = max(dark, 1.0 - smoothstep(halfRim - 0.6, halfRim + 0.6, abs(fromRim)));
    fragOutput0.rgb = mix(fragOutput0.rgb, chosenColour, dark);
  }}
"""
"""For a fragment shader, with the attribute `selectedAt` and the uniforms `hatchOrigin`, in pixels, and `edgeScale`."""


def selected_colours(areas: Sequence[AreaMark], count: int) -> ByteArray | None:
    """Return colours (n, 4) uint8 of vertices by the areas they are in, the last on top; None for no areas."""
    colours = np.zeros((count, 4), np.uint8)
    for area in areas:
        inside = area.vertices[area.vertices < count]
        colours[inside] = *(int(area.colour[k : k + 2], 16) for k in (1, 3, 5)), 255
    return colours if colours[:, 3].any() else None
