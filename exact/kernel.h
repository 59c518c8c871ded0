// The exact kernel: CGAL's Epeck (interval filter over GMP rationals). No rounding, no tolerance; a decision
// that intervals cannot make is made in rationals.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <string>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::exact {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using FT = Kernel::FT;
using Point3 = Kernel::Point_3;
using Vector3 = Kernel::Vector_3;
using Plane3 = Kernel::Plane_3;
using Point2 = Kernel::Point_2;
using Vector2 = Kernel::Vector_2;

// Of plain rationals, in which the kernel decides what its intervals cannot.
using RationalKernel = Kernel::Exact_kernel;

enum class Side : signed char { negative = -1, on = 0, positive = 1 };

inline Side to_side(CGAL::Sign s) { return static_cast<Side>(static_cast<int>(s)); }

inline Point3 to_exact(const scene::Point& p) { return Point3(p[0], p[1], p[2]); }

// Nearest-ish doubles for pictures and reports; never used in a decision.
inline scene::Point to_double_estimate(const Point3& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

// The plane's form at p: its sign is the side p is on, its ratio at two points the ratio of their distances.
inline FT value_at(const Plane3& h, const Point3& p) { return h.a() * p.x() + h.b() * p.y() + h.c() * p.z() + h.d(); }

// 1 where the largest coordinate is about 2^-64 to 2^64, else about its power of two. Constructions of CGAL in the plane, the intersection of two lines for
// one, fail in silence where an interval overflows; so they are made in this unit.
double unit_of(const std::vector<Point3>& points);

// "p/q" in lowest terms, "p" when the denominator is 1.
std::string to_string_exact(const FT& x);

// Replaces the lazy expression by its value, so that its history can be freed.
Point3 collapsed(const Point3& p);
FT collapsed(const FT& x);

// Collapsed points that are made in rationals from the start: lazy numbers would make a node for each operation, and an
// interval for each node.
Point3 to_lazy(const RationalKernel::Point_3& p);
// Where a plane crosses the line ab, which is not parallel to it.
Point3 crossing(const Plane3& h, const Point3& a, const Point3& b);
// The point of the line ab where a linear form is zero that has these different values at a and b.
Point3 zero_on_line(const Point3& a, const Point3& b, const FT& at_a, const FT& at_b);

}  // namespace clues::exact
