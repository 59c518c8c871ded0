// The planar oracle (D18): gather every direction at which a triangle's shadow can begin or end, then try one direction in each
// gap. What is seen in the directions in between, and in no gap beside them, is no open part of the cell
// (D6).
#include "exact/sight/planar_occlusion.h"

#include <algorithm>
#include <utility>

#include "exact/sight/sight_segment.h"

namespace clues::exact {
namespace {

// x with f(x) = 0 on the line ab, for the linear f with the given values at a and b.
Point3 zero_between(const Point3& a, const Point3& b, const FT& at_a, const FT& at_b) {
  return a + (b - a) * (at_a / (at_a - at_b));
}

class Fan {
 public:
  // Directions strictly between `first` and `last`, which make less than a straight angle.
  Fan(const Point3& p, const std::optional<Plane3>& side, Vector3 first, Vector3 last)
      : p_(p), first_(std::move(first)), last_(std::move(last)), normal_(CGAL::cross_product(first_, last_)) {
    if (side) {
      side_ = side->orthogonal_vector();
      const Vector3 border = CGAL::cross_product(normal_, *side_);
      add_direction(border);
      add_direction(-border);
    }
  }

  void add_point(const Point3& x) { add_direction(x - p_); }

  // The corners of the triangle's section with the plane, and where its edges cross the lines.
  void add_section(const TriangleCorners& t, const std::vector<std::pair<Point3, Point3>>& lines) {
    std::vector<Point3> section;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3 &a = t[i], &b = t[(i + 1) % 3];
      const FT at_a = CGAL::scalar_product(normal_, a - p_), at_b = CGAL::scalar_product(normal_, b - p_);
      if (CGAL::is_zero(at_a)) section.push_back(a);
      if (CGAL::sign(at_a) * CGAL::sign(at_b) == CGAL::NEGATIVE) section.push_back(zero_between(a, b, at_a, at_b));
    }
    for (std::size_t i = 0; i < section.size(); ++i) {
      const Point3 &a = section[i], &b = section[(i + 1) % section.size()];
      add_point(a);
      for (const auto& [c, d] : lines) {
        const Vector3 across = CGAL::cross_product(normal_, d - c);
        const FT at_a = CGAL::scalar_product(across, a - c), at_b = CGAL::scalar_product(across, b - c);
        if (CGAL::sign(at_a) * CGAL::sign(at_b) == CGAL::NEGATIVE) add_point(zero_between(a, b, at_a, at_b));
      }
    }
  }

  // One direction in each gap.
  std::vector<Vector3> trials() {
    std::sort(events_.begin(), events_.end(), [&](const Vector3& a, const Vector3& b) { return turn(a, b) > 0; });
    events_.push_back(last_);
    std::vector<Vector3> allowed;
    Vector3 before = first_;
    for (const Vector3& event : events_) {
      if (turn(before, event) == CGAL::ZERO) continue;
      const Vector3 between = before + event;
      if (!side_ || CGAL::sign(CGAL::scalar_product(*side_, between)) == CGAL::POSITIVE) allowed.push_back(between);
      before = event;
    }
    return allowed;
  }

  const Vector3& normal() const { return normal_; }

 private:
  CGAL::Sign turn(const Vector3& a, const Vector3& b) const {
    return CGAL::sign(CGAL::scalar_product(normal_, CGAL::cross_product(a, b)));
  }
  void add_direction(const Vector3& d) {
    if (turn(first_, d) == CGAL::POSITIVE && turn(d, last_) == CGAL::POSITIVE) events_.push_back(d);
  }

