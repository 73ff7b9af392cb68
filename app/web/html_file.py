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
from .stored_mesh import StoredMesh, deflated

KERNEL = Path(__file__).with_name("kernel.wasm")
MARK = re.compile(r"@([A-Z]+)@")


def page_text(scene: Mapping[str, object], mesh: StoredMesh, points: Mapping[str, StoredPoints]) -> str:
    """The file.  scene: what is shown, with `title`; points: by the names that its panels have for them.

    The page may run its own script only, and fetch nothing (Content-Security-Policy).  ValueError where a number of the
    scene is not finite.
    """
    whole = whole_scene(scene, mesh)
    contents = {
        "kernel": kernel(),
        "mesh": deflated(mesh.packed),
        **{f"points-{name}": deflated(each.packed) for name, each in points.items()},
    }
    elements = [
        f'<script type="text/plain" id="{name}">{b64encode(content).decode()}</script>'
        for name, content in contents.items()
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


def whole_scene(scene: Mapping[str, object], mesh: StoredMesh) -> dict[str, object]:
    """With what the solver needs to know of the mesh."""
    return {**scene, "near": mesh.near, "corrections": mesh.corrections(str(scene["areas"]))}


def kernel() -> bytes:
    """The compiled module, as the viewer inflates it."""
    return deflated(KERNEL.read_bytes())


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
