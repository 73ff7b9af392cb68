/* Intrinsic Delaunay triangulations, of surfaces and of tufted covers (Sharp and Crane 2020), and the Delaunay
 * triangles about each point of a cloud.
 *
 * Side 3 f + k of triangle f is opposite to its corner k, and leads from corner k + 1 to corner k + 2. */
#include "kernel.h"

enum { NONE = -1, MOST = 64 };
#define SLACK 1e-12 /* by how much, for rounding, cotangents may add up to less than nothing */
#define TIE 1e-9    /* in one place, on one line or one circle, for rounding: a share of lengths, or a sine */

typedef struct {
  i32 *corner;    /* (m, 3) vertices; one may be at several corners */
  double *length; /* (m, 3) of sides */
  i32 *twin;      /* (m, 3) twice the side that each is glued to, and 1 if both lead the same way; NONE on a boundary */
} Triangles;

static inline i32 next(i32 s) { return s % 3 == 2 ? s - 2 : s + 1; }
static inline i32 previous(i32 s) { return s % 3 ? s - 1 : s + 2; }
static inline double root(double x) { return __builtin_sqrt(x > 0 ? x : 0); }
static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static void cross(const double *a, const double *b, double *c) {
  for (int k = 0; k < 3; k++) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}
static void between(const double *x, i64 from, i64 to, double *d) {
  for (int k = 0; k < 3; k++) d[k] = x[3 * to + k] - x[3 * from + k];
}

/* Glue side s to what `twin` says, and that to it. */
static void glue(const Triangles *T, i32 s, i32 twin) {
  T->twin[s] = twin;
  if (twin >= 0) T->twin[twin >> 1] = 2 * s + (twin & 1);
}

/* The area of a triangle by its sides, to all digits (Kahan 1986). */
static double area_of(double a, double b, double c) {
  double t;
  if (a < b) t = a, a = b, b = t;
  if (b < c) t = b, b = c, c = t;
  if (a < b) t = a, a = b, b = t;
  return root((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))) / 4;
}

/* The cotangent of the corner opposite to a side. */
static double cotangent(const Triangles *T, i32 s) {
  double a = T->length[s], b = T->length[next(s)], c = T->length[previous(s)];
  return (b * b + c * c - a * a) / (4 * area_of(a, b, c) + 1e-300);
}

static int is_delaunay(const Triangles *T, i32 s) {
  i32 t = T->twin[s] >> 1;
  if (t < 0 || t / 3 == s / 3) return 1;
  double a = cotangent(T, s), b = cotangent(T, t);
  return !(a + b < -SLACK * (1 + __builtin_fabs(a) + __builtin_fabs(b)));
}

/* Flip side s: triangles p, i, j and q, j, i become p, i, q and p, q, j, with `outer` sides p i, i q, q j and j p. */
static void flip(const Triangles *T, i32 s, i32 *outer) {
  i32 t = T->twin[s] >> 1, f = s - s % 3, g = t - t % 3, turned = T->twin[s] & 1; /* then the second is q, i, j */
  i32 old[4] = {previous(s), turned ? previous(t) : next(t), turned ? next(t) : previous(t), next(s)};
  i32 to[4] = {f + 2, f, g, g + 1}, change[4] = {0, turned, turned, 0}, twin[4];
  i32 p = T->corner[s], i = T->corner[next(s)], j = T->corner[previous(s)], q = T->corner[t];
  double base = T->length[s], l[4];
  for (int k = 0; k < 4; k++) {
    l[k] = T->length[old[k]], twin[k] = T->twin[old[k]];
    if (twin[k] < 0) continue;
    twin[k] ^= change[k];
    for (int n = 0; n < 4; n++) /* these may be glued to each other */
      if (twin[k] >> 1 == old[n]) {
        twin[k] = 2 * to[n] + ((twin[k] & 1) ^ change[n]);
        break;
      }
  }
  double x = (base * base + l[0] * l[0] - l[3] * l[3]) / (2 * base), y = 2 * area_of(base, l[0], l[3]) / base;
  double u = (base * base + l[1] * l[1] - l[2] * l[2]) / (2 * base), v = 2 * area_of(base, l[1], l[2]) / base;
  T->corner[f] = T->corner[g] = p, T->corner[f + 1] = i, T->corner[g + 2] = j;
  T->corner[f + 2] = T->corner[g + 1] = q;
  T->length[f + 1] = T->length[g + 2] = root((x - u) * (x - u) + (y + v) * (y + v));
  for (int k = 0; k < 4; k++) T->length[to[k]] = l[k], glue(T, to[k], twin[k]), outer[k] = to[k];
  glue(T, f + 1, 2 * (g + 2));
}

/* Flip sides of m triangles until all are Delaunay, but so often at most that rounding cannot go round in circles.
 * waiting (m, 3), is_waiting (m, 3), 0 before. */
