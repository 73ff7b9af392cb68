/* Meshes in text files (OFF, OBJ, PLY, STL), read in one pass.
 *
 * Only what there is nothing to say about is read here.  Where a file is damaged or unusual a function returns OUTSIDE or
 * NO_ROOM, and the caller has another reader, which says what is wrong.  Single numbers that are unusual (nan, more digits
 * than decide a rounding, subnormal) are left to the caller, too. */
#include "kernel.h"

typedef uint64_t u64;
typedef unsigned char byte;

enum { LEAST = -342, MOST = 308, DIGITS = 19 };

/* A text and what has been found in it.  Rooms: how many of each there may be. */
typedef struct {
  const byte *text, *at;    /* its begin, and what is read next; a zero byte is the end */
  const u64 *powers;        /* (651, 2) 128 bits of 5^e for e from LEAST to MOST, high word first */
  u64 comment;              /* the character that begins a comment, or 0 */
  u64 allowed;              /* bit k: a point may have k numbers, of which three are kept */
  i64 point_room, polygon_room, corner_room, word_room;
  i64 points, polygons, corners, words;
  double *point;            /* (points, 3) */
  i64 *size;                /* (polygons,) */
  i64 *corner;              /* (corners,) vertices from 0 */
  i64 *word;                /* (words, 3) begin and end of a word that is left to the caller; its place in point, or -1 */
  i64 greatest;             /* the greatest corner */
  i64 loose;                /* lines of loose points and edges */
} Text;

