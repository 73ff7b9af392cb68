/* A run: from sources outwards, what is nearest first, in rounds of parts. */
#include "geodesic.h"

#define CORNER 1e-12 /* barycentric: a source this near to a corner is that vertex */

/* ------------------------------------------------------------------ the heaps of what waits, four children to a node */

static i32 *place_of(Run *run, i32 id) {
  i64 sides = 3 * run->mesh->faces;
  return id < sides ? &run->queue[id].at : &run->reached[id - sides].at;
}

static void put(Run *run, Part *part, i64 i, Waiting item) { part->heap[i] = item, *place_of(run, item.id) = (i32)i; }

/* A side or vertex waits with this distance, or with a lesser one if it has that. */
static void lower(Run *run, i32 id, double distance) {
  i64 i = *place_of(run, id), sides = 3 * run->mesh->faces;
  Part *part = &run->round->part[part_of(run, id < sides ? id : first_corner(run->mesh, id - sides))];
  Waiting *heap = part->heap;
  if (i < 0) i = part->waiting++;
  else if (distance >= heap[i].distance) return;
  for (; i > 0 && heap[(i - 1) >> 2].distance > distance; i = (i - 1) >> 2) put(run, part, i, heap[(i - 1) >> 2]);
  put(run, part, i, (Waiting){distance, id});
}

static Waiting pop(Run *run, Part *part) {
  Waiting *heap = part->heap, top = heap[0], last = heap[--part->waiting];
  i64 i = 0, child, best;
  for (; (child = 4 * i + 1) < part->waiting; i = best) {
    i64 end = least(child + 4, part->waiting);
    for (best = child++; child < end; child++)
      if (heap[child].distance < heap[best].distance) best = child;
    if (heap[best].distance >= last.distance) break;
    put(run, part, i, heap[best]);
  }
  put(run, part, i, last);
  *place_of(run, top.id) = NONE;
  return top;
}

/* ------------------------------------------------------------------ what is reached, and what is sent to other parts */

static void send(Run *run, i64 to, i32 window, Reached reached) {
  Part *part = &run->round->part[run->part];
  run->round->message[run->message] = (Message){reached, (i32)to, window, part->sent};
  part->sent = (i32)run->message++;
}

/* A window waits at side h, with this least distance. */
void wait_at(Run *run, i32 h, i32 window, double distance) {
  if (!is_here(run, h)) {
    send(run, h, window, (Reached){.distance = distance});
    return;
  }
  run->window[window].next = run->queue[h].head, run->queue[h].head = window;
  lower(run, h, distance);
}

/* A vertex is reached, as far as its corners are here; returns whether all of them are. */
static int reach_here(Run *run, i32 vertex, Reached found) {
  const Mesh *mesh = run->mesh;
  Reached *r = &run->reached[vertex];
  int all = 1;
  for (i32 i = mesh->first[vertex]; i < mesh->first[vertex + 1]; i++) {
    Queue *corner = &run->queue[mesh->corner[i]];
    if (!is_here(run, mesh->corner[i])) all = 0;
    else if (found.distance < corner->known) corner->known = found.distance;
  }
  if (!is_here(run, first_corner(mesh, vertex)) || !(found.distance < r->distance)) return all;
  found.at = r->at, *r = found;
  if (mesh->kind[vertex] || found.from < 0 || run->everything & ALL_DIRECTIONS)
    lower(run, (i32)(3 * mesh->faces + vertex), found.distance);
  return all;
}

void reach(Run *run, i64 id, double distance, i32 from, double px, double py, i32 root, i32 over) {
  Reached found = {distance, px, py, from, root, over, NONE};
  i32 corner = previous_side(from);
  if (id >= run->mesh->vertices) {
    if (distance < run->reached[id].distance) run->reached[id] = found;
  } else if (is_here(run, corner) && !(distance < run->queue[corner].known)) return;
  else if (!reach_here(run, (i32)id, found)) send(run, 3 * run->mesh->faces + id, NONE, found);
}

/* What parts have sent arrives. */
static void hand_on(Run *run) {
  Round *round = run->round;
  i64 sides = 3 * run->mesh->faces;
  for (i64 k = 0; k < round->count; k++) {
    Part *part = &round->part[round->busy[k]];
    for (; part->sent >= 0; part->sent = round->message[part->sent].before) {
      const Message *sent = &round->message[part->sent];
      if (sent->to < sides) wait_at(run, sent->to, sent->window, sent->reached.distance);
      else reach_here(run, (i32)(sent->to - sides), sent->reached);
    }
  }
  round->sent = 0;
}

/* ------------------------------------------------------------------ room */

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

/* Take so many of what all threads share, some of it at a time; returns where they begin, NONE if there are no more. */
static i64 take(i64 *used, i64 count, i64 room) {
  i64 first = __atomic_fetch_add(used, count, __ATOMIC_RELAXED);
  if (first + count <= room) return first;
  __atomic_fetch_sub(used, count, __ATOMIC_RELAXED);
  return NONE;
}

/* Whether there is room for so many more; else it is noted how many. */
static int has_room(Run *run, i64 windows, i64 crossings, i64 messages) {
  enum { AT_ONCE = 256 };
  Round *round = run->round;
  run->needed = run->messages_needed = 0, run->crossings_needed = crossings;
  if (run->unused < windows) {
    i64 count = most(windows, AT_ONCE), first = take(&round->used, count, run->windows);
    if (first < 0) run->needed = count;
    else
      for (i64 i = first + count; i-- > first; run->unused++) run->window[i].next = run->free, run->free = (i32)i;
  }
  if (run->messages_end - run->message < messages) {
    i64 count = most(messages, AT_ONCE), first = take(&round->sent, count, round->messages);
    if (first < 0) run->messages_needed = count;
    else run->message = first, run->messages_end = first + count;
  }
  return !run->needed && !run->messages_needed && crossings <= run->crossings - run->crossings_used;
}

