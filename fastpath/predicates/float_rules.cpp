// The floating-point environment, tried out rather than asked for.
#include "fastpath/predicates/float_rules.h"

#include <limits>

#include "scene/messages/error.h"

namespace clues::fastpath {

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
}

}  // namespace clues::fastpath
