/* From triangles to a sparse matrix, and to a divergence. */
#include "kernel.h"

/* The stiffness matrix by rows: entry (i, j) is minus the weight of edge ij, the sum over its faces of weight (3, m), at
 * the corner opposite to it; the diagonal makes rows sum to zero.  start (n + 1,), index and value with room for
 * n + 9 m entries; work (3 n + 1,).  Returns how many entries there are. */
API i64 bih_stiffness(i64 n, i64 m, const i64 *faces, const double *weight, i32 *start, i32 *index, double *value,
                      i32 *work) {
  i32 *first = work, *end = first + n + 1, *below = end + n; /* what is above the diagonal lies behind all rows */
  i32 *above = index + n + 6 * m;
  double *weights = value + n + 6 * m;
  zero(work, 4 * (3 * n + 1)), zero(start, 4 * (n + 1));
  for (i64 f = 0; f < m; f++)
    for (int k = 0; k < 3; k++) {
      i64 i = faces[3 * f + k], j = faces[3 * f + (k + 1) % 3];
      first[least(i, j) + 1]++, below[most(i, j)]++;
    }
  for (i64 v = 0, put = 0; v < n; v++) {
    i32 count = below[v];
    first[v + 1] += first[v], end[v] = first[v], below[v] = (i32)put, put += count;
  }
  for (i64 f = 0; f < m; f++) /* by columns, and from there into rows: then rows ascend */
    for (int k = 0; k < 3; k++) {
      i64 i = faces[3 * f + (k + 1) % 3], j = faces[3 * f + (k + 2) % 3], e = below[most(i, j)]++;
      index[e] = (i32)least(i, j), value[e] = weight[k * m + f];
    }
  for (i64 v = 0, e = 0; v < n; v++)
    for (; e < below[v]; e++) {
      i64 to = end[index[e]]++;
      above[to] = (i32)v, weights[to] = value[e];
    }
  for (i64 v = 0; v < n; v++) { /* put what comes twice together */
    i64 put = first[v];
    for (i64 e = put; e < first[v + 1]; e++)
      if (put > first[v] && above[put - 1] == above[e]) weights[put - 1] += weights[e];
      else start[above[e] + 1]++, above[put] = above[e], weights[put++] = weights[e];
    start[v + 1] += (i32)(put - first[v]), end[v] = (i32)put;
  }
  for (i64 v = 0; v < n; v++) start[v + 1] += start[v] + (start[v + 1] > 0), below[v] = start[v];
  for (i64 v = 0; v < n; v++) { /* what is below the diagonal comes from the rows before, in their order */
    i64 diagonal = below[v], put = diagonal;
    double whole = 0;
    if (start[v] == start[v + 1]) continue;
    for (i64 e = start[v]; e < diagonal; e++) whole -= value[e];
    for (i64 e = first[v]; e < end[v]; e++) {
      i64 mirror = below[above[e]]++;
      index[++put] = above[e], index[mirror] = (i32)v;
      value[put] = value[mirror] = -weights[e], whole += weights[e];
    }
    index[diagonal] = (i32)v, value[diagonal] = whole;
  }
  return start[n];
}

/* The lesser or greater end of side k of face f, numbered 3 f + k: from its corner k to the next. */
static i64 end_of(const i64 *faces, i64 side, int greater) {
  i64 a = faces[side], b = faces[side % 3 == 2 ? side - 2 : side + 1];
  return (a < b) == greater ? b : a;
}

/* The edges of faces (m, 3) of n vertices: edge (3 m, 2), lesser end first, ascending, each once; of_side (3, m): the edge
 * of each face's sides.  work (n + 1 + 6 m,).  Returns how many there are. */
