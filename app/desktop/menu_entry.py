"""The program's entry in the menu, and what software centres say of it."""

import re
from xml.etree import ElementTree

from .mime_types import MIME_TYPES, as_file

NAME = "Biharmonic distance"
CATEGORIES = ("Science", "Math", "DataVisualization")
SUMMARY = "See distances on triangle meshes beside each other"
ICON = "bihdist"
WINDOW_CLASS = "bihdist"
"""By which desktops know the program's windows."""
PARAGRAPHS = (
    "Open a triangle mesh, click a point, and see its biharmonic distance to every other point, beside the geodesic "
    "and the diffusion distance. The distance is exact, and fields follow the source while it is dragged.",
    "Isolines, differences of distances, profiles, statistics, regions and correspondences come with it, as do figures "
    "in PDF and SVG and web pages that compute.",
)


def entry(python: str) -> str:
    """The desktop entry; python: the interpreter that has the program, by its whole path."""
    rows = {
        "Type": "Application",
        "Version": "1.1",
        "Name": NAME,
        "GenericName": "Mesh viewer",
        "Comment": SUMMARY,
        "Exec": f"{_escaped(_argument(python))} -m bihdist view %f",
        "TryExec": _escaped(python),
        "Icon": ICON,
        "Terminal": "false",
        "Categories": "".join(f"{each};" for each in CATEGORIES),
        "Keywords": "mesh;surface;geodesic;diffusion;isolines;",
        "MimeType": "".join(f"{each.name};" for each in MIME_TYPES),
        "StartupNotify": "true",
        "StartupWMClass": WINDOW_CLASS,
    }
    return "[Desktop Entry]\n" + "".join(f"{key}={value}\n" for key, value in rows.items())


def _argument(path: str) -> str:
    """A path as a word of a command."""
    path = path.replace("%", "%%")
    if not re.search(r"[^\w@%+=:,./-]", path):
        return path
    return '"' + re.sub(r'(["`$\\])', r"\\\1", path) + '"'


def _escaped(value: str) -> str:
    """A value as files of entries have it."""
    return value.replace("\\", "\\\\").replace("\n", "\\n").replace("\t", "\\t")


def metainfo() -> str:
    """What AppStream knows of the program, as XML."""
    root = ElementTree.Element("component", type="desktop-application")
    for tag, text in {
        "id": "local.bihdist.viewer",  # has to begin with a domain, and .local is nobody's
        "name": NAME,
        "summary": SUMMARY,
        "metadata_license": "CC0-1.0",
        "project_license": "MIT AND CC0-1.0",
    }.items():
        ElementTree.SubElement(root, tag).text = text
    ElementTree.SubElement(ElementTree.SubElement(root, "developer"), "name").text = "The bihdist authors"
    description = ElementTree.SubElement(root, "description")
    for paragraph in PARAGRAPHS:
        ElementTree.SubElement(description, "p").text = paragraph
    ElementTree.SubElement(root, "launchable", type="desktop-id").text = "bihdist.desktop"
    ElementTree.SubElement(root, "icon", type="stock").text = ICON
    categories = ElementTree.SubElement(root, "categories")
    for word in CATEGORIES:
        ElementTree.SubElement(categories, "category").text = word
    provides = ElementTree.SubElement(root, "provides")
    ElementTree.SubElement(provides, "binary").text = "bihdist"
    for each in MIME_TYPES:
        ElementTree.SubElement(provides, "mediatype").text = each.name
    ElementTree.SubElement(root, "content_rating", type="oars-1.1")
    return as_file(root)
