"""The document that is shown, as plain data, with its edits, its history and its files.  Neither Qt nor VTK."""
