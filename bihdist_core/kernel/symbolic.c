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

/* Bottom up: a front's boundary is what its pivots' edges and its children's boundaries reach above it.  Fills bound,
 * and rows as far as there is room; mark (n,).  Returns how many rows there are, NO_ROOM if more than room. */
API i64 bih_boundaries(const Rows *g, const Tree *t, i64 *bound, i32 *rows, i64 room, i32 *mark) {
  i64 count = 0;
  for (i64 v = 0; v < t->n; v++) mark[v] = -1;
  for (i64 q = 0; q < t->fronts; q++) {
    i64 end = t->first[q + 1];
    bound[q] = count;
    for (i64 v = t->first[q]; v < end; v++)
      for (i64 o = t->vertices[v], e = g->start[o]; e < g->start[o + 1]; e++) {
        i32 r = t->place[g->index[e]];
        if (r < end || mark[r] == q) continue;
        if (count == room) return NO_ROOM;
        mark[r] = (i32)q, rows[count++] = r;
      }
    for (int k = 0; k < 2 && t->children[2 * q] >= 0; k++)
      for (i64 d = t->children[2 * q + k], e = bound[d]; e < bound[d + 1]; e++) {
        i32 r = rows[e];
        if (r < end || mark[r] == q) continue;
        if (count == room) return NO_ROOM;
        mark[r] = (i32)q, rows[count++] = r;
      }
    sort(rows + bound[q], count - bound[q]);
    bound[q + 1] = count;
  }
  return count;
}

/* up: where each boundary row is in the parent's front; position (n,). */
API void bih_places_in_parents(const Tree *t, i32 *up, i32 *position) {
  for (i64 q = 0; q < t->fronts; q++) {
    Front f = front_of(t, q);
    if (t->children[2 * q] < 0) continue;
    for (i64 k = 0; k < f.c; k++) position[f.first + k] = (i32)k;
    for (i64 k = 0; k < f.m; k++) position[f.rows[k]] = (i32)(f.c + k);
    for (int k = 0; k < 2; k++)
      for (i64 d = t->children[2 * q + k], e = t->bound[d]; e < t->bound[d + 1]; e++) up[e] = position[t->rows[e]];
  }
}

/* Where Schur complements lie while a subtree is eliminated (stack: a front's replaces its children's), and blocks of
 * the inverse while it is inverted (inverse: each on top of its parent's).  Tasks begin at 0, as what is there already
 * says; what they hand to each other lies elsewhere. */
API void bih_stack(const Tree *t, i64 *stack, i64 *inverse) {
  for (i64 q = t->fronts; q-- > 0;) {
    i64 left = t->children[2 * q], right = t->children[2 * q + 1];
    if (left < 0 || t->top[q]) continue;
    Front f = front_of(t, q), l = front_of(t, left);
    stack[left] = stack[q];
    stack[right] = stack[left] + l.m * l.mp;
    inverse[left] = inverse[right] = inverse[q] + 2 * f.s * f.sp;
  }
}
