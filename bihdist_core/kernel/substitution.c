/* Solves with a finished factor.  A vector is (n, w), in elimination order, its w columns beside each other; w is 1 or a
 * multiple of PAD.  work: (w, row + 2 PAD) doubles and 2 PAD more, row the longest padded row of a front.
 *
 * Up, from the leaves to the root: x[boundary] += N^T x[pivots].  Down: x[pivots] = K x[pivots] + N x[boundary].  With
 * the derivatives the same sweeps turn unit vectors x into columns of G, and y = 0 into those of G A G:
 * up: y[boundary] += N^T y[pivots] + N1^T x[pivots];  down: y[pivots] = K y[pivots] + K1 x[pivots] + N y[boundary] +
 * N1 x[boundary].  Then a vector is (n, 2 w), x and y beside each other, and one product with N serves both.  Of a leaf,
 * whose y is 0 before, up: y[boundary] += N^T (A K x[pivots]), and, with x as it is after it, down: y[pivots] =
 * K (A x[pivots]) + N y[boundary].
 *
 * Of complex numbers x + i y the sweeps are the same, for leaves too, but that what y is multiplied by on the way to y
 * with e^2 = -1 is taken from x: up: x[boundary] -= N1^T y[pivots], down: x[pivots] -= K1 y[pivots] + N1 y[boundary]. */
#include "kernel.h"

enum { AHEAD = 256, SOON = 16, LINE = 8 }; /* so many doubles, or rows, are fetched before they are used; a line of the
                                               cache has so many */
static inline void fetch_ahead(const double *N, i64 length) {
  for (i64 j = 0; j < length; j += LINE) __builtin_prefetch(N + AHEAD + j);
}

static double sum(vec v) {
  double s = 0;
  for (int k = 0; k < LANES; k++) s += v[k];
  return s;
}

/* to (m, w): the rows of x (n, w); w is a multiple of PAD. */
static void gather(const i32 *rows, i64 m, i64 w, const double *x, double *to) {
  for (i64 j = 0; j < m; j++)
    for (i64 l = 0; l < w; l += LANES) *(vec *)(to + j * w + l) = *(const vec *)(x + rows[j] * w + l);
}

/* to (m,) += N^T x, N (c, ln) and x (c,); m is a multiple of PAD. */
static void add_rows(i64 c, i64 m, const double *N, i64 ln, const double *x, double *to) {
  i64 i = 0;
  for (; i + 4 <= c; i += 4, N += 4 * ln) { /* row by row, each would wait for what the one before stores */
    const double a = x[i], b = x[i + 1], c = x[i + 2], d = x[i + 3];
    fetch_ahead(N, 4 * ln);
    for (i64 j = 0; j < m; j += LANES)
      *(vec *)(to + j) += (a * *(const vec *)(N + j) + b * *(const vec *)(N + ln + j)) +
                          (c * *(const vec *)(N + 2 * ln + j) + d * *(const vec *)(N + 3 * ln + j));
  }
  for (; i < c; i++, N += ln) {
    const double a = x[i];
    for (i64 j = 0; j < m; j += LANES) *(vec *)(to + j) += a * *(const vec *)(N + j);
  }
}

/* Rows of b, ldb doubles apart, to the places first to end - 1 of x (n, w): k columns, and zeros beside them. */
API void bih_take_rows(const Tree *t, i64 first, i64 end, i64 k, i64 w, const double *b, i64 ldb, double *x) {
  for (i64 p = first; p < end; p++) {
    const double *next = b + t->vertices[least(p + SOON, end - 1)] * ldb, *from = b + t->vertices[p] * ldb;
    for (i64 l = 0; l < k; l += LINE) __builtin_prefetch(next + l);
    copy(x + p * w, from, 8 * k), zero(x + p * w + k, 8 * (w - k));
  }
}

/* The other way round: k columns of the places first to end - 1 of x (n, w) to rows of b. */
API void bih_put_rows(const Tree *t, i64 first, i64 end, i64 k, i64 w, const double *x, double *b, i64 ldb) {
  for (i64 p = first; p < end; p++) copy(b + t->vertices[p] * ldb, x + p * w, 8 * k);
}

