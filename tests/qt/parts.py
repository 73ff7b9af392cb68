"""The parts of a window, by their names."""

from importlib import import_module

WHERE = {
    "brushing": "qt.docks.brushing:Brushing",
    "changes": "qt.changes:Changes",
    "choices": "qt.choices:Choices",
    "curve_files": "qt.files.curve_files:CurveFiles",
    "docks": "qt.docks.docks:Docks",
    "dragging": "qt.dragging:Dragging",
    "exports": "qt.files.exports:Exports",
    "field_files": "qt.files.field_files:FieldFiles",
    "files": "qt.files.files:Files",
    "gestures": "qt.gestures:Gestures",
    "guide": "qt.guide:Guide",
    "held_keys": "qt.held_keys:HeldKeys",
    "isolines": "qt.choices:IsolineChoices",
    "pairs": "tools.correspondence.gestures:PairGestures",
    "repairs": "qt.files.mesh_repairs:MeshRepairs",
    "quality": "tools.quality.findings:QualityFindings",
    "regions": "tools.regions.findings:RegionFindings",
    "progress_display": "qt.progress_display:ProgressDisplay",
    "session_file": "qt.files.session_actions:SessionFile",
    "snapping": "qt.snapping:Snapping",
    "sources": "tools.source.gestures:SourceGestures",
    "typed_source": "qt.typed_source:TypedSource",
    "views": "qt.views:Views",
}


class Parts:
    """`parts(window).choices`, and so on."""

    def __init__(self, window):
        self._context = window.context

    def __getattr__(self, name):
        module, _, kind = WHERE[name].partition(":")
        return self._context[getattr(import_module(f"app.{module}"), kind)]


parts = Parts
