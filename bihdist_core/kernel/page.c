/* A connected mesh in a web page: its distances, with all arrays in the module's own memory, one after the other from
 * the end of its stack on.  An instance of the module is for one mesh.
 *
 * A page calls page_begin, fills in what page_array has of points and faces, calls page_measure, corrects weights and
 * areas at degenerate faces, and calls page_order and page_factor; then page_field as often as it likes.  With matrices of
 * its own it calls page_matrix instead of page_measure, and fills in rows and areas.  After page_order it may also call
 * page_shift, and page_resolvent as often.  For geodesic distance it calls page_unfold, and page_geodesic as often. */
#ifdef __wasm__
#include "geodesic.h"

/* What page_array has. */
enum { POINTS, FACES, WEIGHTS, AREAS, BIHARMONIC, COMMUTE_TIME, GEODESIC, RESOLVENT, START, INDEX, VALUE };

enum { PIN = 0, MOST_NEAR = 16 };

#define EXPORT(name) __attribute__((export_name(#name)))

extern unsigned char __heap_base;
static unsigned char *end = &__heap_base;

static i32 n, m;
static double *points, *weights, *areas, *field[3]; /* (n, 3), (3, m), (n,), (n,) each */
static double *diagonal, *sandwich, *u;              /* (n,) of G, of C = G A G - u u^T / total, and G A 1 */
static double total;                                 /* area */
static i32 *faces, *place, *order, fronts;
static i64 totals[5];
static double *work, *xy, *resolvent; /* resolvent (2 n,) */
static i32 *count;
static Rows stiffness, matrix; /* L; without row and column PIN, but for a 1 where they meet */
static Tree tree;
static Factor factor;
static Mesh mesh;
static Run run;
static Round whole; /* of one part, all in one round */

/* So many bytes, in whole registers; a page that gets no more memory ends here. */
static void *take(i64 bytes) {
  unsigned char *found = end;
  end += (bytes + 15) & ~(i64)15;
  i64 pages = (((i64)(size_t)end + 65535) >> 16) - (i64)__builtin_wasm_memory_size(0);
  if (pages > 0 && __builtin_wasm_memory_grow(0, (size_t)pages) == (size_t)-1) __builtin_trap();
  return found;
}
static double *take_doubles(i64 k) { return take(8 * k); }
static i32 *take_ints(i64 k) { return take(4 * k); }
static i64 *take_longs(i64 k) { return take(8 * k); }

EXPORT(page_begin) void page_begin(i32 vertices, i32 triangles) {
  n = vertices, m = triangles;
  points = take_doubles(3 * n), faces = take_ints(3 * m);
  weights = take_doubles(3 * m), areas = take_doubles(n);
  for (int k = 0; k < 3; k++) field[k] = take_doubles(n);
}

EXPORT(page_array) const void *page_array(i32 which) {
  switch (which) {
  case POINTS: return points;
  case FACES: return faces;
  case WEIGHTS: return weights;
  case AREAS: return areas;
  case RESOLVENT: return resolvent;
  case START: return stiffness.start;
  case INDEX: return stiffness.index;
  case VALUE: return stiffness.value;
  default: return field[which - BIHARMONIC];
  }
}

/* Half the cotangents of the faces' corners, and vertex areas: mixed Voronoi, or barycentric. */
EXPORT(page_measure) void page_measure(i32 barycentric) {
  unsigned char *before = end;
  i64 *wide = take_longs(3 * m);
  double *area = take_doubles(m), *longest_square = take_doubles(m), *square = take_doubles(3 * m);
  for (i64 k = 0; k < 3 * m; k++) wide[k] = faces[k];
  bih_measures(m, points, wide, area, longest_square);
  bih_corners(m, points, wide, area, weights, square);
  zero(areas, 8 * n);
  if (!barycentric) bih_voronoi_areas(m, wide, weights, square, area, areas);
  for (i64 k = 0; k < 3 * m; k++) {
    if (barycentric) areas[faces[k]] += area[k / 3] / 3;
    weights[k] /= 2;
  }
  end = before;
}

