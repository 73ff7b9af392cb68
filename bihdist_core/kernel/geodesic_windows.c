/* Windows: how they leave a face, what they lose to others, and how they cross the next.
 *
 * Between thin faces windows come round to the same side again and again at hardly any cost.  At the sides of such faces
 * those that crossed stay in the list, and win where a later one is not nearer by more than rounding. */
#include "geodesic.h"

#define SOURCE_ON_EDGE 1e-13 /* of an edge: a source this near to it sees the whole face behind it */
#define NARROW 4e-12         /* of an edge: windows overlap less only by rounding */
#define THIN 1e-2            /* of the longest edge: the height of a face below which it is thin */
#define NEARER 1e-13         /* ratio by which a window is nearer that comes after another one crossed, */
#define NEARER_BY 1e-14      /* and of the edge, */
#define COME_AGAIN 0.1       /* if their sources are no farther apart than so much of it */

static double distance_at(const Window *w, double x) {
  return w->parallel ? w->s + x * w->px : w->s + length_of(x - w->px, w->py);
}

/* The direction of the ray at x, not of unit length. */
static void direction_at(const Window *w, double x, double *dx, double *dy) {
  if (w->parallel) *dx = w->px, *dy = w->py;
  else *dx = x - w->px, *dy = w->py;
}

/* Vertex or target `id` is reached by the ray of a window that crosses the edge at x. */
static void reach_by(Run *run, i64 id, double distance, i32 from, double x, const Window *w) {
  double px = w->px, py = w->py;
  if (w->parallel) { /* the foot on the straight source */
    double offset = run->offset[-2 - w->root], way = distance_at(w, x) - offset;
    if (distance < offset) distance = offset;
    px = x - way * w->px, py = way * w->py;
  }
  reach(run, id, distance, from, px, py, w->root, w->over);
}

/* A window leaves its face over side h, in whose frame it is, into every other face there, unless an end of h is nearer
 * to all of it. */
void leave(Run *run, i32 h, Window w) {
  const Mesh *mesh = run->mesh;
  const Side *side = &mesh->side[h];
  if (side->twin < 0 || !(w.b1 > w.b0)) return;
  if (!(w.py > 0)) w.py = 0;
  double d0 = distance_at(&w, w.b0), d1 = distance_at(&w, w.b1), l = side->length;
  if (!(run->everything & ALL_WINDOWS) && is_here(run, h)) {
    double begin = run->queue[h].known, end = run->queue[next_side(h)].known;
    if (begin + w.b1 < d1 * (1 - EQUAL) || end + l - w.b0 < d0 * (1 - EQUAL)) return;
  }
  double nearest = w.parallel ? (d0 < d1 ? d0 : d1) : w.px < w.b0 ? d0 : w.px > w.b1 ? d1 : w.s + w.py;
  i32 t = side->twin >> 1, turned = 0;
  if (mesh->side[t].twin >> 1 != h) {
    run->crossing[run->crossings_used] = (Crossing){h, w.over};
    w.over = (i32)run->crossings_used++;
  }
  Window mirrored = w;
  mirrored.b0 = l - w.b1, mirrored.b1 = l - w.b0;
  if (w.parallel) mirrored.px = -w.px, mirrored.s = w.s + l * w.px;
  else mirrored.px = l - w.px;
  for (i32 from = h; (t = mesh->side[from].twin >> 1) != h; from = t) {
    turned ^= !(mesh->side[from].twin & 1);
    i32 i = run->free;
    run->free = run->window[i].next, run->unused--;
    run->window[i] = turned ? mirrored : w;
    wait_at(run, t, i, nearest);
  }
}

/* Whether a point (x, y) of the face ahead is seen, or as good as; its distance, and where on the edge the ray to it
 * crosses.  all: the window sees the whole face. */
static int sees(const Window *w, double x, double y, double tolerance, int all, double *across, double *distance) {
  if (w->parallel) *across = x - w->px * (y / w->py), *distance = w->s + x * w->px + y * w->py;
  else {
    *across = w->py + y > 0 ? w->px + (x - w->px) * (w->py / (w->py + y)) : x;
    *distance = w->s + length_of(x - w->px, y + w->py);
  }
  double c = clamp(*across, w->b0, w->b1);
  if (all || c == *across) return 1;
  if (!(__builtin_fabs(c - *across) <= tolerance)) return 0;
  *distance = distance_at(w, c) + length_of(x - c, y);
  return 1;
}

/* How far from the origin a ray from (b, 0) meets the line into this direction; NaN where it does not. */
static double meeting(double b, double dx, double dy, Ray line) {
  double across = dy * line.c - dx * line.s;
  return across > 0 ? dy * b / across : __builtin_nan("");
}

