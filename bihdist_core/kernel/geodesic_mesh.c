/* The mesh on which windows unfold: frames of its sides, rings of sides at edges, and where paths bend. */
#include "geodesic.h"

#define FLAT 1e-6        /* a corner whose sine is less is one of a flat face */
#define NEEDLE 4e-3      /* a corner whose sine is less: its vertex sends, see kind_of */
#define FULL_TURN 1e-10  /* radians by which a saddle's angle is more than 2 pi */

static void frame(Side *side, const double *p, const double *q, const double *r) {
  double e[3], w[3], dot = 0;
  for (int k = 0; k < 3; k++) e[k] = q[k] - p[k], w[k] = r[k] - p[k], dot += e[k] * w[k];
  double cx = e[1] * w[2] - e[2] * w[1], cy = e[2] * w[0] - e[0] * w[2], cz = e[0] * w[1] - e[1] * w[0];
  side->length = apart(p, q);
  side->x = dot / side->length, side->y = __builtin_sqrt(cx * cx + cy * cy + cz * cz) / side->length;
}

/* Whether a face has no height that arithmetic can tell from none. */
static int is_degenerate(const Side *side) {
  double longest = 0;
  for (int k = 0; k < 3; k++)
    if (side[k].length > longest) longest = side[k].length;
  return !(side->y * side->length > NO_HEIGHT * longest * longest);
}

static i32 end_of(const Side *side, i32 h, int high) {
  i32 a = side[h].vertex, b = side[next_side(h)].vertex;
  return (a < b) == high ? b : a;
}

static int meet(const Side *side, i32 g, i32 h) { /* whether two sides have the same ends */
  return end_of(side, g, 0) == end_of(side, h, 0) && end_of(side, g, 1) == end_of(side, h, 1);
}

/* Sides `from` (count,) in the order of their lower or higher ends, stable. */
static void sort_by_end(const Mesh *mesh, i64 count, const i32 *from, i32 *to, i32 *put, int high) {
  zero(put, 4 * (mesh->vertices + 1));
  for (i64 i = 0; i < count; i++) put[end_of(mesh->side, from[i], high) + 1]++;
  for (i64 v = 0; v < mesh->vertices; v++) put[v + 1] += put[v];
  for (i64 i = 0; i < count; i++) to[put[end_of(mesh->side, from[i], high)]++] = from[i];
}

/* Sides with the same ends in the order of their labels. */
static void sort_by_label(const Side *side, i64 count, i32 *a, const i32 *label) {
  for (i64 i = 1, j; i < count; i++) {
    i32 h = a[i];
    for (j = i; j > 0 && label[a[j - 1]] > label[h] && meet(side, a[j - 1], h); j--) a[j] = a[j - 1];
    a[j] = h;
  }
}

/* Whether the angle of a fan of corners is more than 2 pi: unit vectors turn, and half turns are counted. */
typedef struct {
  double c, s;
  i64 half;
} Turn;

static void turn_by(Turn *t, const Side *side) {
  double l = length_of(side->x, side->y), c = side->x / l, s = side->y / l, x = t->c * c - t->s * s;
  t->s = t->s * c + t->c * s, t->c = x;
  if (t->s < 0) t->half++, t->c = -t->c, t->s = -t->s;
}

/* Rays beside a vertex that are too few to be kept (NARROW) are more than what is seen all the same (CRACK) once they
 * have passed one of its needles: there it has to send, too. */
static unsigned char kind_of(const Mesh *mesh, i32 v, int on_boundary) {
  i64 lo = mesh->first[v], hi = mesh->first[v + 1], seen = 1;
  Turn turn = {1, 0, 0};
  for (i64 i = lo; i < hi; i++) {
    i32 h = mesh->corner[i];
    for (int k = 0; k < 3; k++, h = next_side(h)) {
      const Side *side = &mesh->side[h];
      if (!(side->y > (k ? FLAT : NEEDLE) * length_of(side->x, side->y))) return ANYWHERE;
    }
    turn_by(&turn, &mesh->side[mesh->corner[i]]);
  }
  i32 begin = mesh->corner[lo], corner;
  for (int way = 0; way < 2; way++)
    for (i32 e = way ? previous_side(begin) : begin; (e = turn_over(mesh, v, e, &corner)) >= 0; seen++) {
      if (corner == begin) {
        way = 2;
        break;
      }
      if (seen >= hi - lo) return ANYWHERE;
    }
  if (seen != hi - lo) return ANYWHERE;
  if (on_boundary) return turn.half ? BOUNDARY : CONVEX;
  return turn.half > 2 || (turn.half == 2 && (turn.s > FULL_TURN || turn.c < 0)) ? SADDLE : CONVEX;
}

/* X (vertices, 3), finite; faces (faces, 3), in range; one that names a vertex twice is none; label (3 faces,): sides
 * with the same ends but other labels are not joined, NULL if there are none such.  a, b (3 faces,) and put
 * (vertices + 1,): workspace.  Returns how many faces are degenerate: windows do not unfold there. */
API i64 bih_geodesic_mesh(const Mesh *mesh, const double *X, const i32 *faces, const i32 *label, i32 *a, i32 *b,
                           i32 *put) {
  i32 *first = mesh->first;
  i64 n = mesh->vertices, count = 0, degenerate = 0;
  zero(first, 4 * (n + 1)), zero(mesh->kind, n);
  for (i64 f = 0; f < mesh->faces; f++) {
    const i32 *v = faces + 3 * f;
    int is_face = v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
    for (int k = 0; k < 3; k++) {
      i32 h = (i32)(3 * f) + k;
      mesh->side[h] = (Side){0, 0, 0, v[k], NONE};
      if (!is_face) continue;
      frame(&mesh->side[h], X + 3 * (i64)v[k], X + 3 * (i64)v[(k + 1) % 3], X + 3 * (i64)v[(k + 2) % 3]);
      first[v[k] + 1]++, a[count++] = h;
    }
    degenerate += is_face && is_degenerate(&mesh->side[3 * f]);
  }
  for (i64 v = 0; v < n; v++) first[v + 1] += first[v];
  copy(put, first, 4 * (n + 1));
  for (i64 i = 0; i < count; i++) mesh->corner[put[mesh->side[a[i]].vertex]++] = a[i];
  sort_by_end(mesh, count, a, b, put, 1), sort_by_end(mesh, count, b, a, put, 0);
  if (label) sort_by_label(mesh->side, count, a, label);
  enum { ALONE = 1, MANY = 2 };
  for (i64 i = 0, j; i < count; i = j) { /* the ring of sides at an edge */
    for (j = i + 1; j < count && meet(mesh->side, a[i], a[j]) && !(label && label[a[i]] != label[a[j]]);) j++;
    for (int high = 0; high < 2 && j - i != 2; high++)
      mesh->kind[end_of(mesh->side, a[i], high)] |= j - i > 2 ? MANY : ALONE;
    for (i64 k = i; k < j && j - i > 1; k++) {
      i32 t = a[k + 1 < j ? k + 1 : i];
      mesh->side[a[k]].twin = 2 * t + (mesh->side[a[k]].vertex == mesh->side[t].vertex);
    }
  }
  for (i32 v = 0; v < n; v++) {
    int edges = mesh->kind[v];
    if (first[v] == first[v + 1]) mesh->kind[v] = CONVEX;
    else mesh->kind[v] = edges & MANY ? ANYWHERE : kind_of(mesh, v, edges & ALONE);
  }
  return degenerate;
}
