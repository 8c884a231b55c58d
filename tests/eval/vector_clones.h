// The same loop compiled for the vector registers of two generations of x86 and chosen at
// run time, so that a baseline is not slow for want of a compiler flag.
#pragma once

namespace haarmony::eval {

#if defined(__x86_64__)
[[nodiscard]] inline bool has_avx2() { return __builtin_cpu_supports("avx2") != 0; }
#define HAARMONY_EVAL_AVX2 [[gnu::target("avx2")]]
#else
[[nodiscard]] inline bool has_avx2() { return false; }
#define HAARMONY_EVAL_AVX2
#endif

}  // namespace haarmony::eval
