/* Nested dissection: in which order to eliminate the vertices of a graph so that little fill appears.
 *
 * A region is cut in two by a small separator, each half again, down to LEAF vertices.  Where to cut is read off charts
 * of the vertices: positions fail on folded sheets, so edge counts to far-apart landmarks are tried as well: they see
 * along the surface, in the measure that separators are paid in. */
#include "kernel.h"

enum {
  LEAF = 24,    /* most vertices of a region that is not cut */
  SMALL = 150,  /* up to so many, regions are cut by positions alone */
  LARGE = 3000, /* from so many on, separators are made as small as can be */
  SAMPLE = 200, /* so many vertices of a region tell its principal axes */
  BINS = 512,   /* places where a cut along an axis is tried */
  REACH = 2,    /* how many edges from the cut a separator may move */
  POSITIONS = 3,
  LANDMARKS = 4
};
static const double UNEVEN = 0.12; /* a half may differ by this fraction of the region from one half */

/* ------------------------------------------------------------------ the graph, numbered breadth first */

/* Number vertices breadth first from `from`, in `order`; hops: edge counts.  Further components begin two further out. */
static void breadth_first(const Rows *g, i64 from, i32 *hops, i32 *order) {
  i64 tail = 0, head = 0;
  i32 start = 0;
  for (i64 v = 0; v < g->n; v++) hops[v] = -1;
  for (i64 next = 0; tail < g->n; from = next) {
    while (hops[from] >= 0) from = next++;
    hops[from] = start, order[tail++] = (i32)from;
    for (; head < tail; head++)
      for (i64 v = order[head], e = g->start[v]; e < g->start[v + 1]; e++) {
        i32 u = g->index[e];
        if (hops[u] < 0) hops[u] = hops[v] + 1, order[tail++] = u;
      }
    start = hops[order[tail - 1]] + 2;
  }
}

/* Whether each entry has its mirror image; rows ascend.  cursor: (n,). */
static i32 check_symmetric(const Rows *g, i32 *cursor) {
  for (i64 v = 0; v < g->n; v++) cursor[v] = g->start[v];
  for (i64 v = 0; v < g->n; v++)
    for (i64 e = g->start[v]; e < g->start[v + 1]; e++) {
      i32 u = g->index[e];
      if (u < v && (cursor[u] >= g->start[u + 1] || g->index[cursor[u]++] != v)) return ASYMMETRIC;
      if (u <= v) cursor[v] = (i32)(e + 1);
    }
  for (i64 v = 0; v < g->n; v++)
    if (cursor[v] != g->start[v + 1]) return ASYMMETRIC;
  return DONE;
}

/* Positions x (n, 3) as charts, moved and scaled as a whole into [-1, 1]: as they are, single precision might not hold
 * them, nor doubles their squares. */
static void chart_positions(Dissection *D, const double *x) {
  double middle[POSITIONS], size = 0;
  i64 n = D->graph.n;
  for (int a = 0; a < POSITIONS; a++) {
    double low = x[a], high = x[a];
    for (i64 v = 1; v < n; v++) {
      double value = x[POSITIONS * v + a];
      low = value < low ? value : low, high = value > high ? value : high;
    }
    middle[a] = low / 2 + high / 2;
    if (high / 2 - low / 2 > size) size = high / 2 - low / 2;
  }
  for (int a = 0; a < POSITIONS; a++)
    for (i64 k = 0; k < n; k++)
      D->charts[a * n + k] = (float)((x[POSITIONS * (i64)D->numbers[k] + a] - middle[a]) / (size > 0 ? size : 1));
}

/* Fill in the graph of a matrix without its diagonal, numbered breadth first, and its charts; x (n, 3).  bin, band, at
 * and key are workspace. */
