"""One HTML file that computes: the kernel, a mesh, what is shown of it, and the viewer, with nothing to load."""

from __future__ import annotations

import html
import json
import re
from base64 import b64encode
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

from bihdist_core.file_content import file_text

from .modules import VIEWER, joined, unpadded
from .points import StoredPoints
from .stored_field import StoredField
from .stored_mesh import StoredMesh, deflated

KERNEL = Path(__file__).with_name("kernel.wasm")
MARK = re.compile(r"@([A-Z]+)@")
NONE_GIVEN: Mapping[str, StoredField] = {}


def page_text(
    scene: Mapping[str, object],
    mesh: StoredMesh,
    points: Mapping[str, StoredPoints],
    given: Mapping[str, StoredField] = NONE_GIVEN,
) -> str:
    """The file.  scene: what is shown, with `title`; points, given: by the names that its panels have for them.

    The page may run its own script only, and fetch nothing (Content-Security-Policy).  ValueError where a number of the
    scene is not finite.
    """
    whole = whole_scene(scene, mesh, given)
    elements = [
        f'<script type="text/plain" id="{name}">{b64encode(content).decode()}</script>'
        for name, content in packed_contents(mesh, points, given).items()
    ]
    elements.append(f'<script type="application/json" id="scene">{_as_json(whole)}</script>')
    script, its_style = joined("main.js"), style()
    filled = {
        "TITLE": html.escape(str(scene["title"])),
        "POLICY": html.escape(_policy(script, its_style)),
        "STYLE": its_style,
        "CONTENT": "\n".join(elements),
        "SCRIPT": script,
    }
    return MARK.sub(lambda mark: filled[mark[1]], file_text(VIEWER / "page.html", "the frame of pages"))


def whole_scene(
    scene: Mapping[str, object], mesh: StoredMesh, given: Mapping[str, StoredField] = NONE_GIVEN
) -> dict[str, object]:
    """With what the solver needs to know of the mesh, and the names of the fields that it is given."""
    corrections = mesh.corrections(str(scene["areas"]))
    return {**scene, "near": mesh.near, "corrections": corrections, "given": list(given)}


def packed_contents(
    mesh: StoredMesh, points: Mapping[str, StoredPoints], given: Mapping[str, StoredField] = NONE_GIVEN
) -> dict[str, bytes]:
    """What the viewer inflates: the kernel, the mesh, points that stand for vertices, and given fields in order."""
    return {
        "kernel": deflated(KERNEL.read_bytes()),
        "mesh": deflated(mesh.packed),
        "given": deflated(b"".join(each.packed for each in given.values())),
        **{f"points-{name}": deflated(each.packed) for name, each in points.items()},
    }


def style() -> str:
    """The viewer's."""
    return unpadded(file_text(VIEWER / "page.css", "the style of pages"))


def _policy(script: str, style: str) -> str:
    """What the page may do: only what stands in it, of scripts and styles only these."""
    hashes = [f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'" for text in (script, style)]
    return (
        f"default-src 'none'; script-src {hashes[0]} 'wasm-unsafe-eval'; style-src {hashes[1]}; worker-src blob:; "
        "img-src data: blob:; base-uri 'none'; form-action 'none'"
    )


def _as_json(value: object) -> str:
    """JSON in which nothing ends an element, or begins one."""
    return json.dumps(value, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