static void flip_all(i64 m, const Triangles *T, i32 *waiting, unsigned char *is_waiting) {
  enum { MANY = 1000 };
  i64 count = 0, flips = 0;
  for (i32 s = 0; s < 3 * m; s++)
    if (T->twin[s] >> 1 > s && !is_delaunay(T, s)) waiting[count++] = s, is_waiting[s] = 1;
  while (count && flips < MANY * m) {
    i32 s = waiting[--count], outer[4];
    is_waiting[s] = 0;
    if (is_delaunay(T, s)) continue;
    flip(T, s, outer), flips++;
    for (int k = 0; k < 4; k++)
      if (!is_waiting[outer[k]]) waiting[count++] = outer[k], is_waiting[outer[k]] = 1;
  }
}

/* What grows with the angle of d about a direction, of which `axes` (2, 3) are across, from -2 to 2. */
static double angle_of(const double *d, const double *axes) {
  double x = dot(d, axes), y = dot(d, axes + 3), size = __builtin_fabs(x) + __builtin_fabs(y);
  double c = size > 0 ? x / size : 1;
  return y < 0 ? c - 1 : 1 - c;
}

/* Two axes (2, 3) across a direction, of one length. */
static void find_axes(const double *d, double *axes) {
  double unit[3] = {0, 0, 0}, length = root(dot(d, d));
  int least = 0;
  for (int k = 1; k < 3; k++)
    if (__builtin_fabs(d[k]) < __builtin_fabs(d[least])) least = k;
  unit[least] = length;
  cross(d, unit, axes), cross(d, axes, axes + 3);
  for (int k = 0; k < 3; k++) axes[k] *= length;
}

/* The side of the back of one of m faces that is behind side s of its front. */
static i32 behind(i64 m, i32 s) { return (i32)(3 * m) + s - s % 3 + (3 - s % 3) % 3; }

/* Glue the fronts and backs of m faces about an edge with `count` sides, each to the next by its angle (count,). */
static void glue_around(i64 m, const Triangles *T, const double *x, i64 count, i32 *side, double *angle) {
  i32 tail = T->corner[next(side[0])], head = T->corner[previous(side[0])];
  double d[3], axes[6];
  between(x, tail, head, d), find_axes(d, axes);
  for (i64 k = 0; k < count; k++) {
    between(x, tail, T->corner[side[k]], d);
    double a = angle_of(d, axes);
    i32 s = side[k];
    i64 j = k;
    for (; j > 0 && angle[j - 1] > a; j--) angle[j] = angle[j - 1], side[j] = side[j - 1];
    angle[j] = a, side[j] = s;
  }
  for (i64 k = 0; k < count; k++) { /* what looks the way in which angles grow leads from the tail to the head */
    i32 s = side[k], t = side[k + 1 < count ? k + 1 : 0];
    if (T->corner[next(s)] != tail) s = behind(m, s);
    if (T->corner[next(t)] == tail) t = behind(m, t);
    glue(T, s, 2 * t);
  }
}

/* Make m faces, corner and length (m, 3), an intrinsic Delaunay triangulation; or, with x (n, 3), their tufted cover,
 * where corner and length (2 m, 3) have their backs behind them, with corners 0, 2 and 1.  edge (m, 3): that of each
 * side, from 0 to e - 1.  With M triangles in all: twin (M, 3); work (e + 1 + 3 M,), is_waiting (M, 3), 0 before, angle
 * (m, 3). */
API void bih_make_delaunay(i64 m, i64 e, const i64 *edge, const double *x, i32 *corner, double *length, i32 *twin,
                           i32 *work, unsigned char *is_waiting, double *angle) {
  Triangles T = {corner, length, twin};
  i32 *first = work, *sorted = work + e + 1;
  zero(first, 4 * (e + 1));
  for (i64 s = 0; s < 3 * m; s++) first[edge[s] + 1]++, twin[s] = NONE;
  for (i64 i = 0; i < e; i++) first[i + 1] += first[i];
  for (i32 s = 0; s < 3 * m; s++) sorted[first[edge[s]]++] = s;
  for (i64 i = 0, begin = 0; i < e; begin = first[i++]) {
    i32 *side = sorted + begin;
    i64 count = first[i] - begin;
    if (x) glue_around(m, &T, x, count, side, angle);
    else if (count == 2) glue(&T, side[0], 2 * side[1] + (corner[next(side[0])] == corner[next(side[1])]));
  }
  flip_all(x ? 2 * m : m, &T, sorted, is_waiting);
}

/* Eigenvectors (3, 3), by columns, of a symmetric matrix; its diagonal becomes the eigenvalues (Jacobi). */
static void diagonalize(double C[3][3], double V[3][3]) {
  enum { TURNS = 30 };
  for (int k = 0; k < 9; k++) V[k / 3][k % 3] = k % 4 == 0;
  for (int turn = 0; turn < TURNS; turn++) {
    int p = turn % 3 == 2, q = 1 + (turn % 3 > 0);
    if (C[p][q] == 0) continue;
    double h = (C[q][q] - C[p][p]) / (2 * C[p][q]), t = 1 / (__builtin_fabs(h) + root(h * h + 1));
    double c = 1 / root(t * t + 1), s = (h < 0 ? -t : t) * c;
    for (int k = 0; k < 3; k++) {
      double a = C[k][p], b = C[k][q], v = V[k][p], w = V[k][q];
      C[k][p] = c * a - s * b, C[k][q] = s * a + c * b, V[k][p] = c * v - s * w, V[k][q] = s * v + c * w;
    }
    for (int k = 0; k < 3; k++) {
      double a = C[p][k], b = C[q][k];
      C[p][k] = c * a - s * b, C[q][k] = s * a + c * b;
    }
  }
}

