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

/* The tree of fronts from what a dissection says of them: first (fronts + 1,), children (fronts, 2), parent (fronts,). */
API void bih_link(i64 fronts, const i32 *last, const i32 *subtrees, i32 *first, i32 *children, i32 *parent) {
  first[0] = 0;
  for (i64 q = 0; q < fronts; q++) {
    first[q + 1] = last[q], parent[q] = children[2 * q] = children[2 * q + 1] = -1;
    if (!subtrees[2 * q]) continue;
    i64 right = q - 1, left = right - subtrees[2 * q + 1];
    children[2 * q] = (i32)left, children[2 * q + 1] = (i32)right, parent[left] = parent[right] = (i32)q;
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
API i64 bih_boundaries(const Rows *g, const Tree *t, i64 *bound, i32 *rows, i64 room, i32 *work) {
  i32 *mark = work, *both = work + t->n;
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
static void find_places_in_parents(const Tree *t, i32 *up, i32 *position) {
  for (i64 q = 0; q < t->fronts; q++) {
    Front f = front_of(t, q);
    if (t->children[2 * q] < 0) continue;
    for (i64 k = 0; k < f.c; k++) position[f.first + k] = (i32)k;
    for (i64 k = 0; k < f.m; k++) position[f.rows[k]] = (i32)(f.c + k);
    for (int k = 0; k < 2; k++)
      for (i64 d = t->children[2 * q + k], e = t->bound[d]; e < t->bound[d + 1]; e++) up[e] = position[t->rows[e]];
  }
}

/* Where everything lies, which fronts are tasks of their own (top: those whose subtrees are more than the tasks-th part
 * of the whole work; none if tasks is 0), and where boundary rows are in the parent's front; position (n,).  Blocks of
 * the factor begin with those of the last front, as in a sweep down.  Schur complements lie on a stack while a subtree is
 * eliminated (a front's replaces its children's), and blocks of the inverse while it is inverted (each on top of its
 * parent's); tasks begin at 0, and what they hand to each other lies elsewhere.  totals (4,): doubles of all K and of all
 * N, the work, and doubles of all that tasks hand to each other, with derivatives. */
API void bih_lay_out(const Tree *t, i64 tasks, i64 *pivot_block, i64 *row_block, i64 *stack, i64 *inverse,
                     unsigned char *top, i32 *rank, i32 *up, i32 *position, i64 *totals) {
  i64 *inside = stack, handed_up = 0, handed_down = 0, last = t->fronts - 1;
  i32 ranked = -1;
  for (i64 q = 0; q <= last; q++) {
    Front f = front_of(t, q);
    i64 left = t->children[2 * q];
    inside[q] = f.c * f.s * f.s + (left < 0 ? 0 : inside[left] + inside[t->children[2 * q + 1]]);
  }
  i64 pivots = 0, boundaries = 0, whole = last < 0 ? 0 : inside[last];
  for (i64 q = last; q >= 0; q--) {
    Front f = front_of(t, q);
    i64 parent = t->parent[q];
    top[q] = t->children[2 * q] >= 0 && inside[q] * tasks > whole;
    if (top[q]) handed_down += f.s * f.sp;
    if (top[q] || parent < 0 || top[parent]) handed_up += f.m * f.mp;
    pivot_block[q] = pivots, row_block[q] = boundaries;
    pivots += f.c * f.cp, boundaries += f.c * f.mp;
  }
  totals[0] = pivots, totals[1] = boundaries, totals[2] = whole, totals[3] = 2 * most(handed_up, handed_down);
  for (i64 q = 0; q <= last; q++) {
    stack[q] = inverse[q] = 0;
    for (i64 v = t->first[q]; v < t->first[q + 1]; v++) rank[v] = ranked += top[q];
  }
  for (i64 q = last; q >= 0; q--) {
    i64 left = t->children[2 * q], right = t->children[2 * q + 1];
    if (left < 0 || top[q]) continue;
    Front f = front_of(t, q), l = front_of(t, left);
    stack[left] = stack[q];
    stack[right] = stack[left] + l.m * l.mp;
    inverse[left] = inverse[right] = inverse[q] + 2 * f.s * f.sp;
  }
  find_places_in_parents(t, up, position);
}
