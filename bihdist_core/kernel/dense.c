/* Products and inverses of dense blocks, row by row, rows padded to PAD doubles. */
#include "kernel.h"

enum {
  TALL = 4,              /* a tile of a product is so many rows */
  WIDE = LANES > 2 ? 3 : 2, /* by so many registers */
  DEEP = 256,            /* so many terms are added up before a tile goes back to memory */
  NARROW = 8,            /* so many rows are swept one by one */
  BLOCK = 64             /* so many at once, by products */
};
#define INLINE static inline __attribute__((always_inline))

/* A tile of C += scale A B, A[i, k] = A[i row + k column]. */
INLINE void tile(const int rows, const int wide, i64 inner, double scale, const double *A, i64 row, i64 column,
                 const double *B, i64 ldb, double *C, i64 ldc) {
  vec sum[TALL][WIDE], b[WIDE];
  for (int i = 0; i < rows; i++)
    for (int v = 0; v < wide; v++) sum[i][v] = (vec){0};
  for (i64 k = 0; k < inner; k++, A += column, B += ldb) {
    for (int v = 0; v < wide; v++) b[v] = *(const vec *)(B + v * LANES);
    for (int i = 0; i < rows; i++) {
      double a = A[i * row];
      for (int v = 0; v < wide; v++) sum[i][v] += a * b[v];
    }
  }
  for (int i = 0; i < rows; i++)
    for (int v = 0; v < wide; v++) *(vec *)(C + i * ldc + v * LANES) += scale * sum[i][v];
}

INLINE void column_of_tiles(const int wide, i64 rows, i64 inner, double scale, const double *A, i64 row, i64 column,
                            const double *B, i64 ldb, double *C, i64 ldc) {
  i64 i = 0;
  for (; i + TALL <= rows; i += TALL, A += TALL * row, C += TALL * ldc)
    tile(TALL, wide, inner, scale, A, row, column, B, ldb, C, ldc);
  switch (rows - i) {
  case 3: tile(3, wide, inner, scale, A, row, column, B, ldb, C, ldc); break;
  case 2: tile(2, wide, inner, scale, A, row, column, B, ldb, C, ldc); break;
  case 1: tile(1, wide, inner, scale, A, row, column, B, ldb, C, ldc);
  }
}

INLINE void product(const int upper, i64 rows, i64 columns, i64 inner, double scale, const double *A, i64 row,
                    i64 column, const double *B, i64 ldb, double *C, i64 ldc) {
  double panel[DEEP * WIDE * LANES] __attribute__((aligned(64)));
  for (i64 k0 = 0; k0 < inner; k0 += DEEP) {
    i64 deep = least(DEEP, inner - k0);
    const double *a = A + k0 * column;
    for (i64 j = 0; j < columns; j += WIDE * LANES) {
      const double *b = B + k0 * ldb + j;
      i64 ld = ldb, tall = upper ? least(rows, j + WIDE * LANES) : rows;
      if (columns - j <= (WIDE - 1) * LANES) { /* what is left is narrower than a tile */
        if (WIDE > 2 && columns - j > LANES) column_of_tiles(2, tall, deep, scale, a, row, column, b, ldb, C + j, ldc);
        else column_of_tiles(1, tall, deep, scale, a, row, column, b, ldb, C + j, ldc);
        break;
      }
      if (tall > 16) { /* close together it is read faster */
        for (i64 k = 0; k < deep; k++)
          for (int v = 0; v < WIDE; v++)
            *(vec *)(panel + (k * WIDE + v) * LANES) = *(const vec *)(b + k * ldb + v * LANES);
        b = panel, ld = WIDE * LANES;
      }
      column_of_tiles(WIDE, tall, deep, scale, a, row, column, b, ld, C + j, ldc);
    }
  }
}

/* C (rows, columns) += scale A B; rows of B and of C are read and written up to their padding. */
void add_product(i64 rows, i64 columns, i64 inner, double scale, const double *A, i64 row, i64 column, const double *B,
                 i64 ldb, double *C, i64 ldc) {
  product(0, rows, columns, inner, scale, A, row, column, B, ldb, C, ldc);
}

