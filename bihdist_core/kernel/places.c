/* Which points are in one place. */
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
