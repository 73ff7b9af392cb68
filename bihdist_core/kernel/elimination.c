/* The numeric factorization: fronts are eliminated bottom up, with their derivatives or imaginary parts. */
#include "kernel.h"

static const double STIFF = 3e-2; /* Below this fraction of its diagonal entry a pivot has lost digits that matter: beside
  a degenerate face, of height h, rows have entries of size 1 / h, and what K lacks comes back in S magnified by that. */

typedef struct {
  const Factor *factor;
  const Rows *matrix; /* on and above the diagonal and below it, equal */
  double *stack, *const *blocks;
  double *F, *F1, *work;
  i64 row, column; /* an entry outside the pattern */
} Elimination;

static double *schur_of(const Elimination *e, i64 q) {
  const Tree *t = e->factor->tree;
  double *block = handed(e->blocks, q);
  return block ? block : e->stack + (1 + (e->factor->second != SINGLE)) * t->stack[q];
}

static i64 work_of(Front f, i64 second) {
  i64 products = second == DERIVATIVE ? f.c * (f.cp + 2 * f.mp) : 0, parts = 1 + (second == IMAGINARY);
  i64 refined = parts * most(f.c * f.mp, 2 * f.c * f.cp); /* for K, N */
  return most(most(sweep_work(f.c, f.sp, parts), f.s), most(products, refined)) + f.cp + PAD;
}

/* What eliminating the fronts first to last needs, in doubles: room[0] for the stack, room[1] for the largest front,
 * room[2] in all.  The last one's Schur complement is handed on as a block of (1, m, mp), or (2, m, mp) with
 * a second one. */
API void bih_elimination_room(const Tree *t, i64 second, i64 first, i64 last, i64 *room) {
  i64 stack = 0, front = 0, work = 0, blocks = 1 + (second != SINGLE);
  for (i64 q = first; q <= last; q++) {
    Front f = front_of(t, q);
    if (q < last) stack = most(stack, blocks * (t->stack[q] + f.m * f.mp));
    front = most(front, f.s * f.sp), work = most(work, work_of(f, second));
  }
  room[0] = padded(stack), room[1] = front + PAD, room[2] = room[0] + blocks * room[1] + work;
}

/* Add the Schur complement S of a child g into its parent's F; end (m,) as find_runs leaves it. */
static void add_child(Front g, const work_i32 *end, const double *S, double *F, i64 ld) {
  for (i64 i = 0; i < g.m; i++)
    for (i64 j = i; j < g.m;) {
      double *to = F + g.up[i] * ld + g.up[j];
      const double *from = S + i * g.mp + j, *last = S + i * g.mp + end[j];
      j = end[j];
      for (; from + LANES <= last; from += LANES, to += LANES) *(vec *)to += *(const vec *)from;
      for (; from < last; from++, to++) *to += *from;
    }
}

/* Fetch what the pivots some places further on will need: rows of the matrix lie in an order of their own.  Inline, for
 * GCC leaves out calls of functions that do no more than fetch. */
static inline __attribute__((always_inline)) void fetch_ahead(const Elimination *e, i64 place) {
  enum { STEP = 8 };
  const Tree *t = e->factor->tree;
  const Rows *L = e->matrix;
  if (place + 3 * STEP >= t->n) return;
  __builtin_prefetch(L->start + t->vertices[place + 3 * STEP]);
  i64 v = t->vertices[place + 2 * STEP], k = L->start[v];
  __builtin_prefetch(L->index + k), __builtin_prefetch(L->value + k), __builtin_prefetch(L->value + k + 7);
  v = t->vertices[place + STEP];
  for (k = L->start[v]; k < L->start[v + 1]; k++) __builtin_prefetch(t->place + L->index[k]);
}

/* How many of the ascending rows (m,) are below a place. */
static i64 count_below(const i32 *rows, i64 m, i64 place) {
  i64 low = 0;
  for (i64 half; m > 1; m -= half) half = m / 2, low += half * (rows[low + half - 1] < place); /* no branch to guess */
  return m ? low + (rows[low] < place) : 0;
}

