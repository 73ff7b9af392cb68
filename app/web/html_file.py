"""The HTML file of a page: kernel, mesh, scene and viewer, which loads nothing else."""

from __future__ import annotations

import html
import json
import re
from base64 import b64encode
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

from bihdist_core.file_content import file_text
from bihdist_core.version import VERSION

from .modules import VIEWER, joined, unpadded
from .stored_mesh import StoredMesh, deflated
from .stored_values import StoredField, StoredPoints

KERNEL = Path(__file__).with_name("kernel.wasm")
MARK = re.compile(r"@([A-Z]+)@")


def page_text(
    scene: Mapping[str, object],
    mesh: StoredMesh,
    points: Mapping[str, StoredPoints],
    given: Mapping[str, StoredField],
) -> str:
    """Return the HTML of a page; `points` and `given` are keyed by the names that the scene's panels use.

    Its Content-Security-Policy allows its own script only, and no network. Raises ValueError if a number of the
    scene is not finite.
    """
    whole = {**whole_scene(scene, mesh, given), "embed": embed_code("PAGE", str(scene["title"]))}
    elements = [
        f'<script type="text/plain" id="{name}">{b64encode(content).decode()}</script>'
        for name, content in packed_contents(mesh, points, given).items()
    ]
    elements.append(f'<script type="application/json" id="scene">{_as_json(whole)}</script>')
    script, its_style = joined("main.js"), style()
    filled = {
        "TITLE": html.escape(str(scene["title"])),
        "VERSION": VERSION,
        "POLICY": html.escape(_policy(script, its_style)),
        "STYLE": its_style,
        "CONTENT": "\n".join(elements),
        "SCRIPT": script,
    }
    return MARK.sub(lambda mark: filled[mark[1]], file_text(VIEWER / "page.html", "the frame of pages"))


def embed_code(address: str, title: str) -> str:
    """Return the HTML that shows the page at an address inside another page."""
    return (
        f'<iframe src="{html.escape(address)}" title="{html.escape(title)}" loading="lazy" allow="clipboard-write" '
        'style="width:100%;aspect-ratio:16/9;min-height:420px;border:0"></iframe>'
    )


def whole_scene(scene: Mapping[str, object], mesh: StoredMesh, given: Mapping[str, StoredField]) -> dict[str, object]:
    """Return the scene with what the solver needs of the mesh, and the names of the fields of the user's own."""
    corrections = mesh.corrections(str(scene["areas"]))
    return {**scene, "near": mesh.near, "corrections": corrections, "given": list(given)}


def packed_contents(
    mesh: StoredMesh, points: Mapping[str, StoredPoints], given: Mapping[str, StoredField]
) -> dict[str, bytes]:
    """Pack what the viewer inflates: the kernel, the mesh, points of spectral distances, and fields in order."""
    more = {} if mesh.normals is None else {"normals": deflated(mesh.normals.tobytes())}
    if mesh.matrices:
        more |= {name: deflated(getattr(mesh.matrices, name).packed) for name in ("weights", "areas")}
    return {
        "kernel": deflated(KERNEL.read_bytes()),
        "mesh": deflated(mesh.packed),
        **more,
        "given": deflated(b"".join(each.packed for each in given.values())),
        **{f"points-{name}": deflated(each.packed) for name, each in points.items()},
    }


def style() -> str:
    """Return the style sheet of the viewer."""
    return unpadded(file_text(VIEWER / "page.css", "the style of pages"))


def _policy(script: str, style: str) -> str:
    """Return a policy that allows this script and this style, and nothing from elsewhere."""
    hashes = [f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'" for text in (script, style)]
    return (
        f"default-src 'none'; script-src {hashes[0]} 'wasm-unsafe-eval'; style-src {hashes[1]}; worker-src blob:; "
        "img-src data: blob:; base-uri 'none'; form-action 'none'"
    )


def _as_json(value: object) -> str:
    """Return JSON that cannot begin or end an HTML element."""
    return json.dumps(value, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