static void number_graph(Dissection *D, const Rows *matrix, const double *x, i32 *start, i32 *index) {
  i64 n = matrix->n, put = 0;
  i32 *vertices = D->numbers, *place = D->bin;
  float *far = D->key;
  breadth_first(matrix, 0, D->band, vertices);
  for (i64 k = 0; k < n; k++) place[vertices[k]] = (i32)k;
  for (i64 k = 0; k < n; k++) {
    start[k] = (i32)put;
    for (i64 v = vertices[k], e = matrix->start[v]; e < matrix->start[v + 1]; e++)
      if (matrix->index[e] != v) index[put++] = place[matrix->index[e]];
  }
  start[n] = (i32)put;
  chart_positions(D, x);
  if (n <= SMALL) return;
  i64 from = n - 1; /* a far end to begin from */
  for (int a = 0; a < LANDMARKS; a++) {
    float *chart = D->charts + (POSITIONS + a) * n;
    breadth_first(&D->graph, from, D->band, D->at);
    from = 0;
    for (i64 v = 0; v < n; v++) {
      chart[v] = (float)D->band[v];
      far[v] = a && far[v] < chart[v] ? far[v] : chart[v];
      if (far[v] > far[from]) from = v;
    }
  }
}

/* ------------------------------------------------------------------ where to cut */

/* The first axis of the covariance C by power iteration; it is then taken out of C. */
static void principal_axis(double C[4][4], int d, double *axis) {
  double length = 0, next[4];
  for (int k = 0; k < d; k++) axis[k] = 1 - 0.1 * k;
  for (int round = 0; round < 24; round++) {
    length = 0;
    for (int i = 0; i < d; i++) {
      next[i] = 0;
      for (int j = 0; j < d; j++) next[i] += C[i][j] * axis[j];
      length += next[i] * next[i];
    }
    if (!(length > 0)) return;
    length = __builtin_sqrt(length);
    for (int i = 0; i < d; i++) axis[i] = next[i] / length;
  }
  for (int i = 0; i < d; i++)
    for (int j = 0; j < d; j++) C[i][j] -= length * axis[i] * axis[j];
}

static void covariance(const Dissection *D, i64 lo, i64 hi, const float *chart, int d, double C[4][4]) {
  double mean[4] = {0}, count = 0;
  i64 step = most(1, (hi - lo) / SAMPLE), n = D->graph.n;
  for (i64 t = lo; t < hi; t += step, count++)
    for (int k = 0; k < d; k++) mean[k] += chart[k * n + D->vertices[t]];
  for (int k = 0; k < d; k++) mean[k] /= count;
  for (i64 t = lo; t < hi; t += step)
    for (int k = 0; k < d; k++)
      for (int l = 0; l < d; l++)
        C[k][l] += (chart[k * n + D->vertices[t]] - mean[k]) * (chart[l * n + D->vertices[t]] - mean[l]);
}

/* side = 0 or 1: across a principal axis of a chart, where the fewest edges are cut. */
static void halve(Dissection *D, Region r) {
  i64 m = r.hi - r.lo, n = D->graph.n;
  const i32 *vertices = D->vertices + r.lo;
  i64 bins = least(BINS, 2 * m);
  double best = 1e300;
  for (i64 t = 0; t < m; t++) D->side[vertices[t]] = t >= m / 2;
  for (int by_hops = 0; by_hops < (m > SMALL ? 2 : 1); by_hops++) {
    int d = by_hops ? LANDMARKS : POSITIONS;
    const float *chart = D->charts + (by_hops ? POSITIONS * n : 0);
    double C[4][4] = {{0}}, axis[4];
    covariance(D, r.lo, r.hi, chart, d, C);
    for (int tried = 0; tried <= by_hops; tried++) {
      i32 here[BINS], cut[BINS];
      zero(here, 4 * bins), zero(cut, 4 * bins);
      principal_axis(C, d, axis);
      float low = 3e38f, high = -3e38f;
      for (i64 t = 0; t < m; t++) {
        i32 v = vertices[t];
        float key = 0;
        for (int k = 0; k < d; k++) key += (float)axis[k] * chart[k * n + v];
        D->key[v] = key, low = key < low ? key : low, high = key > high ? key : high;
      }
      /* in double precision: beside a vertex much farther away, others have keys that differ by next to nothing */
      double scale = high > low ? (double)(bins - 1) / ((double)high - low) : 0;
      for (i64 t = 0; t < m; t++) {
        i32 v = vertices[t];
        here[D->bin[v] = (i32)(((double)D->key[v] - low) * scale)]++;
      }
      for (i64 e = r.edge; e < r.edge_end; e++) {
        i32 p = D->bin[D->edges[2 * e]], q = D->bin[D->edges[2 * e + 1]];
        cut[p < q ? p : q]++, cut[p < q ? q : p]--;
      }
      i64 run = 0, across = 0, at = -1;
      for (i64 b = 0; b < bins - 1; b++) {
        run += here[b], across += cut[b];
        double off = (double)run / (double)m - 0.5, far = off < 0 ? -off : off;
        double cost = (double)(across + 1) * (1 + 2 * far);
        if (far < UNEVEN && cost < best) best = cost, at = b;
      }
      if (at >= 0)
        for (i64 t = 0; t < m; t++) D->side[vertices[t]] = D->bin[vertices[t]] > at;
    }
  }
}

