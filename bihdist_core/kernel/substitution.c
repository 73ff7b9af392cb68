/* Solves with a finished factor.  Vectors are (n, k), in elimination order, their k columns beside each other.
 *
 * Up, from the leaves to the root: x[boundary] += N^T x[pivots].  Down: x[pivots] = K x[pivots] + N x[boundary].  With
 * the derivatives the same sweeps turn a unit vector x into a column of G, and y = 0 into one of G A G beside it:
 * up: y[boundary] += N^T y[pivots] + N1^T x[pivots];  down: y[pivots] = K y[pivots] + K1 x[pivots] + N y[boundary] +
 * N1 x[boundary]. */
#include "kernel.h"

#ifndef LANES
#define LANES 2
#endif
typedef double vec __attribute__((vector_size(8 * LANES), aligned(8), may_alias));

static double sum(vec v) {
  double s = 0;
  for (int k = 0; k < LANES; k++) s += v[k];
  return s;
}

/* Row r of a vector: of the task's own places, or of those that tasks share. */
static inline double *row_of(const Tree *t, double *own, double *above, i64 end, i64 k, i64 r) {
  return r < end ? own + r * k : above + t->rank[r] * k;
}

/* Doubles that a sweep of k columns up or down the fronts first to last needs to work. */
API i64 bih_sweep_room(const Tree *t, i64 first, i64 last, i64 k) {
  i64 room = 0;
  for (i64 q = first; q <= last; q++) {
    Front f = front_of(t, q);
    room = most(room, f.sp);
  }
  return 4 * room * padded(k) + 4 * PAD;
}

/* Sweep x (n, k) up the fronts first to last; what comes to places from `end` on, all of them pivots of
 * top fronts, is added to above (r, k), by their rank among those. */
API i32 bih_sweep_up(const Factor *factor, i64 first, i64 last, i64 end, i64 k, double *x, double *above, double *work,
                     Watch *watch) {
  const Tree *t = factor->tree;
  i64 kp = padded(k);
  for (i64 q = first; q <= last; q++) {
    if (stopped(watch)) return STOPPED;
    Front f = front_of(t, q);
    i64 ln = (1 + factor->dual) * f.mp, filled = 0;
    const double *N = block_N(factor, q), *pivots = x + f.first * k;
    for (i64 i = 0; i < f.c * k && !filled; i++) filled = pivots[i] != 0;
    if (!filled) continue;
    if (k == 1) {
      zero(work, 8 * f.mp);
      for (i64 i = 0; i < f.c; i++)
        for (i64 j = 0; j < f.mp; j++) work[j] += N[i * ln + j] * pivots[i];
      for (i64 j = 0; j < f.m; j++) *row_of(t, x, above, end, 1, f.rows[j]) += work[j];
      continue;
    }
    double *sent = work, *p = work + f.m * kp;
    zero(sent, 8 * f.m * kp);
    for (i64 i = 0; i < f.c; i++) {
      copy(p + i * kp, pivots + i * k, 8 * k);
      for (i64 j = k; j < kp; j++) p[i * kp + j] = 0;
    }
    add_product(f.m, k, f.c, 1, N, 1, ln, p, kp, sent, kp);
    for (i64 j = 0; j < f.m; j++) {
      double *to = row_of(t, x, above, end, k, f.rows[j]);
      for (i64 l = 0; l < k; l++) to[l] += sent[j * kp + l];
    }
  }
  return DONE;
}

/* Sweep x (n, k) down the fronts last to first. */
API i32 bih_sweep_down(const Factor *factor, i64 first, i64 last, i64 k, double *x, double *work, Watch *watch) {
  const Tree *t = factor->tree;
  i64 kp = padded(k);
  for (i64 q = last; q >= first; q--) {
    if (stopped(watch)) return STOPPED;
    Front f = front_of(t, q);
    i64 ln = (1 + factor->dual) * f.mp;
    const double *K = block_K(factor, q), *N = block_N(factor, q);
    double *pivots = x + f.first * k, *b = work, *p = b + f.mp * kp, *r = p + f.cp * kp;
    if (k == 1) {
      for (i64 j = 0; j < f.m; j++) b[j] = x[f.rows[j]];
      for (i64 j = f.m; j < f.mp; j++) b[j] = 0;
      copy(p, pivots, 8 * f.c);
      for (i64 j = f.c; j < f.cp; j++) p[j] = 0;
      for (i64 i = 0; i < f.c; i++) {
        vec v = {0};
        for (i64 j = 0; j < f.cp; j += LANES) v += *(const vec *)(K + i * f.cp + j) * *(const vec *)(p + j);
        for (i64 j = 0; j < f.mp; j += LANES) v += *(const vec *)(N + i * ln + j) * *(const vec *)(b + j);
        pivots[i] = sum(v);
      }
      continue;
    }
    for (i64 j = 0; j < f.m; j++) {
      copy(b + j * kp, x + f.rows[j] * k, 8 * k);
      for (i64 l = k; l < kp; l++) b[j * kp + l] = 0;
    }
    for (i64 i = 0; i < f.c; i++) {
      copy(p + i * kp, pivots + i * k, 8 * k);
      for (i64 l = k; l < kp; l++) p[i * kp + l] = 0;
    }
    zero(r, 8 * f.c * kp);
    add_product(f.c, k, f.c, 1, K, f.cp, 1, p, kp, r, kp);
    add_product(f.c, k, f.m, 1, N, ln, 1, b, kp, r, kp);
    for (i64 i = 0; i < f.c; i++) copy(pivots + i * k, r + i * kp, 8 * k);
  }
  return DONE;
}