/* Biharmonic distances of r vertices from k sources, by columns of G A G: values (r, ldv) of vertex (r,).
 *
 * With C = G A G - u u^T / sum(A), u = G A 1, and the diagonal of C, own (k,) at the sources, and share = u / sum(A) at
 * them: d^2 = diagonal + own - 2 C, put as d to rows `vertex` of out, ldo apart.  near (k,) counts d^2 below `limit`.
 * Returns how many d^2 are below `floor` or no number, 0 if all is well. */
API i64 bih_distances(i64 r, i64 k, const i64 *vertex, const double *values, i64 ldv, const double *diagonal,
                      const double *u, const double *own, const double *share, double floor, double limit, i64 *near,
                      double *out, i64 ldo) {
  i64 bad = 0;
  for (i64 i = 0; i < r; i++, values += ldv) {
    const double mine = diagonal[vertex[i]], by = u[vertex[i]];
    double *to = out + vertex[i] * ldo;
    for (i64 c = 0; c < k; c++) {
      double square = mine + own[c] - 2 * (values[c] - by * share[c]);
      bad += !(square >= floor), near[c] += square < limit;
      to[c] = __builtin_sqrt(square > 0 ? square : 0);
    }
  }
  return bad;
}

/* Sweep x (n, w) up the fronts first to last; what comes to places from `end` on, all of them pivots of top fronts, is
 * added to above (r, w), by their rank among those. */
API i32 bih_sweep_up(const Factor *factor, i64 first, i64 last, i64 end, i64 w, double *x, double *above, double *work,
                     Watch *watch) {
  const Tree *t = factor->tree;
  for (i64 q = first; q <= last; q++) {
    if (stopped(watch)) return STOPPED;
    Front f = front_of(t, q);
    i64 ln = kept(factor, q) * f.mp, filled = 0;
    const double *N = block_N(factor, q), *pivots = x + f.first * w;
    for (i64 i = 0; i < f.c * w && !filled; i++) filled = pivots[i] != 0;
    if (!filled) continue;
    zero(work, 8 * f.mp * w);
    if (w == 1)
      add_rows(f.c, f.mp, N, ln, pivots, work);
    else add_product(f.m, w, f.c, 1, N, 1, ln, pivots, w, work, w);
    for (i64 j = 0; j < f.m; j++) {
      i64 r = f.rows[j];
      double *to = r < end ? x + r * w : above + t->rank[r] * w;
      if (w == 1) *to += work[j];
      else
        for (i64 l = 0; l < w; l += LANES) *(vec *)(to + l) += *(const vec *)(work + j * w + l);
    }
  }
  return DONE;
}

/* Sweep x (n, w) down the fronts last to first. */
API i32 bih_sweep_down(const Factor *factor, i64 first, i64 last, i64 w, double *x, double *work, Watch *watch) {
  const Tree *t = factor->tree;
  for (i64 q = last; q >= first; q--) {
    if (stopped(watch)) return STOPPED;
    Front f = front_of(t, q);
    i64 ln = kept(factor, q) * f.mp;
    const double *K = block_K(factor, q), *N = block_N(factor, q);
    double *pivots = x + f.first * w, *b = work, *p = b + f.mp * w;
    if (w == 1) {
      for (i64 j = 0; j < f.mp; j++) b[j] = j < f.m ? x[f.rows[j]] : 0;
      for (i64 j = 0; j < f.cp; j++) p[j] = j < f.c ? pivots[j] : 0;
      for (i64 i = 0; i < f.c; i++) {
        vec v = {0};
        fetch_ahead(N + i * ln, ln);
        for (i64 j = 0; j < f.cp; j += LANES) v += *(const vec *)(K + i * f.cp + j) * *(const vec *)(p + j);
        for (i64 j = 0; j < f.mp; j += LANES) v += *(const vec *)(N + i * ln + j) * *(const vec *)(b + j);
        pivots[i] = sum(v);
      }
    } else {
      gather(f.rows, f.m, w, x, b);
      zero(p, 8 * f.c * w);
      add_product(f.c, w, f.c, 1, K, f.cp, 1, pivots, w, p, w);
      add_product(f.c, w, f.m, 1, N, ln, 1, b, w, p, w);
      copy(pivots, p, 8 * f.c * w);
    }
  }
  return DONE;
}

