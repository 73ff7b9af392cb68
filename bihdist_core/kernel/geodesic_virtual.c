/* Approximate geodesic distance without a set-up: each vertex sees one virtual source, a point in space that is unfolded
 * into the plane of each face that the front crosses (after Trettner, Bommes, Kobbelt 2021).
 *
 * Where both ends of a side see the same source, it is unfolded by the distances that they have, as on a plane;
 * elsewhere by chords, or by these distances where they are longer.  A new source begins only where paths may bend
 * (Mesh.kind).  Vertices are visited in the order of their distance, and again where it falls later. */
#include "geodesic.h"

#define LESS (1 - 1e-6) /* ratio: by less than this a distance does not fall, or vertices would be visited on and on */
#define SETTLED (-2)

typedef struct {
  double distance, start, at[3]; /* start: the distance at the virtual source */
  i32 root, place;               /* root: the vertex or source where it began; its place in the heap, NONE, SETTLED */
} Seen;

typedef struct {
  const Mesh *mesh;
  const double *X; /* (vertices, 3) */
  Places source, target;
  const double *offset; /* (sources,) the distance at each source */
  Seen *seen;           /* (vertices,) */
  Waiting *heap;        /* (vertices,) */
  double *at_target;    /* (targets,) */
  double radius;
  i64 waiting;
} Spread;

/* ------------------------------------------------------------------ the heap, four children to a node */

static void put(Spread *run, i64 i, Waiting item) { run->heap[i] = item, run->seen[item.id].place = (i32)i; }

static void lift(Spread *run, i32 v, double distance) {
  i64 i = run->seen[v].place >= 0 ? run->seen[v].place : run->waiting++;
  for (; i > 0 && run->heap[(i - 1) >> 2].distance > distance; i = (i - 1) >> 2) put(run, i, run->heap[(i - 1) >> 2]);
  put(run, i, (Waiting){distance, v});
}

static i32 settle(Spread *run) {
  i32 v = run->heap[0].id;
  Waiting last = run->heap[--run->waiting];
  i64 i = 0, child, best;
  for (; (child = 4 * i + 1) < run->waiting; i = best) {
    i64 end = least(child + 4, run->waiting);
    for (best = child++; child < end; child++)
      if (run->heap[child].distance < run->heap[best].distance) best = child;
    if (run->heap[best].distance >= last.distance) break;
    put(run, i, run->heap[best]);
  }
  put(run, i, last);
  run->seen[v].place = SETTLED;
  return v;
}

/* ------------------------------------------------------------------ what is seen */

static void see(Spread *run, i32 v, double distance, double start, i32 root, const double *at) {
  Seen *s = &run->seen[v];
  if (!(distance < s->distance * LESS)) return;
  s->distance = distance, s->start = start, s->root = root;
  copy(s->at, at, sizeof s->at);
  lift(run, v, distance);
}

/* In a straight line from the source that one end of side h sees to the point (x, y) of its face: the distance, and
 * where the source is when it is unfolded into its frame; infinite where the line does not cross the side. */
typedef struct {
  double distance, px, py;
} Line;

static Line line(const Spread *run, i32 h, int from_end, double x, double y) {
  const Side *side = &run->mesh->side[h];
  const Seen *ends[2] = {&run->seen[side->vertex], &run->seen[run->mesh->side[next_side(h)].vertex]}, *s = ends[from_end];
  int same = ends[0]->root == ends[1]->root;
  double r[2], length = side->length;
  for (int k = 0; k < 2; k++) {
    double known = ends[k]->distance - s->start;
    if (same || k == from_end) r[k] = known;
    else {
      r[k] = apart(s->at, run->X + 3 * (i64)(k ? run->mesh->side[next_side(h)].vertex : side->vertex));
      if (known > r[k]) r[k] = known;
    }
  }
  double px = ((r[0] - r[1]) * (r[0] + r[1]) + length * length) / (2 * length), square = r[0] * r[0] - px * px;
  double py = square > 0 ? __builtin_sqrt(square) : 0, c = px + (x - px) * (py / (y + py));
  if (!(c >= 0 && c <= length)) return (Line){__builtin_inf(), 0, 0};
  return (Line){s->start + length_of(x - px, y + py), px, -py};
}

/* The apex of side h, both of whose ends are settled, sees what they see. */
static void unfold(Spread *run, i32 h) {
  const Mesh *mesh = run->mesh;
  const Side *side = &mesh->side[h];
  i32 a = side->vertex, b = mesh->side[next_side(h)].vertex, apex = mesh->side[previous_side(h)].vertex;
  /* No line is shorter than this, by the inequality of triangles. */
  double least = (run->seen[a].distance + run->seen[b].distance - side->length) / 2 + side->y;
  if (!(side->y > 0) || run->seen[apex].distance <= least) return;
  for (int end = 0; end < 1 + (run->seen[a].root != run->seen[b].root); end++) {
    Line found = line(run, h, end, side->x, side->y);
    if (!(found.distance < run->seen[apex].distance * LESS)) continue;
    const double *A = run->X + 3 * (i64)a, *B = run->X + 3 * (i64)b, *C = run->X + 3 * (i64)apex;
    double at[3], along = found.px / side->length, up = found.py / side->y, foot = side->x / side->length;
    for (int k = 0; k < 3; k++) {
      double e = B[k] - A[k];
      at[k] = A[k] + along * e + up * (C[k] - A[k] - foot * e);
    }
    const Seen *s = &run->seen[end ? b : a];
    see(run, apex, found.distance, s->start, s->root, at);
  }
}

