"""Linear algebra: a factor that is computed once, diagonals of inverses, eigenpairs.  Matrices only, no meshes."""
