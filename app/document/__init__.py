"""What is shown, as plain data: the document, its edits, its history, its files.  Neither Qt nor VTK."""
