"""A surface coloured by a field, with isolines painted by the fragment shader.

The field crosses the surface as a vertex attribute, and a fragment is painted where it is within half a line's width
of a value that has a line, measured in pixels.  Lines so drawn have the same width everywhere and cost no geometry.
"""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

from bihdist_core.analysis.label_borders import label_weights
from bihdist_core.arrays import AnyArray, ByteArray, FloatArray, IntArray

from ..document.looks import MOST_ISOLINES, NO_LINES, TWENTY_STEPS, Isolines, Shading
from ..drawing.glyphs import SECTION
from ..session.base import Greys
from .clipping import ClipPlane, Cut
from .drawable import copies_of, has_backs, vertex_faces, with_cut
from .face_look import map_attribute, pass_on, put_face_look
from .levels import BOLD, ZERO, Levels, levels, too_many
from .selected import PAINT_SELECTED
from .splats import at_corners
from .stand_in import StandInActor
from .style import CASING, RIM, IsolineInk, Style

UNDEFINED = -1000.0
"""Stands for NaN in the scalars: shares are never negative, and the shader needs a number.  As far from them as VTK
allows, so that a face with an undefined corner is undefined up to the others, without a seam of other colours."""

FINE = 8192
"""Colours of a table with bands, so that each ends where its isoline is."""

TINTS = {
    "selected": ("selectedAt", "vec4"), "colours": ("coloursAt", "vec4"), "labels": ("coloursOf", "corners vec4"),
    "base": ("baseAt", "float"), "light": ("lightAt", "float"),
}  # fmt: skip
"""Colours of vertices besides those of the field, each with an attribute of the shader: its name there and its type.
Those of labels are there for all corners of a face, as between two there is no third; the base has shares of greys, and
light is a share of the colours."""

_STAY = {"selected", "base", "light"}
"""Those that are there with any field."""

OCCLUSION = 0.7
"""The fraction of its colours that a vertex loses where no light arrives."""

_DARKEN = f"  fragOutput0.rgb *= {1 - OCCLUSION:.2f} + {OCCLUSION:.2f} * lightAt;\n"

_LIT = "//VTK::Light::Impl"

# Light from behind, where the surface turns away: form is seen in dark colours, too.
_RIM = "  fragOutput0.rgb += {} * pow(1.0 - clamp(normalVCVSOutput.z, 0.0, 1.0), 3.0);\n"

MOST_PEELS = 8
"""Each of them has two layers of what is translucent, the nearest and the farthest that are left."""

MOST_LINES = 2 * MOST_ISOLINES + 64
"""Lines that the shader has room for: on both sides of 0, and through points."""

# Values are in order.  Of the two lines nearest in value, one below and one above, the wider is painted last.
_PAINT = """
  float perPixel = length(vec2(dFdx(isolineValue), dFdy(isolineValue)));
  int above = 0, end = isolineCount;
  while (above < end) {
    int middle = (above + end) / 2;
    if (isolineAt[middle] < isolineValue) above = middle + 1;
    else end = middle;
  }
  // None where all is of one value but for rounding, where the range passes in a few pixels, or where it is undefined.
  float drawn = perPixel > 5e-7 && isolineValue > -900.0 && !isBack ? 1.0 - smoothstep(0.2, 0.4, perPixel) : 0.0;
  for (int pass = 0; pass < 2; pass++) {
    for (int k = max(above - 1, 0); k < min(above + 1, isolineCount); k++) {
      bool isThrough = isolineKind[k] > 1.5;
      if (isThrough != (pass == 1)) continue;
      float halfWidth = isolineHalfWidth * (isolineKind[k] > 0.5 ? BOLD : isolineKind[k] > 0.25 ? ZERO : 1.0);
      float fromLine = abs(isolineValue - isolineAt[k]) / max(perPixel, 1e-12);
      float paint = drawn * (1.0 - smoothstep(halfWidth - 0.6, halfWidth + 0.6, fromLine));
      if (isThrough) {
        float rim = halfWidth + isolineCasing;
        float under = drawn * (1.0 - smoothstep(rim - 0.6, rim + 0.6, fromLine));
        fragOutput0.rgb = mix(fragOutput0.rgb, isolineCasingColour, under);
        fragOutput0.rgb = mix(fragOutput0.rgb, isolineThroughColour, paint);
        continue;
      }
      // Lines fade where they would merge; bold ones stay longer.
      float room = 1e9;
      if (k > 0) room = min(room, isolineAt[k] - isolineAt[k - 1]);
      if (k + 1 < isolineCount) room = min(room, isolineAt[k + 1] - isolineAt[k]);
      float least = isolineKind[k] > 0.5 ? 0.4 : 2.0;
      float fade = smoothstep(least, 2.0 * least, room / max(perPixel, 1e-12));
      paint *= fade;
      bool isZero = isolineSigned > 0.5 && abs(2.0 * isolineAt[k] - 1.0) < 1e-6;
      if (!isZero) {
        float rim = halfWidth + isolineRimWidth;
        float under = drawn * fade * (1.0 - smoothstep(rim - 0.6, rim + 0.6, fromLine));
        fragOutput0.rgb = mix(fragOutput0.rgb, isolineRimColour, isolineRimOpacity * under);
      }
      fragOutput0.rgb = mix(fragOutput0.rgb, isZero ? isolineZeroColour : ISOLINE, paint);
    }
  }
""".replace("BOLD", str(BOLD)).replace("ZERO", str(ZERO))