/* out (n, k) = L^-1 b, rows of b and of out ldb and ldo doubles apart, all of it on one thread; x (n, w). */
API void bih_solve(const Factor *factor, i64 k, i64 w, const double *b, i64 ldb, double *out, i64 ldo, double *x,
                   double *work) {
  const Tree *t = factor->tree;
  Watch watch = {0, 0};
  bih_take_rows(t, 0, t->n, k, w, b, ldb, x);
  bih_sweep_up(factor, 0, t->fronts - 1, t->n, w, x, NULL, work, &watch);
  bih_sweep_down(factor, 0, t->fronts - 1, w, x, work, &watch);
  bih_put_rows(t, 0, t->n, k, w, x, out, ldo);
}

/* What several columns send from one front to the places above it; work: (m + c, 2 w). */
static void send_several(const Factor *factor, Front f, i64 q, i64 w, const double *pivots, double *xy, double *work) {
  const double *N = block_N(factor, q), *N1 = N + f.mp;
  i64 ln = kept(factor, q) * f.mp;
  zero(work, 16 * f.mp * w);
  add_product(f.m, (is_short(factor, q) ? 1 : 2) * w, f.c, 1, N, 1, ln, pivots, 2 * w, work, 2 * w);
  if (is_short(factor, q)) {
    double *loads = work + f.mp * 2 * w; /* A K x */
    zero(loads, 8 * f.c * w);
    add_product(f.c, w, f.c, 1, block_K(factor, q), f.cp, 1, pivots, 2 * w, loads, w);
    for (i64 i = 0; i < f.c; i++)
      for (i64 l = 0; l < w; l++) loads[i * w + l] *= factor->areas[f.first + i];
    add_product(f.m, w, f.c, 1, N, 1, ln, loads, w, work + w, 2 * w);
  } else add_product(f.m, w, f.c, 1, N1, 1, ln, pivots, 2 * w, work + w, 2 * w);
  if (factor->second == IMAGINARY) add_product(f.m, w, f.c, -1, N1, 1, ln, pivots + w, 2 * w, work, 2 * w);
  for (i64 j = 0; j < f.m; j++)
    for (i64 l = 0; l < 2 * w; l += LANES) *(vec *)(xy + f.rows[j] * 2 * w + l) += *(const vec *)(work + j * 2 * w + l);
}

/* The same of one column, the only one here. */
static void send_one(const Factor *factor, Front f, i64 q, i64 w, i64 column, double *xy, double *work) {
  const double *N = block_N(factor, q), *K = block_K(factor, q), *pivots = xy + f.first * 2 * w + column;
  int is_complex = factor->second == IMAGINARY;
  double *a = work, *b = a + f.mp;
  zero(work, 16 * f.mp);
  for (i64 i = 0; i < f.c; i++, N += kept(factor, q) * f.mp) {
    double x = pivots[i * 2 * w], y = pivots[i * 2 * w + w], minus = is_complex ? y : 0;
    if (is_short(factor, q)) {
      for (i64 k = 0; k < f.c; k++) y += K[i * f.cp + k] * pivots[k * 2 * w];
      y *= factor->areas[f.first + i];
    }
    fetch_ahead(N, 2 * f.mp);
    if (x == 0 && y == 0) continue;
    if (is_short(factor, q))
      for (i64 j = 0; j < f.mp; j++) a[j] += N[j] * x, b[j] += N[j] * y;
    else
      for (i64 j = 0; j < f.mp; j++) a[j] += N[j] * x - N[f.mp + j] * minus, b[j] += N[j] * y + N[f.mp + j] * x;
  }
  for (i64 j = 0; j < f.m; j++) {
    double *to = xy + f.rows[j] * 2 * w + column;
    to[0] += a[j], to[w] += b[j];
  }
}

