"""Files that the window opens and writes: meshes, sessions, pictures, figures and movies."""