API i64 bih_edges(i64 n, i64 m, const i64 *faces, i64 *edge, i64 *of_side, i32 *work) {
  i32 *place = work, *by_greater = place + n + 1, *sorted = by_greater + 3 * m;
  for (int greater = 1; greater >= 0; greater--) { /* sorted by one end, and that stably by the other */
    zero(place, 4 * (n + 1));
    for (i64 s = 0; s < 3 * m; s++) place[end_of(faces, s, greater) + 1]++;
    for (i64 v = 0; v < n; v++) place[v + 1] += place[v];
    for (i64 i = 0; i < 3 * m; i++) {
      i64 s = greater ? i : by_greater[i];
      (greater ? by_greater : sorted)[place[end_of(faces, s, greater)]++] = (i32)s;
    }
  }
  i64 count = 0;
  for (i64 i = 0; i < 3 * m; i++) {
    i64 s = sorted[i], a = end_of(faces, s, 0), b = end_of(faces, s, 1);
    if (!count || edge[2 * count - 2] != a || edge[2 * count - 1] != b) edge[2 * count] = a, edge[2 * count++ + 1] = b;
    of_side[s % 3 * m + s / 3] = count - 1;
  }
  return count;
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The sides opposite to the corners of a face. */
static void sides(const double *x, const i64 *face, double side[3][3]) {
  for (int k = 0; k < 3; k++)
    for (int a = 0; a < 3; a++) side[k][a] = x[3 * face[(k + 2) % 3] + a] - x[3 * face[(k + 1) % 3] + a];
}

/* Of each face (m, 3) its area and the square of its longest side, (m,) each; x (n, 3). */
API void bih_measures(i64 m, const double *x, const i64 *faces, double *area, double *longest) {
  for (i64 f = 0; f < m; f++) {
    double s[3][3], normal[3];
    sides(x, faces + 3 * f, s);
    for (int a = 0; a < 3; a++)
      normal[a] = s[0][(a + 1) % 3] * s[1][(a + 2) % 3] - s[0][(a + 2) % 3] * s[1][(a + 1) % 3];
    area[f] = __builtin_sqrt(dot(normal, normal)) / 2, longest[f] = 0;
    for (int k = 0; k < 3; k++) {
      double square = dot(s[k], s[k]);
      if (square > longest[f]) longest[f] = square;
    }
  }
}

/* Of each face (m, 3) the cotangents of its corners (3, m) and the squared lengths of the sides opposite to them (3, m);
 * x (n, 3), area (m,). */
API void bih_corners(i64 m, const double *x, const i64 *faces, const double *area, double *cotangent, double *square) {
  for (i64 f = 0; f < m; f++) {
    double side[3][3];
    sides(x, faces + 3 * f, side);
    for (int k = 0; k < 3; k++) {
      square[k * m + f] = dot(side[k], side[k]);
      cotangent[k * m + f] = -dot(side[(k + 1) % 3], side[(k + 2) % 3]) / (2 * area[f]);
    }
  }
}

/* Add to divergence (n,) the integrals of grad(hat) . X, X = -grad u / |grad u|, over the faces some[first] to
 * some[end - 1], or first to end - 1 if it is NULL; a face where u is constant has X = 0.  corner (3, m); side: four arrays (3, m), the sides
 * from corner 0 to corners 1 and 2 by which u is turned into a direction, and those along which it is integrated. */
API void bih_divergence(i64 m, const i64 *corner, const double *const *side, i64 first, i64 end, const i64 *some,
                        const double *u, double *divergence) {
  enum { MANY = 64 }; /* faces between what is gathered and what is scattered, in registers side by side */
  double e[4][3][MANY], to1[MANY], to2[MANY], d1[MANY], d2[MANY];
  for (i64 start = first; start < end; start += MANY) {
    i64 many = least(MANY, end - start), face[MANY];
    for (i64 i = 0; i < many; i++) {
      i64 f = face[i] = some ? some[start + i] : start + i;
      double base = u[corner[f]];
      d1[i] = u[corner[m + f]] - base, d2[i] = u[corner[2 * m + f]] - base;
    }
    for (int s = 0; s < 4; s++)
      for (int a = 0; a < 3; a++)
        for (i64 i = 0; i < many; i++) e[s][a][i] = side[s][a * m + face[i]];
    for (i64 i = 0; i < many; i++) {
      double a = __builtin_fabs(d1[i]), b = __builtin_fabs(d2[i]), size = a > b ? a : b;
      size += size == 0; /* squares of 1e-200 are 0, so each face is brought to size 1 first */
      a = d1[i] / size, b = d2[i] / size;
      double x = a * e[1][0][i] - b * e[0][0][i], y = a * e[1][1][i] - b * e[0][1][i],
             z = a * e[1][2][i] - b * e[0][2][i], length = __builtin_sqrt(x * x + y * y + z * z);
      double half = 0.5 / (length + (length == 0));
      to1[i] = -half * (e[3][0][i] * x + e[3][1][i] * y + e[3][2][i] * z);
      to2[i] = half * (e[2][0][i] * x + e[2][1][i] * y + e[2][2][i] * z);
    }
    for (i64 i = 0; i < many; i++) {
      i64 f = face[i];
      divergence[corner[f]] -= to1[i] + to2[i], divergence[corner[m + f]] += to1[i];
      divergence[corner[2 * m + f]] += to2[i];
    }
  }
}

/* Mixed Voronoi areas of vertices (n,), 0 before, from what bih_corners has of each face and its area (m,). */
API void bih_voronoi_areas(i64 m, const i64 *faces, const double *cotangent, const double *square, const double *area,
                           double *areas) {
  for (i64 f = 0; f < m; f++) {
    double part[3], sum = 0;
    int obtuse = -1;
    for (int k = 0; k < 3; k++) {
      sum += part[k] = cotangent[k * m + f] * square[k * m + f];
      if (cotangent[k * m + f] < 0) obtuse = k;
    }
    for (int k = 0; k < 3; k++)
      areas[faces[3 * f + k]] += obtuse < 0 ? (sum - part[k]) / 8 : k == obtuse ? area[f] / 2 : area[f] / 4;
  }
}