/* F and F1 of a front: the matrix' entries, areas, and the Schur complements of its children; above the diagonal.  Of a
 * leaf's F1 that is a derivative there are the areas alone, and zeros for S1.  scale (c,): the matrix' own diagonal, before Schur complements come on top. */
static i32 assemble(Elimination *e, i64 q, Front f, double *scale, double *work) {
  const Tree *t = e->factor->tree;
  const Rows *L = e->matrix;
  double *F = e->F, *F1 = e->F1;
  const double *areas = e->factor->areas;
  i64 ld = f.sp, filled = is_short(e->factor, q) ? f.c * ld : 0;
  zero(F, 8 * f.s * ld);
  if (areas) zero(F1 + filled, 8 * (f.s * ld - filled));
  for (i64 i = 0; i < f.c; i++) {
    i64 v = t->vertices[f.first + i];
    fetch_ahead(e, f.first + i);
    for (i64 k = L->start[v]; k < L->start[v + 1]; k++) {
      i64 to = t->place[L->index[k]], at = to - f.first;
      if (at < i || L->value[k] == 0) continue;
      if (at >= f.c) {
        i64 below = count_below(f.rows, f.m, to);
        at = f.c + below;
        if (below == f.m || f.rows[below] != to) {
          e->row = v, e->column = L->index[k];
          return OUTSIDE;
        }
      }
      F[i * ld + at] += L->value[k];
    }
    scale[i] = F[i * ld + i];
    if (areas) F1[i * ld + i] = areas[f.first + i];
  }
  for (int k = 0; k < 2 && !is_leaf(t, q); k++) {
    i64 child = t->children[2 * q + k];
    Front g = front_of(t, child);
    const double *S = schur_of(e, child);
    work_i32 *end = (work_i32 *)work;
    find_runs(g, end);
    add_child(g, end, S, F, ld);
    if (areas) add_child(g, end, S + g.m * g.mp, F1, ld);
  }
  return DONE;
}

/* K = W^T W, W the inverse of Cholesky's factor of F: then F K = 1 holds to rounding, which a sweep does not give. */
static void invert_by_cholesky(const Front f, double *K, const double *F, double *work) {
  i64 c = f.c, cp = f.cp;
  double *D = work, *W = D + c * cp;
  zero(W, 8 * c * cp);
  for (i64 i = 0; i < c; i++) copy(D + i * cp + i, F + i * f.sp + i, 8 * (c - i)), W[i * cp + i] = 1;
  for (i64 k = 0; k < c; k++) {
    const double *d = D + k * cp, *w = W + k * cp;
    for (i64 i = k + 1; i < c; i++) {
      double factor = d[i] / d[k];
      for (i64 j = i; j < c; j++) D[i * cp + j] -= factor * d[j];
      for (i64 j = 0; j <= k; j++) W[i * cp + j] -= factor * w[j];
    }
  }
  for (i64 k = 0; k < c; k++) {
    double root = __builtin_sqrt(D[k * cp + k]);
    for (i64 j = 0; j <= k; j++) W[k * cp + j] /= root;
  }
  zero(K, 8 * c * cp);
  add_upper_product(c, c, c, 1, W, 1, cp, W, cp, K, cp);
  for (i64 i = 0; i < c; i++)
    for (i64 j = 0; j < i; j++) K[i * cp + j] = K[j * cp + i];
}

/* The same of a complex F, by Newton's step K += K (1 - F K). */
static void improve(const Front f, Pair K, Pair F, double *work) {
  i64 c = f.c, cp = f.cp;
  Pair E = {work, work + c * cp};
  double *const parts[] = {E.x, E.x1, K.x, K.x1};
  zero(E.x, 16 * c * cp);
  for (i64 i = 0; i < c; i++) E.x[i * cp + i] = 1;
  add_pairs(0, c, c, c, -1, F, f.sp, 1, K, cp, E, cp);
  double *T = E.x1 + c * cp; /* K, which the product reads as it was */
  copy(T, K.x, 8 * c * cp), copy(T + c * cp, K.x1, 8 * c * cp);
  add_pairs(1, c, c, c, 1, (Pair){T, T + c * cp}, cp, 1, E, cp, K, cp);
  for (int p = 2; p < 4; p++)
    for (i64 i = 0; i < c; i++)
      for (i64 j = 0; j < i; j++) parts[p][i * cp + j] = parts[p][j * cp + i];
}

