/* Degenerate faces are taken out of a mesh: the ends of edges of no length become one vertex, and all faces at the
 * longest edge of a flat face are divided by its apex, which makes that face the edges that it is.
 *
 * Of flat faces the longest is first.  Then the flat ones that it divides have their own longest edge there, so that
 * what becomes of them is shorter; in another order flat faces beside each other undo what one does to the other. */
#include "geodesic.h"

/* What a face, or a part of it, has become: a triangle, an edge or a point.  Those that stand for a cell come later. */
typedef struct {
  double part;
  i32 corner[3]; /* NONE: it has fewer */
  i32 edge[3];   /* from each corner of a triangle to the next; of an edge the first alone */
  i32 face, before;
  i32 step[3]; /* part > 0: a half of the cell before, of which corner step[0] stays and step[1] goes, so that this part
                * of their edge is left; else what each corner of the cell before has become, NONE: the same */
  i32 is_there;
} Cell;

typedef struct {
  double length;
  i32 cell;
} Flat;

typedef struct {
  i64 cells, edges, waiting, flat; /* how many there are; of `longest` */
  i64 room, edge_room;
  const double *X;              /* (vertices, 3) */
  Cell *cell;                   /* (room,) */
  i32 *first, *next;            /* (vertices,), (3 room,): lists of 3 cell + corner at each vertex, with cells that are gone */
  i32 *vertex_for, *edge_for;   /* (vertices,), (edge_room,): what stands for each, perhaps itself */
  i32 *divided;                 /* (edge_room, 2) of edges within faces the ends of the edge that was divided, else NONE */
  i32 *wait, *found;            /* (room,) each */
  Flat *longest;                /* (room,) a heap of flat faces, the longest first */
} Cells;

static i32 root(i32 *stands, i32 i) {
  while (stands[i] != i) i = stands[i] = stands[stands[i]];
  return i;
}

static void put_aside(Cells *all, i32 cell, double length) {
  i64 i = all->flat++, above;
  for (; i > 0 && all->longest[above = (i - 1) / 2].length < length; i = above) all->longest[i] = all->longest[above];
  all->longest[i] = (Flat){length, cell};
}

static i32 take_longest(Cells *all) {
  Flat *heap = all->longest, top = heap[0], last = heap[--all->flat];
  i64 i = 0, child;
  for (; (child = 2 * i + 1) < all->flat; i = child) {
    if (child + 1 < all->flat && heap[child + 1].length > heap[child].length) child++;
    if (heap[child].length <= last.length) break;
    heap[i] = heap[child];
  }
  heap[i] = last;
  return top.cell;
}

/* Enter a cell, which waits to be looked at. */
static void enter(Cells *all, i32 number) {
  Cell *cell = &all->cell[number];
  cell->is_there = 1;
  for (int k = 0; k < 3 && cell->corner[k] >= 0; k++) {
    all->next[3 * number + k] = all->first[cell->corner[k]];
    all->first[cell->corner[k]] = 3 * number + k;
  }
  if (cell->corner[1] >= 0 && cell->corner[2] < 0 && cell->edge[1] >= 0) { /* a flat face's edges are one */
    i32 a = root(all->edge_for, cell->edge[0]), b = root(all->edge_for, cell->edge[1]);
    cell->edge[0] = a < b ? a : b, cell->edge[1] = NONE;
    all->edge_for[a < b ? b : a] = cell->edge[0];
  }
  all->wait[all->waiting++] = number;
}

/* A cell as it is, or without the corners that it has twice, as another. */
static i32 reduced(Cells *all, i32 number) {
  Cell from = all->cell[number], to = {0, {NONE, NONE, NONE}, {NONE, NONE, NONE}, from.face, number, {0, 0, 0}, 0};
  int corners = 0, edges = 0, count = 0;
  for (int k = 0, m; k < 3 && from.corner[k] >= 0; k++, count++) {
    for (m = 0; m < corners && to.corner[m] != from.corner[k]; m++) continue;
    if (m == corners) to.corner[corners++] = from.corner[k];
    to.step[k] = m;
  }
  if (corners == count) return number;
  for (int k = 0; k < count && from.edge[k] >= 0; k++)
    if (from.corner[k] != from.corner[(k + 1) % count]) to.edge[edges++] = from.edge[k];
  all->cell[all->cells] = to;
  return (i32)all->cells++;
}

/* Note the cells at a vertex; returns how many. */
static i64 cells_at(Cells *all, i32 vertex) {
  i64 count = 0;
  for (i32 *link = &all->first[vertex]; *link >= 0;)
    if (all->cell[*link / 3].is_there) all->found[count++] = *link / 3, link = &all->next[*link];
    else *link = all->next[*link];
  return count;
}

/* Whether there is room for what `count` cells become. */
static int has_room(const Cells *all, i64 count) {
  return all->cells + 4 * count <= all->room && all->edges + count <= all->edge_room;
}

