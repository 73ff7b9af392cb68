/* Symbolic analysis: which rows each front of the elimination tree has, and where everything lies. */
#include "kernel.h"

static void sort(i32 *x, i64 count) { /* Shell's: the lists are short */
  i64 gap = 1;
  while (gap < count / 3) gap = 3 * gap + 1;
  for (; gap; gap /= 3)
    for (i64 i = gap, j; i < count; i++) {
      i32 value = x[i];
      for (j = i; j >= gap && x[j - gap] > value; j -= gap) x[j] = x[j - gap];
      x[j] = value;
    }
}

/* first, children and parent from what a dissection says of fronts. */
static void link(Tree *t, const i32 *last, const i32 *subtrees) {
  t->first[0] = 0;
  for (i64 q = 0; q < t->fronts; q++) {
    t->first[q + 1] = last[q], t->parent[q] = t->children[2 * q] = t->children[2 * q + 1] = -1;
    if (!subtrees[2 * q]) continue;
    i64 right = q - 1, left = right - subtrees[2 * q + 1];
    t->children[2 * q] = (i32)left, t->children[2 * q + 1] = (i32)right, t->parent[left] = t->parent[right] = (i32)q;
  }
}

/* Rows from a place on of two ascending lists, each once and ascending; returns how many there are. */
static i64 merge(i64 from, const i32 *a, i64 na, const i32 *b, i64 nb, i32 *to) {
  i64 count = 0;
  while (na && *a < from) a++, na--;
  while (nb && *b < from) b++, nb--;
  while (na && nb) {
    i32 one = *a, other = *b;
    to[count++] = one < other ? one : other;
    if (one <= other) a++, na--;
    if (other <= one) b++, nb--;
  }
  copy(to + count, a, 4 * na), copy(to + count + na, b, 4 * nb);
  return count + na + nb;
}

/* Bottom up: a front's boundary is what its pivots' edges and its children's boundaries reach above it.  Fills bound,
 * and rows as far as there is room; work (3 n,).  Returns how many rows there are, NO_ROOM if room might not do. */
static i64 find_boundaries(const Rows *g, const Tree *t, i64 room, i32 *work) {
  i32 *mark = work, *both = work + t->n, *rows = t->rows;
  i64 *bound = t->bound;
  for (i64 v = 0; v < t->n; v++) mark[v] = -1;
  bound[0] = 0;
  for (i64 q = 0; q < t->fronts; q++) {
    i64 end = t->first[q + 1], own = 0, joined = 0, left = t->children[2 * q], right = t->children[2 * q + 1];
    i32 *to = rows + bound[q];
    if (bound[q] + t->n - end > room) return NO_ROOM;
    for (i64 v = t->first[q]; v < end; v++)
      for (i64 o = t->vertices[v], e = g->start[o]; e < g->start[o + 1]; e++) {
        i32 r = t->place[g->index[e]];
        if (r < end || mark[r] == q) continue;
        mark[r] = (i32)q, to[own++] = r;
      }
    sort(to, own);
    if (left >= 0) {
      joined = merge(end, rows + bound[left], bound[left + 1] - bound[left], rows + bound[right],
                     bound[right + 1] - bound[right], both);
      copy(both + joined, to, 4 * own);
      own = merge(end, both, joined, both + joined, own, to);
    }
    bound[q + 1] = bound[q] + own;
  }
  return bound[t->fronts];
}

/* up: where each boundary row is in the parent's front; position (n,). */
static void find_places_in_parents(const Tree *t, i32 *position) {
  for (i64 q = 0; q < t->fronts; q++) {
    Front f = front_of(t, q);
    if (t->children[2 * q] < 0) continue;
    for (i64 k = 0; k < f.c; k++) position[f.first + k] = (i32)k;
    for (i64 k = 0; k < f.m; k++) position[f.rows[k]] = (i32)(f.c + k);
    for (int k = 0; k < 2; k++)
      for (i64 d = t->children[2 * q + k], e = t->bound[d]; e < t->bound[d + 1]; e++) t->up[e] = position[t->rows[e]];
  }
}

