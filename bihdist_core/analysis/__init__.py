"""What is made of distances: samples, interpolation, correspondence, isolines, extrema, diagnostics, all pairs."""