/* One step of iterative refinement of N: F N = -R then holds to rounding, as after solves with Cholesky's factor.  F as
 * assembled, mirrored; overwrites its boundary block with S. */
static void refine(const Front f, Pair K, Pair N, i64 ln, Pair F, double *work) {
  i64 c = f.c, m = f.m, mp = f.mp, ld = f.sp, right = c * ld + c;
  Pair E = {work, F.x1 ? work + c * mp : NULL}; /* R + F N */
  for (int p = 0; p < 1 + (F.x1 != NULL); p++)
    for (i64 i = 0; i < c; i++) {
      double *e = (p ? E.x1 : E.x) + i * mp;
      copy(e, (p ? F.x1 : F.x) + i * ld + c, 8 * m);
      zero(e + m, 8 * (mp - m));
    }
  add_pairs(0, c, m, c, 1, F, ld, 1, N, ln, E, mp);
  add_pairs(0, c, m, c, -1, K, f.cp, 1, E, mp, N, ln);
  Pair R = {F.x + c, F.x1 ? F.x1 + c : NULL}, S = {F.x + right, F.x1 ? F.x1 + right : NULL};
  add_pairs(1, m, m, c, 1, R, 1, ld, N, ln, S, ld);
}

/* Of a leaf: in the boundary block of F1, S1 = X + X^T = N^T A N. */
static void derive_leaf(const Front f, const double *N, double *F1, double *work) {
  i64 c = f.c, m = f.m, mp = f.mp, ld = f.sp;
  for (i64 i = 0; i < c; i++)
    for (i64 j = 0; j < mp; j++) work[i * mp + j] = F1[i * ld + i] * N[i * mp + j];
  add_upper_product(m, m, c, 1, work, 1, mp, N, mp, F1 + c * ld + c, ld);
}

/* Of other fronts: K1, N1 and, in the boundary block of F1, S1. */
static void derive(const Front f, const double *K, double *K1, const double *N, double *N1, i64 ln, double *F1,
                   double *work) {
  i64 c = f.c, m = f.m, cp = f.cp, mp = f.mp, ld = f.sp;
  double *T = work, *U = T + c * cp, *P = U + c * mp, *S1 = F1 + c * ld + c;
  zero(K1, 8 * c * cp);
  for (i64 i = 0; i < c; i++) zero(N1 + i * ln, 8 * mp);
  for (i64 i = 0; i < c; i++)
    for (i64 j = 0; j < i; j++) F1[i * ld + j] = F1[j * ld + i];
  zero(T, 8 * c * (cp + mp));
  add_product(c, c, c, 1, F1, ld, 1, K, cp, T, cp);
  add_product(c, m, c, 1, F1, ld, 1, N, ln, U, mp);
  for (i64 i = 0; i < c; i++)
    for (i64 j = 0; j < m; j++) {
      double r = F1[i * ld + c + j], u = U[i * mp + j];
      P[i * mp + j] = r + u / 2, U[i * mp + j] = r + u;
    }
  add_upper_product(c, c, c, 1, K, cp, 1, T, cp, K1, cp);
  for (i64 i = 0; i < c; i++)
    for (i64 j = 0; j < i; j++) K1[i * cp + j] = K1[j * cp + i];
  add_product(c, m, c, 1, K, cp, 1, U, mp, N1, ln);
  add_upper_product(m, m, c, 1, P, 1, mp, N, ln, S1, ld);
  add_upper_product(m, m, c, 1, N, 1, ln, P, mp, S1, ld);
}

