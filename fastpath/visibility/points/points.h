// Points and planes that keep their construction: an interval for each coordinate now, the rational when a predicate asks for it, then
// kept. No coordinate is ever rounded.
#pragma once

#include <atomic>
#include <optional>
#include <utility>

#include "fastpath/predicates/filter.h"
#include "fastpath/visibility/points/linear_form.h"
#include "fastpath/visibility/points/numbers.h"

namespace clues::fastpath {

class Plane;

using Exact3 = Vec3<Rational>;
using Integer3 = Vec3<Integer>;

// The point v / (w 2^e), w > 0.
struct Homogeneous {
  Integer3 v;
  Integer w;
  int e = 0;
  bool whole = false;  // w is 1
};

// Keeps the first of two values that two threads have computed.
template <class T>
const T& keep_first(std::atomic<const T*>& slot, T value) {
  const auto* fresh = new T(std::move(value));
  const T* expected = nullptr;
  if (slot.compare_exchange_strong(expected, fresh, std::memory_order_acq_rel)) return *fresh;
  delete fresh;
  return *expected;
}

class ExactPoint {
 public:
  ExactPoint() : ExactPoint(Point{0, 0, 0}) {}
  explicit ExactPoint(const Point& p);  // finite
  explicit ExactPoint(const Exact3& p);
  // Where the segment ab crosses a plane; a and b are on different sides of it.
  static ExactPoint on_plane(const ExactPoint& a, const ExactPoint& b, const Plane& plane);
  // a + t (b - a).
  static ExactPoint between(const ExactPoint& a, const ExactPoint& b, double t);
  // from + step (to - from) + lift step direction, exactly; `direction` is a plane's normal scaled to about the length of to - from.
  static ExactPoint lifted(const ExactPoint& from, const ExactPoint& to, double step, const Plane& plane, double lift);
  // The same distance beyond x as s is before it.
  static ExactPoint reflected(const ExactPoint& x, const ExactPoint& s);

  ExactPoint(const ExactPoint& other);
  ExactPoint& operator=(const ExactPoint& other);
  ~ExactPoint() {
    delete exact_.load(std::memory_order_relaxed);
    delete homogeneous_.load(std::memory_order_relaxed);
  }

  const Vec3<Interval>& approximate() const { return near_; }
  bool is_double() const { return near_.x.is_point() && near_.y.is_point() && near_.z.is_point(); }
  const Exact3& exact() const;
  const Homogeneous& homogeneous() const;  // integers.cpp
  Point estimate() const;

 private:
  enum class Kind : std::uint8_t { given, on_plane, between, reflected };
  // Nothing reduced; none if the numbers get long.
  std::optional<Homogeneous> crossing_in_whole_numbers() const;
  std::optional<Homogeneous> combination_in_whole_numbers() const;
  Kind kind_ = Kind::given;
  Vec3<Interval> near_{};
  const ExactPoint *a_ = nullptr, *b_ = nullptr;
  const Plane* plane_ = nullptr;
  double t_ = 0;
  mutable std::atomic<const Exact3*> exact_{nullptr};
  mutable std::atomic<const Homogeneous*> homogeneous_{nullptr};
};

// Through three points that are not collinear; positive side: from which a, b, c turn counter-clockwise.
class Plane {
 public:
  Plane(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c);
  Plane(const Plane&) = delete;
  Plane& operator=(const Plane&) = delete;
  ~Plane() {
    delete exact_.load(std::memory_order_relaxed);
    delete direction_.load(std::memory_order_relaxed);
  }

  const Vec3<Interval>& normal_approximate() const { return normal_; }
  Point normal_estimate() const {  // twice the middle of it: for directions
    return {normal_.x.inf() + normal_.x.sup(), normal_.y.inf() + normal_.y.sup(), normal_.z.inf() + normal_.z.sup()};
  }
  const Exact3& normal_exact() const;
  const Integer3& normal_direction() const;  // a positive multiple of it, in whole numbers (integers.cpp)
  const ExactPoint& base() const { return *a_; }
  std::array<const ExactPoint*, 3> corners() const { return {a_, b_, c_}; }

  // The side of x: sign of normal . (x - base).
  int side(const ExactPoint& x) const;
  Interval value_approximate(const ExactPoint& x) const { return dot(normal_, x.approximate() - a_->approximate()); }
  Rational value_exact(const ExactPoint& x) const { return dot(normal_exact(), x.exact() - a_->exact()); }

  // Two coordinates in which points of the plane turn as they do seen from its positive side.
  const std::array<std::uint8_t, 2>& axes() const { return axes_; }

 private:
  const ExactPoint *a_, *b_, *c_;
  LinearForm first_look_;
  Vec3<Interval> normal_{};
  std::array<std::uint8_t, 2> axes_{};
  mutable std::atomic<const Exact3*> exact_{nullptr};
  mutable std::atomic<const Integer3*> direction_{nullptr};
};

template <class NT>
Vec3<NT> coordinates(const ExactPoint& p);
template <>
inline Vec3<Interval> coordinates<Interval>(const ExactPoint& p) {
  return p.approximate();
}
template <>
inline Vec3<Rational> coordinates<Rational>(const ExactPoint& p) {
  return p.exact();
}
template <class NT>
Vec3<NT> normal_of(const Plane& h);
template <>
inline Vec3<Interval> normal_of<Interval>(const Plane& h) {
  return h.normal_approximate();
}
template <>
inline Vec3<Rational> normal_of<Rational>(const Plane& h) {
  return h.normal_exact();
}

// The length of a vector, without underflow; zero only for the zero vector.
double length_estimate(const Point& v);

// A point near x and close to the way to another. Near, nearer and nearer, and closer and closer, with level 0, 1, ...: first with double coordinates,
// then with as many bits as it takes.
ExactPoint point_near(const ExactPoint& x, const ExactPoint& to, int level);

// How often rationals had to decide, on this thread.
std::uint64_t& exact_decisions();

// Evaluates f<NT>() in intervals and, when that is unsure, exactly: in rationals, or in whole numbers where only directions are asked for (integers.h).
template <class Exact = Rational, class F>
auto decide(const F& f) {
  try {
    return f.template operator()<Interval>();
  } catch (const Unsure&) {
    ++exact_decisions();
    return f.template operator()<Exact>();
  }
}

// Positive when a, b, c turn left seen from d, as CGAL::orientation(a, b, c, d).
int orientation(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d);
// Coordinate by coordinate.
bool equal(const ExactPoint& a, const ExactPoint& b);
int compare_coordinate(const ExactPoint& a, const ExactPoint& b, int axis);
bool collinear(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c);

}  // namespace clues::fastpath
