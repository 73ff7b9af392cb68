/* The way back from what a run reached to its source. */
#include "geodesic.h"

#define THROUGH 1e-14 /* of an edge: a line this near to the apex goes through it, or along a face of no height */
#define AS_GOOD 1e-12 /* of the distance and the edge: a way through a vertex may be longer by this */

typedef struct {
  i64 room, count;
  i32 *face;
  double *begin, *end; /* (room, 3) each */
} Pieces;

static void set_weights(double *weight, const double *value) { copy(weight, value, 3 * sizeof *weight); }

/* A point of side h, x along it. */
static void on_side(const Mesh *mesh, i32 h, double x, double *weight) {
  double share = x / mesh->side[h].length;
  weight[h % 3] = 1 - share, weight[next_side(h) % 3] = share, weight[previous_side(h) % 3] = 0;
}

static void at_corner(i32 h, double *weight) {
  for (int k = 0; k < 3; k++) weight[k] = k == h % 3;
}

/* The point of a source that is nearest to (x, y), in the frame of side h of its face: nothing is shorter than straight. */
static void on_source(const Run *run, i32 source, i32 h, double x, double y, double *weight) {
  const double *begin = run->source.begin + 3 * (i64)source, *end = run->source.end + 3 * (i64)source;
  double t = nearest_share(run, source, h, x, y);
  for (int k = 0; k < 3; k++) weight[k] = (1 - t) * begin[k] + t * end[k];
}

/* The side that begins at a vertex, of the face of side h; NONE if it is no corner of it. */
static i32 corner_with(const Mesh *mesh, i32 h, i32 vertex) {
  for (int k = 0; k < 3; k++, h = next_side(h))
    if (mesh->side[h].vertex == vertex) return h;
  return NONE;
}

/* A vertex at an end of side h, nearer than `limit`, by which a way from (qx, qy) to its source, `distance` long, goes
 * across the side at x, or as good as; NONE without one. */
static i32 vertex_on_way(const Run *run, i32 h, double x, double qx, double qy, double distance, double limit) {
  const Side *side = &run->mesh->side[h];
  for (int k = 0; k < 2; k++) {
    double at = k ? side->length : 0;
    i32 v = run->mesh->side[k ? next_side(h) : h].vertex;
    double there = run->reached[v].distance;
    if (__builtin_fabs(x - at) <= CRACK * side->length && there < limit &&
        there + length_of(qx - at, qy) <= distance + AS_GOOD * (distance + side->length))
      return v;
  }
  return NONE;
}

/* The straight part of a way that ends at vertex or target `id`; returns the vertex where it begins, NONE if that is a
 * source in a face, NO_ROOM or LOST. */
static i32 straight_part(const Run *run, i64 id, Pieces *out) {
  const Mesh *mesh = run->mesh;
  const Reached *r = &run->reached[id];
  i32 h = r->from, root = r->root, over = r->over;
  double px = r->px, py = r->py, qx, qy, here[3];
  if (id < mesh->vertices) at_corner(previous_side(h), here);
  else set_weights(here, run->target.begin + 3 * (id - mesh->vertices));
  in_frame(mesh, h, here, &qx, &qy);
  double s = r->distance - length_of(qx - px, qy + py);
  double limit = id < mesh->vertices ? r->distance : __builtin_inf();
  for (i64 steps = 0; steps <= mesh->faces; steps++) { /* a shortest path crosses a face once */
    if (out->count == out->room) return NO_ROOM;
    double *end = out->end + 3 * out->count;
    out->face[out->count] = h / 3, set_weights(out->begin + 3 * out->count, here), out->count++;
    i32 corner = root >= 0 ? corner_with(mesh, h, root) : NONE;
    if (corner >= 0) {
      at_corner(corner, end);
      return root;
    }
    if (root < NONE && run->source.face[-2 - root] == h / 3) {
      on_source(run, -2 - root, h, qx, qy, end);
      return NONE;
    }
    const Side *side = &mesh->side[h];
    if (py < 0) py = 0;
    double x = clamp(py + qy > 0 ? px + (qx - px) * (py / (py + qy)) : px, 0, side->length);
    i32 through = vertex_on_way(run, h, x, qx, qy, s + length_of(qx - px, qy + py), limit);
    if (through >= 0) {
      at_corner(corner_with(mesh, h, through), end);
      return through;
    }
    on_side(mesh, h, x, end);
    if (side->twin < 0) return LOST;
    i32 t = side->twin >> 1;
    if (mesh->side[t].twin >> 1 != h) { /* three or more faces: the one that the window came from */
      if (over < 0) return LOST;
      t = run->crossing[over].side, over = run->crossing[over].before;
    }
    /* Whether both sides run the same way follows from their ends: no face has a vertex twice. */
    if (mesh->side[t].vertex != side->vertex) x = side->length - x, px = side->length - px;
    side = &mesh->side[h = t];
    on_side(mesh, h, x, here);
    /* The source is ahead, at (px, py) in the new frame: by which edge does the straight line come? */
    double turn = (px - x) * side->y - py * (side->x - x), l = side->length;
    int right = __builtin_fabs(turn) > THROUGH * l * l ? turn > 0 : px > side->x;
    i32 e = right ? next_side(h) : previous_side(h);
    Ray a = corner_at(mesh, right ? e : h);
    double ox = right ? side->length : side->x, oy = right ? 0 : side->y, ux = -a.c, uy = right ? a.s : -a.s;
    double ax = px - ox, ay = py - oy, bx = x - ox, by = -oy;
    px = ax * ux + ay * uy, py = ux * -ay + uy * ax, qx = bx * ux + by * uy, qy = ux * by - uy * bx;
    if (qy < 0) qy = 0;
    h = e;
  }
  return LOST;
}

/* From vertex or target `id` back to its source, a piece in each face: faces (room,), ends (room, 3) each.  Returns how
 * many; NO_ROOM, or LOST if it does not come back, or OUTSIDE if it was not reached. */
API i64 bih_geodesic_path(const Run *run, i64 id, i64 room, i32 *face, double *begin, double *end) {
  Pieces out = {room, 0, face, begin, end};
  if (!(run->reached[id].distance <= run->radius)) return OUTSIDE;
  while (id >= 0 && run->reached[id].from >= 0) {
    i32 before = straight_part(run, id, &out);
    if (before < NONE) return before;
    /* From vertex to vertex it is nearer; a target may be where a vertex is. */
    if (before >= 0 && id < run->mesh->vertices && run->reached[before].distance > run->reached[id].distance)
      return LOST;
    id = before;
  }
  return out.count;
}
