"""Figures and movies on pages: laid out, drawn off screen, written.  No Qt."""