/* The same, where only C[i, j] with j >= i matters; some others change. */
void add_upper_product(i64 rows, i64 columns, i64 inner, double scale, const double *A, i64 row, i64 column,
                       const double *B, i64 ldb, double *C, i64 ldc) {
  product(1, rows, columns, inner, scale, A, row, column, B, ldb, C, ldc);
}

/* (C, C1) += scale (A, A1) (B, B1), all or (upper) as above, for complex numbers; without imaginary parts C += A B. */
void add_pairs(int upper, i64 rows, i64 columns, i64 inner, double scale, Pair A, i64 row, i64 column, Pair B, i64 ldb,
               Pair C, i64 ldc) {
  product(upper, rows, columns, inner, scale, A.x, row, column, B.x, ldb, C.x, ldc);
  if (!A.x1) return;
  product(upper, rows, columns, inner, -scale, A.x1, row, column, B.x1, ldb, C.x, ldc);
  product(upper, rows, columns, inner, scale, A.x1, row, column, B.x, ldb, C.x1, ldc);
  product(upper, rows, columns, inner, scale, A.x, row, column, B.x1, ldb, C.x1, ldc);
}

static Pair at(Pair F, i64 k) { return (Pair){F.x + k, F.x1 ? F.x1 + k : NULL}; }

/* Gauss and Jordan on T (k, ld), whose columns b to b + k - 1 are a symmetric block: T becomes block^-1 T, the block its
 * inverse.  left: lowered to the least pivot as a fraction of scale.  0 if a pivot is not positive, or a complex one 0. */
static int divide(i64 k, i64 b, i64 ld, double *T, const double *scale, double *left) {
  for (i64 i = 0; i < k; i++) {
    double *t = T + i * ld, pivot = t[b + i];
    if (!(pivot > 1e-14 * scale[i])) return 0;
    if (pivot < *left * scale[i]) *left = pivot / scale[i];
    t[b + i] = 1, pivot = 1 / pivot;
    for (i64 j = 0; j < ld; j++) t[j] *= pivot;
    for (i64 o = 0; o < k; o++) {
      double *r = T + o * ld, factor = r[b + i];
      if (o == i) continue;
      r[b + i] = 0;
      for (i64 j = 0; j < ld; j++) r[j] -= factor * t[j];
    }
  }
  return 1;
}
static int divide_complex(i64 k, i64 b, i64 ld, Pair T, const double *scale, double *left) {
  for (i64 i = 0; i < k; i++) {
    double *t = T.x + i * ld, *t1 = T.x1 + i * ld, p = t[b + i], p1 = t1[b + i];
    double size = p * p + p1 * p1, least_size = 1e-14 * scale[i];
    if (!(size > least_size * least_size)) return 0;
    if (size < *left * *left * scale[i] * scale[i]) *left = __builtin_sqrt(size) / scale[i];
    t[b + i] = 1, t1[b + i] = 0, p /= size, p1 /= -size;
    for (i64 j = 0; j < ld; j++) {
      double x = t[j], x1 = t1[j];
      t[j] = x * p - x1 * p1, t1[j] = x * p1 + x1 * p;
    }
    for (i64 o = 0; o < k; o++) {
      double *r = T.x + o * ld, *r1 = T.x1 + o * ld, f = r[b + i], f1 = r1[b + i];
      if (o == i) continue;
      r[b + i] = r1[b + i] = 0;
      for (i64 j = 0; j < ld; j++) r[j] -= f * t[j] - f1 * t1[j], r1[j] -= f * t1[j] + f1 * t[j];
    }
  }
  return 1;
}

/* What sweep does with one of its parts, real or imaginary: a block's rows, what is left of the diagonal taken from above
 * it, and where they go back. */
