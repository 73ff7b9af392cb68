/* From triangles to a sparse matrix. */
#include "kernel.h"

static void sort(i32 *index, double *value, i64 count) { /* Shell's: rows are short, or those of a few hubs */
  i64 gap = 1;
  while (gap < count / 3) gap = 3 * gap + 1;
  for (; gap; gap /= 3)
    for (i64 i = gap, j; i < count; i++) {
      i32 u = index[i];
      double w = value[i];
      for (j = i; j >= gap && index[j - gap] > u; j -= gap) index[j] = index[j - gap], value[j] = value[j - gap];
      index[j] = u, value[j] = w;
    }
}

/* The stiffness matrix by rows: entry (i, j) is minus the weight of edge ij, the sum over its faces of weight (3, m), at
 * the corner opposite to it; the diagonal makes rows sum to zero.  start (n + 1,), index and value with room for
 * n + 6 m entries; cursor (n,).  Returns how many entries there are. */
API i64 bih_stiffness(i64 n, i64 m, const i64 *faces, const double *weight, i32 *start, i32 *index, double *value,
                      i32 *cursor) {
  i64 put = 0;
  for (i64 v = 0; v <= n; v++) start[v] = 0;
  for (i64 k = 0; k < 3 * m; k++) start[faces[k] + 1] += 2;
  for (i64 v = 0; v < n; v++) {
    start[v + 1] += 1 + start[v]; /* room for the diagonal, too */
    index[start[v]] = (i32)v, value[start[v]] = 0, cursor[v] = start[v] + 1;
  }
  for (i64 f = 0; f < m; f++)
    for (int k = 0; k < 3; k++) {
      i64 i = faces[3 * f + (k + 1) % 3], j = faces[3 * f + (k + 2) % 3];
      double w = weight[k * m + f];
      index[cursor[i]] = (i32)j, value[cursor[i]++] = -w;
      index[cursor[j]] = (i32)i, value[cursor[j]++] = -w;
    }
  for (i64 v = 0, lo = 0; v < n; v++) { /* sort each row, put what comes twice together */
    i64 hi = start[v + 1], begin = put;
    double whole = 0;
    sort(index + lo, value + lo, hi - lo);
    for (i64 e = lo; e < hi && hi > lo + 1; e++) {
      whole -= value[e];
      if (put > begin && index[put - 1] == index[e]) value[put - 1] += value[e];
      else index[put] = index[e], value[put++] = value[e];
    }
    for (i64 e = begin; e < put; e++)
      if (index[e] == v) value[e] = whole;
    start[v] = (i32)begin, lo = hi;
  }
  start[n] = (i32)put;
  return put;
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Of each face (m, 3) the cotangents of its corners (3, m) and the squared lengths of the sides opposite to them (3, m);
 * x (n, 3), area (m,). */
API void bih_corners(i64 m, const double *x, const i64 *faces, const double *area, double *cotangent, double *square) {
  for (i64 f = 0; f < m; f++) {
    double side[3][3];
    for (int k = 0; k < 3; k++)
      for (int a = 0; a < 3; a++)
        side[k][a] = x[3 * faces[3 * f + (k + 2) % 3] + a] - x[3 * faces[3 * f + (k + 1) % 3] + a];
    for (int k = 0; k < 3; k++) {
      square[k * m + f] = dot(side[k], side[k]);
      cotangent[k * m + f] = -dot(side[(k + 1) % 3], side[(k + 2) % 3]) / (2 * area[f]);
    }
  }
}