/* ------------------------------------------------------------------ separators */
enum { NONE = -1, RIM = -2 };

typedef struct {
  const Dissection *D;
  i64 lo, k;       /* the region's first place; how many vertices the band has */
  i32 *next, *prev; /* (k,) along the disjoint paths found so far */
  i32 *seen;       /* (2 k,) the round in which an entry 2 b or an exit 2 b + 1 was last reached */
  i32 *edge;       /* (k,) the next edge to try from an exit */
  i32 *path;       /* (2 k,) the path under way */
  i32 *flags;      /* (k,) 1: at the band's rim, 2: on a path */
  i32 round;
} Flow;

static int inside(const Flow *w, i32 u) {
  return __atomic_load_n(&w->D->region[u], __ATOMIC_RELAXED) == w->lo && w->D->at[u] >= 0;
}

/* Depth first from the rim at s on side 0 to the rim on side 1, along what is left; the path's length, or 0. */
static i64 find_path(Flow *w, i64 s) {
  const Dissection *D = w->D;
  i64 length = 1;
  w->path[0] = (i32)(2 * s), w->seen[2 * s] = w->round;
  while (length) {
    i32 x = w->path[length - 1], b = x >> 1, to = NONE;
    int full = w->flags[b] & 2;
    if (!(x & 1)) { /* at an entry: through the vertex, or back along the path that passes it */
      to = !full ? x + 1 : w->prev[b] >= 0 ? 2 * w->prev[b] + 1 : NONE;
      if (to >= 0 && w->seen[to] == w->round) to = NONE;
      else if (to >= 0) w->edge[to >> 1] = D->graph.start[D->band[w->lo + (to >> 1)]];
    } else {
      i64 v = D->band[w->lo + b];
      if ((w->flags[b] & 1) && D->side[v] && w->next[b] != RIM) break;
      if (full && w->seen[x - 1] != w->round) to = x - 1;
      for (; to < 0 && w->edge[b] < D->graph.start[v + 1]; w->edge[b]++) {
        i32 u = D->graph.index[w->edge[b]];
        if (inside(w, u) && w->seen[2 * D->at[u]] != w->round) to = 2 * D->at[u];
      }
    }
    if (to < 0) length--;
    else w->seen[to] = w->round, w->path[length++] = to;
  }
  return length;
}

/* Add a path: first take back what it runs against, then lay it. */
static void lay_path(Flow *w, i64 length) {
  const i32 *path = w->path;
  for (i64 t = 0; t + 1 < length; t++) {
    i32 x = path[t], y = path[t + 1], b = x >> 1, c = y >> 1;
    if (b == c) w->flags[b] = (w->flags[b] & 1) | (x & 1 ? 0 : 2);
    else if (!(x & 1)) {
      if (w->next[c] == b) w->next[c] = NONE;
      if (w->prev[b] == c) w->prev[b] = NONE;
    }
  }
  for (i64 t = 0; t + 1 < length; t++) {
    i32 b = path[t] >> 1, c = path[t + 1] >> 1;
    if ((path[t] & 1) && b != c) w->next[b] = c, w->prev[c] = b;
  }
  w->prev[path[0] >> 1] = RIM, w->next[path[length - 1] >> 1] = RIM;
}

/* side = 2 for the fewest vertices that part the sides, within `reach` edges of the cut; a vertex cover of the cut
 * (Koenig) if reach is 0.  By Menger's theorem: as many as disjoint paths through that band, where each of its vertices
 * is an entry and an exit.  0, and nothing is changed, if the sides would get too uneven. */
