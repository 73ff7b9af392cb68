/* Takahashi's selected inversion: the diagonals of G = L^-1 and of G A G, or of the real and imaginary parts of G,
 * without most of their other entries.
 *
 * Top down each front gets the block Z of G on its own rows (1: pivots, 2: boundary), of which the boundary's is part of
 * its parent's, and Z1, that of G A G:
 *
 *     Z12 = N Z22      Z11 = K + Z12 N^T      Z1_12 = N1 Z22 + N Z1_22      Z1_11 = K1 + Z12 N1^T + Z1_12 N^T
 *
 * and of complex numbers Z12 = N Z22 - N1 Z1_22 and Z11 = K + Z12 N^T - Z1_12 N1^T.
 *
 * Of a leaf only the diagonals are wanted.  With K1 = K A K and N1 = K A N that of Z1_11 is that of
 * K A (K + 2 Z12 N^T) + N Z1_22 N^T. */
#include "kernel.h"

static i64 work_of(Front f) { return most(f.m, 2 * f.c * f.mp + f.cp * (f.m + most(f.m, f.c))); }

/* What inverting the fronts first to last needs, in doubles: room[0] for the stack, room[1] in all. */
API void bih_inversion_room(const Tree *t, i64 first, i64 last, i64 *room) {
  i64 stack = 0, work = 0;
  for (i64 q = first; q <= last; q++) {
    Front f = front_of(t, q);
    if (!t->top[q]) stack = most(stack, t->inverse[q] + 2 * f.s * f.sp);
    work = most(work, work_of(f));
  }
  room[0] = padded(stack) + PAD, room[1] = room[0] + work + PAD;
}

static void transpose(i64 rows, i64 columns, const double *A, i64 lda, double *B, i64 ldb) {
  enum { LINE = 8 };
  for (i64 first = 0; first < rows; first += LINE)
    for (i64 j = 0, end = least(first + LINE, rows); j < columns; j++)
      for (i64 i = first; i < end; i++) B[j * ldb + i] = A[i * lda + j];
}

/* Z22 (m, m) of a front out of its parent's Z; end (m,) as find_runs leaves it. */
static void gather(Front f, const work_i32 *end, const double *Zp, i64 ldp, double *Z, i64 ld) {
  for (i64 i = 0; i < f.m; i++, Z += ld) {
    for (i64 j = 0; j < f.m;) {
      const double *from = Zp + f.up[i] * ldp + f.up[j];
      double *to = Z + j, *last = Z + end[j];
      j = end[j];
      for (; to + LANES <= last; from += LANES, to += LANES) *(vec *)to = *(const vec *)from;
      for (; to < last; from++, to++) *to = *from;
    }
    for (i64 j = f.m; j < ld - f.c; j++) Z[j] = 0;
  }
}

static double *block_of(const Tree *t, i64 q, double *const *blocks, double *stack) {
  double *block = handed(blocks, q);
  return block ? block : stack + t->inverse[q];
}

static void invert_leaf(const Factor *factor, i64 q, Front f, const double *Z, const double *Z1, double *work,
                        double *diagonal, double *sandwich) {
  i64 c = f.c, m = f.m, ld = f.sp, cp = f.cp, mp = f.mp;
  const double *K = block_K(factor, q), *N = block_N(factor, q), *areas = factor->areas + f.first;
  const i32 *vertices = factor->tree->vertices + f.first;
  double *Y = work, *Y1 = Y + c * mp, *Nt = Y1 + c * mp, *W = Nt + m * cp; /* W = Z12 N^T */
  zero(Y, 16 * c * mp), zero(W, 8 * c * cp);
  add_product(c, m, m, 1, N, mp, 1, Z + c * ld + c, ld, Y, mp);
  add_product(c, m, m, 1, N, mp, 1, Z1 + c * ld + c, ld, Y1, mp);
  for (i64 i = 0; i < m; i++) zero(Nt + i * cp + c, 8 * (cp - c));
  transpose(c, m, N, mp, Nt, cp);
  add_upper_product(c, c, m, 1, Y, mp, 1, Nt, cp, W, cp);
  for (i64 i = 0; i < c; i++) {
    double z1 = 0;
    for (i64 j = 0; j < m; j++) z1 += Y1[i * mp + j] * N[i * mp + j];
    for (i64 j = 0; j < c; j++)
      z1 += K[i * cp + j] * areas[j] * (K[i * cp + j] + 2 * (j < i ? W[j * cp + i] : W[i * cp + j]));
    diagonal[vertices[i]] = K[i * cp + i] + W[i * cp + i], sandwich[vertices[i]] = z1;
  }
}

static void put_entries(const Tree *t, Front f, const double *Z, const double *Z1, const Entries *entries) {
  for (i64 i = 0; i < f.c; i++) {
    i64 own = f.first + i, v = t->vertices[own];
    for (i64 k = entries->pattern.start[v]; k < entries->pattern.start[v + 1]; k++) {
      i64 place = t->place[entries->pattern.index[k]], column = place - f.first;
      if (place < own) continue;
      if (column >= f.c) {
        i64 low = 0, high = f.m;
        while (high - low > 1) {
          i64 middle = (low + high) / 2;
          if (f.rows[middle] <= place) low = middle;
          else high = middle;
        }
        column = f.c + low;
      }
      entries->value[k] = Z[i * f.sp + column];
      if (entries->second) entries->second[k] = Z1[i * f.sp + column];
    }
  }
}

