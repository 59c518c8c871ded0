#include "reference/visibility/refinement/deviation.h"

#include <cmath>
#include <utility>

#include "reference/visibility/map/sides.h"

namespace clues::reference {

using exact::FT;
using exact::Plane3;
using exact::Point3;

namespace {

using Corner = std::array<double, 3>;

double nearest(const FT& x) { return CGAL::to_double(exact::collapsed(x)); }  // whatever was computed before

struct HalfSpace {
  std::array<double, 4> form;
  HalfSpace(const Plane3& p, bool positive) {
    const std::array<double, 4> f{nearest(p.a()), nearest(p.b()), nearest(p.c()), nearest(p.d())};
    for (std::size_t i = 0; i < 4; ++i) form[i] = positive ? f[i] : -f[i];
  }
  double at(const Corner& c) const { return form[0] * c[0] + form[1] * c[1] + form[2] * c[2] + form[3]; }
};

std::vector<Corner> clipped(const std::vector<Corner>& ring, const HalfSpace& half) {
  std::vector<Corner> out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Corner &p = ring[i], &q = ring[(i + 1) % ring.size()];
    const double at_p = half.at(p), at_q = half.at(q);
    if (at_p >= 0) out.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const double t = at_p / (at_p - at_q);
      out.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
    }
  }
  return out;
}

// Of a flat ring.
double area(const std::vector<Corner>& ring) {
  Corner twice{0, 0, 0};
  for (std::size_t i = 2; i < ring.size(); ++i) {
    Corner u, v;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = ring[i - 1][k] - ring[0][k];
      v[k] = ring[i][k] - ring[0][k];
    }
    for (std::size_t k = 0; k < 3; ++k) twice[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
  }
  return std::hypot(twice[0], twice[1], twice[2]) / 2;
}

}  // namespace

Plane3 separating_plane(const ContourSegment& segment, const exact::ConvexCell& cell) {
  const Point3 &a = segment.lo, &b = segment.hi;
  const CGAL::Orientation turn = CGAL::orientation(a, b, segment.center, cell.center());
  Point3 last = segment.center;
  for (const Point3& v : cell.vertices()) {
    if (!CGAL::collinear(a, b, v) && CGAL::orientation(a, b, last, v) == turn) last = v;
  }
  return *adjusted_plane(segment, {last}, cell);
}

DoubtfulArea::DoubtfulArea(const Bounds& bounds, const SideSets& seen, const std::vector<bool>& wanted) {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!wanted[i]) continue;
    const TriangleFrame frame(bounds.first_order().complex, piece_of(i));
    for (const Face2& face : subtract(intersect(seen[i], bounds.upper()[i]), bounds.lower()[i]).faces()) {
      for (std::size_t r = 0; r < face.size(); ++r) {
        Ring ring{{}, r > 0};
        for (const exact::Point2& q : face[r]) {
          const Point3 p = frame.lift(q);
          ring.corners.push_back({nearest(p.x()), nearest(p.y()), nearest(p.z())});
        }
        rings_.push_back(std::move(ring));
      }
    }
  }
}

double DoubtfulArea::between(const Plane3& first_order, const Plane3& adjusted) const {
  const HalfSpace beyond_first(first_order, true), before_adjusted(adjusted, false);
  double sum = 0;
  for (const Ring& ring : rings_) {
    const double part = area(clipped(clipped(ring.corners, beyond_first), before_adjusted));
    sum += ring.hole ? -part : part;
  }
  return sum;
}

}  // namespace clues::reference
