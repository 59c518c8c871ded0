// Four floats at once, for stage 1 of the segment queries. The vector types of GCC and clang: the same operations, in the same order,
// on every machine.
#pragma once

#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "fastpath/predicates/float_rules.h"

namespace clues::fastpath {

using Float4 = float __attribute__((vector_size(16)));
using Mask4 = std::int32_t __attribute__((vector_size(16)));  // a lane is 0 or -1

inline Float4 all_lanes(float x) { return Float4{x, x, x, x}; }

inline Float4 load4(const float* aligned) {
  Float4 v;
  std::memcpy(&v, __builtin_assume_aligned(aligned, 16), sizeof v);
  return v;
}

inline void store4(float* to, Float4 v) { std::memcpy(to, &v, sizeof v); }

// Without NaN the order of the arguments does not matter, except for the sign of zero.
inline Float4 min4(Float4 a, Float4 b) {
#ifdef __SSE2__
  return reinterpret_cast<Float4>(_mm_min_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
#else
  return a < b ? a : b;
#endif
}

inline Float4 max4(Float4 a, Float4 b) {
#ifdef __SSE2__
  return reinterpret_cast<Float4>(_mm_max_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
#else
  return a > b ? a : b;
#endif
}

// Bit i is set when lane i is.
inline unsigned bits_of(Mask4 m) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(m)));
#else
  return (m[0] & 1U) | (m[1] & 2U) | (m[2] & 4U) | (m[3] & 8U);
#endif
}

}  // namespace clues::fastpath
