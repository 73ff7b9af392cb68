/* What the processor can do. */
#include "kernel.h"
#if defined(__x86_64__)
#include <cpuid.h>
#endif

/* Whether it, and the system, run the library that is compiled for AVX2 and FMA.  (__builtin_cpu_supports says no to all
 * where zig links it.) */
API i32 bih_has_avx2(void) {
#if defined(__x86_64__)
  enum { FMA = 1 << 12, SAVED = 1 << 27, AVX2 = 1 << 5, REGISTERS = 6 };
  unsigned a, b, c, d, kept;
  if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & FMA) || !(c & SAVED)) return 0;
  __asm__("xgetbv" : "=a"(kept), "=d"(d) : "c"(0)); /* which registers the system keeps: SSE's and AVX's */
  return (kept & REGISTERS) == REGISTERS && __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & AVX2);
#else
  return 0;
#endif
}