static int separate(Dissection *D, Region r, int reach) {
  const Rows *g = &D->graph;
  i64 lo = r.lo, hi = r.hi;
  i64 k = 0, done = 0, count[3] = {0};
  i32 *band = D->band + lo, *at = D->at;
  for (i64 e = r.edge; e < r.edge_end; e++) {
    i32 ends[2] = {D->edges[2 * e], D->edges[2 * e + 1]};
    if (D->side[ends[0]] == D->side[ends[1]]) continue;
    for (int k_end = 0; k_end < 2; k_end++)
      if (at[ends[k_end]] < 0) at[ends[k_end]] = (i32)k, band[k++] = ends[k_end];
  }
  for (int step = 0; step < reach; step++)
    for (i64 stop = k; done < stop; done++)
      for (i64 v = band[done], e = g->start[v]; e < g->start[v + 1]; e++) {
        i32 u = g->index[e];
        if (__atomic_load_n(&D->region[u], __ATOMIC_RELAXED) == lo && at[u] < 0) at[u] = (i32)k, band[k++] = u;
      }
  i32 *f = D->flow + 8 * lo;
  Flow w = {D, lo, k, f, f + k, f + 2 * k, f + 4 * k, f + 5 * k, f + 7 * k, 0};
  for (i64 b = 0; b < k; b++) {
    i64 v = band[b];
    w.next[b] = w.prev[b] = NONE, w.seen[2 * b] = w.seen[2 * b + 1] = 0, w.flags[b] = !reach;
    for (i64 e = g->start[v]; e < g->start[v + 1]; e++) {
      i32 u = g->index[e];
      w.flags[b] |= __atomic_load_n(&D->region[u], __ATOMIC_RELAXED) == lo && at[u] < 0;
    }
  }
  for (int found = 1; found;) {
    found = 0, w.round++;
    for (i64 s = 0; s < k; s++) {
      if (!(w.flags[s] & 1) || D->side[band[s]] || w.seen[2 * s] == w.round) continue;
      i64 length = find_path(&w, s);
      if (length) lay_path(&w, length), found = 1;
    }
  }
  i32 *part = w.edge; /* side 0 is what the last round reached */
  for (i64 b = 0; b < k; b++) part[b] = w.seen[2 * b + 1] == w.round ? 0 : w.seen[2 * b] == w.round ? 2 : 1;
  for (i64 t = lo; t < hi; t++) {
    i32 v = D->vertices[t];
    count[at[v] < 0 ? D->side[v] : part[at[v]]]++;
  }
  int good = !reach || least(count[0], count[1]) * 4 >= hi - lo;
  for (i64 b = 0; b < k; b++) {
    if (good) D->side[band[b]] = (unsigned char)part[b];
    at[band[b]] = -1;
  }
  return good;
}

/* ------------------------------------------------------------------ the recursion */

/* Bytes of a dissection of a matrix with so many rows and entries. */
API i64 bih_dissection_room(i64 n, i64 entries) { return (i64)sizeof(Dissection) + 4 * (23 * n + 1 + 3 * entries) + n; }

/* Begin to dissect a symmetric matrix' graph, all of its vertices in one region; x (n, 3), finite.
 * D: as many bytes as bih_dissection_room says.  Returns how many edges there are, ASYMMETRIC if entries have no mirror
 * image. */
API i64 bih_begin_dissection(const Rows *matrix, const double *x, Dissection *D) {
  i64 n = matrix->n, entries = matrix->start[n], count = 0;
  i32 *free = (i32 *)(D + 1);
  i32 **const ints[] = {&D->numbers, &D->vertices, &D->region, &D->bin, &D->band, &D->at};
  for (int k = 0; k < 6; k++) *ints[k] = free, free += n;
  i32 *start = free, *index = start + n + 1;
  D->edges = index + entries, D->spare = D->edges + entries, D->flow = D->spare + entries;
  D->charts = (float *)(D->flow + 8 * n), D->key = D->charts + 7 * n, D->side = (unsigned char *)(D->key + n);
  if (check_symmetric(matrix, D->at)) return ASYMMETRIC;
  D->graph = (Rows){n, start, index, NULL};
  if (n) number_graph(D, matrix, x, start, index);
  for (i64 v = 0; v < n; v++) {
    D->vertices[v] = (i32)v, D->region[v] = 0, D->at[v] = -1;
    for (i64 e = start[v]; e < start[v + 1]; e++)
      if (index[e] < v) D->edges[2 * count] = index[e], D->edges[2 * count++ + 1] = (i32)v;
  }
  return count;
}

