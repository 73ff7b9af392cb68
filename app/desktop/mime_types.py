"""The MIME types of mesh files, sessions and recipes, as a package of shared-mime-info.

Types that the system, F3D or MeshLab describe have their names.
"""

from dataclasses import dataclass
from xml.etree import ElementTree

from bihdist_core.formats.mesh_names import GZIP, MESH_FORMATS

NAMESPACE = "http://www.freedesktop.org/standards/shared-mime-info"


@dataclass(frozen=True)
class Match:
    """What files of a type hold: a text or number, as shared-mime-info writes it, that begins at `offset`, with other
    matches of which one has to hold, too."""

    value: str
    offset: str = "0"
    kind: str = "string"
    inside: tuple["Match", ...] = ()


@dataclass(frozen=True)
class MimeType:
    """comment: empty for those that shared-mime-info itself describes.  patterns: of names.  weight: above 50 where
    another type has the pattern, too.  parent: the type of which this is a kind.  priority: of its matches."""

    name: str
    comment: str = ""
    patterns: tuple[str, ...] = ()
    weight: int = 50
    parent: str = ""
    aliases: tuple[str, ...] = ()
    matches: tuple[Match, ...] = ()
    priority: int = 50
    icon: str = ""


def _vtk_xml(kind: str) -> tuple[Match, ...]:
    return (Match("<VTKFile", "0:256", inside=(Match(f'type="{kind}"', "0:512"),)),)


MIME_TYPES = (
    MimeType(
        "application/vnd.off",
        "OFF mesh",
        ("*.off",),
        aliases=("model/x-geomview-off",),
        matches=tuple(
            Match(f"{word}{end}") for word in ("OFF", "COFF", "NOFF", "CNOFF", "STOFF") for end in (" ", "\\n", "\\r")
        ),
    ),
    # The system has *.obj also for drawings of Tgif.
    MimeType("model/obj", patterns=("*.obj",), weight=60),
    MimeType(
        "application/vnd.ply",
        "PLY mesh",
        ("*.ply",),
        aliases=("model/x-ply",),
        matches=(Match("ply\\nformat "), Match("ply\\r\\nformat "), Match("ply\\rformat ")),
    ),
    MimeType("model/stl", patterns=("*.stl",)),
    MimeType("application/vnd.vtk", "VTK data", ("*.vtk",), matches=(Match("# vtk DataFile Version "),)),
    MimeType("application/vnd.vtp", "VTK surface", ("*.vtp",), matches=_vtk_xml("PolyData")),
    MimeType(
        "application/vnd.vtu",
        "VTK unstructured grid",
        ("*.vtu",),
        matches=_vtk_xml("UnstructuredGrid"),
    ),
    MimeType("model/gltf+json", patterns=("*.gltf",)),
    MimeType("model/gltf-binary", patterns=("*.glb",)),
    MimeType(
        "application/gifti+xml", "GIFTI data", ("*.gii",), parent="application/xml", matches=(Match("<GIFTI", "0:512"),)
    ),
    # Its files are named by what they show, `lh.pial`, and so are those that are no surfaces: `lh.thickness`.
    MimeType(
        "application/x-freesurfer-surface",
        "FreeSurfer surface",
        matches=(Match("0xfffffe63", kind="big32", inside=(Match("created by ", "3"),)),),
    ),
    MimeType(
        "application/x-compressed-mesh",
        "Compressed mesh",
        tuple(f"*{extension}{GZIP}" for extension in MESH_FORMATS),
        parent="application/gzip",
    ),
    # Their names are those of any JSON, and programs look into such files as the system has two types for them, one of
    # which has the priority 80.
    MimeType(
        "application/x-bihdist+json",
        "Biharmonic distance session or recipe",
        parent="application/json",
        matches=(Match("{", inside=(Match('"program": "bihdist ', "1:64"),)),),
        priority=85,
        icon="bihdist",
    ),
)
"""Of all that the window opens."""


def package() -> str:
    """The XML file that describes the types."""
    root = ElementTree.Element("mime-info", xmlns=NAMESPACE)
    for each in MIME_TYPES:
        described = ElementTree.SubElement(root, "mime-type", type=each.name)
        if each.comment:
            ElementTree.SubElement(described, "comment").text = each.comment
        if each.parent:
            ElementTree.SubElement(described, "sub-class-of", type=each.parent)
        for alias in each.aliases:
            ElementTree.SubElement(described, "alias", type=alias)
        if each.matches:
            magic = ElementTree.SubElement(described, "magic", priority=str(each.priority))
            for match in each.matches:
                _add(match, magic)
        for pattern in each.patterns:
            ElementTree.SubElement(described, "glob", pattern=pattern, weight=str(each.weight))
        if each.icon:
            ElementTree.SubElement(described, "icon", name=each.icon)
    return as_file(root)


def _add(match: Match, parent: ElementTree.Element) -> None:
    described = ElementTree.SubElement(parent, "match", type=match.kind, value=match.value, offset=match.offset)
    for each in match.inside:
        _add(each, described)


def as_file(root: ElementTree.Element) -> str:
    """XML as text, a line for each element."""
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, "unicode")}\n'