/* Where everything lies, and which fronts are tasks of their own (top: those whose subtrees are more than the tasks-th
 * part of the whole work; none if tasks is 0).  Blocks of the factor begin with those of the last front, as in a sweep
 * down; those of leaves lie behind all others.  Schur complements lie on a stack while a subtree is eliminated (a front's
 * replaces its children's), and blocks of the inverse while it is inverted (each on top of its parent's); tasks begin at
 * 0, and what they hand to each other lies elsewhere. */
static void place_blocks(Tree *t, i64 tasks, i64 *totals) {
  i64 *inside = t->stack, handed_up = 0, handed_down = 0, last = t->fronts - 1, largest = 0;
  i32 ranked = -1;
  for (i64 q = 0; q <= last; q++) {
    Front f = front_of(t, q);
    i64 left = t->children[2 * q];
    inside[q] = f.c * f.s * f.s + (left < 0 ? 0 : inside[left] + inside[t->children[2 * q + 1]]);
    largest = most(largest, f.sp);
  }
  i64 pivots = 0, boundaries = 0, whole = last < 0 ? 0 : inside[last];
  for (int leaves = 0; leaves < 2; leaves++) {
    if (leaves) t->pivot_block[t->fronts] = pivots, t->row_block[t->fronts] = boundaries;
    for (i64 q = last; q >= 0; q--) {
      Front f = front_of(t, q);
      if (is_leaf(t, q) != leaves) continue;
      t->pivot_block[q] = pivots, t->row_block[q] = boundaries;
      pivots += f.c * f.cp, boundaries += f.c * f.mp;
    }
  }
  for (i64 q = last; q >= 0; q--) {
    Front f = front_of(t, q);
    i64 parent = t->parent[q];
    t->top[q] = !is_leaf(t, q) && inside[q] * tasks > whole;
    if (t->top[q]) handed_down += f.s * f.sp;
    if (t->top[q] || parent < 0 || t->top[parent]) handed_up += f.m * f.mp;
  }
  totals[0] = pivots, totals[1] = boundaries, totals[2] = whole, totals[3] = 2 * most(handed_up, handed_down);
  totals[4] = largest;
  for (i64 q = 0; q <= last; q++) {
    t->stack[q] = t->inverse[q] = 0;
    for (i64 v = t->first[q]; v < t->first[q + 1]; v++) t->rank[v] = ranked += t->top[q];
  }
  for (i64 q = last; q >= 0; q--) {
    i64 left = t->children[2 * q], right = t->children[2 * q + 1];
    if (left < 0 || t->top[q]) continue;
    Front f = front_of(t, q), l = front_of(t, left);
    t->stack[left] = t->stack[q];
    t->stack[right] = t->stack[left] + l.m * l.mp;
    t->inverse[left] = t->inverse[right] = t->inverse[q] + 2 * f.s * f.sp;
  }
}

/* Fill in the tree of a matrix, of which vertices and place are there, from what a dissection says of its fronts: last
 * and subtrees.  tasks: see place_blocks.  rows and up have `room` places; work (3 n,).  totals (5,): doubles of all K and
 * of all N, the work, doubles of all that tasks hand to each other, with derivatives, and the longest padded row of a
 * front.  Returns how many rows there are, NO_ROOM if room might not do. */
API i64 bih_lay_out(const Rows *g, Tree *t, const i32 *last, const i32 *subtrees, i64 tasks, i64 room, i32 *work,
                    i64 *totals) {
  link(t, last, subtrees);
  i64 found = find_boundaries(g, t, room, work);
  if (found < 0) return found;
  place_blocks(t, tasks, totals);
  find_places_in_parents(t, work);
  return found;
}
