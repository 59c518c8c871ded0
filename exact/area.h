// Areas for reports; never used in a decision.
#pragma once

#include "exact/kernel.h"

namespace clues::exact {

// Of the triangle abc, to about the nearest double; coordinates may be of any size as long as the area itself is a double.
double area_estimate(const Point3& a, const Point3& b, const Point3& c);

}  // namespace clues::exact
