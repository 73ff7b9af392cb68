"""The window's own colours: white, so that only the surfaces have colour."""

from qtpy import QtWidgets

THUMBNAIL = 56


class LargeIcons(QtWidgets.QProxyStyle):
    """For menus whose icons are pictures."""

    def pixelMetric(self, metric, option=None, widget=None) -> int:
        if metric == QtWidgets.QStyle.PixelMetric.PM_SmallIconSize:
            return THUMBNAIL
        return super().pixelMetric(metric, option, widget)


# The labels' heights do not depend on whether there is a text: the pictures between them keep their size.
STYLE_SHEET = """
QMainWindow, QToolBar, QStatusBar, QMenuBar { background: #f6f7f8; }
QToolBar { border: none; border-bottom: 1px solid #dcdfe3; padding: 4px 6px; spacing: 6px; }
QStatusBar { border-top: 1px solid #dcdfe3; }
DistancePanel, PanelControls { background: white; }
QLabel#title { background: white; font-size: 15px; font-weight: 600; color: #21242a; }
QLabel#title { padding-top: 2px; min-height: 20px; }
QLabel#hint { background: white; font-size: 12px; color: #737880; padding-bottom: 4px; min-height: 17px; }
QLabel#value { background: white; font-size: 13px; color: #21242a; padding: 4px; min-height: 18px; }
"""
