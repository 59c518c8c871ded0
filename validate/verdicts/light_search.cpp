#include "validate/verdicts/light_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "exact/sight/witness.h"
#include "fastpath/predicates/estimated_vectors.h"
#include "fastpath/queries/segment_queries.h"

namespace clues::validate {
namespace {

using exact::FT;
using exact::Point3;
using scene::Point;

constexpr std::size_t kViewpoints = 16;
constexpr int kLinesEach = 32;            // sight lines from a viewpoint
constexpr int kTrials = 8;                // of all to a triangle that seem free, such as are put to the witness checker
constexpr double kBeforePlane = 0x1p-40;  // of the way: so far in front of the triangle's plane lines end
constexpr double kTooSmall = 0x1p-44;     // of the triangle's area
constexpr std::size_t kMostParts = 4096;  // that are left; more mean that doubles do not suffice here

// In coordinates of the triangle: (1, 0) is its second corner, (0, 1) the third one.
using Place = std::array<double, 2>;
using Polygon2 = std::vector<Place>;

double cross(const Place& a, const Place& b, const Place& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double area(const Polygon2& p) {
  double sum = 0;
  for (std::size_t i = 2; i < p.size(); ++i) sum += cross(p[0], p[i - 1], p[i]);
  return std::abs(sum);
}

// Of the middles of the triangles of a fan that of the largest, so that slivers do not matter.
Place middle(const Polygon2& p) {
  std::size_t best = 2;
  for (std::size_t i = 3; i < p.size(); ++i) {
    if (std::abs(cross(p[0], p[i - 1], p[i])) > std::abs(cross(p[0], p[best - 1], p[best]))) best = i;
  }
  return {(p[0][0] + p[best - 1][0] + p[best][0]) / 3, (p[0][1] + p[best - 1][1] + p[best][1]) / 3};
}

// The part of a convex polygon where `value`, which is linear, is at least 0. Corners have any number of coordinates.
template <class Corner, class Value>
std::vector<Corner> part_where(const std::vector<Corner>& polygon, const Value& value) {
  std::vector<Corner> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0) part.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
      Corner between;
      for (std::size_t k = 0; k < a.size(); ++k) between[k] = a[k] + at_a / (at_a - at_b) * (b[k] - a[k]);
      part.push_back(between);
    }
  }
  return part;
}

// What a convex shadow, counter-clockwise, leaves of a convex polygon; nothing: it does not reach it. Parts share borders alone: what has no corner beyond a line of the shadow, as of a
// side without length, leaves nothing there.
std::optional<std::vector<Polygon2>> without(const Polygon2& polygon, const Polygon2& shadow) {
  std::vector<Polygon2> left;
  Polygon2 rest = polygon;
  for (std::size_t i = 0; i < shadow.size() && rest.size() >= 3; ++i) {
    const Place &a = shadow[i], &b = shadow[(i + 1) % shadow.size()];
    const auto beyond = [&](const Place& p) { return -cross(a, b, p); };
    if (std::none_of(rest.begin(), rest.end(), [&](const Place& p) { return beyond(p) > 0; })) continue;
    Polygon2 outside = part_where(rest, beyond);
    if (outside.size() >= 3 && area(outside) > kTooSmall) left.push_back(std::move(outside));
    rest = part_where(rest, [&](const Place& p) { return cross(a, b, p); });
  }
  if (shadow.size() < 3 || rest.size() < 3 || !(area(rest) > 0)) return std::nullopt;
  return left;
}

// A triangle and a viewpoint, in coordinates of its own: of its plane as above, and how far from it (0) to the viewpoint (1).
class Frame {
 public:
  Frame(const Point& v, const std::array<Point, 3>& corners) : origin_(corners[0]) {
    const Point a = from_origin(corners[1]), b = from_origin(corners[2]), c = from_origin(v);
    rows_ = {fastpath::cross_of(b, c), fastpath::cross_of(c, a), fastpath::cross_of(a, b)};
    determinant_ = fastpath::dot_of(a, rows_[0]);
  }
  bool is_good() const {
    return determinant_ != 0 && std::isfinite(determinant_);
  }  // v is not in the plane, and nothing overflows

  // The shadow of a triangle, counter-clockwise, where it is between the plane and the viewpoint.
  Polygon2 shadow(const std::array<Point, 3>& blocker) const {
    std::vector<Point> part;
    for (const Point& p : blocker) part.push_back(local(p));
    part = part_where(part, [](const Point& p) { return p[2]; });
    part = part_where(part, [](const Point& p) { return 1 - 0x1p-20 - p[2]; });
    Polygon2 shadow;
    for (const Point& p : part) shadow.push_back({p[0] / (1 - p[2]), p[1] / (1 - p[2])});
    if (shadow.size() >= 3) {
      double turn = 0;
      for (std::size_t i = 2; i < shadow.size(); ++i) turn += cross(shadow[0], shadow[i - 1], shadow[i]);
      if (turn < 0) std::reverse(shadow.begin(), shadow.end());
    }
    return shadow;
  }

