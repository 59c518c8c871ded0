#include "validate/stream/boundary_chain.h"

namespace clues::validate {

void BoundaryChain::add(const RVector& a, const RVector& b, int times) {
  if (a == b) return;
  if (b < a) {
    add(b, a, -times);
    return;
  }
  const IVector direction = primitive(minus(b, a));
  const RVector along{Rational(direction[0]), Rational(direction[1]), Rational(direction[2])};
  const Line line{direction, cross(a, along)};
  auto& steps = steps_[line];
  for (const auto& [point, change] : {std::pair(&a, times), std::pair(&b, -times)}) {
    const auto [at, fresh] = steps.try_emplace(*point, 0);
    at->second += change;
    if (at->second == 0) steps.erase(at);
  }
  if (steps.empty()) steps_.erase(line);
}

}  // namespace clues::validate
