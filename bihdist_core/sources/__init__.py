"""Sources of distances: vertices, places in faces, sets of them, boundary loops and curves, with their pieces."""
