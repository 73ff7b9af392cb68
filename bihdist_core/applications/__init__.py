"""Applications of distances (section 5 of the paper): interpolation, correspondence, robustness."""
