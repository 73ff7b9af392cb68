"""The style sheet of a window: all that Qt's own widgets need to look like the rest."""

from ...samples import SAMPLES
from .theme import Theme

ICONS = SAMPLES / "icons"


def style_sheet(theme: Theme, scale: float = 1.0) -> str:
    """scale: of letters, as a multiple of the usual size."""
    small = round(12 * scale)
    return f"""
QMainWindow, QDialog, QMessageBox {{ background: {theme.window}; color: {theme.text}; }}
QWidget {{ color: {theme.text}; }}
QWidget:disabled {{ color: {theme.disabled}; }}
QToolTip {{ background: {theme.raised}; color: {theme.text}; border: 1px solid {theme.strong}; padding: 3px 6px; }}

QMenuBar {{ background: {theme.window}; color: {theme.text}; border: none; padding: 1px 6px; }}
QMenuBar::item {{ background: transparent; padding: 4px 8px; border-radius: 5px; }}
QMenuBar::item:selected {{ background: {theme.hover}; }}
QMenuBar::item:pressed {{ background: {theme.pressed}; }}
QMenu {{ background: {theme.raised}; color: {theme.text}; border: 1px solid {theme.strong}; border-radius: 8px;
  padding: 4px; }}
QMenu::item {{ padding: 5px 24px 5px 12px; border-radius: 5px; background: transparent; }}
QMenu::item:selected {{ background: {theme.selection}; color: {theme.text}; }}
QMenu::item:disabled {{ color: {theme.disabled}; }}
QMenu::separator {{ height: 1px; background: {theme.border}; margin: 4px 8px; }}
QMenu::icon {{ padding-left: 8px; }}
QMenu::indicator {{ width: 14px; height: 14px; padding-left: 6px; }}

QToolBar {{ background: {theme.window}; border: none; border-bottom: 1px solid {theme.border}; spacing: 4px;
  padding: 0px 8px; }}
QToolBar::separator {{ background: {theme.border}; width: 1px; margin: 10px 6px; }}
QToolButton {{ background: transparent; color: {theme.text}; border: 1px solid transparent; border-radius: 6px;
  padding: 4px; }}
QToolButton:hover {{ background: {theme.hover}; }}
QToolButton:pressed, QToolButton:open {{ background: {theme.pressed}; }}
QToolButton:checked {{ background: {theme.selection}; }}
QToolButton:disabled {{ color: {theme.disabled}; }}
QToolButton::menu-indicator {{ image: none; }}
QToolButton[keys="true"]:focus {{ border: 2px solid {theme.accent}; padding: 3px; }}

QPushButton {{ background: {theme.raised}; color: {theme.text}; border: 1px solid {theme.strong}; border-radius: 6px;
  padding: 5px 12px; min-height: 18px; }}
QPushButton:hover {{ background: {theme.hover}; }}
QPushButton:pressed {{ background: {theme.pressed}; }}
QPushButton:focus {{ border: 2px solid {theme.accent}; padding: 4px 11px; }}
QPushButton:disabled {{ color: {theme.disabled}; border-color: {theme.border}; }}
QPushButton:default, QPushButton#fill, QToolButton#fill {{ background: {theme.fill}; color: {theme.on_fill};
  border: 1px solid {theme.fill}; }}
QPushButton:default:focus, QPushButton#fill:focus {{ border: 2px solid {theme.text}; }}
QPushButton#fill:disabled, QPushButton:default:disabled, QToolButton#fill:disabled {{ background: {theme.window};
  color: {theme.disabled}; border-color: {theme.border}; }}
QPushButton#link {{ background: transparent; border: none; color: {theme.accent}; padding: 2px; text-align: left; }}
QPushButton#link:hover {{ text-decoration: underline; }}
QPushButton#link:focus {{ border: 2px solid {theme.accent}; padding: 0px; border-radius: 4px; }}

QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox, QPlainTextEdit, QTextEdit, QTextBrowser {{ background: {theme.raised};
  color: {theme.text}; border: 1px solid {theme.strong}; border-radius: 5px; padding: 3px 6px;
  selection-background-color: {theme.selection}; selection-color: {theme.text}; }}
QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox {{ min-height: 20px; }}
QLineEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus, QComboBox:focus {{ border: 2px solid {theme.accent};
  padding: 2px 5px; }}
QLineEdit[wrong="true"] {{ border: 2px solid {theme.error}; padding: 2px 5px; }}
QLineEdit:disabled, QSpinBox:disabled, QComboBox:disabled {{ background: {theme.window}; color: {theme.disabled};
  border-color: {theme.border}; }}
QComboBox::drop-down {{ border: none; width: 20px; }}
QComboBox QAbstractItemView {{ background: {theme.raised}; color: {theme.text}; border: 1px solid {theme.strong};
  selection-background-color: {theme.selection}; selection-color: {theme.text}; outline: none; }}

QSlider::groove:horizontal {{ height: 2px; background: {theme.strong}; border-radius: 1px; }}
QSlider::sub-page:horizontal {{ height: 2px; background: {theme.accent}; border-radius: 1px; }}
QSlider::handle:horizontal {{ width: 10px; height: 10px; margin: -5px 0; border-radius: 6px;
  background: {theme.canvas}; border: 1px solid {theme.accent}; }}
QSlider::handle:horizontal:hover, QSlider::handle:horizontal:focus {{ background: {theme.accent}; }}

QCheckBox {{ spacing: 8px; }}
QProgressBar {{ background: {theme.border}; border: none; border-radius: 2px; max-height: 4px; }}
QProgressBar::chunk {{ background: {theme.accent}; border-radius: 2px; }}
QStatusBar {{ background: {theme.window}; border-top: 1px solid {theme.border}; color: {theme.quiet}; }}
QStatusBar::item {{ border: none; }}
QScrollBar:vertical {{ background: transparent; width: 10px; margin: 0; }}
QScrollBar:horizontal {{ background: transparent; height: 10px; margin: 0; }}
QScrollBar::handle {{ background: {theme.strong}; border-radius: 4px; min-height: 24px; min-width: 24px; margin: 1px; }}
QScrollBar::add-line, QScrollBar::sub-line {{ width: 0; height: 0; }}
QScrollArea {{ background: transparent; border: none; }}
QHeaderView::section {{ background: {theme.window}; color: {theme.quiet}; border: none;
  border-bottom: 1px solid {theme.border}; padding: 4px 8px; font-size: {small}px; }}
QTableView, QTableWidget, QListView, QTreeView {{ background: {theme.raised}; color: {theme.text};
  border: 1px solid {theme.border}; gridline-color: {theme.border}; selection-background-color: {theme.selection};
  selection-color: {theme.text}; alternate-background-color: {theme.window}; outline: none; }}
QLabel {{ background: transparent; }}
QLabel[quiet="true"] {{ color: {theme.quiet}; }}
QLabel[small="true"] {{ font-size: {small}px; }}
QLabel[error="true"] {{ color: {theme.error}; }}
"""
