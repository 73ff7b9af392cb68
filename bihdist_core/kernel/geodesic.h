/* Exact geodesic distance on triangle meshes: windows that unfold from face to face.
 *
 * A window (Mitchell, Mount, Papadimitriou 1987; Chen, Han 1990) is an interval of an edge whose points see one source,
 * unfolded into the plane of the face ahead: a point, or parallel rays that leave a straight source at right angles.
 * All windows waiting at one side of an edge cross the face together (after Qin, Han, Yu, Yu, Zhang 2016), sides in the
 * order of their least distance.  Nothing is dropped but what is known to be farther than something else.
 *
 * Side h = 3 face + k is the edge of a face from its corner k to the next.  Its frame has that corner at the origin, the
 * next at (length, 0) and the third, the apex, at (x, y), y >= 0. */
#ifndef BIHDIST_GEODESIC_H
#define BIHDIST_GEODESIC_H
#include "kernel.h"

/* Besides those of kernel.h: more windows than allowed, a path that does not come back to its source, another round. */
enum { TOO_MUCH = -6, LOST = -7, MORE = 1 };

#define NONE (-1)
#define EVERYWHERE (-1)
#define EQUAL 1e-12 /* ratio: distances nearer to each other than this count as equal, and nothing is dropped */
#define NO_HEIGHT 2e-13 /* of a face's longest edge: with less, and with a shorter edge, a face is degenerate */
#define CRACK 1e-9  /* of an edge: a point this near beside a window is seen by it, so that none falls between two */

/* Whether paths may bend at a vertex: at a saddle or on the boundary only where both sides have an angle of pi or more.
 * Where its faces are no single fan, or one of them is so flat that the way that came in is unknown, it sends
 * everywhere. */
enum { CONVEX, SADDLE, BOUNDARY, ANYWHERE };

/* What a run may leave out, for tests: bits of Run.everything. */
enum { ALL_DIRECTIONS = 1, ALL_WINDOWS = 2 };

typedef struct {
  double length, x, y;
  i32 vertex; /* at its beginning */
  i32 twin;   /* 2 side + whether both run the same way, the next in the ring of sides at this edge; NONE: boundary */
} Side;

typedef struct {
  i64 vertices, faces;
  Side *side;          /* (3 faces,) */
  i32 *first, *corner; /* (vertices + 1,), (3 faces,): corners at each vertex, as the sides that begin there */
  unsigned char *kind; /* (vertices,) whether paths bend there */
} Mesh;

/* [b0, b1] of an edge, whose points have the distance s + |(x - px, py)|, or s + x px where rays are parallel to the
 * unit vector (px, py). */
typedef struct {
  double b0, b1, px, py, s;
  i32 next, root; /* root: the vertex where the rays bent last, or -2 - the number of a source in a face */
  i32 over;       /* the last crossing on the way here of an edge of three or more faces */
  unsigned char parallel, crossed; /* crossed: kept to compare later ones with, see geodesic_windows.c */
} Window;

/* How a vertex or a place was reached: in the face of side `from`, in a straight line from (px, -py) in its frame. */
typedef struct {
  double distance, px, py;
  i32 from, root, over;
  i32 at; /* its place in the heap */
} Reached;

typedef struct {
  i32 head, at; /* the first window waiting at a side; the side's place in the heap */
  double known; /* the distance of the vertex at its beginning, as far as the side's part knows */
} Queue;

typedef struct {
  double distance;
  i32 id; /* a side, or the number of sides + a vertex */
} Waiting;

typedef struct {
  i32 side, before; /* the side by which a window left over an edge of three or more faces; the crossing before */
} Crossing;

/* Points, or straight pieces, of faces, by the barycentric coordinates of their ends. */
typedef struct {
  i64 count;
  const i32 *face;
  const double *begin, *end; /* (count, 3) each */
} Places;

/* What has left a part: a window that waits at a side, or how a vertex was reached. */
typedef struct {
  Reached reached;        /* of a window its least distance alone */
  i32 to, window, before; /* a side, or the number of sides + a vertex; the message that its part sent before */
} Message;

/* 2^shift faces that follow each other in number, and thus lie near each other: in a round one thread works on them, and
 * they stay in its cache. */
typedef struct {
  Waiting *heap; /* six for each face: its sides, and vertices whose first corner is in it */
  i64 waiting;
  i32 sent, is_taken; /* the last message; whether a thread works on it, or has done so in this round */
  i64 apart[5];  /* see Run */
} Part;

/* What the threads of a run share.  In each round they work on all parts where something waits within the bound; what
 * leaves a part is handed on between rounds, so that no number depends on which thread was faster. */
