"""Drawings in two dimensions beside and over surfaces: described once as shapes, and painted by painters."""
