"""What most pages import, before processes are forked for them; nothing here opens a display or a thread."""

import bihdist  # noqa: F401
import matplotlib.pyplot  # noqa: F401
import pyvista  # noqa: F401

import app.figures.export
import app.main  # noqa: F401
