// What every file of the floating-point path relies on: IEEE arithmetic as written. Options that let the compiler replace it
// are refused here; a floating-point environment that differs from the default is refused at run time.
#pragma once

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(__NO_SIGNED_ZEROS__)
#error \
    "clues/fastpath derives its error bounds from IEEE arithmetic: compile without -ffast-math, -Ofast and their parts"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error \
    "clues/fastpath needs float and double to be evaluated as such (no x87): compile for SSE2 or another 64-bit target"
#endif

namespace clues::fastpath {

// Throws scene::Error unless the calling thread rounds to nearest and keeps subnormal numbers, and products and sums are rounded
// apart in this library.
void require_float_rules();

}  // namespace clues::fastpath
