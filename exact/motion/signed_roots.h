// The sign of a sum of up to four square roots, by integers alone: what the predicates of motion bounds (D29) come down to. A whole
// number a is the root of a^2 with the sign of a, so that sums of numbers and roots are the same thing.
#pragma once

#include <gmpxx.h>

#include <initializer_list>

namespace clues::exact {

// sign * sqrt(square); square >= 0, and sign is -1, 0 (then the square does not matter) or 1.
struct SignedRoot {
  int sign = 0;
  mpz_class square;
};
struct SignedRationalRoot {
  int sign = 0;
  mpq_class square;
};

inline SignedRationalRoot as_root(const mpq_class& number) { return {sgn(number), number * number}; }
// factor * sqrt(square)
inline SignedRationalRoot root_of(const mpq_class& factor, const mpq_class& square) {
  return {sgn(square) == 0 ? 0 : sgn(factor), factor * factor * square};
}

// The sign of a + b, of a + b + c, of a + b + c + d. Two comparisons of squares for two roots; for three and four, numbers of four times the length of the
// squares.
int sign_of_sum(const SignedRoot& a, const SignedRoot& b);
int sign_of_sum(const SignedRoot& a, const SignedRoot& b, const SignedRoot& c);
int sign_of_sum(const SignedRoot& a, const SignedRoot& b, const SignedRoot& c, const SignedRoot& d);
// At most four.
int sign_of_sum(std::initializer_list<SignedRationalRoot> roots);

}  // namespace clues::exact
