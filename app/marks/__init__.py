"""Marks on surfaces as data: points with glyphs, lines, faces.  The window and figures draw these alike."""
