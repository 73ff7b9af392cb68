"""The viewer, the figures and the command line.

From the bottom up: state, lane, session (plain Python); scene and picking (VTK); the figures: what they are
(figure_description), their pieces (figure_*, vector_*) and the whole (figures), recipes and movies; paper (the paper's
figures on one page); qt (the window); main (the command line, which wires everything).  Only qt and main know Qt.
"""
