"""The JavaScript modules of a page, joined into one script."""

import re
from pathlib import Path

from bihdist_core.file_content import file_text

VIEWER = Path(__file__).parent / "viewer"
IMPORT = re.compile(r'^import \{ ([\w, ]+) \} from "\./([\w-]+\.js)";\n', re.M)
EXPORT = re.compile(r"^export (?=(?:async )?(?:function|class|const)\b)", re.M)
NAMES = re.compile(r"^(?:export )?(?:async )?(?:function\*?|class|const|let) (\w+|[\[{][^=]*[\]}])", re.M)
PADDING = re.compile(r"^\s*(?://.*\n|/\*(?:[^*]|\*(?!/))*\*/\s*\n)|^\s+", re.M)


def joined(entry: str, folder: Path = VIEWER) -> str:
    """Return a module after all the modules that it imports, without indentation and comment lines.

    A module imports by `import { a, b } from "./other.js";` at its beginning, and exports functions, classes and
    constants where they are defined. No two modules share a top-level name. Raises ValueError if that is not so.
    """
    texts: dict[str, str] = {}
    _collect(entry, folder, texts, ())
    owner: dict[str, str] = {}
    for module, text in texts.items():
        for name in top_names(text):
            if owner.setdefault(name, module) != module:
                raise ValueError(f"{module} and {owner[name]} both define {name}.")
    return unpadded("\n".join(texts.values()))


def unpadded(text: str) -> str:
    """Return a script or style sheet without indentation and comment lines."""
    return PADDING.sub("", text)


def top_names(text: str) -> list[str]:
    """Return the top-level names of a module."""
    return [name for found in NAMES.findall(text) for name in re.findall(r"\w+", found)]


def _collect(module: str, folder: Path, texts: dict[str, str], above: tuple[str, ...]) -> None:
    if module in above:
        raise ValueError(f"{module} imports itself by way of {', '.join(above)}.")
    if module in texts:
        return
    text = file_text(folder / module, "a module of pages")
    for names, other in IMPORT.findall(text):
        _collect(other, folder, texts, (*above, module))
        offered = _exported(file_text(folder / other, "a module of pages"))
        if missing := [name for name in names.split(", ") if name not in offered]:
            raise ValueError(f"{module} imports {', '.join(missing)} of {other}, which does not export it.")
    rest = EXPORT.sub("", IMPORT.sub("", text))
    if bad := re.search(r"^(import|export)\b.*", rest, re.M):
        raise ValueError(f"{module}: {bad[0]!r} is neither an import nor an export of the kinds that can be joined.")
    texts[module] = rest


def _exported(text: str) -> set[str]:
    return set(top_names("\n".join(re.findall(r"^export .*", text, re.M))))
