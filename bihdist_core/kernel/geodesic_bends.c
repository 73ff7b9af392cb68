/* How rays bend at vertices.  Directions are unit vectors that turn from face to face: there are no angles here. */
#include "geodesic.h"

#define SLACK 1e-6 /* radians more than needed into which rays bend */

static Ray turned_back(Ray a, Ray b) { return (Ray){a.c * b.c + a.s * b.s, a.s * b.c - a.c * b.s}; }
static int is_before(Ray a, Ray b) { return a.c * b.s - a.s * b.c > 0; } /* of angles between 0 and pi */

/* Rays from a vertex over the face of its corner, from one direction to another; NULL: the corner's end. */
static void fan(Run *run, i32 corner, const Ray *from, const Ray *to) {
  i32 h = next_side(corner), vertex = run->mesh->side[corner].vertex;
  const Side *side = &run->mesh->side[h];
  double b[2] = {0, side->length};
  for (int k = 0; k < 2; k++) {
    const Ray *ray = k ? to : from;
    if (!ray) continue;
    double dx = ray->s * side->y - ray->c * side->x, dy = -ray->s * side->x - ray->c * side->y;
    double hit = dy < 0 ? side->x - dx * side->y / dy : b[k];
    if (hit > 0 && hit < side->length) b[k] = hit;
  }
  leave(run, h, (Window){b[0], b[1], side->x, side->y, run->reached[vertex].distance, NONE, vertex, NONE, 0});
}

/* Where a fan begins: the corner after which the angle from the way that came in is pi, and the ray of that. */
typedef struct {
  i32 out, corner; /* the side by which its face is left; NONE where there is no such ray */
  Ray ray, width;
} Straight;

/* Going round from side `out` of the corner in which the way came in, rest before a half turn is complete. */
static Straight straight_on(const Mesh *mesh, i32 begin, i32 out, Ray rest) {
  i32 vertex = mesh->side[begin].vertex, corner = NONE;
  while ((out = turn_over(mesh, vertex, out, &corner)) >= 0 && corner != begin) {
    Ray width = corner_at(mesh, corner);
    if (is_before(rest, width)) return (Straight){out, corner, rest, width};
    rest = turned_back(rest, width);
  }
  return (Straight){NONE, NONE, rest, rest};
}

/* The same direction from the other side of the corner. */
static Ray from_other_side(Ray ray, Ray width) { return turned_back(width, ray); }

/* The fan of a corner from a ray in the order in which corners come: to the side by which it is left. */
static void fan_onward(Run *run, const Straight *at) {
  Ray other = from_other_side(at->ray, at->width);
  if (at->out == at->corner) fan(run, at->corner, NULL, at->ray.s > 0 ? &other : NULL);
  else fan(run, at->corner, at->ray.s > 0 ? &at->ray : NULL, NULL);
}

static void fan_everywhere(Run *run, i32 vertex) {
  const Mesh *mesh = run->mesh;
  for (i32 i = mesh->first[vertex]; i < mesh->first[vertex + 1]; i++) fan(run, mesh->corner[i], NULL, NULL);
}

/* Rays go on from a vertex into directions that leave pi or more on both sides of the way that came in. */
void bend(Run *run, i32 vertex) {
  const Mesh *mesh = run->mesh;
  Reached *here = &run->reached[vertex];
  i32 from = here->from;
  for (i32 i = mesh->first[vertex]; i < mesh->first[vertex + 1]; i++) { /* along the edges */
    i32 c = mesh->corner[i], p = previous_side(c);
    reach(run, mesh->side[next_side(c)].vertex, here->distance + mesh->side[c].length, p, mesh->side[p].length, 0,
          vertex, NONE);
    reach(run, mesh->side[p].vertex, here->distance + mesh->side[p].length, c, 0, 0, vertex, NONE);
  }
  if (from < 0 || mesh->kind[vertex] == ANYWHERE || run->everything & ALL_DIRECTIONS) {
    fan_everywhere(run, vertex);
    return;
  }
  i32 begin = previous_side(from), corner;
  const Side *side = &mesh->side[from];
  Ray width = corner_at(mesh, begin);
  double ax = -side->x, ay = -side->y, bx = here->px + ax, by = -here->py + ay;
  double c = ax * bx + ay * by, s = ax * by - ay * bx, l = length_of(c, s);
  Ray in = l > 0 ? (Ray){c / l, s / l} : (Ray){1, 0};
  if (in.s < 0) in = (Ray){1, 0};
  else if (!is_before(in, width)) in = width;
  const Ray slack = {1, SLACK};
  Straight at[2];
  for (int way = 0; way < 2; way++) {
    Ray gone = way ? from_other_side(in, width) : in;
    if (gone.s < 0) gone = (Ray){1, 0};
    Ray rest = turned_back((Ray){-gone.c, gone.s}, slack); /* pi - gone - slack */
    if (rest.s < 0) rest = (Ray){1, 0};
    at[way] = straight_on(mesh, begin, way ? previous_side(begin) : begin, rest);
  }
  if (mesh->kind[vertex] == BOUNDARY) {
    for (int way = 0; way < 2; way++) {
      if (at[way].out < 0) continue;
      fan_onward(run, &at[way]);
      for (i32 e = at[way].out; (e = turn_over(mesh, vertex, e, &corner)) >= 0;) fan(run, corner, NULL, NULL);
    }
    return;
  }
  if (at[0].out < 0 || at[1].out < 0) {
    fan_everywhere(run, vertex);
    return;
  }
  /* From the one straight ray on to the other, which was found going the other way round. */
  if (at[0].corner == at[1].corner) {
    Ray ends[2];
    for (int way = 0; way < 2; way++)
      ends[way] = at[way].out == at[way].corner ? from_other_side(at[way].ray, at[way].width) : at[way].ray;
    int first = at[0].out == at[0].corner; /* which of the two comes first, counted from the corner's side */
    fan(run, at[0].corner, &ends[first], &ends[!first]);
    return;
  }
  fan_onward(run, &at[0]), fan_onward(run, &at[1]);
  for (i32 e = at[0].out; (e = turn_over(mesh, vertex, e, &corner)) >= 0 && corner != at[1].corner;)
    fan(run, corner, NULL, NULL);
}
