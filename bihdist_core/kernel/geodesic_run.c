/* A run: from sources outwards, what is nearest first. */
#include "geodesic.h"

#define CORNER 1e-12 /* barycentric: a source this near to a corner is that vertex */

/* ------------------------------------------------------------------ the heap of what waits, four children to a node */

static i32 *place_of(Run *run, i32 id) {
  i64 sides = 3 * run->mesh->faces;
  return id < sides ? &run->queue[id].at : &run->reached[id - sides].at;
}

static void put(Run *run, i64 i, Waiting item) { run->heap[i] = item, *place_of(run, item.id) = (i32)i; }

/* A side or vertex waits with this distance, or with a lesser one if it has that. */
void lower(Run *run, i32 id, double distance) {
  i64 i = *place_of(run, id);
  if (i < 0) i = run->waiting++;
  else if (distance >= run->heap[i].distance) return;
  for (; i > 0 && run->heap[(i - 1) >> 2].distance > distance; i = (i - 1) >> 2) put(run, i, run->heap[(i - 1) >> 2]);
  put(run, i, (Waiting){distance, id});
}

static Waiting pop(Run *run) {
  Waiting top = run->heap[0], last = run->heap[--run->waiting];
  i64 i = 0, child, best;
  for (; (child = 4 * i + 1) < run->waiting; i = best) {
    i64 end = least(child + 4, run->waiting);
    for (best = child++; child < end; child++)
      if (run->heap[child].distance < run->heap[best].distance) best = child;
    if (run->heap[best].distance >= last.distance) break;
    put(run, i, run->heap[best]);
  }
  put(run, i, last);
  *place_of(run, top.id) = NONE;
  return top;
}

/* ------------------------------------------------------------------ what is reached */

void reach(Run *run, i64 id, double distance, i32 from, double px, double py, i32 root, i32 over) {
  Reached *r = &run->reached[id];
  if (!(distance < r->distance)) return;
  *r = (Reached){distance, px, py, from, root, over, r->at};
  if (id < run->mesh->vertices && (run->mesh->kind[id] || run->everything & ALL_DIRECTIONS))
    lower(run, (i32)(3 * run->mesh->faces + id), distance);
}

/* How many windows a window becomes that leaves over side h. */
static i64 sides_beyond(const Mesh *mesh, i32 h) {
  i64 count = 0;
  for (i32 t = h; mesh->side[t].twin >= 0 && (t = mesh->side[t].twin >> 1) != h;) count++;
  return count;
}

/* Room for what so many windows become that leave over side h. */
static void add_room(const Mesh *mesh, i32 h, i64 count, i64 *windows, i64 *crossings) {
  i64 beyond = sides_beyond(mesh, h);
  *windows += count * beyond;
  if (beyond > 1) *crossings += count;
}

/* Whether there is room for so many more; else it is noted how many. */
static int has_room(Run *run, i64 windows, i64 crossings) {
  run->needed = windows, run->crossings_needed = crossings;
  return windows <= run->windows - run->live && crossings <= run->crossings - run->crossings_used;
}

static int has_room_for(Run *run, i32 id) {
  const Mesh *mesh = run->mesh;
  i64 sides = 3 * mesh->faces, windows = 0, crossings = 0, count = 0;
  if (id < sides) {
    for (i32 i = run->queue[id].head; i >= 0; i = run->window[i].next) count++;
    add_room(mesh, next_side(id), count, &windows, &crossings);
    add_room(mesh, previous_side(id), count, &windows, &crossings);
  } else
    for (i32 i = mesh->first[id - sides]; i < mesh->first[id - sides + 1]; i++)
      add_room(mesh, next_side(mesh->corner[i]), 1, &windows, &crossings);
  return has_room(run, windows, crossings);
}

/* ------------------------------------------------------------------ sources */

/* Where along a source the point is that is nearest to (x, y), in the frame of side h of its face: 0 to 1. */
double nearest_share(const Run *run, i32 source, i32 h, double x, double y) {
  double ax, ay, bx, by;
  in_frame(run->mesh, h, run->source.begin + 3 * (i64)source, &ax, &ay);
  in_frame(run->mesh, h, run->source.end + 3 * (i64)source, &bx, &by);
  double ux = bx - ax, uy = by - ay, square = ux * ux + uy * uy;
  return square > 0 ? clamp(((x - ax) * ux + (y - ay) * uy) / square, 0, 1) : 0;
}

static i32 vertex_at(const Mesh *mesh, i32 face, const double *weight) {
  for (int k = 0; k < 3; k++)
    if (weight[k] >= 1 - CORNER) return mesh->side[3 * face + k].vertex;
  return NONE;
}

static void start_at_vertex(Run *run, i32 vertex, double offset) {
  Reached *r = &run->reached[vertex];
  if (!(offset < r->distance)) return;
  r->distance = offset, r->from = r->root = NONE;
  lower(run, (i32)(3 * run->mesh->faces + vertex), offset);
}

/* Rays from one point of a face, over all its sides. */
static void start_at_point(Run *run, i32 source, const double *weight) {
  i32 face = run->source.face[source];
  for (i32 h = 3 * face; h < 3 * face + 3; h++) {
    double x, y;
    in_frame(run->mesh, h, weight, &x, &y);
    leave(run, h, (Window){0, run->mesh->side[h].length, x, y, run->offset[source], NONE, -2 - source, NONE, 0, 0});
  }
}

