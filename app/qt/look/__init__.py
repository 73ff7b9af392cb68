"""How the window looks: colours, icons, and how numbers are written."""
