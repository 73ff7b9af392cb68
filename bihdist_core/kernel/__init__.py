"""The exact kernel in C, and its binding."""
