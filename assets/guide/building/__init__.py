"""What makes the guide's pages: blocks that run, and what is written of the program itself."""