/* Along an edge the source stays, and where paths may bend a new one begins. */
static void follow(Spread *run, i32 from, i32 to, double length) {
  const Seen *s = &run->seen[from];
  double distance = s->distance + length;
  if (!(distance < run->seen[to].distance * LESS)) return;
  if (run->mesh->kind[from]) see(run, to, distance, s->distance, from, run->X + 3 * (i64)from);
  else see(run, to, distance, distance - apart(s->at, run->X + 3 * (i64)to), s->root, s->at);
}

/* ------------------------------------------------------------------ sources */

static void in_space(const Spread *run, i32 face, const double *weight, double *x) {
  for (int k = 0; k < 3; k++) {
    x[k] = 0;
    for (int c = 0; c < 3; c++) x[k] += weight[c] * run->X[3 * (i64)run->mesh->side[3 * face + c].vertex + k];
  }
}

/* A vertex of the source's face sees the point of the source that is nearest, the same root for all if it is one. */
static void see_source(Spread *run, i64 i, i32 v, const double *p, const double *q, i32 corner) {
  const double *x = run->X + 3 * (i64)v;
  double dot = 0, square = 0, at[3];
  for (int k = 0; k < 3; k++) dot += (x[k] - p[k]) * (q[k] - p[k]), square += (q[k] - p[k]) * (q[k] - p[k]);
  double share = square > 0 ? clamp(dot / square, 0, 1) : 0;
  for (int k = 0; k < 3; k++) at[k] = p[k] + share * (q[k] - p[k]);
  i32 root = (i32)(run->mesh->vertices + 4 * i + (square > 0 ? corner : 3));
  see(run, v, run->offset[i] + apart(x, at), run->offset[i], root, at);
}

static void start(Spread *run, i64 i) {
  const Mesh *mesh = run->mesh;
  i32 face = run->source.face[i];
  const double *begin = run->source.begin + 3 * i, *end = run->source.end + 3 * i;
  double p[3], q[3];
  in_space(run, face, begin, p), in_space(run, face, end, q);
  for (i32 k = 0; k < 3; k++) {
    i32 h = 3 * face + k, apex = mesh->side[previous_side(h)].vertex;
    see_source(run, i, apex, p, q, k);
    if (begin[(k + 2) % 3] || end[(k + 2) % 3]) continue;
    for (i32 t = h; mesh->side[t].twin >= 0 && (t = mesh->side[t].twin >> 1) != h;) /* it lies in their faces, too */
      see_source(run, i, mesh->side[previous_side(t)].vertex, p, q, k);
  }
}

/* ------------------------------------------------------------------ targets */

static double at_target(const Spread *run, i64 i) {
  double nearest = __builtin_inf();
  for (i32 h = 3 * run->target.face[i], k = 0; k < 3; k++, h++) {
    double x, y;
    in_frame(run->mesh, h, run->target.begin + 3 * i, &x, &y);
    double ways[] = {run->seen[run->mesh->side[h].vertex].distance + length_of(x, y), __builtin_inf(), __builtin_inf()};
    if (y > 0) ways[1] = line(run, h, 0, x, y).distance, ways[2] = line(run, h, 1, x, y).distance;
    for (int way = 0; way < 3; way++)
      if (ways[way] < nearest) nearest = ways[way];
  }
  return nearest;
}

/* Distances of all vertices, and then of targets, up to the radius; infinite beyond.  The watch counts vertices.
 * Returns DONE or STOPPED. */
API i32 bih_virtual_sources(Spread *run, Watch *watch) {
  const Mesh *mesh = run->mesh;
  enum { OFTEN = 4096 };
  i64 settled = 0;
  run->waiting = 0;
  for (i64 v = 0; v < mesh->vertices; v++) run->seen[v] = (Seen){__builtin_inf(), 0, {0, 0, 0}, NONE, NONE};
  for (i64 i = 0; i < run->source.count; i++) start(run, i);
  while (run->waiting && run->heap[0].distance <= run->radius) {
    i32 v = settle(run);
    if (++settled % OFTEN == 0) {
      advance(watch, OFTEN);
      if (stopped(watch)) return STOPPED;
    }
    for (i32 i = mesh->first[v]; i < mesh->first[v + 1]; i++) {
      i32 h = mesh->corner[i], g = previous_side(h), next = mesh->side[next_side(h)].vertex, last = mesh->side[g].vertex;
      follow(run, v, next, mesh->side[h].length);
      if (mesh->side[g].twin & 1) follow(run, v, last, mesh->side[g].length); /* no side beyond g begins at v */
      if (run->seen[next].place == SETTLED) unfold(run, h);
      if (run->seen[last].place == SETTLED) unfold(run, g);
    }
  }
  for (i64 i = 0; i < run->target.count; i++) run->at_target[i] = at_target(run, i);
  return DONE;
}
