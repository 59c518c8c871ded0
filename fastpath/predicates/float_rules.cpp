// The floating-point environment, tried out rather than asked for.
#include "fastpath/predicates/float_rules.h"

#include <array>
#include <limits>

#include "scene/messages/error.h"

namespace clues::fastpath {

namespace {

// As a compiler's vectorizer sees it: g++ 12 leaves out pairs of conversions here (CMakeLists.txt).
[[gnu::noinline]] std::array<double, 3> as_floats(std::array<double, 3> x) {
  for (double& value : x) value = static_cast<float>(value);
  return x;
}

bool conversions_are_kept() {
  volatile double third = 1.0 / 3;
  const std::array<double, 3> x = as_floats({third, third / 5, third / 7});
  volatile float one = static_cast<float>(third);
  return x[0] == one && x[0] != third && x[1] != third / 5 && x[2] != third / 7;
}

}  // namespace

void require_float_rules() {
  volatile double one = 1, half_ulp = 0x1p-53, tiny = std::numeric_limits<double>::min();
  volatile float one_f = 1, half_ulp_f = 0x1p-24F, tiny_f = std::numeric_limits<float>::min();
  // Every other rounding mode moves one of these sums off 1 or -1.
  const bool nearest = one + half_ulp == 1 && -one - half_ulp == -1 && one - half_ulp / 2 == 1 &&
                       one_f + half_ulp_f == 1 && -one_f - half_ulp_f == -1 && one_f - half_ulp_f / 2 == 1;
  const bool gradual = tiny / 2 != 0 && tiny_f / 2 != 0;
  // (1 + 2^-30)^2 - (1 + 2^-29) is 2^-60, or 0 when the product is rounded before the subtraction.
  volatile double near_one = 1 + 0x1p-30, square = 1 + 0x1p-29;
  const double x = near_one, y = square;
  const bool apart = x * x - y == 0;
  if (!nearest || !gradual || !apart) {
    throw scene::Error(
        scene::ErrorCode::bad_argument,
        "the floating-point environment is not the default one (rounding to nearest, subnormal numbers kept, no "
        "fused products); restore it in this thread before calling clues/fastpath");
  }
  static const bool kept = conversions_are_kept();
  if (!kept) {
    throw scene::Error(
        scene::ErrorCode::internal,
        "clues/fastpath was compiled so that conversions to float get lost: use -fno-tree-slp-vectorize");
  }
}

}  // namespace clues::fastpath
