/* Which points are in one place, and whether a face is there twice: found by hashing. */
#include "kernel.h"

/* Number the places of k finite points (k, 3) in the order in which they first appear: place (n, 3), number (k,).
 * table (slots,), a power of two.  Returns n, or NO_ROOM where half of the slots are not enough. */
API i64 bih_merge_points(i64 k, const double *point, i64 slots, i32 *table, double *place, i64 *number) {
  i64 n = 0;
  for (i64 s = 0; s < slots; s++) table[s] = -1;
  for (i64 i = 0; i < k; i++) {
    const double *x = point + 3 * i, *y;
    uint64_t hash = 0, bits;
    for (int c = 0; c < 3; c++) {
      double coordinate = x[c] + 0.0; /* -0 becomes 0 */
      copy(&bits, &coordinate, 8);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15;
      hash ^= hash >> 32;
    }
    i64 s = (i64)(hash & (uint64_t)(slots - 1));
    for (; table[s] >= 0; s = (s + 1) & (slots - 1)) {
      y = place + 3 * (i64)table[s];
      if (x[0] == y[0] && x[1] == y[1] && x[2] == y[2]) break;
    }
    if (table[s] < 0) {
      if (2 * n >= slots) return NO_ROOM;
      copy(place + 3 * n, x, 24);
      table[s] = (i32)n++;
    }
    number[i] = table[s];
  }
  return n;
}

/* Whether each of m faces (m, 3) names three different vertices from 0 to n - 1, and no other face the same three.
 * table (slots,), a power of two above m. */
API i32 bih_check_faces(i64 n, i64 m, const i64 *face, i64 slots, i32 *table) {
  for (i64 s = 0; s < slots; s++) table[s] = -1;
  for (i64 f = 0; f < m; f++) {
    const i64 *v = face + 3 * f;
    i64 low = least(v[0], least(v[1], v[2])), high = most(v[0], most(v[1], v[2]));
    if (low < 0 || high >= n || v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return OUTSIDE;
    i64 middle = v[0] + v[1] + v[2] - low - high;
    uint64_t hash = ((uint64_t)low * 0x9e3779b97f4a7c15 ^ (uint64_t)middle) * 0x9e3779b97f4a7c15 + (uint64_t)high;
    hash *= 0x9e3779b97f4a7c15;
    i64 s = (i64)((hash ^ hash >> 32) & (uint64_t)(slots - 1));
    for (; table[s] >= 0; s = (s + 1) & (slots - 1)) {
      const i64 *u = face + 3 * (i64)table[s];
      if (u[0] + u[1] + u[2] == low + middle + high && least(u[0], least(u[1], u[2])) == low &&
          most(u[0], most(u[1], u[2])) == high)
        return OUTSIDE;
    }
    table[s] = (i32)f;
  }
  return DONE;
}

static i64 root_of(i64 *above, i64 v) {
  while (above[v] != v) v = above[v] = above[above[v]];
  return v;
}

/* label (n,): the component, numbered by its least vertex, of each vertex of a graph in which the k vertices of each of
 * m rows, edges or faces, are connected: row (m, k). */
API void bih_connected(i64 n, i64 m, i64 k, const i64 *row, i64 *label) {
  i64 count = 0;
  for (i64 v = 0; v < n; v++) label[v] = v;
  for (const i64 *end = row + m * k; row < end; row += k)
    for (i64 j = 1; j < k; j++) { /* a tree's root is its least vertex */
      i64 a = root_of(label, row[0]), b = root_of(label, row[j]);
      if (a < b) label[b] = a;
      else label[a] = b;
    }
  for (i64 v = 0; v < n; v++) label[v] = label[v] == v ? count++ : label[label[v]];
}