static int has_room_for(Run *run, i32 id) {
  const Mesh *mesh = run->mesh;
  i64 sides = 3 * mesh->faces, windows = 0, crossings = 0, count = 0;
  if (id < sides) {
    for (i32 i = run->queue[id].head; i >= 0; i = run->window[i].next) count++;
    add_room(mesh, next_side(id), count, &windows, &crossings);
    add_room(mesh, previous_side(id), count, &windows, &crossings);
  } else
    for (i32 i = mesh->first[id - sides]; i < mesh->first[id - sides + 1]; i++, count++)
      add_room(mesh, next_side(mesh->corner[i]), 1, &windows, &crossings);
  /* Of each window two and the apex, of each corner a window and two vertices. */
  return has_room(run, windows, crossings, run->part == EVERYWHERE ? 0 : 3 * count);
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
  reach_here(run, vertex, (Reached){offset, 0, 0, NONE, NONE, NONE, NONE});
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
  Round *round = run->round;
  i64 windows = 0, crossings = 0;
  round->count = round->used = round->sent = round->taken = 0;
  run->crossings_used = run->taken = run->unused = 0, run->free = NONE, run->part = EVERYWHERE;
  for (i64 i = 0; i < run->source.count; i++)
    for (i32 h = 3 * run->source.face[i], k = 0; k < 3; k++) add_room(mesh, h + k, 3, &windows, &crossings);
  if (!has_room(run, windows, crossings, 0)) return NO_ROOM;
  for (i64 p = 0; p < round->parts; p++) round->part[p] = (Part){run->heap + 6 * (p << round->shift), 0, NONE, 0, {0}};
  for (i64 i = 0; i < mesh->vertices + run->target.count; i++)
    run->reached[i] = (Reached){__builtin_inf(), 0, 0, NONE, NONE, NONE, NONE};
  for (i64 h = 0; h < 3 * mesh->faces; h++) run->queue[h] = (Queue){NONE, NONE, __builtin_inf()};
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

/* Get the next round ready: MORE, or DONE if all within the radius is reached, or TOO_MUCH. */
API i32 bih_geodesic_next(Run *run) {
  Round *round = run->round;
  double nearest = __builtin_inf();
  run->part = EVERYWHERE;
  hand_on(run);
  round->count = 0;
  for (i64 p = 0; p < round->parts; p++)
    if (round->part[p].waiting && round->part[p].heap[0].distance < nearest) nearest = round->part[p].heap[0].distance;
  if (round->taken > run->most_taken) return TOO_MUCH;
  double farthest = reach_from_corners(run);
  if (nearest == __builtin_inf() || nearest > run->radius || (run->targets_only && farthest <= nearest)) return DONE;
  round->bound = nearest + round->band < run->radius ? nearest + round->band : run->radius;
  for (i64 p = 0; p < round->parts; p++)
    if (round->part[p].waiting && round->part[p].heap[0].distance <= round->bound)
      round->busy[round->count++] = (i32)p, round->part[p].is_taken = 0;
  return MORE;
}

/* Work on one part: DONE, STOPPED, TOO_MUCH, or NO_ROOM, after which it can go on. */
static i32 work_on(Run *run, Part *part, Watch *watch) {
  enum { OFTEN = 1024 };
  while (part->waiting && part->heap[0].distance <= run->round->bound) {
    i32 id = part->heap[0].id;
    if (!has_room_for(run, id)) return NO_ROOM;
    if (run->taken >= OFTEN) {
      i64 taken = __atomic_add_fetch(&run->round->taken, run->taken, __ATOMIC_RELAXED);
      advance(watch, run->taken), run->taken = 0;
      if (taken > run->most_taken) return TOO_MUCH;
    }
    if (stopped(watch)) return STOPPED;
    pop(run, part);
    if (id < 3 * run->mesh->faces) cross_all(run, id);
    else bend(run, (i32)(id - 3 * run->mesh->faces));
  }
  return DONE;
}

/* One thread's share of a round, each by a Run of its own: DONE, STOPPED, TOO_MUCH, or NO_ROOM, after which the round can
 * go on.  Threads begin far apart, so that each mostly has the parts that it had before.  The watch counts windows. */
API i32 bih_geodesic_round(Run *run, Watch *watch) {
  Round *round = run->round;
  i64 first = run->thread * round->count / round->threads;
  i32 status = DONE;
  run->message = run->messages_end = 0;
  for (i64 k = 0; k < round->count && status == DONE; k++) {
    i32 number = round->busy[(first + k) % round->count];
    Part *part = &round->part[number];
    if (__atomic_exchange_n(&part->is_taken, 1, __ATOMIC_ACQUIRE)) continue;
    run->part = round->parts > 1 ? number : EVERYWHERE;
    status = work_on(run, part, watch);
    if (status == NO_ROOM) __atomic_store_n(&part->is_taken, 0, __ATOMIC_RELEASE);
  }
  __atomic_fetch_add(&round->taken, run->taken, __ATOMIC_RELAXED);
  advance(watch, run->taken), run->taken = 0;
  return status;
}