static void take_rows(i64 b, i64 k, const double *F, double *W, i64 ld) {
  for (i64 i = 0; i < k; i++) {
    for (i64 j = 0; j < b + i; j++) W[i * ld + j] = F[j * ld + b + i];
    copy(W + i * ld + b + i, F + (b + i) * ld + b + i, 8 * (ld - b - i));
  }
}
static void put_rows(i64 b, i64 k, const double *T, double *F, i64 ld) {
  for (i64 i = 0; i < k; i++) {
    for (i64 j = 0; j < b; j++) F[j * ld + b + i] = T[i * ld + j];
    for (i64 j = b; j < ld; j++) F[(b + i) * ld + j] = j < b + k ? -T[i * ld + j] : T[i * ld + j];
  }
}
static void take_block(i64 b, i64 k, const double *W, i64 ld, double *D, i64 kp) {
  for (i64 i = 0; i < k; i++) {
    copy(D + i * kp, W + i * ld + b, 8 * k);
    zero(D + i * kp + k, 8 * (kp - k));
  }
}
static void mirror_swept(i64 k, double *D, i64 kp) {
  for (i64 i = 0; i < k; i++)
    for (i64 j = i; j < k; j++) D[i * kp + j] = D[j * kp + i] = -D[i * kp + j];
}

static i64 size_of_blocks(i64 c) { return c > BLOCK ? BLOCK : least(NARROW, c); }
/* Doubles that sweep needs to work, for 1 or 2 parts of numbers. */
i64 sweep_work(i64 c, i64 sp, i64 parts) {
  return parts * (2 * least(c, BLOCK) * sp + BLOCK * BLOCK + 2 * NARROW * BLOCK + PAD);
}

/* The sweep operator on the first c rows of the symmetric F (s, s), of which what is on and above the diagonal matters:
 * F11 becomes minus its inverse, F12 that inverse times F12, F22 the Schur complement.  scale (c,): what pivots are
 * compared with; left: lowered to the least such fraction.  0 if F11 is not positive definite, or, of complex numbers, is
 * singular, to working accuracy. */
int sweep(i64 c, i64 s, Pair F, i64 ld, const double *scale, double *work, double *left) {
  i64 size = size_of_blocks(c), parts = 1 + (F.x1 != NULL), block = size * ld;
  Pair T = {work, F.x1 ? work + block : NULL}, W = at(T, parts * block);
  double *rest = work + 2 * parts * block;
  Pair D = {rest, F.x1 ? rest + BLOCK * BLOCK : NULL};
  double *of_F[] = {F.x, F.x1}, *of_T[] = {T.x, T.x1}, *of_W[] = {W.x, W.x1}, *of_D[] = {D.x, D.x1};
  for (i64 b = 0; b < c; b += size) {
    i64 k = least(size, c - b), kp = padded(k);
    for (int p = 0; p < parts; p++) take_rows(b, k, of_F[p], of_W[p], ld);
    if (k <= NARROW) {
      for (int p = 0; p < parts; p++) copy(of_T[p], of_W[p], 8 * k * ld);
      int good = F.x1 ? divide_complex(k, b, ld, T, scale + b, left) : divide(k, b, ld, T.x, scale + b, left);
      if (!good) return 0;
    } else {
      for (int p = 0; p < parts; p++) take_block(b, k, of_W[p], ld, of_D[p], kp);
      if (!sweep(k, k, D, kp, scale + b, rest + parts * BLOCK * BLOCK, left)) return 0;
      for (int p = 0; p < parts; p++) mirror_swept(k, of_D[p], kp), zero(of_T[p], 8 * k * ld);
      add_pairs(0, k, ld, k, 1, D, kp, 1, W, ld, T, ld);
      for (int p = 0; p < parts; p++)
        for (i64 i = 0; i < k; i++) copy(of_T[p] + i * ld + b, of_D[p] + i * kp, 8 * k);
    }
    add_pairs(1, s, s, k, -1, W, 1, ld, T, ld, F, ld);
    for (int p = 0; p < parts; p++) put_rows(b, k, of_T[p], of_F[p], ld);
  }
  return 1;
}
