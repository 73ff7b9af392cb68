/* The exact kernel: nested dissection, dual multifrontal elimination and selected inversion of a sparse symmetric
 * positive definite matrix L, and solves with its factor.  Plain C11 without libc (but memcpy and memset), without
 * global state: every array is the caller's.
 *
 * A front is a dense block of the elimination: c pivots, which it eliminates, and m boundary rows above them, s = c + m.
 * Fronts are numbered in postorder, their pivots are consecutive places of the elimination order.  With F the pivots'
 * block of a front, R the rows right of it (c x m) and Q the boundary's block, L's derivative along L + t A beside each:
 *
 *     K = F^-1          N = -K R           S = Q + R^T N            (S: Schur complement, added into the parent)
 *     K1 = K F1 K       N1 = K (R1 + F1 N)     S1 = Q1 + X + X^T,   X = (R1 + F1 N / 2)^T N
 *
 * K1 and N1 are minus the derivatives of K and N, so that all that follows adds up to +G A G, G = L^-1.
 *
 * A leaf has no children: its F1 = A, diagonal, and R1 = 0, so that K1 = K A K and N1 = K A N.  These are not kept but
 * applied as products, for two thirds of a factor's pivots are in leaves.
 *
 * The same pairs of blocks are complex numbers where L + i A is factored.  A pair (X, X1) is X + e X1 with e^2 = 0 for
 * derivatives and e^2 = -1 for imaginary parts, which is one product more: see add_pairs in dense.c. */
#ifndef BIHDIST_KERNEL_H
#define BIHDIST_KERNEL_H
#include <stddef.h>
#include <stdint.h>

typedef int32_t i32;
typedef int64_t i64;

#if defined(_WIN32)
#define API __declspec(dllexport)
#else
#define API __attribute__((visibility("default")))
#endif

/* What functions return: 0, or how they failed. */
enum { DONE = 0, STOPPED = -1, NOT_POSITIVE = -2, OUTSIDE = -3, ASYMMETRIC = -4, NO_ROOM = -5 };

/* Doubles in a register: 2 in SSE2, NEON and WebAssembly, 4 in AVX2. */
#ifndef LANES
#define LANES 2
#endif
typedef double vec __attribute__((vector_size(8 * LANES), aligned(8), may_alias));
typedef int32_t work_i32 __attribute__((may_alias)); /* where doubles lie at other times */

/* Rows of dense blocks are padded to so many doubles. */
enum { PAD = 4 };
static inline i64 padded(i64 k) { return (k + PAD - 1) & -(i64)PAD; }
static inline i64 least(i64 a, i64 b) { return a < b ? a : b; }
static inline i64 most(i64 a, i64 b) { return a > b ? a : b; }

/* Set by one thread while others work: whether to stop, and how much is done. */
typedef struct {
  i32 stop;
  i64 done;
} Watch;
static inline int stopped(const Watch *w) { return __atomic_load_n(&w->stop, __ATOMIC_RELAXED); }
static inline void advance(Watch *w, i64 work) { __atomic_fetch_add(&w->done, work, __ATOMIC_RELAXED); }

/* A symmetric sparse matrix, or a graph (value NULL), by rows. */
typedef struct {
  i64 n;
  const i32 *start; /* (n + 1,) */
  const i32 *index;
  const double *value;
} Rows;

/* Nested dissection of a graph whose vertices are numbered breadth first (ordering.c); its arrays lie behind it. */
typedef struct {
  Rows graph;
  i32 *numbers;        /* (n,) what the matrix calls each vertex */
  float *charts;       /* (7, n) positions, then edge counts to four landmarks */
  i32 *vertices;       /* (n,) in elimination order; each region is a stretch of it, in which they ascend */
  i32 *edges, *spare;  /* (e, 2) ends of the edges; each region has a stretch of those inside it */
  i32 *region;         /* (n,) the first place of a vertex' region, -1 in separators */
  i32 *bin, *band, *at; /* (n,) each */
  i32 *flow;           /* (8 n,) */
  float *key;          /* (n,) */
  unsigned char *side; /* (n,) 0 or 1, 2 in the separator */
} Dissection;

/* A region: its vertices are at places lo to hi - 1, its edges are those numbered edge to edge_end - 1. */
typedef struct {
  i64 lo, hi, edge, edge_end;
} Region;

/* The elimination tree (symbolic.c). */
typedef struct {
  i64 n, fronts;
  i32 *vertices;   /* (n,) the vertex at each place of the elimination order */
  i32 *place;      /* (n,) the place of each vertex */
  i32 *first;      /* (fronts + 1,) the first pivot of each front */
  i32 *children;   /* (fronts, 2), or -1 */
  i32 *parent;     /* (fronts,), or -1 */
  i64 *bound;      /* (fronts + 1,) where each front's boundary begins in rows */
  i32 *rows;       /* places of boundary rows, ascending in each front */
  i32 *up;         /* where each of these is in the parent's front */
  i64 *pivot_block; /* (fronts + 1,) where each front's K begins, in doubles of a factor without derivatives: those of
                             leaves behind all others, and last where they begin */
  i64 *row_block;   /* (fronts + 1,) the same of N */
  i64 *stack;      /* (fronts,) where its Schur complement lies on the stack while eliminating */
  i64 *inverse;    /* (fronts,) where its block of the inverse lies on the stack while inverting */
  unsigned char *top; /* (fronts,) whether the front is a task of its own */
  i32 *rank; /* (n,) of a place among the pivots of top fronts */
} Tree;

/* What the second block of each pair is: there is none, it is the derivative along A, or the imaginary part, A's. */
enum { SINGLE = 0, DERIVATIVE = 1, IMAGINARY = 2 };