 private:
  Point from_origin(const Point& p) const { return fastpath::minus(p, origin_); }
  Point local(const Point& p) const {
    const Point q = from_origin(p);
    Point out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = fastpath::dot_of(q, rows_[i]) / determinant_;
    return out;
  }

  Point origin_;
  std::array<Point, 3> rows_{};
  double determinant_ = 0;
};

std::vector<Point> estimates(const exact::ConvexCell& cell) {
  std::vector<Point> out;
  for (const Point3& v : cell.vertices()) out.push_back(exact::to_double_estimate(v));
  return out;
}

double scale_of(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell) {
  double largest = 0;
  const auto add = [&](const Point& p) {
    largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  };
  for (const scene::Triangle& t : mesh.triangles) {
    for (const auto v : t) add(mesh.points[v]);
  }
  for (const Point& v : estimates(cell)) add(v);
  return largest > 0 ? std::ldexp(1, std::max(-1000, std::min(1000, -std::ilogb(largest) - 1))) : 1;
}

}  // namespace

LightSearch::LightSearch(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, bool backs)
    : mesh_(mesh), cell_(cell), backs_(backs), scale_(scale_of(mesh, cell)), bvh_(mesh), inside_(estimates(cell)) {
  const auto add = [&](const Point3& v) {
    if (viewpoints_.size() < kViewpoints) viewpoints_.push_back({v, exact::to_double_estimate(v)});
  };
  add(cell.center());
  if (cell.dimension() == 0) return;
  // Very near the corners, and half-way.
  for (const FT& part : {FT(1) / FT(64), FT(1) / FT(2)}) {
    for (const Point3& corner : cell.vertices()) add(exact::collapsed(corner + part * (cell.center() - corner)));
  }
}

std::optional<Witness> LightSearch::find(std::uint32_t triangle) const {
  int trials = 0;
  for (const Viewpoint& from : viewpoints_) {
    if (auto found = find_from(from, triangle, trials)) return found;
    if (trials == kTrials) break;
  }
  return std::nullopt;
}

std::optional<Witness> LightSearch::find_from(const Viewpoint& from, std::uint32_t triangle, int& trials) const {
  const auto scaled = [&](Point p) {
    for (double& x : p) x *= scale_;
    return p;
  };
  const auto scaled_corners = [&](std::uint32_t t) {
    const auto corners = bvh_.corners(t);
    return std::array{scaled(corners[0]), scaled(corners[1]), scaled(corners[2])};
  };
  const auto corners = bvh_.corners(triangle);
  const Point3 a = exact::to_exact(corners[0]), b = exact::to_exact(corners[1]), c = exact::to_exact(corners[2]);
  const auto side = CGAL::orientation(a, b, c, from.v);
  if (side == CGAL::COPLANAR || (side == CGAL::NEGATIVE && !backs_)) return std::nullopt;
  const Frame frame(scaled(from.estimate), scaled_corners(triangle));
  if (!frame.is_good()) return std::nullopt;

  fastpath::SegmentQueries queries(bvh_);
  const std::array<std::uint32_t, 1> itself{triangle};
  std::vector<Polygon2> left{{{0, 0}, {1, 0}, {0, 1}}}, next;
  for (int lines = 0; lines < kLinesEach && trials < kTrials && !left.empty() && left.size() <= kMostParts; ++lines) {
    const auto largest = std::max_element(left.begin(), left.end(),
                                          [](const Polygon2& x, const Polygon2& y) { return area(x) < area(y); });
    const Place at = middle(*largest);
    // Sums of parts, as differences of doubles may be none. What lies in the triangle's plane stops nothing.
    Point p;
    for (std::size_t i = 0; i < 3; ++i) {
      const double on = (1 - at[0] - at[1]) * corners[0][i] + at[0] * corners[1][i] + at[1] * corners[2][i];
      p[i] = (1 - kBeforePlane) * on + kBeforePlane * from.estimate[i];
    }
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return std::nullopt;
    const auto blocker = queries.first_hit({from.estimate, p}, {itself, &inside_});
    if (!blocker) {
      ++trials;
      const Point3 exact_p = a + FT(at[0]) * (b - a) + FT(at[1]) * (c - a);
      const bool front = side == CGAL::POSITIVE;
      if (exact::check_witness(mesh_, cell_, triangle, front, from.v, exact_p).valid)
        return Witness{triangle, front, from.v, exact_p};
      left.erase(largest);
      continue;
    }
    const Polygon2 shadow = frame.shadow(scaled_corners(*blocker));
    next.clear();
    for (const Polygon2& polygon : left) {
      if (auto parts = without(polygon, shadow)) {
        next.insert(next.end(), parts->begin(), parts->end());
      } else if (&polygon != &*largest) {  // too narrow for doubles where it is: left at that
        next.push_back(polygon);
      }
    }
    left.swap(next);
  }
  return std::nullopt;
}

}  // namespace clues::validate