/* Parallel rays from a segment at right angles, to both sides. */
static void start_along(Run *run, i32 source) {
  i32 face = run->source.face[source];
  for (i32 h = 3 * face; h < 3 * face + 3; h++) {
    double ax, ay, bx, by, offset = run->offset[source];
    in_frame(run->mesh, h, run->source.begin + 3 * (i64)source, &ax, &ay);
    in_frame(run->mesh, h, run->source.end + 3 * (i64)source, &bx, &by);
    double nx = by - ay, ny = ax - bx, l = length_of(nx, ny);
    if (ny > 0) nx = -nx; /* so that (nx, -ny) is at right angles and leads out over h */
    else ny = -ny;
    nx /= l, ny /= l;
    if (!(ny > 0)) continue;
    double b0 = ax + nx * (ay / ny), b1 = bx + nx * (by / ny), limit = run->mesh->side[h].length;
    if (b1 < b0) l = b0, b0 = b1, b1 = l;
    leave(run, h, (Window){clamp(b0, 0, limit), clamp(b1, 0, limit), nx, ny, offset + ay * ny - ax * nx, NONE,
                           -2 - source, NONE, 1, 0});
  }
}

/* A straight way within the source's face to a point with these coordinates. */
static void reach_within(Run *run, i32 source, i64 id, i32 h, const double *weight) {
  double x, y, ax, ay, bx, by;
  in_frame(run->mesh, h, weight, &x, &y);
  in_frame(run->mesh, h, run->source.begin + 3 * (i64)source, &ax, &ay);
  in_frame(run->mesh, h, run->source.end + 3 * (i64)source, &bx, &by);
  double t = nearest_share(run, source, h, x, y), fx = ax + t * (bx - ax), fy = ay + t * (by - ay);
  reach(run, id, run->offset[source] + length_of(x - fx, y - fy), h, fx, -fy, -2 - source, NONE);
}

static void start(Run *run, i32 source) {
  const Mesh *mesh = run->mesh;
  i32 face = run->source.face[source], ends[2];
  const double *weight[2] = {run->source.begin + 3 * (i64)source, run->source.end + 3 * (i64)source};
  int is_point = 1;
  for (int k = 0; k < 3; k++) is_point = is_point && weight[0][k] == weight[1][k];
  for (int k = 0; k < 2; k++) {
    ends[k] = vertex_at(mesh, face, weight[k]);
    if (ends[k] >= 0) start_at_vertex(run, ends[k], run->offset[source]);
    else if (!k || !is_point) start_at_point(run, source, weight[k]);
  }
  if (!is_point) start_along(run, source);
  if (is_point && ends[0] >= 0) return;
  static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < 3; k++) {
    i32 h = next_side(3 * face + k);
    if (mesh->side[3 * face + k].length > 0) reach_within(run, source, mesh->side[3 * face + k].vertex, h, unit[k]);
  }
  if (run->target.count)
    for (i32 t = run->first_target[face]; t >= 0; t = run->next_target[t])
      reach_within(run, source, mesh->vertices + t, 3 * face, run->target.begin + 3 * (i64)t);
}

/* Clear a run and send from its sources; NO_ROOM, and how much is needed, if the windows do not fit. */
API i32 bih_geodesic_begin(Run *run) {
  const Mesh *mesh = run->mesh;
  i64 windows = 0, crossings = 0;
  run->live = run->used = run->waiting = run->crossings_used = run->taken = 0, run->free = NONE;
  for (i64 i = 0; i < run->source.count; i++)
    for (i32 h = 3 * run->source.face[i], k = 0; k < 3; k++) add_room(mesh, h + k, 3, &windows, &crossings);
  if (!has_room(run, windows, crossings)) return NO_ROOM;
  for (i64 i = 0; i < mesh->vertices + run->target.count; i++)
    run->reached[i] = (Reached){__builtin_inf(), 0, 0, NONE, NONE, NONE, NONE};
  for (i64 h = 0; h < 3 * mesh->faces; h++) run->queue[h] = (Queue){NONE, NONE};
  for (i64 i = 0; i < run->source.count; i++) start(run, (i32)i);
  return DONE;
}

/* Targets are reached straight from the corners of their faces; returns the largest distance. */
static double reach_from_corners(Run *run) {
  const Mesh *mesh = run->mesh;
  double largest = 0;
  for (i64 t = 0; t < run->target.count; t++) {
    const Reached *target = &run->reached[mesh->vertices + t];
    for (int k = 0; k < 3; k++) {
      i32 h = 3 * run->target.face[t] + k, vertex = mesh->side[h].vertex;
      double x, y;
      in_frame(mesh, h, run->target.begin + 3 * t, &x, &y);
      reach(run, mesh->vertices + t, run->reached[vertex].distance + length_of(x, y), h, 0, 0, vertex, NONE);
    }
    if (target->distance > largest) largest = target->distance;
  }
  return largest;
}

/* Go on until all within the radius is reached: DONE, STOPPED, TOO_MUCH, or NO_ROOM, after which it can go on.  The
 * watch counts windows. */
API i32 bih_geodesic_run(Run *run, Watch *watch) {
  i64 sides = 3 * run->mesh->faces, told = run->taken;
  enum { OFTEN = 1024 };
  while (run->waiting && run->heap[0].distance <= run->radius) {
    i32 id = run->heap[0].id;
    if (!has_room_for(run, id)) return NO_ROOM;
    if (run->taken - told >= OFTEN) {
      advance(watch, run->taken - told), told = run->taken;
      if (run->targets_only && reach_from_corners(run) <= run->heap[0].distance) break;
    }
    if (stopped(watch)) return STOPPED;
    if (run->taken > run->most_taken) return TOO_MUCH;
    pop(run);
    if (id < sides) cross_all(run, id);
    else bend(run, (i32)(id - sides));
  }
  reach_from_corners(run);
  return DONE;
}
