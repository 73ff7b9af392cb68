"""Mesh files and files of fields, one reader or writer each."""
