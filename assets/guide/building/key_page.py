"""The window's commands and keys, from its table."""

INTRODUCTION = """# Commands and keys of the window

Every command of the menus, with its keys. {kbd}`F1` in the window finds each of them by its name. [The
viewer](viewer.md#mouse) describes what the mouse does.

"""


def key_page() -> dict[str, str]:
    """Return the text of the page, by its path in the guide."""
    from app.qt import acts
    from app.qt.actions import actions_of_tools

    groups = {
        "File": acts.FILE, "Edit": acts.EDIT, "View": (*acts.VIEW, *acts.SETTINGS), "Panels": acts.PANELS,
        "Tools": acts.INSTRUMENTS, "Sources": acts.TOOLS, "In the tools": actions_of_tools(),
        "Where a panel has the keys": acts.TURNS, "Help": acts.HELP,
    }  # fmt: skip
    parts = []
    for title, group in groups.items():
        rows = [f"| {_plain(act.text)} | {_keys(act.keys)} | {_plain(act.tip)} |" for act in group]
        parts.append(f"## {title}\n\n| Command | Keys | Effect |\n| --- | --- | --- |\n{chr(10).join(rows)}\n")
    return {"reference/keys.md": INTRODUCTION + "\n".join(parts)}


def _plain(text: str) -> str:
    return text.replace("&", "").replace("|", r"\|").replace("*", r"\*")


def _keys(keys: tuple[str, ...]) -> str:
    return ", ".join(f"{{kbd}}`{key}`" for key in keys if key)
