"""The public names of the library by topic, each of which is a page of the reference."""

import bihdist_core
from bihdist_core.distances.distance_types import BUILT_IN

DISTANCES = [name for each in BUILT_IN if (name := str(each.make).rpartition(":")[2]) in bihdist_core.__all__]

TOPICS: dict[str, tuple[str, str, list[str]]] = {
    "meshes": (
        "Meshes and files",
        "Surfaces, and what is read from and written to files.",
        ["Surface", "PointCloud", "TetrahedralMesh", "MeshLike", "read_surface", "sample", "write_mesh",
         "read_vertex_values", "Pins", "read_pins", "write_pins", "read_map", "write_map"],
    ),
    "distances": (
        "Distances",
        "The methods that all distances have, and each distance.",
        ["Distance", *DISTANCES, "difference", "Embedding", "DistanceType", "Parameter"],
    ),
    "sources": (
        "Sources",
        "A distance starts from a vertex, given by its id, or from one of these.",
        ["SurfacePoint", "BoundaryLoop", "Curve", "SourceSet", "source_from_words"],
    ),
    "operators": (
        "Operators and eigenpairs",
        "The operators and eigenpairs that distances are made of.",
        ["Laplacian", "Spectrum", "eigenpairs"],
    ),
    "graphs": (
        "Graphs and sparse inverses",
        "Distances between nodes, and entries of the inverse of a sparse matrix.",
        ["Graph", "read_graph", "kirchhoff_index", "biharmonic_index", "SparseFactor", "diagonal_of_inverse",
         "inverse_on_pattern"],
    ),
    "fields": (
        "Isolines, statistics and extrema",
        "Measurements of one field, or of two.",
        ["isolines", "Isoline", "write_isolines", "band", "Band", "field_statistics", "FieldStatistics",
         "field_agreement", "Agreement", "rank_correlation", "field_scatter", "FieldScatter", "field_change",
         "FieldChange", "extrema", "Extrema", "gradient_jumps", "GradientJumps"],
    ),
    "signatures": (
        "Signatures of vertices",
        "A value at each vertex that is the same in every pose: centrality, and diagonals of kernels.",
        ["centrality", "biharmonic_kernel_signature", "heat_kernel_signature", "wave_kernel_signature", "Signature"],
    ),
    "quality": (
        "Quality of a distance",
        "Triangle inequality, isotropy, extrema and kinks, and what truncation loses.",
        ["field_quality", "FieldQuality", "difference_quality", "geodesic_circles", "Circle", "isotropy_ratio",
         "other_extrema", "OtherExtrema", "apparent_source", "triangle_sample", "triangle_samples", "TriangleSample",
         "triangle_violations", "smallest_distance", "truncation_loss", "TruncationLoss"],
    ),
    "paths": (
        "Paths and profiles",
        "Curves on a surface, and fields along them.",
        ["GeodesicPaths", "plane_section", "SurfacePath", "Places", "write_profile"],
    ),
    "samples": (
        "Samples, neighbours, regions and parcels",
        "Vertices chosen by a distance, and surfaces divided by it.",
        ["farthest_points", "write_samples", "nearest", "tips", "at_tips", "voronoi_regions", "Regions",
         "region_boundaries", "Boundary", "region_mesh", "RegionMesh", "write_boundaries", "write_labels",
         "write_region_mesh", "parcel_means", "Parcels", "Brush", "cut_out", "write_selection"],
    ),
    "applications": (
        "Interpolation, correspondence, robustness",
        "Applications of distances, and changes to a mesh that test them.",
        ["ShepardInterpolant", "correspondence_prediction", "Correspondence", "map_errors", "error_curve", "ErrorCurve",
         "noisy", "with_holes", "with_handle", "welded", "simplified"],
    ),
    "pictures": (
        "Figures, web pages and the window",
        "What draws, and what opens the window.",
        ["figure", "figure_again", "LookOptions", "ViewOptions", "IsolineOptions", "MarkOptions", "LayoutOptions",
         "page", "widget", "show"],
    ),
    "errors": (
        "Errors",
        "The exceptions that the library raises.",
        ["BihdistError", "MeshError", "MissingFileError", "MissingInputError", "VertexError", "ParameterError",
         "SolverError", "OutputError", "NotEnoughMemory", "Cancelled"],
    ),
}  # fmt: skip
"""By word: title, what the page is about, and its names in order."""

RESULTS = {
    "figure": ["bihdist.figures.picture.Picture"],
    "page": ["bihdist.web.export.Page"],
    "show": [f"bihdist.qt.show.{name}" for name in ("Viewer", "ShownPanel", "Pick")],
    "widget": ["bihdist.web.distance_widget.DistanceWidget"],
}
"""Classes without a public name, on the page of the function that makes them."""
