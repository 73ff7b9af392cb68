"""Parts of documents that several tools use, which do not import each other."""