static void invert(const Factor *factor, i64 q, double *const *blocks, double *stack, double *work, double *diagonal,
                   double *second, const Entries *entries) {
  const Tree *t = factor->tree;
  Front f = front_of(t, q);
  i64 c = f.c, m = f.m, ld = f.sp, cp = f.cp, mp = f.mp, ln = kept(factor, q) * mp, parent = t->parent[q];
  int both = factor->second != SINGLE, is_complex = factor->second == IMAGINARY;
  double *Z = block_of(t, q, blocks, stack), *Z1 = Z + f.s * ld;
  if (parent >= 0) {
    Front p = front_of(t, parent);
    const double *Zp = block_of(t, parent, blocks, stack), *Zp1 = Zp + p.s * p.sp;
    work_i32 *end = (work_i32 *)work;
    find_runs(f, end);
    gather(f, end, Zp, p.sp, Z + c * ld + c, ld);
    if (both) gather(f, end, Zp1, p.sp, Z1 + c * ld + c, ld);
  }
  if (is_short(factor, q)) {
    invert_leaf(factor, q, f, Z, Z1, work, diagonal, second);
    return;
  }
  const double *K = block_K(factor, q), *K1 = K + c * cp, *N = block_N(factor, q), *N1 = N + mp;
  const double *Z22 = Z + c * ld + c, *Z1_22 = Z1 + c * ld + c;
  double *Y = work, *Y1 = Y + c * mp, *Nt = Y1 + c * mp, *Nt1 = Nt + m * cp;
  zero(Y, 16 * c * mp);
  add_product(c, m, m, 1, N, ln, 1, Z22, ld, Y, mp);
  if (both) add_product(c, m, m, 1, N1, ln, 1, Z22, ld, Y1, mp), add_product(c, m, m, 1, N, ln, 1, Z1_22, ld, Y1, mp);
  if (is_complex) add_product(c, m, m, -1, N1, ln, 1, Z1_22, ld, Y, mp);
  const i32 *vertices = t->vertices + f.first;
  for (i64 i = 0; i < m; i++) zero(Nt + i * cp + c, 8 * (cp - c)), zero(Nt1 + i * cp + c, 8 * (cp - c));
  transpose(c, m, N, ln, Nt, cp);
  for (i64 i = 0; i < c; i++) copy(Z + i * ld, K + i * cp, 8 * c);
  add_upper_product(c, c, m, 1, Y, mp, 1, Nt, cp, Z, ld);
  if (both) {
    transpose(c, m, N1, ln, Nt1, cp);
    for (i64 i = 0; i < c; i++) copy(Z1 + i * ld, K1 + i * cp, 8 * c);
    add_upper_product(c, c, m, 1, Y, mp, 1, Nt1, cp, Z1, ld);
    add_upper_product(c, c, m, 1, Y1, mp, 1, Nt, cp, Z1, ld);
  }
  if (is_complex) add_upper_product(c, c, m, -1, Y1, mp, 1, Nt1, cp, Z, ld);
  for (int k = 0; k < 1 + both; k++) {
    double *z = k ? Z1 : Z, *y = k ? Y1 : Y, *to = k ? second : diagonal;
    for (i64 i = 0; i < c; i++) {
      copy(z + i * ld + c, y + i * mp, 8 * m);
      for (i64 j = i; j < c; j++) z[j * ld + i] = z[i * ld + j];
      to[vertices[i]] = z[i * ld + i];
    }
    transpose(c, m, y, mp, z + c * ld, ld);
  }
  if (entries) put_entries(t, f, Z, Z1, entries);
}

/* The diagonals (n,) at the pivots of the fronts last to first, one task.  blocks (fronts,): of top fronts, where their
 * blocks of the inverse lie, (2, s, sp); NULL for others, or for all.  entries: those that are wanted, or NULL.  work:
 * as much as bih_inversion_room says. */
API i32 bih_invert(const Factor *factor, i64 first, i64 last, double *const *blocks, double *work, double *diagonal,
                   double *second, const Entries *entries, Watch *watch) {
  i64 room[2];
  bih_inversion_room(factor->tree, first, last, room);
  for (i64 q = last; q >= first; q--) {
    if (stopped(watch)) return STOPPED;
    invert(factor, q, blocks, work, work + room[0], diagonal, second, entries);
    Front f = front_of(factor->tree, q);
    advance(watch, f.c * f.s * f.s);
  }
  return DONE;
}

/* A whole factor on one thread, and, with a second block, the diagonals (n,).  work: as much as bih_factor_room says. */
API i32 bih_factor(const Factor *factor, const Rows *matrix, double *work, double *diagonal, double *second, i64 *where) {
  Watch watch = {0, 0};
  i64 last = factor->tree->fronts - 1;
  i32 status = bih_eliminate(factor, matrix, 0, last, NULL, work, where, &watch);
  if (status || !diagonal) return status;
  return bih_invert(factor, 0, last, NULL, work, diagonal, second, NULL, &watch);
}

API i64 bih_factor_room(const Tree *t, i64 second, i32 inverted) {
  i64 up[3], down[2] = {0};
  bih_elimination_room(t, second, 0, t->fronts - 1, up);
  if (inverted) bih_inversion_room(t, 0, t->fronts - 1, down);
  return most(up[2], down[1]);
}