# Where the surface is cut: VTK has thrown away what is beyond the plane.
_PAINT_SECTION = """
  float fromCut = clipDistancesVSOutput[0];
  float cutPerPixel = max(length(vec2(dFdx(fromCut), dFdy(fromCut))), 1e-12);
  float section = 1.0 - smoothstep(sectionWidth - 0.6, sectionWidth + 0.6, fromCut / cutPerPixel);
  fragOutput0.rgb = mix(fragOutput0.rgb, sectionColour, section);
"""


class FieldActor:
    """A surface with a field, for any VTK renderer.

    `scale` is the number of device pixels in a pixel of the style's widths.
    """

    def __init__(self, style: Style, scale: float = 1.0) -> None:
        self.style = style
        self.table = lookup_table(style)
        self.is_signed = self._is_plain = False
        self.actor = vtkActor()
        self.maximum = 1.0
        self.mesh = vtkPolyData()
        self._mapper = vtkPolyDataMapper()
        self.isolines = TWENTY_STEPS
        self._through: tuple[float, ...] = ()
        self._edges = np.empty(0)
        self._own_maximum, self._has_lines = 1.0, True
        self._own = vtkPolyData()
        self._has_edges = False
        self.clip: ClipPlane | None = None
        self._cut: Cut | None = None
        self._paints_section = True
        self._followed: tuple[object, ...] | None = None
        self._tints: dict[str, AnyArray] = {}
        self._base = (False, False)  # whether it has two greys, and coloured isolines
        self._passed_on = (set[str](), self._base)  # of these, what reaches the shader
        self._make()
        self.stand_in = StandInActor(self.actor)
        self.show_isolines(self.isolines, self._through)
        self.set_scale(scale)
        self.actor.VisibilityOff()

    def show_surface(self, mesh: vtkPolyData) -> None:
        """Show a surface made by `drawable`, without a field yet."""
        self._cut = None
        count = mesh.GetNumberOfPoints() - len(copies_of(mesh))
        self._put_mesh(mesh, np.full(count, UNDEFINED, np.float32))

    def show_normals(self, mesh: vtkPolyData) -> None:
        """Show the same surface, made by `drawable` with another shading; its field stays."""
        count = mesh.GetNumberOfPoints() - len(copies_of(mesh))
        self._put_mesh(mesh, self._values[:count])

    def _put_mesh(self, mesh: vtkPolyData, values: AnyArray) -> None:
        self.stand_in.take(None)
        self.mesh = mesh
        own = vtkPolyData()
        own.ShallowCopy(mesh if self._cut is None else with_cut(mesh, self._cut))
        self._copies = copies_of(mesh)
        if self._cut is not None:
            self._copies = np.concatenate([self._copies, self._cut.ends[:, 0]])
        self._values = np.concatenate([values, self._at_copies(values)]).astype(np.float32, copy=False)
        self._array = numpy_to_vtk(self._values)
        self._array.SetName("distance")
        own.GetPointData().AddArray(self._array)
        self._draw(own)
        before, self._tints = self._tints, {}
        for name in TINTS:
            kept = before.get(name)
            self._tint(name, kept if kept is not None and len(kept) == len(values) else None)
        self.actor.VisibilityOn()

    def _at_copies(self, values: AnyArray) -> AnyArray:
        """Return a field (n,) at the copies of vertices (k,), which stand beside them where they are of points."""
        beside = at_corners(self.mesh, values, UNDEFINED)
        found = values[self._copies] if beside is None else beside
        if self._cut is not None:
            found[len(found) - len(self._cut.ends) :] = self._cut.at_points(values, UNDEFINED)
        return found

    def show_selected(self, colours: ByteArray | None) -> None:
        """Tint vertices that stand out with colours (n, 4) uint8, see `selected_colours`; None for none."""
        self._tint("selected", colours)

    def show_colours(self, colours: FloatArray, are_labels: bool = False) -> None:
        """Show colours (n, 3) from 0 to 1 instead of a field, grey where they are NaN.

        Between those of `are_labels` there are borders, smoothed within faces; others go over into each other.
        """
        self.show_bare()
        known = np.isfinite(colours).all(axis=1)
        tint = np.zeros((len(colours), 4), np.uint8)
        tint[known] = np.column_stack([np.round(255 * colours[known]), np.full(known.sum(), 255)])
        if are_labels:
            self._tint("labels", _weighted(tint, vertex_faces(self.mesh)))
        else:
            self._tint("colours", tint)

    def _drop_colours(self) -> None:
        for name in self._tints.keys() - _STAY:
            self._tint(name, None)

    def show_base(self, base: Greys | None, has_coloured_isolines: bool = True) -> None:
        """Show greys instead of the field's colours, which the isolines may have, or these again."""
        shares = None if base is None else base.shares
        is_of_two = base is not None and base.are_two
        self._base = is_of_two, has_coloured_isolines and self.style.coloured and base is not None
        if shares is not self._tints.get("base"):
            self._tint("base", shares)
        self._pass_tints(set(self._tints))

    def show_light(self, light: AnyArray | None) -> None:
        """Darken vertices by the share (n,) float32 of the light that reaches them; None for none."""
        if light is not self._tints.get("light"):
            self._tint("light", light)

    def _tint(self, name: str, colours: ByteArray | FloatArray | None) -> None:
        """Let vertices have colours (n, 4) uint8, multiplied by alpha, or shares (n,) of a base; None for none."""
        self._tints.pop(name, None)
        if colours is not None:
            self._tints[name] = colours
            # Multiplied by alpha 0, what has none has no colour to lend.
            whole = 255 if colours.dtype == np.uint8 else 1
            array = numpy_to_vtk(np.concatenate([colours, colours[self._copies]]).astype(np.float32) / whole, deep=True)
            array.SetName(name)
            self._own.GetPointData().AddArray(array)
            self._own.Modified()
        self._pass_tints(set(self._tints))

    def _pass_tints(self, names: set[str]) -> None:
        """Hand those of TINTS that are named to the shader, which paints them."""
        for name in TINTS:
            if name in names:
                map_attribute(self._mapper, f"{name}Attribute", name)
            else:
                self._mapper.RemoveVertexAttributeMapping(f"{name}Attribute")
        if (names, self._base) != self._passed_on:
            self._passed_on = names, self._base
            self._uniforms.SetUniformf("baseIsOfTwo", float(self._base[0]))
            self._put_shaders(self._has_edges)
            self._take_table()
            self.set_scale(*self._scale)

    def _draw(self, own: vtkPolyData) -> None:
        self._own = own
        self._mapper.SetInputData(own)
        map_attribute(self._mapper, "isolineAttribute", "distance")
        self._show_backs()

    def follow(self, other: "FieldActor", isolines: Isolines) -> None:
        """Show what another one shows now, from the same memory, with isolines of its own."""
        if self._own is not other._own:
            self._draw(other._own)
        self.show_clip(other.clip)
        self._show_backs()
        self._values, self._array = other._values, other._array
        if self.table is not other.table:
            self.table, self.is_signed = other.table, other.is_signed
            self._take_table()
        look = other.actor.GetProperty()
        if self.actor.GetProperty() is not look or self._has_edges != other._has_edges:
            self.actor.SetProperty(look)
            self.stand_in.actor.SetProperty(look)
            self._put_shaders(other._has_edges)
        if self._passed_on != other._passed_on:
            names, self._base = other._passed_on
            self._pass_tints(names)
        if self.stand_in.stand_in is not other.stand_in.stand_in:
            self.stand_in.take(other.stand_in.stand_in)
        self.show_stand_in(other.stand_in.is_shown)
        self.actor.SetVisibility(other.actor.GetVisibility())
        shown = (isolines, other._through, other.maximum, other._own_maximum, other.is_signed, other._has_lines)
        if shown != self._followed:
            self._followed, self.maximum, self._own_maximum = shown, other.maximum, other._own_maximum
            self._has_lines = other._has_lines
            self.show_isolines(isolines, other._through)

    def show_field(
        self, field: AnyArray, maximum: float | None = None, signed: bool = False, has_lines: bool = True
    ) -> None:
        """Colour the surface by a field (n,); NaN is grey.

        Parameters
        ----------
        maximum
            Upper colour limit, the field's own maximum if None.
        signed
            Whether colours go from -maximum to maximum, in the diverging map, with a line of its own at 0.
        has_lines
            Whether there are isolines.
        """
        self._drop_colours()
        own = float(np.nanmax(np.abs(field) if signed else field, initial=0.0))
        top = own if maximum is None else maximum
        shares = field / top if top > 0 else np.zeros_like(field)
        values = np.where(np.isnan(field), UNDEFINED, (shares + 1) / 2 if signed else shares)
        self._values[: len(values)] = values
        self._values[len(values) :] = self._at_copies(values)
        self._array.Modified()
        self.maximum, self._own_maximum, self._has_lines = top, own, has_lines
        self._be_plain(False)
        if signed != self.is_signed:
            self.is_signed = signed
            self._set_colours()
        self.show_isolines(self.isolines, self._through)

    def show_bare(self, is_plain: bool = False) -> None:
        """Show the surface in grey; `is_plain` for one that is meant to have no field."""
        self._be_plain(is_plain)
        self._drop_colours()
        self._values[:] = UNDEFINED
        self._array.Modified()
        self.maximum = self._own_maximum = 0.0
        self.show_isolines(self.isolines, self._through)

    def _be_plain(self, is_plain: bool) -> None:
        if is_plain != self._is_plain:
            self._is_plain = is_plain
            self._set_colours()

    def show_isolines(self, isolines: Isolines, through: tuple[float, ...] = ()) -> None:
        """Show these isolines, and one at each value `through`, which stands out."""
        self.isolines, self._through = isolines, through
        found = self.levels
        shares = found.values / self.maximum if self.maximum > 0 else found.values
        at = (shares + 1) / 2 if self.is_signed else shares
        kinds = np.where(found.is_through, 2.0, np.where(found.is_bold, 1.0, 0.0))
        if self.is_signed and not isolines.bold:
            kinds[(found.values == 0) & ~found.is_through] = 0.5
        count = min(len(at), MOST_LINES)
        self._uniforms.SetUniformi("isolineCount", count)
        # Of one size, so that the shader need not be made anew.
        for name, numbers in (("isolineAt", at), ("isolineKind", kinds)):
            padded = np.zeros(MOST_LINES)
            padded[:count] = numbers[:count]
            self._uniforms.SetUniform1fv(name, MOST_LINES, padded.tolist())

    def show_bands(self, edges: FloatArray) -> None:
        """Show bands that end at fractions (k,) of the maximum, if the style has any."""
        if not np.array_equal(edges, self._edges):
            self._edges = edges
            if self.style.bands:
                self._set_colours()

    def _set_colours(self) -> None:
        """Take the colours of the style for the sign of the field and its bands."""
        self.table = lookup_table(self.style, self.is_signed, self._edges)
        if self._is_plain:
            self.table.SetBelowRangeColor(*self.style.plain, 1)
        self._take_table()

    def _take_table(self) -> None:
        self._mapper.SetLookupTable(self.table)
        rim = self.isoline_ink().rim or (0.0, 0.0, 0.0, 0.0)
        self._uniforms.SetUniform3f("isolineColour", self.style.isoline)
        self._uniforms.SetUniform3f("isolineZeroColour", self.style.isoline_ink(self.is_signed, 0.0).colour[:3])
        self._uniforms.SetUniform3f("isolineRimColour", rim[:3])
        self._uniforms.SetUniformf("isolineRimOpacity", rim[3])
        self._uniforms.SetUniform3f("isolineThroughColour", self.style.source)
        self._uniforms.SetUniform3f("isolineCasingColour", self.style.mark_edge)
        self._uniforms.SetUniform3f("sectionColour", self.style.section)
        self._uniforms.SetUniformf("isolineSigned", float(self.is_signed))

    def isoline_ink(self, value: float = 1.0, is_through: bool = False) -> IsolineInk:
        """Return the ink of an isoline, which on a base may have the colour of the field there."""
        names, (_, has_own_colour) = self._passed_on
        share = value / (self.maximum or 1.0) if has_own_colour else None
        return self.style.isoline_ink(self.is_signed, value, is_through, "base" in names, share)

    @property
    def levels(self) -> Levels:
        """The values that have a line."""
        isolines = self.isolines if self._has_lines else NO_LINES
        return levels(isolines, self.maximum, self._own_maximum, self.is_signed, self._through)

    @property
    def too_many(self) -> str:
        """A sentence where a spacing makes more lines than are drawn, so that none are; else ""."""
        return too_many(self.levels, self.isolines, self._own_maximum)

    def show_shading(self, shading: Shading) -> None:
        """Set whether faces are flat, and edges drawn; where normals are split, `drawable` has done."""
        look = self.actor.GetProperty()
        if shading.normals == "flat":
            look.SetInterpolationToFlat()
        else:
            look.SetInterpolationToGouraud()
        if self._has_edges != shading.show_edges:
            self._put_shaders(shading.show_edges)

    def show_clip(self, clip: ClipPlane | None, paints_section: bool = True) -> None:
        """Cut the surface by a plane, or no longer; `paints_section` holds from the next `set_scale` on."""
        self._paints_section = paints_section
        if clip == self.clip:
            return
        is_other = (clip is None) != (self.clip is None)
        self.clip = clip
        for mapper in (self._mapper, self.stand_in.mapper):
            mapper.RemoveAllClippingPlanes()
            if clip is not None:
                mapper.AddClippingPlane(clip.for_vtk)
        if is_other:
            self._show_backs()
            self._put_shaders(self._has_edges)

    def show_cut(self, cut: Cut | None) -> None:
        """Close the surface of a solid where a plane cuts it, or no longer."""
        if cut is not self._cut:
            count = len(self._values) - len(self._copies)
            self._cut = cut
            self._put_mesh(self.mesh, self._values[:count])

    @property
    def opacity(self) -> float:
        """Of the surface, at most 1."""
        return float(self.actor.GetProperty().GetOpacity())

    def show_opacity(self, opacity: float) -> None:
        """Let the surface be translucent, or no longer; its renderer has to blend by depth (`light`)."""
        self.actor.GetProperty().SetOpacity(opacity)
        self._show_backs()

    def _show_backs(self) -> None:
        self._uniforms.SetUniformf("hasBacks", float(has_backs(self._own, self.clip is not None, self.opacity)))

    def show_stand_in(self, is_shown: bool) -> None:
        """Draw what `stand_in` has taken instead of the surface, if it has anything, or the surface again."""
        data = self._own.GetPointData()
        self.stand_in.show(is_shown, self._array, UNDEFINED, {name: data.GetArray(name) for name in self._passed_on[0]})

    def set_scale(self, scale: float, share: float = 1.0) -> None:
        """Set the device pixels per pixel of line widths, and the fraction of their usual width that isolines have."""
        self._scale = scale, share
        self._uniforms.SetUniformf("edgeScale", scale)
        self._uniforms.SetUniformf("isolineCasing", CASING * scale * share)
        self._uniforms.SetUniformf("isolineRimWidth", RIM * scale * share)
        section = SECTION.strokes[0].width * scale * share if self._paints_section else -1.0
        self._uniforms.SetUniformf("sectionWidth", section)
        self._uniforms.SetUniformf(
            "isolineHalfWidth", self.isoline_ink().width * self.style.isoline_width / 2 * scale * share
        )

    def set_origin(self, x: float, y: float) -> None:
        """Set where the picture begins in a whole of which it is a part, so that hatching goes on from part to part."""
        self._uniforms.SetUniform2f("hatchOrigin", (x, y))

    def _make(self) -> None:
        mapper, actor = self._mapper, self.actor
        mapper.SetLookupTable(self.table)
        mapper.UseLookupTableScalarRangeOn()
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("distance")
        # Colours are looked up per pixel, not blended between the vertices' colours.
        mapper.InterpolateScalarsBeforeMappingOn()
        actor.SetMapper(mapper)
        surface = actor.GetProperty()
        surface.SetInterpolationToGouraud()
        if self.style.shading:
            surface.SetAmbient(0.26)
            surface.SetDiffuse(0.80)
            surface.SetSpecular(0.06)
            surface.SetSpecularPower(20)
        else:
            surface.SetAmbient(1.0)
            surface.SetDiffuse(0.0)
            surface.SetSpecular(0.0)
        # Those of VTK are not faded where they are dense.
        surface.SetEdgeOpacity(0.0)
        self._uniforms = actor.GetShaderProperty().GetFragmentCustomUniforms()
        self._uniforms.SetUniformf("hasBacks", 0.0)
        self.set_origin(0, 0)
        self._uniforms.SetUniform3f("backColour", self.style.back)
        self._uniforms.SetUniform3f("edgeColour", self.style.edge)
        self._uniforms.SetUniform3f("edgeOnDark", self.style.edge_on_dark)
        self._uniforms.SetUniformf("baseIsOfTwo", 0.0)
        self._uniforms.SetUniform3f("baseLight", self.style.base_light)
        self._uniforms.SetUniform3f("baseDark", self.style.base_dark)
        self._set_colours()
        self._put_shaders(False)

    def _put_shaders(self, has_edges: bool) -> None:
        self._has_edges = has_edges
        shader = self.actor.GetShaderProperty()
        shader.ClearAllShaderReplacements()
        attributes = [("isolineAttribute", "isolineValue", "float")]
        names, (_, has_own_colours) = self._passed_on
        attributes += [(f"{name}Attribute", *TINTS[name]) for name in TINTS if name in names]
        pass_on(shader, *attributes)
        # Edges that are seen or not, VTK draws them by a geometry shader, which labels need.
        self.actor.GetProperty().SetEdgeVisibility(has_edges or "labels" in names)
        put_face_look(shader, has_edges, bool(names - _STAY), "base" in names, "labels" in names)
        paint = _PAINT.replace("ISOLINE", "fieldColour" if has_own_colours else "isolineColour")
        paint = (_DARKEN if "light" in names else "") + (PAINT_SELECTED if "selected" in names else "") + paint
        paint += _PAINT_SECTION if self.clip is not None else ""
        rim = _RIM.format(self.style.rim) if self.style.rim else ""
        shader.AddFragmentShaderReplacement(_LIT, False, f"{_LIT}\n{rim}{paint}", False)