/* The front that eliminates a place. */
static i64 front_at(const Tree *t, i64 place) {
  i64 low = 0, high = t->fronts;
  while (high - low > 1) {
    i64 middle = (low + high) / 2;
    if (t->first[middle] <= place) low = middle;
    else high = middle;
  }
  return low;
}

/* Send xy (n, 2 w) up to the root, but for fronts with a count (fronts,) of 0, which are not set; of a count of 1 one
 * column alone is not 0. */
API void bih_sweep_up_both(const Factor *factor, i64 w, double *xy, const i32 *count, double *work) {
  const Tree *t = factor->tree;
  for (i64 q = 0; q < t->fronts; q++) {
    if (!count[q]) continue;
    Front f = front_of(t, q);
    const double *pivots = xy + f.first * 2 * w;
    if (count[q] > 1 && w > 1) {
      send_several(factor, f, q, w, pivots, xy, work);
      continue;
    }
    i64 column = 0; /* that of the only path here */
    for (i64 i = 0; i < f.c * 2 * w; i++)
      if (pivots[i] != 0) column = i % w;
    send_one(factor, f, q, w, column, xy, work);
  }
}

/* Send unit vectors, at places (k,), up their paths to the root; xy (n, 2 w), w >= k, is set there alone.
 * count (fronts,): on how many paths a front is. */
API void bih_send_units(const Factor *factor, const i32 *places, i64 k, i64 w, double *xy, i32 *count, double *work) {
  const Tree *t = factor->tree;
  for (i64 q = 0; q < t->fronts; q++) count[q] = 0;
  for (i64 l = 0; l < k; l++)
    for (i64 q = front_at(t, places[l]); q >= 0; q = t->parent[q])
      if (!count[q]++) zero(xy + t->first[q] * 2 * w, 16 * w * (t->first[q + 1] - t->first[q]));
  for (i64 l = 0; l < k; l++) xy[places[l] * 2 * w + l] = 1;
  bih_sweep_up_both(factor, w, xy, count, work);
}

/* Add the products of one row of N and of N1, or of K and of K1: x += N bx, x1 += N1 by, y += N by, y1 += N1 bx. */
typedef struct {
  vec x, x1, y, y1;
} Both;
static inline void add_row(Both *to, i64 length, const double *N, const double *N1, const double *bx, const double *by) {
  for (i64 j = 0; j < length; j += LANES) {
    vec n = *(const vec *)(N + j), n1 = *(const vec *)(N1 + j), b = *(const vec *)(bx + j), c = *(const vec *)(by + j);
    to->x += n * b, to->x1 += n1 * c, to->y += n * c, to->y1 += n1 * b;
  }
}

/* The pivots of one front, of a single column. */
static void down_one(const Factor *factor, Front f, i64 q, int sent, double *xy, double *work) {
  i64 c = f.c, cp = f.cp, mp = f.mp;
  int is_complex = factor->second == IMAGINARY;
  const double *K = block_K(factor, q), *K1 = K + c * cp, *N = block_N(factor, q);
  double *pivots = xy + 2 * f.first, *bx = work, *by = bx + mp, *px = by + mp, *py = px + cp;
  for (i64 j = 0; j < mp; j++) bx[j] = j < f.m ? xy[2 * f.rows[j]] : 0, by[j] = j < f.m ? xy[2 * f.rows[j] + 1] : 0;
  for (i64 j = 0; j < cp && sent; j++) px[j] = j < c ? pivots[2 * j] : 0, py[j] = j < c ? pivots[2 * j + 1] : 0;
  for (i64 i = 0; i < c; i++, N += 2 * mp) {
    Both p = {{0}, {0}, {0}, {0}};
    fetch_ahead(N, 2 * mp);
    if (sent) add_row(&p, cp, K + i * cp, K1 + i * cp, px, py);
    add_row(&p, mp, N, N + mp, bx, by);
    if (is_complex) p.x -= p.x1;
    pivots[2 * i] = sum(p.x), pivots[2 * i + 1] = sum(p.y + p.y1);
  }
}

