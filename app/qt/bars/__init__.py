"""The window's bars: menus, tool bar, status bar."""