/* Send unit vectors up their paths to the root: x, y (n, k), zero but for what is found here.  column (k,): the place of
 * each unit; on (fronts,): set where there is something to begin from. */
API void bih_send_units(const Factor *factor, const i32 *front, const i32 *column, i64 k, double *x, double *y,
                        unsigned char *on) {
  const Tree *t = factor->tree;
  for (i64 l = 0; l < k; l++) {
    x[column[l] * k + l] = 1;
    for (i64 q = front[l]; q >= 0; q = t->parent[q]) {
      Front f = front_of(t, q);
      const double *N = block_N(factor, q);
      on[q] = 1;
      for (i64 i = 0; i < f.c; i++, N += 2 * f.mp) {
        double a = x[(f.first + i) * k + l], b = y[(f.first + i) * k + l];
        if (a == 0 && b == 0) continue;
        for (i64 j = 0; j < f.m; j++) {
          i64 to = f.rows[j] * k + l;
          x[to] += N[j] * a, y[to] += N[j] * b + N[f.mp + j] * a;
        }
      }
    }
  }
}

/* Sweep x and y (n, k) down the fronts last to first. */
API i32 bih_sweep_down_both(const Factor *factor, i64 first, i64 last, i64 k, double *x, double *y,
                            const unsigned char *on, double *work, Watch *watch) {
  const Tree *t = factor->tree;
  i64 kp = padded(k);
  for (i64 q = last; q >= first; q--) {
    if (stopped(watch)) return STOPPED;
    Front f = front_of(t, q);
    i64 c = f.c, m = f.m, cp = f.cp, mp = f.mp;
    const double *K = block_K(factor, q), *K1 = K + c * cp, *N = block_N(factor, q), *N1 = N + mp;
    if (k == 1) {
      double *bx = work, *by = bx + mp, *px = by + mp, *py = px + cp;
      for (i64 j = 0; j < m; j++) bx[j] = x[f.rows[j]], by[j] = y[f.rows[j]];
      for (i64 j = m; j < mp; j++) bx[j] = by[j] = 0;
      for (i64 i = 0; i < c; i++) {
        px[i] = py[i] = 0;
        for (i64 j = 0; on[q] && j < c; j++) {
          double a = x[f.first + j], b = y[f.first + j];
          px[i] += K[i * cp + j] * a, py[i] += K[i * cp + j] * b + K1[i * cp + j] * a;
        }
      }
      for (i64 i = 0; i < c; i++, N += 2 * mp, N1 += 2 * mp) {
        vec real = {0}, one = {0}, other = {0};
        for (i64 j = 0; j < mp; j += LANES) {
          vec n = *(const vec *)(N + j), a = *(const vec *)(bx + j);
          real += n * a, one += n * *(const vec *)(by + j), other += *(const vec *)(N1 + j) * a;
        }
        x[f.first + i] = px[i] + sum(real), y[f.first + i] = py[i] + sum(one + other);
      }
      continue;
    }
    i64 wide = 2 * kp; /* x and y beside each other: one product with N serves both */
    double *b = work, *p = b + mp * wide, *r = p + 0;
    for (i64 j = 0; j < m; j++) {
      double *to = b + j * wide;
      copy(to, x + f.rows[j] * k, 8 * k), copy(to + kp, y + f.rows[j] * k, 8 * k);
      for (i64 l = k; l < kp; l++) to[l] = to[kp + l] = 0;
    }
    zero(r, 8 * c * wide);
    if (on[q]) {
      double *units = r + c * wide;
      for (i64 i = 0; i < c; i++) {
        double *to = units + i * wide;
        copy(to, x + (f.first + i) * k, 8 * k), copy(to + kp, y + (f.first + i) * k, 8 * k);
        for (i64 l = k; l < kp; l++) to[l] = to[kp + l] = 0;
      }
      add_product(c, wide, c, 1, K, cp, 1, units, wide, r, wide);
      add_product(c, k, c, 1, K1, cp, 1, units, wide, r + kp, wide);
    }
    add_product(c, wide, m, 1, N, 2 * mp, 1, b, wide, r, wide);
    add_product(c, k, m, 1, N1, 2 * mp, 1, b, wide, r + kp, wide);
    for (i64 i = 0; i < c; i++) {
      copy(x + (f.first + i) * k, r + i * wide, 8 * k), copy(y + (f.first + i) * k, r + i * wide + kp, 8 * k);
    }
  }
  return DONE;
}
