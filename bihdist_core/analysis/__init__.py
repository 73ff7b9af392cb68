"""Analysis of distances: samples, regions, paths, isolines, statistics, quality, interpolation, all pairs."""
