"""What is marked on surfaces, as data: points with glyphs, lines, faces.  Windows and figures draw these alike."""
