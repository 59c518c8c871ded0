// The exact point of a suite's strings (suite.h), for those who have an exact kernel.
#pragma once

#include "exact/kernel.h"
#include "validate/vectors/suite.h"

namespace clues::validate {

// In whatever terms the fractions are.
inline exact::Point3 point_of(const RationalPoint& p) {
  const auto number = [](const std::string& text) {
    exact::FT::Exact_type value(text);
    value.canonicalize();
    return exact::FT(value);
  };
  return {number(p[0]), number(p[1]), number(p[2])};
}

}  // namespace clues::validate
