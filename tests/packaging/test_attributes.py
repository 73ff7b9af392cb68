"""What a widget asks of itself exists; mypy takes subclasses of Qt's classes for `Any` and does not check it."""

import ast
from pathlib import Path

from qtpy import QtCore, QtGui, QtWidgets

ROOT = Path(__file__).parents[2]
QT = {"QtCore": QtCore, "QtGui": QtGui, "QtWidgets": QtWidgets}


def classes():
    found = {}
    for path in sorted((ROOT / "app").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef):
                found.setdefault(node.name, []).append((path, node))
    return found


def names_in(node):
    """Names that the body of a class gives to attributes."""
    for each in ast.walk(node):
        if isinstance(each, ast.FunctionDef | ast.ClassDef):
            yield each.name
        elif isinstance(each, ast.Attribute | ast.Name) and isinstance(each.ctx, ast.Store):
            yield each.attr if isinstance(each, ast.Attribute) else each.id


def attributes(node, known):
    """Those of a class and its bases; None if one of them is neither ours nor Qt's."""
    found = {*dir(object), *names_in(node)}
    for base in node.bases:
        word = ast.unparse(base).partition("[")[0]
        module, _, name = word.rpartition(".")
        if module in QT:
            found.update(dir(getattr(QT[module], name)))
        elif word in known:
            inherited = [attributes(each, known) for _, each in known[word]]
            if None in inherited:
                return None
            found.update(*inherited)
        elif word not in ("Generic", "Protocol", "ABC"):
            return None
    return found


def missing(known):
    for name, places in known.items():
        for path, node in places:
            has = attributes(node, known)
            for each in ast.walk(node) if has is not None else ():
                if isinstance(each, ast.Attribute) and ast.unparse(each.value) == "self" and each.attr not in has:
                    yield f"{path.relative_to(ROOT)}:{each.lineno}: {name}.{each.attr}"


def test_what_a_class_asks_of_itself_exists():
    known = classes()
    assert sum(attributes(node, known) is not None for places in known.values() for _, node in places) > 300
    assert list(missing(known)) == []


def test_a_renamed_method_is_found():
    source = (
        "class Box(QtWidgets.QWidget):\n    def _fill(self): ...\n    def show_all(self): self._filled(); self.show()"
    )
    (node,) = ast.parse(source).body
    assert list(missing({"Box": [(ROOT / "app/box.py", node)]})) == ["app/box.py:3: Box._filled"]