def _weighted(colours: ByteArray, faces: IntArray) -> FloatArray:
    """Return colours (n, 4) of labels at vertices of faces (m, 3), multiplied by weights, which draw borders."""
    signed = np.where(colours[:, 3:] == 0, [0, 0, 0, -1], colours / 255)
    labels = colours.view(np.uint32).ravel().astype(np.int64)
    weighted: FloatArray = signed * label_weights(labels, faces)[:, None]
    return weighted


def lookup_table(style: Style, signed: bool = False, edges: FloatArray | None = None) -> vtkLookupTable:
    """Return the style's colours from 0 to 1, or those of a signed field, and the colour of what is undefined.

    Parameters
    ----------
    edges
        (k,) fractions of the maximum at which bands end, if the style has any.
    """
    if style.bands and edges is not None and len(edges):
        # Each colour stands for a part of the range, not for its beginning.
        shares = (np.arange(FINE) + 0.5) / FINE
        of = np.searchsorted(edges, 2 * shares - 1 if signed else shares, side="right")
        colours = style.band_colours(edges, signed)[of]
    else:
        colours = style.colours(signed=signed)
    table = vtkLookupTable()
    rgba = np.column_stack([np.round(255 * colours), np.full(len(colours), 255)]).astype(np.uint8)
    table.SetNumberOfTableValues(len(colours))
    table.SetTable(numpy_to_vtk(rgba, deep=True))
    table.SetRange(0, 1)
    table.SetBelowRangeColor(*style.undefined, 1)
    table.UseBelowRangeColorOn()
    return table


def light(renderer: vtkRenderer) -> None:
    """Add a key light from the upper left of the camera and a weak fill, so that form reads without dark sides.

    What is translucent is blended by depth, in whatever order it is drawn.
    """
    renderer.UseDepthPeelingOn()
    renderer.SetMaximumNumberOfPeels(MOST_PEELS)
    renderer.SetOcclusionRatio(0.0)
    renderer.RemoveAllLights()
    renderer.AutomaticLightCreationOff()
    for position, intensity in [((-0.5, 0.6, 1.0), 0.85), ((0.8, -0.2, 0.7), 0.42)]:
        source = vtkLight()
        source.SetLightTypeToCameraLight()
        source.SetPosition(*position)
        source.SetFocalPoint(0, 0, 0)
        source.SetIntensity(intensity)
        renderer.AddLight(source)