/* A window leaves over the side before h; which of the two rays at its ends meets it there. */
static void leave_left(Run *run, i32 h, const Window *w, int all, int right) {
  i32 side = previous_side(h);
  const Side *frame = &run->mesh->side[h];
  double l = run->mesh->side[side].length, near = 0, far = l, dx, dy;
  Ray a = corner_at(run->mesh, h);
  Window out = *w;
  if (!all) {
    direction_at(w, w->b0, &dx, &dy), near = meeting(w->b0, dx, dy, a);
    direction_at(w, w->b1, &dx, &dy);
    if (!right) far = meeting(w->b1, dx, dy, a);
  }
  if (!(near > 0)) near = 0;
  if (!(far < l)) far = l;
  out.b0 = l - far, out.b1 = l - near; /* the frame begins at the apex, and runs to the origin */
  if (w->parallel) {
    out.s = w->s + frame->x * w->px + frame->y * w->py;
    out.px = -(a.c * w->px + a.s * w->py), out.py = a.c * w->py - a.s * w->px;
  } else out.px = l - (w->px * a.c - w->py * a.s), out.py = a.c * w->py + a.s * w->px;
  leave(run, side, out);
}

/* The same over the side after h, whose frame runs from the end of h to the apex. */
static void leave_right(Run *run, i32 h, const Window *w, int all, int left) {
  i32 side = next_side(h);
  double before = run->mesh->side[h].length, l = run->mesh->side[side].length, near = 0, far = l, dx, dy;
  double px = before - w->px;
  Ray a = corner_at(run->mesh, side);
  Window out = *w;
  if (!all) {
    direction_at(w, w->b1, &dx, &dy), near = meeting(before - w->b1, -dx, dy, a);
    direction_at(w, w->b0, &dx, &dy);
    if (!left) far = meeting(before - w->b0, -dx, dy, a);
  }
  if (!(near > 0)) near = 0;
  if (!(far < l)) far = l;
  out.b0 = near, out.b1 = far;
  if (w->parallel) {
    out.s = w->s + before * w->px;
    out.px = -a.c * w->px + a.s * w->py, out.py = a.c * w->py + a.s * w->px;
  } else out.px = px * a.c - w->py * a.s, out.py = a.c * w->py + a.s * px;
  leave(run, side, out);
}

/* A window crosses the face of side h and leaves over its two other sides. */
static void cross(Run *run, i32 h, const Window *entering) {
  const Mesh *mesh = run->mesh;
  const Side *side = &mesh->side[h];
  i32 apex = mesh->side[previous_side(h)].vertex;
  double left_length = mesh->side[previous_side(h)].length, right_length = mesh->side[next_side(h)].length, across, d;
  double longest = left_length > right_length ? left_length : right_length;
  double tolerance = CRACK * (longest > side->length ? longest : side->length);
  Window here = *entering;
  const Window *w = &here;
  double near = SOURCE_ON_EDGE * side->length;
  int all = !w->parallel && w->py <= near && w->px >= w->b0 - near && w->px <= w->b1 + near;
  if (all) { /* from a point of the window, if need be by a detour along the edge */
    here.px = clamp(w->px, w->b0, w->b1);
    here.s += __builtin_fabs(here.px - entering->px);
  }
  if (run->target.count)
    for (i32 t = run->first_target[h / 3]; t >= 0; t = run->next_target[t]) {
      double x, y;
      in_frame(mesh, h, run->target.begin + 3 * (i64)t, &x, &y);
      if (sees(w, x, y, tolerance, all, &across, &d))
        reach_by(run, mesh->vertices + t, d, h, clamp(across, w->b0, w->b1), w);
    }
  int seen = sees(w, side->x, side->y, tolerance, all, &across, &d);
  int left = all || w->b0 < across, right = all || w->b1 > across;
  if (seen) reach_by(run, apex, d, h, clamp(across, w->b0, w->b1), w);
  else if (!(run->everything & ALL_WINDOWS)) { /* beside the beam: is the apex nearer to all that lies ahead? */
    double b = left && !right ? w->b0 : w->b1;
    if (run->queue[previous_side(h)].known + length_of(side->x - b, side->y) < distance_at(w, b) * (1 - EQUAL)) return;
  }
  if (left) leave_left(run, h, w, all, right);
  if (right) leave_right(run, h, w, all, left);
}

/* Whether a is nowhere farther than b on [x0, x1] of an edge of this length.  Their difference has one extremum at most, where rays are parallel. */
static int beats(const Window *a, const Window *b, double x0, double x1, double length) {
  double apart = COME_AGAIN * length, x; /* on an edge as short as rounding, others than the same come as near */
  int again = __builtin_fabs(a->px - b->px) <= apart && __builtin_fabs(a->py - b->py) <= apart;
  double known = again ? a->crossed - b->crossed : 0, ratio = 1 - NEARER * known, slack = NEARER_BY * length * known;
  if (distance_at(a, x0) * ratio - slack > distance_at(b, x0) || distance_at(a, x1) * ratio - slack > distance_at(b, x1)) return 0;
  if (a->parallel && b->parallel) return 1;
  if (a->parallel) x = b->px + b->py * (a->px / a->py);
  else if (b->parallel) x = a->px + a->py * (b->px / b->py);
  else x = (a->px * b->py - b->px * a->py) / (b->py - a->py);
  return !(x > x0 && x < x1) || distance_at(a, x) * ratio - slack <= distance_at(b, x);
}