typedef struct {
  double x, y;
} Point;
static inline Point minus(Point a, Point b) { return (Point){a.x - b.x, a.y - b.y}; }
static inline double square(Point a) { return a.x * a.x + a.y * a.y; }
static inline double along(Point a, Point b) { return a.x * b.x + a.y * b.y; }
/* 1 where b is left of a, -1 where it is right, 0 on one line. */
static int side_of(Point a, Point b) {
  double turn = a.x * b.y - a.y * b.x;
  return turn * turn <= TIE * TIE * square(a) * square(b) ? 0 : turn > 0 ? 1 : -1;
}

/* p and id (k + 1,): points of x in the plane that fits near (k,) best, inverted at a circle about the one in the
 * middle, which is at 0 and comes first, and their numbers; of those in one place the nearest alone.  Returns how many
 * there are. */
static i64 invert(i64 k, const double *x, i64 middle, const i64 *near, Point *p, i64 *id) {
  double d[MOST][3], far = 0, mean[3] = {0}, C[3][3] = {{0}}, V[3][3];
  for (i64 i = 0; i < k; i++) {
    between(x, middle, near[i], d[i]);
    for (int a = 0; a < 3; a++)
      if (__builtin_fabs(d[i][a]) > far) far = __builtin_fabs(d[i][a]);
  }
  for (i64 i = 0; i < k; i++)
    for (int a = 0; a < 3; a++) d[i][a] /= far, mean[a] += d[i][a] / (double)k;
  for (i64 i = 0; i < k; i++)
    for (int a = 0; a < 9; a++) C[a / 3][a % 3] += (d[i][a / 3] - mean[a / 3]) * (d[i][a % 3] - mean[a % 3]);
  diagonalize(C, V);
  int least = C[1][1] < C[0][0];
  if (C[2][2] < C[least][least]) least = 2;
  int u = (least + 1) % 3, v = (least + 2) % 3;
  i64 count = 1;
  p[0] = (Point){0, 0}, id[0] = middle;
  for (i64 i = 0; i < k; i++) {
    Point a = {0, 0};
    for (int c = 0; c < 3; c++) a.x += d[i][c] * V[c][u], a.y += d[i][c] * V[c][v];
    double size = square(a);
    i64 j = 1;
    if (!(size > TIE * TIE)) continue;
    a.x /= size, a.y /= size;
    while (j < count && square(minus(a, p[j])) > TIE * TIE * square(a)) j++;
    if (j == count) p[count] = a, id[count++] = near[i];
  }
  return count;
}

/* The Delaunay triangles about each of the points first to end - 1 of x (n, 3), in the plane of the k points near it,
 * near (k,), at most MOST - 1: of star (k, 2) the first `size` are their other corners.  An inversion makes circles
 * through the point lines, and so these are the edges of the convex hull of what it makes of the others, and of the
 * point.  Points on one circle are joined to the one with the least number, so that the stars of all of them agree. */
API void bih_stars(i64 first, i64 end, i64 k, const double *x, const i64 *near, i32 *size, i32 *star) {
  for (i64 middle = first; middle < end; middle++, near += k, star += 2 * k, size++) {
    Point p[MOST];
    i64 id[MOST], count = invert(k, x, middle, near, p, id), begin = 0, a, b, run[MOST];
    for (i64 j = 1; j < count; j++)
      if (square(p[j]) > square(p[begin])) begin = j;
    *size = 0, a = begin;
    for (i64 step = 0; step < count && (!step || a != begin); step++, a = b) { /* from corner to corner */
      b = a;
      for (i64 j = 0; j < count; j++) {
        Point to = minus(p[b], p[a]), on = minus(p[j], p[b]);
        int side = side_of(to, on);
        if (j != a && (b == a || side < 0 || (!side && along(to, on) > 0))) b = j;
      }
      i64 many = 0, low = id[a] < id[b] ? a : b;
      int through = !a || !b; /* the point in the middle, which is on a boundary */
      for (i64 j = 0; j < count; j++) { /* what is on the edge, in its order */
        Point to = minus(p[j], p[a]), on = minus(p[b], p[j]);
        if (j == a || j == b || side_of(to, on) || along(to, on) <= 0) continue;
        through |= !j, low = id[j] < id[low] ? j : low;
        i64 h = many++;
        for (; h > 0 && square(minus(p[run[h - 1]], p[a])) > square(to); h--) run[h] = run[h - 1];
        run[h] = j;
      }
      run[many] = b;
      for (i64 h = 0, from = a; h <= many && !through && *size < k; h++)
        if (middle < id[low] || run[h] == low || h == many) {
          star[2 * *size] = (i32)id[from], star[2 * (*size)++ + 1] = (i32)id[run[h]], from = run[h];
        }
    }
  }
}