/* Room for the rows of a stiffness matrix that is not of the faces, with so many entries. */
EXPORT(page_matrix) void page_matrix(i32 entries) {
  stiffness = (Rows){n, take_ints(n + 1), take_ints(entries), take_doubles(entries)};
}

/* The stiffness matrix of the faces. */
static void assemble(void) {
  i32 *start = take_ints(n + 1), *index = take_ints(n + 9 * m);
  double *value = take_doubles(n + 9 * m);
  i64 *wide = take_longs(3 * m);
  for (i64 k = 0; k < 3 * m; k++) wide[k] = faces[k];
  i64 entries = bih_stiffness(n, m, wide, weights, start, index, value, take_ints(3 * n + 1));
  end = (unsigned char *)index;
  index = take_ints(entries); /* where it is, but shorter */
  double *from = value;
  value = take_doubles(entries);
  for (i64 e = 0; e < entries; e++) value[e] = from[e];
  stiffness = (Rows){n, start, index, value};
}

/* The matrices, and the order and layout of their elimination. */
EXPORT(page_order) i32 page_order(void) {
  if (!stiffness.n) assemble();
  const i32 *start = stiffness.start, *index = stiffness.index;
  i64 entries = start[n];
  double *pinned = take_doubles(entries);
  for (i64 v = 0; v < n; v++)
    for (i64 e = start[v]; e < start[v + 1]; e++)
      pinned[e] = v == PIN || index[e] == PIN ? v == index[e] : stiffness.value[e];
  matrix = (Rows){n, start, index, pinned};

  i32 *last = take_ints(2 * n + 1), *subtrees = take_ints(4 * n + 2);
  order = take_ints(n), place = take_ints(n);
  unsigned char *before = end;
  i64 found = bih_order(&matrix, points, take(bih_dissection_room(n, entries)), order, place, last, subtrees);
  end = before;
  if (found < 0) return (i32)found;
  fronts = (i32)found;

  tree = (Tree){.n = n, .fronts = fronts, .vertices = order, .place = place};
  tree.first = take_ints(fronts + 1), tree.children = take_ints(2 * fronts), tree.parent = take_ints(fronts);
  tree.bound = take_longs(fronts + 1), tree.pivot_block = take_longs(fronts + 1);
  tree.row_block = take_longs(fronts + 1), tree.stack = take_longs(fronts + 1);
  tree.inverse = take_longs(fronts + 1), tree.top = take(fronts), tree.rank = take_ints(n);
  found = NO_ROOM, before = end;
  for (i64 room = 12 * n + 128; found == NO_ROOM; room *= 2) {
    end = before;
    tree.rows = take_ints(room), tree.up = take_ints(room);
    found = bih_lay_out(&matrix, &tree, last, subtrees, 0, room, take_ints(3 * n), totals);
  }
  end = before;
  tree.rows = take_ints(found);
  i32 *up = tree.up;
  tree.up = take_ints(found);
  for (i64 e = 0; e < found; e++) tree.up[e] = up[e];
  work = take_doubles((totals[4] + 8) * MOST_NEAR + 8), xy = take_doubles(2 * n), count = take_ints(fronts);
  resolvent = take_doubles(2 * n);
  return DONE;
}

/* The factor, the diagonals of G and C, and u.  NOT_POSITIVE: the faces are too thin. */
EXPORT(page_factor) i32 page_factor(void) {
  double *ordered = take_doubles(n);
  total = 0;
  for (i64 v = 0; v < n; v++) total += areas[v];
  for (i64 p = 0; p < n; p++) ordered[p] = order[p] == PIN ? 0 : areas[order[p]];
  double *K = take_doubles(totals[0] + tree.pivot_block[fronts] + 8);
  double *N = take_doubles(totals[1] + tree.row_block[fronts] + 8);
  factor = (Factor){&tree, ordered, K, N, DERIVATIVE};
  diagonal = take_doubles(n), sandwich = take_doubles(n), u = take_doubles(n);
  unsigned char *before = end;
  i64 where[2];
  i32 status = bih_factor(&factor, &matrix, take_doubles(bih_factor_room(&tree, DERIVATIVE, 1)), diagonal, sandwich, where);
  end = before;
  if (status) return status;
  bih_solve(&factor, 1, 1, areas, 1, u, 1, xy, work);
  diagonal[PIN] = u[PIN] = 0;
  for (i64 v = 0; v < n; v++) sandwich[v] -= u[v] * u[v] / total;
  return DONE;
}

