"""A surface with a field in a VTK renderer, for the window's panels and for figures alike.  No Qt."""