/* The order of elimination: vertices (n,), as the matrix numbers them, and the place (n,) of each. */
API void bih_end_dissection(const Dissection *D, i32 *vertices, i32 *place) {
  for (i64 k = 0; k < D->graph.n; k++) vertices[k] = D->numbers[D->vertices[k]], place[vertices[k]] = (i32)k;
}

/* Cut a region in halves[0], halves[1] and the separator after both; 0 if it is not cut. */
API i32 bih_cut(Dissection *D, const Region *whole, Region *halves) {
  Region r = *whole;
  i64 count[3] = {0}, put[3];
  if (r.hi - r.lo <= LEAF) return 0;
  halve(D, r);
  if (r.hi - r.lo <= LARGE || !separate(D, r, REACH)) separate(D, r, 0);
  for (i64 t = r.lo; t < r.hi; t++) count[D->side[D->vertices[t]]]++;
  if (!count[0] || !count[1]) return 0;
  put[0] = r.lo, put[1] = r.lo + count[0], put[2] = put[1] + count[1];
  halves[0] = (Region){put[0], put[1], r.edge, r.edge}, halves[1] = (Region){put[1], put[2], 0, 0};
  for (i64 t = r.lo; t < r.hi; t++) {
    i32 v = D->vertices[t];
    int side = D->side[v];
    D->band[put[side]++] = v;
    __atomic_store_n(&D->region[v], side == 2 ? -1 : (i32)halves[side].lo, __ATOMIC_RELAXED);
  }
  copy(D->vertices + r.lo, D->band + r.lo, 4 * (r.hi - r.lo));
  i64 left = r.edge, right = r.edge;
  for (i64 e = r.edge; e < r.edge_end; e++) {
    i32 u = D->edges[2 * e], v = D->edges[2 * e + 1];
    int side = D->side[u];
    if (side != D->side[v] || side == 2) continue;
    if (side) D->spare[2 * right] = u, D->spare[2 * right++ + 1] = v;
    else D->edges[2 * left] = u, D->edges[2 * left++ + 1] = v;
  }
  copy(D->edges + 2 * left, D->spare + 2 * r.edge, 8 * (right - r.edge));
  halves[0].edge_end = halves[1].edge = left, halves[1].edge_end = left + right - r.edge;
  return 1;
}

/* Dissect a region to the end.  Appends its fronts in postorder: last[q], one past the last pivot, and how many fronts its
 * left child's subtree and its right child's have (0 for leaves); returns how many there are by then, STOPPED if told to
 * stop. */
API i64 bih_dissect(Dissection *D, const Region *r, i64 fronts, i32 *last, i32 *subtrees, Watch *watch) {
  Region halves[2];
  i64 begin = fronts, end[2] = {fronts, fronts}, separator = r->lo;
  if (stopped(watch)) return STOPPED;
  if (bih_cut(D, r, halves)) {
    for (int k = 0; k < 2; k++) {
      fronts = end[k] = bih_dissect(D, halves + k, fronts, last, subtrees, watch);
      if (fronts < 0) return fronts;
    }
    separator = halves[1].hi;
  }
  advance(watch, r->hi - separator);
  last[fronts] = (i32)r->hi, subtrees[2 * fronts] = (i32)(end[0] - begin);
  subtrees[2 * fronts + 1] = (i32)(end[1] - end[0]);
  return fronts + 1;
}

/* All of it on one thread: vertices and place (n,) as bih_end_dissection has them, last (2 n + 1,) and subtrees
 * (2 n + 1, 2) as bih_dissect; returns how many fronts there are, ASYMMETRIC if entries have no mirror image. */
API i64 bih_order(const Rows *matrix, const double *x, Dissection *D, i32 *vertices, i32 *place, i32 *last, i32 *subtrees) {
  Watch watch = {0, 0};
  i64 edges = bih_begin_dissection(matrix, x, D);
  if (edges < 0) return edges;
  i64 fronts = bih_dissect(D, &(Region){0, matrix->n, 0, edges}, 0, last, subtrees, &watch);
  bih_end_dissection(D, vertices, place);
  return fronts;
}