static i32 join(Cells *all, i32 a, i32 b) {
  i64 count = cells_at(all, b);
  if (!has_room(all, count)) return NO_ROOM;
  all->vertex_for[b] = a;
  for (i64 i = 0; i < count; i++) {
    Cell to = all->cell[all->found[i]];
    all->cell[all->found[i]].is_there = 0;
    to.before = all->found[i], to.part = 0, to.step[0] = NONE, to.is_there = 0;
    for (int k = 0; k < 3; k++)
      if (to.corner[k] == b) to.corner[k] = a;
    all->cell[all->cells] = to;
    enter(all, reduced(all, (i32)all->cells++));
  }
  return DONE;
}

/* Divide a cell by vertex c, at this share of its edge from corner a to corner b; near: the edges from these to c. */
static void halve(Cells *all, i32 number, int i, double share, i32 a, i32 c, const i32 *near) {
  Cell whole = all->cell[number];
  int corners = whole.corner[2] >= 0 ? 3 : 2, j = (i + 1) % corners, is_turned = whole.corner[i] != a;
  i32 chord = (i32)all->edges++;
  all->edge_for[chord] = chord;
  all->divided[2 * chord] = whole.corner[i], all->divided[2 * chord + 1] = whole.corner[j];
  all->cell[number].is_there = 0;
  for (int k = 0; k < 2; k++) {
    int stays = k ? j : i, goes = k ? i : j;
    Cell half = whole;
    half.part = (is_turned == k) ? share : 1 - share;
    half.before = number, half.step[0] = stays, half.step[1] = goes, half.is_there = 0;
    half.corner[goes] = c, half.edge[i] = near[is_turned ^ k];
    if (corners == 3) half.edge[goes == j ? j : (i + 2) % 3] = chord;
    all->cell[all->cells] = half;
    enter(all, reduced(all, (i32)all->cells++));
  }
}

/* Join vertices if a cell is a needle or an edge of no length; put it aside, or divide faces, if it is flat. */
static i32 mend(Cells *all, i32 number, int divides) {
  const Cell *cell = &all->cell[number];
  if (!cell->is_there || cell->corner[1] < 0) return DONE;
  if (cell->corner[2] < 0) {
    i32 a = cell->corner[0], b = cell->corner[1];
    return apart(all->X + 3 * (i64)a, all->X + 3 * (i64)b) > 0 ? DONE : join(all, a, b);
  }
  double length[3];
  int longest = 0, shortest = 0;
  for (int k = 0; k < 3; k++) {
    length[k] = apart(all->X + 3 * (i64)cell->corner[k], all->X + 3 * (i64)cell->corner[(k + 1) % 3]);
    if (length[k] > length[longest]) longest = k;
    if (length[k] < length[shortest]) shortest = k;
  }
  i32 a = cell->corner[longest], b = cell->corner[(longest + 1) % 3], c = cell->corner[(longest + 2) % 3];
  const double *p = all->X + 3 * (i64)a, *q = all->X + 3 * (i64)b, *r = all->X + 3 * (i64)c;
  double e[3], w[3], along = 0, square = length[longest] * length[longest];
  for (int k = 0; k < 3; k++) e[k] = q[k] - p[k], w[k] = r[k] - p[k], along += e[k] * w[k];
  double x = e[1] * w[2] - e[2] * w[1], y = e[2] * w[0] - e[0] * w[2], z = e[0] * w[1] - e[1] * w[0];
  if (__builtin_sqrt(x * x + y * y + z * z) > NO_HEIGHT * square) return DONE;
  if (length[shortest] <= NO_HEIGHT * length[longest])
    return join(all, cell->corner[shortest], cell->corner[(shortest + 1) % 3]);
  if (!divides) return put_aside(all, number, length[longest]), DONE;
  i32 divided = root(all->edge_for, cell->edge[longest]);
  if (all->divided[2 * divided] == c || all->divided[2 * divided + 1] == c) return DONE; /* that would undo it */
  i32 near[2] = {cell->edge[(longest + 2) % 3], cell->edge[(longest + 1) % 3]};
  double share = clamp(along / square, NO_HEIGHT, 1 - NO_HEIGHT);
  i64 count = cells_at(all, a);
  if (!has_room(all, count)) return NO_ROOM;
  for (i64 k = 0; k < count; k++) {
    const i32 *edge = all->cell[all->found[k]].edge;
    for (int i = 0; i < 3 && edge[i] >= 0; i++)
      if (root(all->edge_for, edge[i]) == divided) {
        halve(all, all->found[k], i, share, a, c, near);
        break;
      }
  }
  return DONE;
}

/* The first `faces` cells are those of faces, with their edges' numbers; faces that name a vertex twice are not there.
 * At most so many cells are looked at.  DONE, or NO_ROOM, after which all has to begin again. */
API i32 bih_geodesic_cells(Cells *all, i64 vertices, i64 faces, i64 most) {
  for (i64 v = 0; v < vertices; v++) all->first[v] = NONE, all->vertex_for[v] = (i32)v;
  for (i64 e = 0; e < all->edges; e++) all->edge_for[e] = (i32)e, all->divided[2 * e] = all->divided[2 * e + 1] = NONE;
  for (i64 f = 0; f < faces; f++)
    if (all->cell[f].is_there) enter(all, (i32)f);
  for (int divides; most > 0 && (all->waiting || all->flat); most--) {
    divides = !all->waiting;
    if (mend(all, divides ? take_longest(all) : all->wait[--all->waiting], divides) != DONE) return NO_ROOM;
  }
  return DONE;
}