/* Biharmonic distances to the nearest vertices again, as pairs: there a difference of the Green's function has few
 * digits left.  near (k,) vertices. */
static void measure_pairs(i32 source, const i32 *near, i32 k) {
  unsigned char *before = end;
  i64 w = k == 1 ? 1 : padded(k);
  double *b = take_doubles(n * k), *x = take_doubles(n * w);
  zero(b, 8 * n * k);
  for (i64 c = 0; c < k; c++) b[source * k + c] = 1, b[near[c] * k + c] = -1;
  bih_solve(&factor, k, w, b, k, b, k, x, work);
  for (i64 c = 0; c < k; c++) {
    double mean = 0, square = 0;
    b[PIN * k + c] = 0;
    for (i64 v = 0; v < n; v++) mean += areas[v] * b[v * k + c];
    mean /= total;
    for (i64 v = 0; v < n; v++) square += areas[v] * (b[v * k + c] - mean) * (b[v * k + c] - mean);
    field[0][near[c]] = __builtin_sqrt(square);
  }
  end = before;
}

/* Biharmonic and commute-time distances from a vertex; those shorter than `near` of the largest as pairs. */
EXPORT(page_field) void page_field(i32 source, double near) {
  Watch watch = {0, 0};
  double share = u[source] / total, largest = 0, limit, *biharmonic = field[0], *commute_time = field[1];
  i32 nearest[MOST_NEAR], k = 0;
  bih_send_units(&factor, &place[source], 1, 1, xy, count, work);
  bih_sweep_down_both(&factor, 0, fronts - 1, 1, xy, count, work, &watch);
  for (i64 v = 0; v < n; v++) largest = sandwich[v] > largest ? sandwich[v] : largest;
  limit = near * __builtin_sqrt(largest);
  for (i64 p = 0; p < n; p++) {
    i32 v = order[p];
    double square = sandwich[v] + sandwich[source] - 2 * (xy[2 * p + 1] - u[v] * share);
    double other = diagonal[v] + diagonal[source] - 2 * (v == PIN || source == PIN ? 0 : xy[2 * p]);
    biharmonic[v] = __builtin_sqrt(square > 0 ? square : 0);
    commute_time[v] = __builtin_sqrt(other > 0 ? other : 0);
    if (v == source || biharmonic[v] >= limit) continue;
    i32 at = k < MOST_NEAR ? k++ : MOST_NEAR;
    for (; at > 0 && biharmonic[nearest[at - 1]] > biharmonic[v]; at--)
      if (at < MOST_NEAR) nearest[at] = nearest[at - 1];
    if (at < MOST_NEAR) nearest[at] = v;
  }
  if (k) measure_pairs(source, nearest, k);
  biharmonic[source] = commute_time[source] = 0;
}

static Factor shifted_factor(const double *block, i64 parts) {
  double *K = (double *)block + parts * n;
  return (Factor){&tree, NULL, K, K + parts * totals[0] + 8, parts == 1 ? SINGLE : IMAGINARY};
}

/* The diagonal of (L - z A)^-1, its real and, unless z is real, imaginary parts, and behind them the factor: in the memory
 * of another one of its kind, or (NULL) in memory of its own.  NULL: the faces are too thin. */
EXPORT(page_shift) double *page_shift(double real, double imaginary, double *block) {
  i64 parts = 1 + (imaginary != 0), where[2];
  if (!block) block = take_doubles(parts * (n + totals[0] + totals[1]) + 16);
  Factor shifted = shifted_factor(block, parts);
  unsigned char *before = end;
  double *value = take_doubles(stiffness.start[n]), *ordered = take_doubles(n);
  for (i64 p = 0; p < n; p++) ordered[p] = -imaginary * areas[order[p]];
  for (i64 v = 0; v < n; v++)
    for (i64 e = stiffness.start[v]; e < stiffness.start[v + 1]; e++)
      value[e] = stiffness.value[e] - (stiffness.index[e] == v ? real * areas[v] : 0);
  Rows of = {n, stiffness.start, stiffness.index, value};
  if (parts == 2) shifted.areas = ordered;
  double *room = take_doubles(bih_factor_room(&tree, shifted.second, 1));
  i32 status = bih_factor(&shifted, &of, room, block, block + n, where);
  end = before;
  return status ? NULL : block;
}