static void sort_by_begin(Run *run, i64 count) {
  const Window *window = run->window;
  i32 *a = run->order, *b = run->spare;
  enum { SHORT = 16 };
  for (i64 lo = 0; lo < count; lo += SHORT)
    for (i64 hi = least(lo + SHORT, count), i = lo + 1, j; i < hi; i++) {
      i32 w = a[i];
      for (j = i; j > lo && window[a[j - 1]].b0 > window[w].b0; j--) a[j] = a[j - 1];
      a[j] = w;
    }
  for (i64 size = SHORT; size < count; size *= 2) {
    for (i64 lo = 0; lo < count; lo += 2 * size) {
      i64 mid = least(lo + size, count), hi = least(lo + 2 * size, count), i = lo, j = mid, k = lo;
      while (k < hi) b[k++] = j == hi || (i < mid && window[a[i]].b0 <= window[a[j]].b0) ? a[i++] : a[j++];
    }
    i32 *swap = a;
    a = b, b = swap;
  }
  if (a != run->order) copy(run->order, a, 4 * count);
}

/* Of windows in the order of their beginnings, drop or shorten what another one beats; returns how many are left. */
static i64 prune(Run *run, i32 h, i64 count) {
  double narrow = NARROW * run->mesh->side[h].length;
  i32 *order = run->order;
  i64 left = 0;
  for (i64 i = 0; i < count; i++) {
    Window *w = &run->window[order[i]];
    int keep = 1;
    for (; left; left--) {
      Window *top = &run->window[order[left - 1]];
      double end = top->b1 < w->b1 ? top->b1 : w->b1;
      if (end - w->b0 <= narrow) break;
      if (beats(top, w, w->b0, end, run->mesh->side[h].length)) {
        w->b0 = end - narrow / 4;
        keep = w->b1 - w->b0 > narrow;
        break;
      }
      if (!beats(w, top, w->b0, end, run->mesh->side[h].length)) break;
      if (top->b1 > w->b1) {
        if (top->b0 >= w->b0) top->b0 = end - narrow / 4;
        break;
      }
      top->b1 = w->b0 + narrow / 4;
      if (top->b1 - top->b0 > narrow) break;
    }
    if (keep) order[left++] = order[i];
  }
  return left;
}

/* Of windows, those that come after others crossed lose what one of these beats, at either end of them; returns how many
 * are left. */
static i64 forget_known(Run *run, i32 h, i64 count) {
  double length = run->mesh->side[h].length, narrow = NARROW * length;
  i64 left = 0;
  for (i64 i = 0; i < count; i++) {
    Window *w = &run->window[run->order[i]];
    for (i64 j = 0; j < count && !w->crossed && w->b1 - w->b0 > narrow; j++) {
      const Window *known = &run->window[run->order[j]];
      if (!known->crossed || known->b1 < w->b0 || known->b0 > w->b1) continue;
      double b0 = known->b0 > w->b0 ? known->b0 : w->b0, b1 = known->b1 < w->b1 ? known->b1 : w->b1;
      if ((b0 > w->b0 + narrow && b1 < w->b1 - narrow) || !beats(known, w, b0, b1, length)) continue;
      if (b0 <= w->b0 + narrow) w->b0 = b1;
      else w->b1 = b0;
    }
    if (w->crossed || w->b1 - w->b0 > narrow) run->order[left++] = run->order[i];
  }
  return left;
}

static int is_thin(const Mesh *mesh, i32 h) {
  double longest = 0;
  for (i32 k = h / 3 * 3; k < h / 3 * 3 + 3; k++)
    if (mesh->side[k].length > longest) longest = mesh->side[k].length;
  return mesh->side[h].y * mesh->side[h].length < THIN * longest * longest;
}

/* All windows waiting at side h cross its face. */
void cross_all(Run *run, i32 h) {
  i64 count = 0;
  i32 head = run->queue[h].head, next;
  int keep = !(run->everything & ALL_WINDOWS) && is_thin(run->mesh, h);
  for (i32 i = head; i >= 0; i = run->window[i].next) run->order[count++] = i;
  run->queue[h].head = NONE;
  run->taken += count;
  if (keep) count = forget_known(run, h, count);
  sort_by_begin(run, count);
  i64 left = run->everything & ALL_WINDOWS ? count : prune(run, h, count);
  /* Downwards, so that the next lists are nearly in order. */
  for (i64 k = left; k--;) {
    Window *w = &run->window[run->order[k]];
    if (!w->crossed) cross(run, h, w);
    w->crossed = 2;
  }
  for (i32 i = head; i >= 0; i = next) {
    Window *w = &run->window[i];
    next = w->next;
    if (keep && w->crossed == 2) w->crossed = 1, w->next = run->queue[h].head, run->queue[h].head = i;
    else w->next = run->free, run->free = i, run->unused++;
  }
}
