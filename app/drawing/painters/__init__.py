"""The painters of shapes: Qt for the window, matplotlib for figures, JSON for web pages."""