/* R_vv + R_ss - 2 R_vs for each v, R = (L - z A)^-1 by what page_shift returns: real parts, then imaginary ones. */
EXPORT(page_resolvent) void page_resolvent(const double *block, i32 is_complex, i32 source) {
  Watch watch = {0, 0};
  i64 parts = 1 + is_complex;
  Factor shifted = shifted_factor(block, parts);
  if (is_complex) {
    bih_send_units(&shifted, &place[source], 1, 1, xy, count, work);
    bih_sweep_down_both(&shifted, 0, fronts - 1, 1, xy, count, work, &watch);
  } else {
    zero(resolvent, 8 * n);
    resolvent[source] = 1;
    bih_solve(&shifted, 1, 1, resolvent, 1, resolvent, 1, xy, work);
  }
  for (i64 p = 0; p < n; p++)
    for (i64 k = 0, v = order[p]; k < parts; k++)
      resolvent[k * n + v] = block[k * n + v] + block[k * n + source] - 2 * xy[parts * p + k];
}

/* Get ready for geodesic distances; returns how many faces are degenerate, and if there are any it is of no use. */
EXPORT(page_unfold) i32 page_unfold(void) {
  mesh = (Mesh){n, m, take(3 * m * (i64)sizeof(Side)), take_ints(n + 1), take_ints(3 * m), take(n)};
  unsigned char *before = end;
  i64 degenerate = bih_geodesic_mesh(&mesh, points, faces, NULL, take_ints(3 * m), take_ints(3 * m), take_ints(n + 1));
  end = before;
  run = (Run){.mesh = &mesh, .round = &whole, .reached = take(n * (i64)sizeof(Reached)), .queue = take(3 * m * (i64)sizeof(Queue)),
              .heap = take((3 * m + n) * (i64)sizeof(Waiting)), .radius = __builtin_inf()};
  whole = (Round){.part = take(sizeof(Part)), .busy = take_ints(1), .parts = 1, .shift = 31, .threads = 1, .band = __builtin_inf()};
  return (i32)degenerate;
}

/* Room for the windows that a run needs, and a copy of those that there are. */
static void make_room(void) {
  if (run.needed) {
    i64 room = most(2 * run.windows, run.windows + run.needed);
    Window *windows = take(room * (i64)sizeof(Window));
    copy(windows, run.window, run.windows * (i64)sizeof(Window));
    run.window = windows, run.order = take_ints(room), run.spare = take_ints(room), run.windows = room;
  }
  if (run.crossings_needed > run.crossings - run.crossings_used) {
    i64 room = 2 * (run.crossings_used + run.crossings_needed);
    Crossing *crossings = take(room * (i64)sizeof(Crossing));
    copy(crossings, run.crossing, run.crossings_used * (i64)sizeof(Crossing));
    run.crossing = crossings, run.crossings = room;
  }
}

/* Exact geodesic distances from a vertex; TOO_MUCH if that takes more than so many windows. */
EXPORT(page_geodesic) i32 page_geodesic(i32 source, double most_windows) {
  Watch watch = {0, 0};
  const double offset = 0;
  i32 corner = mesh.corner[mesh.first[source]], face = corner / 3, status;
  double weight[3] = {0};
  weight[corner % 3] = 1;
  run.source = (Places){1, &face, weight, weight};
  run.offset = &offset, run.most_taken = (i64)most_windows;
  while ((status = bih_geodesic_begin(&run)) == NO_ROOM) make_room();
  while ((status = bih_geodesic_next(&run)) == MORE)
    while ((status = bih_geodesic_round(&run, &watch)) == NO_ROOM) make_room();
  for (i64 v = 0; v < n; v++) field[2][v] = run.reached[v].distance;
  return status;
}
#endif
