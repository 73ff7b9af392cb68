"""Where distances start: vertices, places in faces, sets of them, boundary loops and curves; and what they are made of
on a surface."""
