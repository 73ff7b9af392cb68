/* Depth maps of triangles, and how much light reaches points past them: from many directions, by a map for each. */
#include "kernel.h"

#define ROUNDING 1e-9 /* of shares, so that no pixel is lost between two faces */

static inline i64 inside(double x, i64 count) { return x > 0 ? x < count ? (i64)x : count : 0; }
static inline double smaller(double x, double y) { return x < y ? x : y; }
static inline double larger(double x, double y) { return x > y ? x : y; }

/* at (n, 3): where a map (3, 4) puts points (n, 3). */
API void bih_place(i64 n, const double *point, const double *map, double *at) {
  for (const double *end = point + 3 * n; point < end; point += 3, at += 3)
    for (int c = 0; c < 3; c++) {
      const double *row = map + 4 * c;
      at[c] = row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3];
    }
}

/* Which of m faces (m, 3) is nearest at the middle of each pixel: face (height, width), or NULL, and how near, near
 * (height, width), both left as they are where there is none.  at (n, 3): x and y of vertices in pixels, and nearness,
 * linear in the picture; faces with a corner that is not a number are left out. */
API void bih_nearest_faces(i64 m, const i64 *faces, const double *at, i64 width, i64 height, float *near, i32 *face) {
  for (i64 f = 0; f < m; f++) {
    const double *a = at + 3 * faces[3 * f], *b = at + 3 * faces[3 * f + 1], *c = at + 3 * faces[3 * f + 2];
    double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (!(area > 0 || area < 0)) continue;
    double low = smaller(a[1], smaller(b[1], c[1])), high = larger(a[1], larger(b[1], c[1]));
    double left = smaller(a[0], smaller(b[0], c[0])), right = larger(a[0], larger(b[0], c[0]));
    i64 first = inside(left + 0.5, width), end = inside(right + 0.5, width), bottom = inside(high + 0.5, height);
    /* The shares of a and b, and the nearness, are linear in x and y. */
    double ux = (b[1] - c[1]) / area, uy = (c[0] - b[0]) / area, vx = (c[1] - a[1]) / area, vy = (a[0] - c[0]) / area;
    double u0 = ux * (0.5 - c[0]) + uy * (0.5 - c[1]), v0 = vx * (0.5 - c[0]) + vy * (0.5 - c[1]);
    for (i64 y = inside(low + 0.5, height); y < bottom; y++)
      for (i64 x = first; x < end; x++) {
        double u = u0 + ux * (double)x + uy * (double)y, v = v0 + vx * (double)x + vy * (double)y;
        if (u < -ROUNDING || v < -ROUNDING || u + v > 1 + ROUNDING) continue;
        float z = (float)(c[2] + u * (a[2] - c[2]) + v * (b[2] - c[2])), *seen = near + y * width + x;
        if (z <= *seen) continue;
        *seen = z;
        if (face) face[y * width + x] = (i32)f;
      }
  }
}

/* Add the light of so much weight from one direction to what reaches k points (k, 3), reached (k,), and to what would
 * if nothing stood before them, whole (k,).  normal (k, 3) are those that tell how bright a point is, facing (k, 3)
 * those of the faces that points are on, along which they are lifted by so much.  map (3, 4): a point's x and y in the
 * depth map's pixels, and its nearness along the direction.  near (side, side), of four pixels about a place. */
API void bih_add_light(i64 k, const float *point, const float *normal, const float *facing, const double *map,
                       double weight, double lift, i64 side, const float *near, float *reached, float *whole) {
  const double *to = map + 8;
  for (i64 i = 0; i < k; i++) {
    const float *n = normal + 3 * i, *g = facing + 3 * i;
    double cosine = n[0] * to[0] + n[1] * to[1] + n[2] * to[2];
    if (cosine <= 0 || g[0] * to[0] + g[1] * to[1] + g[2] * to[2] <= 0) continue;
    double at[3];
    for (int c = 0; c < 3; c++) {
      at[c] = map[4 * c + 3];
      for (int d = 0; d < 3; d++) at[c] += map[4 * c + d] * (point[3 * i + d] + lift * g[d]);
    }
    double seen = 1;
    if (at[0] > 0.5 && at[1] > 0.5 && at[0] < side - 0.5 && at[1] < side - 0.5) {
      i64 x = (i64)(at[0] - 0.5), y = (i64)(at[1] - 0.5);
      double u = at[0] - 0.5 - x, v = at[1] - 0.5 - y;
      const float *p = near + y * side + x;
      seen = (1 - v) * ((1 - u) * (at[2] >= p[0]) + u * (at[2] >= p[1])) +
             v * ((1 - u) * (at[2] >= p[side]) + u * (at[2] >= p[side + 1]));
    }
    reached[i] += (float)(weight * cosine * seen);
    whole[i] += (float)(weight * cosine);
  }
}