/* The same of a leaf. */
static void down_one_leaf(const Factor *factor, Front f, i64 q, int sent, double *xy, double *work) {
  i64 c = f.c, cp = f.cp, mp = f.mp;
  const double *K = block_K(factor, q), *N = block_N(factor, q), *areas = factor->areas + f.first;
  double *pivots = xy + 2 * f.first, *bx = work, *by = bx + mp, *px = by + mp, *loads = px + cp;
  for (i64 j = 0; j < mp; j++) bx[j] = j < f.m ? xy[2 * f.rows[j]] : 0, by[j] = j < f.m ? xy[2 * f.rows[j] + 1] : 0;
  for (i64 j = 0; j < cp; j++) px[j] = j < c && sent ? pivots[2 * j] : 0, loads[j] = 0;
  for (i64 i = 0; i < c; i++, N += mp) {
    vec x = {0}, y = {0};
    fetch_ahead(N, mp);
    for (i64 j = 0; j < cp && sent; j += LANES) x += *(const vec *)(K + i * cp + j) * *(const vec *)(px + j);
    for (i64 j = 0; j < mp; j += LANES) {
      vec n = *(const vec *)(N + j);
      x += n * *(const vec *)(bx + j), y += n * *(const vec *)(by + j);
    }
    pivots[2 * i] = sum(x), pivots[2 * i + 1] = sum(y), loads[i] = areas[i] * pivots[2 * i];
  }
  for (i64 i = 0; i < c; i++) {
    vec y = {0};
    for (i64 j = 0; j < cp; j += LANES) y += *(const vec *)(K + i * cp + j) * *(const vec *)(loads + j);
    pivots[2 * i + 1] += sum(y);
  }
}

/* Sweep xy (n, 2 w) down the fronts last to first; count as bih_send_units left it. */
API i32 bih_sweep_down_both(const Factor *factor, i64 first, i64 last, i64 w, double *xy, const i32 *count, double *work,
                            Watch *watch) {
  const Tree *t = factor->tree;
  int is_complex = factor->second == IMAGINARY;
  for (i64 q = last; q >= first; q--) {
    if (stopped(watch)) return STOPPED;
    Front f = front_of(t, q);
    if (w == 1) {
      (is_short(factor, q) ? down_one_leaf : down_one)(factor, f, q, count[q] > 0, xy, work);
      continue;
    }
    i64 c = f.c, cp = f.cp, ln = kept(factor, q) * f.mp;
    const double *K = block_K(factor, q), *K1 = K + c * cp, *N = block_N(factor, q), *N1 = N + f.mp;
    double *pivots = xy + f.first * 2 * w, *b = work, *p = b + f.mp * 2 * w;
    gather(f.rows, f.m, 2 * w, xy, b);
    zero(p, 16 * c * w);
    add_product(c, 2 * w, f.m, 1, N, ln, 1, b, 2 * w, p, 2 * w);
    if (is_short(factor, q)) {
      if (count[q]) add_product(c, w, c, 1, K, cp, 1, pivots, 2 * w, p, 2 * w);
      for (i64 i = 0; i < c; i++)
        for (i64 l = 0; l < w; l++) pivots[i * 2 * w + l] = factor->areas[f.first + i] * p[i * 2 * w + l];
      add_product(c, w, c, 1, K, cp, 1, pivots, 2 * w, p + w, 2 * w);
    } else {
      add_product(c, w, f.m, 1, N1, ln, 1, b, 2 * w, p + w, 2 * w);
      if (is_complex) add_product(c, w, f.m, -1, N1, ln, 1, b + w, 2 * w, p, 2 * w);
      if (count[q]) {
        add_product(c, 2 * w, c, 1, K, cp, 1, pivots, 2 * w, p, 2 * w);
        add_product(c, w, c, 1, K1, cp, 1, pivots, 2 * w, p + w, 2 * w);
        if (is_complex) add_product(c, w, c, -1, K1, cp, 1, pivots + w, 2 * w, p, 2 * w);
      }
    }
    copy(pivots, p, 16 * c * w);
  }
  return DONE;
}
