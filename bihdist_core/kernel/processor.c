/* What the processor can do. */
#include "kernel.h"

/* Whether it runs the library that is compiled for AVX2 and FMA. */
API i32 bih_has_avx2(void) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return 0;
#endif
}