  Point3 p_;
  Vector3 first_, last_, normal_;
  std::optional<Vector3> side_;
  std::vector<Vector3> events_;
};

bool is_free(const Point3& end, bool closed, const Point3& p, const std::vector<TriangleCorners>& triangles) {
  return std::none_of(triangles.begin(), triangles.end(),
                      [&](const TriangleCorners& t) { return blocks(t, end, closed, p); });
}

// Where the line from p enters the cell, and where it leaves it: a point between the two that no triangle
// holds, nor what lies between it and p. None if a triangle meets the way up to `enter`; else there are such
// points near `enter`, as triangles are closed.
std::optional<Point3> free_point_behind(const Point3& enter, const Point3& leave, const Point3& p,
                                        const std::vector<TriangleCorners>& triangles) {
  if (!is_free(enter, true, p, triangles)) return std::nullopt;
  for (FT share = FT(1) / FT(2);; share = share * share) {
    const Point3 v = enter + (leave - enter) * share;
    if (is_free(v, true, p, triangles)) return v;
  }
}

}  // namespace

std::optional<Point3> free_point_of_segment(const Point3& p, const std::optional<Plane3>& side, const Point3& a,
                                            const Point3& b, const std::vector<TriangleCorners>& triangles) {
  Fan fan(p, side, a - p, b - p);
  // Only what is between p and the line ab blocks, so a shadow may also end where its triangle passes that
  // line.
  for (const TriangleCorners& t : triangles) fan.add_section(t, {{a, b}});
  const Vector3 across = CGAL::cross_product(fan.normal(), b - a);
  const FT at_p = CGAL::scalar_product(across, p - a);
  for (const Vector3& d : fan.trials()) {
    const Point3 v = p - d * (at_p / CGAL::scalar_product(across, d));
    if (is_free(v, false, p, triangles)) return v;
  }
  return std::nullopt;
}

std::optional<Point3> free_point_of_segment_end_on(const Point3& p, const Point3& a, const Point3& b,
                                                   const std::vector<TriangleCorners>& triangles) {
  return CGAL::has_smaller_distance_to_point(p, a, b) ? free_point_behind(a, b, p, triangles)
                                                      : free_point_behind(b, a, p, triangles);
}

std::optional<Point3> free_point_of_polygon(const Point3& p, const std::optional<Plane3>& side,
                                            const std::vector<Point3>& polygon,
                                            const std::vector<TriangleCorners>& triangles) {
  const std::size_t n = polygon.size();
  const Vector3 up = CGAL::cross_product(polygon[1] - polygon[0], polygon[2] - polygon[0]);
  const auto turn = [&](const Vector3& a, const Vector3& b) {
    return CGAL::sign(CGAL::scalar_product(up, CGAL::cross_product(a, b)));
  };
  Vector3 first = polygon[0] - p, last = first;
  for (const Point3& corner : polygon) {
    const Vector3 d = corner - p;
    if (turn(d, first) == CGAL::POSITIVE) first = d;
    if (turn(last, d) == CGAL::POSITIVE) last = d;
  }
  Fan fan(p, side, first, last);
  std::vector<std::pair<Point3, Point3>> lines;
  for (std::size_t i = 0; i < n; ++i) lines.emplace_back(polygon[i], polygon[(i + 1) % n]);
  for (const Point3& corner : polygon) fan.add_point(corner);
  for (const TriangleCorners& t : triangles) fan.add_section(t, lines);

  for (const Vector3& d : fan.trials()) {
    std::optional<FT> enter, leave;
    for (const auto& [a, b] : lines) {
      const Vector3 inward = CGAL::cross_product(up, b - a);
      const FT slope = CGAL::scalar_product(inward, d);
      if (CGAL::is_zero(slope)) continue;
      const FT s = CGAL::scalar_product(inward, a - p) / slope;
      auto& bound = CGAL::sign(slope) == CGAL::POSITIVE ? enter : leave;
      if (!bound || (CGAL::sign(slope) == CGAL::POSITIVE ? s > *bound : s < *bound)) bound = s;
    }
    if (auto v = free_point_behind(p + d * *enter, p + d * *leave, p, triangles)) return v;
  }
  return std::nullopt;
}

}  // namespace clues::exact
