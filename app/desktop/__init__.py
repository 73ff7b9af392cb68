"""The program on a Linux desktop: its entry in the menu, and the types of its files."""