typedef struct {
  Part *part;            /* (parts,) */
  i32 *busy;             /* (parts,) those that are worked on in a round */
  Message *message;      /* (messages,) */
  i64 parts, messages, shift, threads;
  i64 count;             /* of busy parts */
  i64 used, sent, taken; /* windows and messages that threads have; windows taken up */
  double band, bound;    /* how far a round goes; up to which distance */
} Round;

/* A run as one of its threads has it. */
typedef struct {
  const Mesh *mesh;
  Round *round;
  Places source, target;
  const double *offset;     /* (sources,) the distance at each source */
  const i32 *first_target;  /* (faces,) of the lists of targets in each face; unused without targets */
  const i32 *next_target;   /* (targets,) */
  Reached *reached;         /* (vertices + targets,) */
  Queue *queue;             /* (3 faces,) */
  Waiting *heap;            /* (6 faces,) */
  Window *window;           /* (windows,) */
  i32 *order, *spare;       /* (windows,) each */
  Crossing *crossing;       /* (crossings,) */
  i64 windows, crossings, crossings_used;          /* room */
  i64 needed, messages_needed, crossings_needed;   /* NO_ROOM: how many more must there be room for */
  i64 taken, most_taken;     /* windows taken up at sides, again where they stay there, and how many may be */
  i64 unused;                /* how many windows this thread has that are free */
  i64 message, messages_end; /* the messages that it may send */
  double radius;
  i32 thread;        /* its number */
  i32 free, part;    /* the first of its free windows; the part it works on, or EVERYWHERE while there is one thread */
  i32 everything;    /* what is not left out */
  i32 targets_only;  /* whether to end once the targets are reached */
  i64 apart[16];     /* threads do not share a line of the cache */
} Run;

static inline i32 next_side(i32 h) { return h % 3 == 2 ? h - 2 : h + 1; }
static inline i32 previous_side(i32 h) { return h % 3 ? h - 1 : h + 2; }
static inline double length_of(double x, double y) { return __builtin_sqrt(x * x + y * y); }
static inline double apart(const double *p, const double *q) {
  double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
  return __builtin_sqrt(x * x + y * y + z * z);
}
static inline double clamp(double x, double lo, double hi) { return x < lo ? lo : x > hi ? hi : x; }

/* The cosine and sine of a face's corner at the beginning of a side. */
typedef struct {
  double c, s;
} Ray;

/* Of the short side of a needle this is exact to the last digit, where differences of coordinates in a frame are not. */
static inline Ray corner_at(const Mesh *mesh, i32 h) {
  double l = mesh->side[previous_side(h)].length;
  return (Ray){mesh->side[h].x / l, mesh->side[h].y / l};
}

/* Where barycentric coordinates are in the frame of a side. */
static inline void in_frame(const Mesh *mesh, i32 h, const double *weight, double *x, double *y) {
  const Side *side = &mesh->side[h];
  double next = weight[next_side(h) % 3], apex = weight[previous_side(h) % 3];
  *x = next * side->length + apex * side->x, *y = apex * side->y;
}

/* Round a vertex: the side by which the next face is left, after one that is left by side h; its corner there. */
static inline i32 turn_over(const Mesh *mesh, i32 vertex, i32 h, i32 *corner) {
  i32 twin = mesh->side[h].twin;
  if (twin < 0) return NONE;
  twin >>= 1;
  if (mesh->side[twin].vertex == vertex) return *corner = twin, previous_side(twin);
  return *corner = next_side(twin);
}

static inline i32 first_corner(const Mesh *mesh, i64 vertex) { return mesh->corner[mesh->first[vertex]]; }

/* The part of a side, and whether it is the one at hand. */
static inline i64 part_of(const Run *run, i32 h) { return (h / 3) >> run->round->shift; }
static inline int is_here(const Run *run, i32 h) { return run->part == EVERYWHERE || part_of(run, h) == run->part; }

/* geodesic_run.c, geodesic_windows.c, geodesic_bends.c */
void wait_at(Run *run, i32 h, i32 window, double distance);
void reach(Run *run, i64 id, double distance, i32 from, double px, double py, i32 root, i32 over);
void leave(Run *run, i32 h, Window w);
void cross_all(Run *run, i32 h);
void bend(Run *run, i32 vertex);
double nearest_share(const Run *run, i32 source, i32 h, double x, double y);

/* geodesic_mesh.c */
API i64 bih_geodesic_mesh(const Mesh *mesh, const double *X, const i32 *faces, const i32 *label, i32 *a, i32 *b,
                          i32 *put);

/* geodesic_run.c */
API i32 bih_geodesic_begin(Run *run);
API i32 bih_geodesic_next(Run *run);
API i32 bih_geodesic_round(Run *run, Watch *watch);
#endif
