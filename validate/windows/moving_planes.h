// Planes through a point y(s) = origin + s u that moves along a line, and the question on which side of each other they cross.
//
// A plane is given by its normal n(s) = A + s B. Which arcs of great circles cross where, seen from y(s), depends only on the
// signs of det(n_i, n_j, n_k) (s). For planes through y(s) and a fixed line, B is perpendicular to u, so the cubic term
// det(B_i, B_j, B_k) vanishes and the sign can change only at the roots of a polynomial of degree two.
//
// A computation at one s that asks only such signs runs in the same way for every s' that gives the same answers. The table
// remembers what it was asked and tells how far that is: valid_range(). Intervals first, integers when they fail.
#pragma once

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Root_of_traits.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <unordered_map>
#include <vector>

#include "validate/windows/rational.h"

namespace clues::validate {

using Root = CGAL::Root_of_traits<CGAL::Gmpq>::Root_of_2;  // a rational, or a root of a quadratic polynomial

struct OpenRange {
  Root low, high;
};

// A dyadic number strictly between the two; low < high. Short where the range is long.
Rational between(const Root& low, const Root& high);
Root to_root(const Rational& x);

class MovingPlanes {
 public:
  using Interval = CGAL::Interval_nt<true>;

  MovingPlanes(RVector origin, RVector direction);

  int add_constant(const RVector& normal);                  // A = normal
  int add_line(const RVector& a, const RVector& b);         // normal (a - y) x (b - y)
  int add_value(const RVector& normal, const RVector& at);  // for value_sign: normal . (y - at)

  // All signs are those at s; what was asked before is forgotten.
  void move_to(const Rational& s);
  const Rational& parameter() const { return s_; }
  RVector position() const { return sum(origin_, times(direction_, s_)); }
  const RVector& direction() const { return direction_; }

  // Sign of det(n_i, n_j, n_k). `certain`: the answer matters, remember it.
  int sign(int i, int j, int k, bool certain);
  int value_sign(int value, bool certain);

  // A remembered polynomial vanishes here, but not everywhere.
  bool on_event() const { return on_event_; }
  // The largest open part of the range around s, on which all remembered answers stay the same.
  OpenRange valid_range(const OpenRange& range) const;

  // The normal at s, times a positive factor.
  const IVector& normal(int i);

 private:
  struct Plane {
    IVector a, b;
    std::array<Interval, 3> near_a, near_b;
    IVector here;
    std::uint64_t here_for = 0;
  };
  struct Polynomial {
    std::array<Interval, 3> near;
    mutable std::unique_ptr<std::array<Integer, 3>> exact;
    std::array<int, 3> planes{-1, -1, -1};
    std::uint64_t remembered_for = 0, sign_for = 0;
    int sign = 0;
  };

  int add(const RVector& a, const RVector& b);
  Polynomial& triple(int i, int j, int k);
  const std::array<Integer, 3>& exact_of(const Polynomial& p) const;
  int sign_here(Polynomial& p);
  void remember(Polynomial& p, int sign);
  void shrink(const Polynomial& p, OpenRange& range) const;

  RVector origin_, direction_;
  Rational s_;
  Interval near_s_;
  std::uint64_t visit_ = 0;
  bool on_event_ = false;
  std::vector<Plane> planes_;
  std::unordered_map<std::uint64_t, Polynomial> triples_;
  std::deque<Polynomial> values_;  // stays in place when it grows
  std::vector<const Polynomial*> remembered_;
};

}  // namespace clues::validate