static inline int is_digit(byte c) { return (byte)(c - '0') < 10; }
static inline int is_blank(byte c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
static inline int ends_line(byte c) { return c == '\n' || c == '\r' || c == 0; }
static inline int ends_word(const Text *t, byte c) { return is_blank(c) || ends_line(c) || c == t->comment; }

static inline void skip_line(Text *t) {
  while (!ends_line(*t->at)) t->at++;
}

/* Whether there is one more word in the line, which is then read next. */
static inline int next_word(Text *t) {
  while (is_blank(*t->at)) t->at++;
  if (*t->at == t->comment) skip_line(t);
  return !ends_line(*t->at);
}

/* Whether there is one more line with a word, which is then read next. */
static inline int next_line(Text *t) {
  while (!next_word(t)) {
    if (!*t->at) return 0;
    t->at++;
  }
  return 1;
}

/* ---------------------------------------------------------------------- numbers */
typedef struct {
  u64 value;     /* of the first digits, at most DIGITS of them */
  i64 count;
  i64 dropped;   /* how many digits were too many */
  int lost;      /* whether one of these is not 0 */
} Digits;

static inline const byte *read_digits(const byte *s, Digits *d) {
  for (; is_digit(*s); s++)
    if (d->count < DIGITS) d->value = 10 * d->value + (u64)(*s - '0'), d->count++;
    else d->dropped++, d->lost |= *s != '0';
  return s;
}

/* The high word of a product of 128 bits, and the low one. */
static inline u64 product(u64 a, u64 b, u64 *low) {
  u64 a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
  u64 left = a1 * b0 + (a0 * b0 >> 32);
  __asm__("" : "+r"(left)); /* else Clang finds out, and calls a library where it has no such instruction */
  u64 right = a0 * b1 + (uint32_t)left;
  *low = a * b;
  return a1 * b1 + (left >> 32) + (right >> 32);
}

/* The bits of w 10^e, rounded to nearest, w > 0; 0 where it is subnormal or infinite.  Eisel and Lemire's algorithm: the
 * product with 128 bits of 5^e always decides (Lemire, Number parsing at a gigabyte per second, 2021; Mushtak and Lemire,
 * Fast number parsing without fallback, 2023). */
static inline u64 rounded(const u64 *powers, u64 w, i64 e) {
  if (e < LEAST || e > MOST) return 0;
  const u64 *power = powers + 2 * (e - LEAST);
  int shift = __builtin_clzll(w);
  w <<= shift;
  u64 low, rest, high = product(w, power[0], &low);
  if ((high & 0x1ff) == 0x1ff) {
    u64 more = product(w, power[1], &rest);
    low += more, high += low < more;
  }
  int top = (int)(high >> 63);
  u64 bits = high >> (top + 9); /* 54 of them: one more than a double has */
  i64 exponent = ((217706 * e) >> 16) + 1086 + top - shift; /* 217706 / 2^16 is close to log2(10) */
  if (exponent <= 0) return 0;
  /* Halfway between two doubles, exactly: to the even one. */
  if (low <= 1 && e >= -4 && e <= 23 && (bits & 3) == 1 && bits << (top + 9) == high) bits--;
  bits = ((u64)(exponent - 1) << 52) + ((bits + (bits & 1)) >> 1); /* rounding up may carry into the exponent */
  return bits < 0x7ffull << 52 ? bits : 0;
}

/* Reads a word as a number into point[place], or nowhere if place is -1; false where there is no room to leave it. */
static inline int number(Text *t, i64 place) {
  const byte *begin = t->at, *s = begin;
  Digits d = {0};
  int negative = *s == '-';
  if (negative || *s == '+') s++;
  const byte *whole = s;
  while (*s == '0') s++;
  s = read_digits(s, &d);
  i64 e = 0, written = s - whole;
  if (*s == '.') {
    const byte *fraction = ++s;
    if (!d.count)
      while (*s == '0') s++;
    s = read_digits(s, &d);
    e -= s - fraction, written += s - fraction;
  }
  if (written && (*s == 'e' || *s == 'E')) {
    int down = s[1] == '-';
    s += down || s[1] == '+' ? 2 : 1;
    i64 power = 0;
    written = is_digit(*s);
    for (; is_digit(*s); s++) power = least(10 * power + (*s - '0'), 1 << 20);
    e += down ? -power : power;
  }
  if (written && ends_word(t, *s)) {
    u64 bits = d.value ? rounded(t->powers, d.value, e + d.dropped) : 0;
    if (d.lost && bits != rounded(t->powers, d.value + 1, e + d.dropped)) bits = 0;
    t->at = s;
    if (place < 0) return 1;
    if (bits || !d.value) {
      bits |= (u64)negative << 63;
      copy(t->point + place, &bits, 8);
      return 1;
    }
  }
  while (!ends_word(t, *s)) s++;
  t->at = s;
  if (t->words == t->word_room) return 0;
  i64 *word = t->word + 3 * t->words++;
  word[0] = begin - t->text, word[1] = s - t->text, word[2] = place;
  return 1;
}

/* Reads digits, -1 where there are none, or too many. */
static inline i64 whole_number(Text *t) {
  const byte *begin = t->at;
  i64 value = 0;
  while (is_digit(*t->at) && t->at < begin + 16) value = 10 * value + (*t->at++ - '0');
  return t->at > begin && t->at < begin + 16 ? value : -1;
}

/* ---------------------------------------------------------------------- lines */
static inline int point(Text *t) {
  i64 count = 0;
  if (t->points == t->point_room) return 0;
  for (; next_word(t); count++)
    if (!number(t, count < 3 ? 3 * t->points + count : -1)) return 0;
  t->points++;
  return count < 64 && (t->allowed >> count & 1);
}

static inline int keep_corner(Text *t, i64 v) {
  if (v < 0 || t->corners == t->corner_room) return 0;
  t->greatest = most(t->greatest, v);
  t->corner[t->corners++] = v;
  return 1;
}

/* A size, so many vertices, and perhaps other numbers, if there may be. */
static inline int polygon(Text *t, int others) {
  i64 size = whole_number(t);
  if (size < 0 || !ends_word(t, *t->at) || t->polygons == t->polygon_room) return 0;
  t->size[t->polygons++] = size;
  for (i64 k = 0; k < size; k++)
    if (!next_word(t) || !keep_corner(t, whole_number(t)) || !ends_word(t, *t->at)) return 0;
  while (next_word(t))
    if (!others || !number(t, -1)) return 0;
  return 1;
}

/* Vertices from 1, or from -1, the last one so far, back; what stands behind slashes is skipped. */
static inline int face(Text *t) {
  i64 begin = t->corners;
  if (t->polygons == t->polygon_room) return 0;
  while (next_word(t)) {
    int back = *t->at == '-';
    t->at += back;
    i64 id = whole_number(t);
    if (id < 1 || !keep_corner(t, back ? t->points - id : id - 1)) return 0;
    if (*t->at == '/')
      while (is_digit(*t->at) || *t->at == '/' || *t->at == '-') t->at++;
    if (!ends_word(t, *t->at)) return 0;
  }
  t->size[t->polygons++] = t->corners - begin;
  return 1;
}

/* The first eight letters of a line's first word. */
static inline u64 keyword(Text *t) {
  u64 code = 0;
  for (int k = 0; k < 8 && !ends_word(t, *t->at); k++) code |= (u64)*t->at++ << 8 * k;
  return code;
}

/* ---------------------------------------------------------------------- files */
/* OFF, PLY: some lines of a header, n points, m polygons. */
API i32 bih_read_lists(Text *t, i64 header, i64 n, i64 m, i32 others) {
  for (; header; header--) {
    if (!next_line(t)) return OUTSIDE;
    skip_line(t);
  }
  while (t->points < n)
    if (!next_line(t) || !point(t)) return OUTSIDE;
  while (t->polygons < m)
    if (!next_line(t) || !polygon(t, others)) return OUTSIDE;
  return next_line(t) || t->greatest >= n ? OUTSIDE : DONE;
}

/* OBJ.  known (k,): the keywords of a point, a face, loose points, loose edges, and of what is skipped. */
API i32 bih_read_obj(Text *t, const u64 *known, i64 k) {
  while (next_line(t)) {
    u64 word = keyword(t);
    i64 which = 0;
    while (which < k && known[which] != word) which++;
    if (which == k || (which == 0 && !point(t)) || (which == 1 && !face(t))) return OUTSIDE;
    t->loose += which == 2 || which == 3;
    skip_line(t);
  }
  return t->points && t->greatest < t->points ? DONE : OUTSIDE;
}

/* STL.  facet (7,): the keywords of a triangle's lines; others between them may only be open and close (solids). */
API i32 bih_read_stl(Text *t, const u64 *facet, u64 open, u64 close) {
  u64 word = 0;
  int line = 0;
  while (next_line(t)) {
    word = keyword(t);
    if (word != open && word != close) {
      if (word != facet[line] || (line >= 2 && line <= 4 && !point(t))) return OUTSIDE;
      line = (line + 1) % 7;
    }
    skip_line(t);
  }
  return !line && word == close ? DONE : OUTSIDE;
}