typedef struct {
  const Tree *tree;
  const double *areas; /* (n,) the diagonal of A in elimination order; NULL if there is no second block */
  double *pivots;      /* K, and K1 after it, but not derivatives of leaves */
  double *boundaries;  /* N, (c, m); where there is N1, their rows take turns */
  i64 second;
} Factor;

/* Entries of the inverse on a pattern, and of its second block: those right of or on the diagonal in elimination order;
 * not of leaves whose second blocks are not kept. */
typedef struct {
  Rows pattern;
  double *value, *second; /* (e,) */
} Entries;

typedef struct {
  i64 c, m, s; /* pivots, boundary rows, both */
  i64 cp, mp, sp; /* padded */
  i64 first;   /* place of the first pivot */
  const i32 *rows, *up;
} Front;

static inline Front front_of(const Tree *t, i64 q) {
  i64 c = t->first[q + 1] - t->first[q], m = t->bound[q + 1] - t->bound[q];
  return (Front){c, m, c + m, padded(c), padded(m), padded(c + m), t->first[q], t->rows + t->bound[q],
                 t->up + t->bound[q]};
}
/* end (m,): for each boundary row where the run ends of rows that follow each other in the parent's front, too. */
static inline void find_runs(Front f, work_i32 *end) {
  for (i64 j = f.m; j-- > 0;) end[j] = (i32)(j + 1 < f.m && f.up[j + 1] == f.up[j] + 1 ? end[j + 1] : j + 1);
}
/* Where the block lies that a task hands on; NULL where a front hands nothing on, or nothing is. */
static inline double *handed(double *const *blocks, i64 q) { return blocks ? blocks[q] : NULL; }
static inline int is_leaf(const Tree *t, i64 q) { return t->children[2 * q] < 0; }
/* Whether the second blocks of a front are not kept. */
static inline int is_short(const Factor *f, i64 q) { return f->second == DERIVATIVE && is_leaf(f->tree, q); }
/* How many of K and K1, or of N and N1, a front keeps. */
static inline i64 kept(const Factor *f, i64 q) { return 1 + (f->second && !is_short(f, q)); }
static inline i64 block_at(const Factor *f, const i64 *block, i64 q) {
  if (f->second == DERIVATIVE) return block[q] + least(block[q], block[f->tree->fronts]);
  return (1 + (f->second == IMAGINARY)) * block[q];
}
static inline double *block_K(const Factor *f, i64 q) { return f->pivots + block_at(f, f->tree->pivot_block, q); }
static inline double *block_N(const Factor *f, i64 q) { return f->boundaries + block_at(f, f->tree->row_block, q); }

/* elimination.c */
API void bih_elimination_room(const Tree *t, i64 second, i64 first, i64 last, i64 *room);
API i32 bih_eliminate(const Factor *factor, const Rows *matrix, i64 first, i64 last, double *const *blocks,
                      double *work, i64 *where, Watch *watch);

/* dense.c */
void add_product(i64 rows, i64 columns, i64 inner, double scale, const double *A, i64 row, i64 column, const double *B,
                 i64 ldb, double *C, i64 ldc);
void add_upper_product(i64 rows, i64 columns, i64 inner, double scale, const double *A, i64 row, i64 column,
                       const double *B, i64 ldb, double *C, i64 ldc);
typedef struct {
  double *x, *x1; /* x1 is NULL where there are no imaginary parts */
} Pair;
void add_pairs(int upper, i64 rows, i64 columns, i64 inner, double scale, Pair A, i64 row, i64 column, Pair B, i64 ldb,
               Pair C, i64 ldc);
int sweep(i64 c, i64 s, Pair F, i64 ld, const double *scale, double *work, double *left);
i64 sweep_work(i64 c, i64 sp, i64 parts);

/* assembly.c */
API void bih_measures(i64 m, const double *x, const i64 *faces, double *area, double *longest);
API void bih_corners(i64 m, const double *x, const i64 *faces, const double *area, double *cotangent, double *square);
API void bih_voronoi_areas(i64 m, const i64 *faces, const double *cotangent, const double *square, const double *area,
                           double *areas);
API i64 bih_stiffness(i64 n, i64 m, const i64 *faces, const double *weight, i32 *start, i32 *index, double *value,
                      i32 *work);

/* ordering.c */
API i64 bih_dissection_room(i64 n, i64 entries);
API i64 bih_order(const Rows *matrix, const double *x, Dissection *D, i32 *vertices, i32 *place, i32 *last,
                  i32 *subtrees);

/* symbolic.c */
API i64 bih_lay_out(const Rows *g, Tree *t, const i32 *last, const i32 *subtrees, i64 tasks, i64 room, i32 *work,
                    i64 *totals);

/* inversion.c */
API i64 bih_factor_room(const Tree *t, i64 second, i32 inverted);
API i32 bih_factor(const Factor *factor, const Rows *matrix, double *work, double *diagonal, double *second,
                   i64 *where);

/* substitution.c */
API void bih_solve(const Factor *factor, i64 k, i64 w, const double *b, i64 ldb, double *out, i64 ldo, double *x,
                   double *work);
API void bih_send_units(const Factor *factor, const i32 *places, i64 k, i64 w, double *xy, i32 *count, double *work);
API i32 bih_sweep_down_both(const Factor *factor, i64 first, i64 last, i64 w, double *xy, const i32 *count,
                            double *work, Watch *watch);

static inline void zero(void *p, i64 bytes) { __builtin_memset(p, 0, (size_t)bytes); }
static inline void copy(void *to, const void *from, i64 bytes) { __builtin_memcpy(to, from, (size_t)bytes); }
#endif
