"""Kinds of broken meshes, each a function of a random generator to vertices (n, 3) and faces (m, 3)."""

from . import edges, flat_faces, pieces, turned_faces, vertices

KINDS = edges.KINDS | turned_faces.KINDS | flat_faces.KINDS | vertices.KINDS | pieces.KINDS
"""All of them by their names."""
