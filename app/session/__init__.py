"""Open meshes, questions and answers, and the workers that compute these.  Neither Qt nor VTK."""
