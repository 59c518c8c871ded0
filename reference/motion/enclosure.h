// A real number between two rationals. Every operation rounds its ends outward to 192 binary digits, so that numbers stay short and what is
// said of the ends is true of the number. For bounds with roots in them that are only wanted from below (T8, T9).
#pragma once

#include <gmpxx.h>

#include <array>

#include "exact/motion/rational_vector.h"

namespace clues::reference {

struct Enclosure {
  mpq_class low, high;

  Enclosure() = default;
  Enclosure(const mpq_class& number) : low(number), high(number) {}  // NOLINT: a rational is its own enclosure
  Enclosure(int number) : low(number), high(number) {}               // NOLINT
  Enclosure(const mpq_class& from, const mpq_class& to);             // rounds outward
};

Enclosure operator+(const Enclosure& a, const Enclosure& b);
Enclosure operator-(const Enclosure& a, const Enclosure& b);
Enclosure operator*(const Enclosure& a, const Enclosure& b);
Enclosure operator/(const Enclosure& a, const Enclosure& b);  // b does not hold 0
Enclosure square(const Enclosure& a);
Enclosure absolute(const Enclosure& a);
Enclosure root(const Enclosure& a);  // of what is not negative; a negative low end counts as 0

using EnclosedVector = std::array<Enclosure, 3>;
EnclosedVector enclosed(const exact::RationalVector& a);
EnclosedVector operator+(const EnclosedVector& a, const EnclosedVector& b);
EnclosedVector operator-(const EnclosedVector& a, const EnclosedVector& b);
EnclosedVector operator*(const Enclosure& factor, const EnclosedVector& a);
Enclosure length(const EnclosedVector& a);

}  // namespace clues::reference
