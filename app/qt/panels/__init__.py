"""A panel of the window, from the bottom up: the view and what lies over it, the head, the colour bar, the grid."""