/* K and N (c, m) out of a swept F. */
static void take_swept(const Front f, const double *F, double *K, double *N, i64 ln) {
  i64 c = f.c, m = f.m, ld = f.sp;
  for (i64 i = 0; i < c; i++) {
    for (i64 j = i; j < c; j++) K[i * f.cp + j] = K[j * f.cp + i] = -F[i * ld + j];
    for (i64 j = c; j < f.cp; j++) K[i * f.cp + j] = 0;
    for (i64 j = 0; j < m; j++) N[i * ln + j] = -F[i * ld + c + j];
    for (i64 j = m; j < f.mp; j++) N[i * ln + j] = 0;
  }
}

static void mirror(i64 c, double *F, i64 ld) {
  for (i64 i = 0; i < c; i++)
    for (i64 j = 0; j < i; j++) F[i * ld + j] = F[j * ld + i];
}

static i32 eliminate(Elimination *e, i64 q) {
  const Tree *t = e->factor->tree;
  Front f = front_of(t, q);
  i64 c = f.c, m = f.m, ld = f.sp, ln = kept(e->factor, q) * f.mp, second = e->factor->second;
  int is_complex = second == IMAGINARY;
  double *scale = e->work, *work = scale + f.cp, left = 1;
  Pair F = {e->F, is_complex ? e->F1 : NULL};
  i32 status = assemble(e, q, f, scale, work);
  if (status) return status;
  for (i64 i = 0; i < c; i++) {
    if (is_complex) scale[i] = scale[i] < 0 ? -scale[i] : scale[i];
    else if (!(scale[i] > 0)) return NOT_POSITIVE;
  }
  if (!sweep(c, f.s, F, ld, scale, work, &left)) return NOT_POSITIVE;
  double *K = block_K(e->factor, q), *K1 = K + c * f.cp, *N = block_N(e->factor, q), *N1 = N + f.mp;
  take_swept(f, e->F, K, N, ln);
  if (is_complex) take_swept(f, e->F1, K1, N1, ln);
  if (left < STIFF) {
    assemble(e, q, f, scale, work); /* the children's Schur complements are still there */
    if (!is_complex) invert_by_cholesky(f, K, e->F, work);
    mirror(c, e->F, ld);
    if (is_complex) mirror(c, e->F1, ld), improve(f, (Pair){K, K1}, F, work);
    refine(f, (Pair){K, is_complex ? K1 : NULL}, (Pair){N, N1}, ln, F, work);
  }
  if (is_short(e->factor, q)) derive_leaf(f, N, e->F1, work);
  else if (second == DERIVATIVE) derive(f, K, K1, N, N1, ln, e->F1, work);
  double *S = schur_of(e, q), *S1 = S + m * f.mp;
  for (i64 i = 0; i < m; i++) {
    copy(S + i * f.mp + i, e->F + (c + i) * ld + c + i, 8 * (m - i));
    if (second) copy(S1 + i * f.mp + i, e->F1 + (c + i) * ld + c + i, 8 * (m - i));
  }
  return DONE;
}

/* Eliminate the fronts first to last, one task.  blocks (fronts,): where Schur complements lie that tasks hand on, the
 * last one's and, of a top front, its children's; NULL for others, or for all.  work: as much as bih_elimination_room says;
 * where (2,): the entry if one is OUTSIDE. */
API i32 bih_eliminate(const Factor *factor, const Rows *matrix, i64 first, i64 last, double *const *blocks, double *work,
                      i64 *where, Watch *watch) {
  i64 room[3];
  i64 parts = 1 + (factor->second != SINGLE);
  bih_elimination_room(factor->tree, factor->second, first, last, room);
  double *F = work + room[0];
  Elimination e = {factor, matrix, work, blocks, F, F + room[1], F + parts * room[1], 0, 0};
  for (i64 q = first; q <= last; q++) {
    if (stopped(watch)) return STOPPED;
    i32 status = eliminate(&e, q);
    if (status) {
      where[0] = e.row, where[1] = e.column;
      return status;
    }
    Front f = front_of(factor->tree, q);
    advance(watch, f.c * f.s * f.s);
  }
  return DONE;
}
