// D22: what is left of a side when the places under its covers are cut away, one convex piece after the other.
#include "scene/levels/bsp_covered.h"

#include <algorithm>
#define BOOST_ALLOW_DEPRECATED_HEADERS  // by headers of Boost 1.74 itself
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <utility>

namespace clues::scene {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using Tree = bg::index::rtree<std::pair<TreeBox, std::size_t>, bg::index::quadratic<16>>;

using Polygon = std::vector<Point>;

// normal * x <= offset, the normal of length 1.
struct Plane {
  Point normal;
  double offset = 0;
  double height(const Point& p) const { return normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - offset; }
};

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

Point area_vector(const Polygon& polygon) {
  Point sum{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point n = cross(minus(polygon[i], polygon[0]), minus(polygon[i + 1], polygon[0]));
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += n[axis] / 2;
  }
  return sum;
}

double area_of(const Polygon& polygon) { return length(area_vector(polygon)); }

// The plane through the point, with `inside` below it.
Plane plane_at(const Point& direction, const Point& through, const Point& inside) {
  const double scale = length(direction);
  Plane plane{{direction[0] / scale, direction[1] / scale, direction[2] / scale}, 0};
  plane.offset = plane.height(through);
  if (plane.height(inside) > 0) {
    for (double& x : plane.normal) x = -x;
    plane.offset = -plane.offset;
  }
  return plane;
}

Point middle_of(const Polygon& polygon) {
  Point middle{};
  for (const auto& p : polygon) {
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += p[axis] / static_cast<double>(polygon.size());
  }
  return middle;
}

TreeBox box_of(const Polygon& polygon) {
  TreeBox box;
  bg::assign_inverse(box);
  for (const auto& p : polygon) bg::expand(box, TreePoint(p[0], p[1], p[2]));
  return box;
}

TreeBox grown(const TreeBox& box) {  // by what a side was moved, and the gap
  const auto& low = box.min_corner();
  const auto& high = box.max_corner();
  return {{low.get<0>() - 3 * covered_gap, low.get<1>() - 3 * covered_gap, low.get<2>() - 3 * covered_gap},
          {high.get<0>() + 3 * covered_gap, high.get<1>() + 3 * covered_gap, high.get<2>() + 3 * covered_gap}};
}

// The part of a convex polygon on one side of the plane: below it, or above.
Polygon part_of(const Polygon& polygon, const Plane& plane, bool below) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double sign = below ? 1 : -1, at_a = sign * plane.height(a), at_b = sign * plane.height(b);
    if (at_a <= 0) part.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
      const double s = at_a / (at_a - at_b);
      part.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])});
    }
  }
  return part.size() < 3 ? Polygon{} : part;
}

// A square of the side covered_gap.
bool is_worth_keeping(const Polygon& polygon) {
  return polygon.size() >= 3 && area_of(polygon) > covered_gap * covered_gap;
}

// Takes the convex region out of the pieces.
void cut_away(std::vector<Polygon>& pieces, const std::vector<Plane>& region) {
  std::vector<Polygon> left;
  for (auto& piece : pieces) {
    Polygon inside = piece;
    std::vector<Polygon> outside;
    for (const auto& plane : region) {
      if (inside.empty()) break;
      Polygon beyond = part_of(inside, plane, false);
      if (is_worth_keeping(beyond)) outside.push_back(std::move(beyond));
      inside = part_of(inside, plane, true);
    }
    if (inside.empty()) {
      left.push_back(std::move(piece));
    } else {
      std::move(outside.begin(), outside.end(), std::back_inserter(left));
    }
  }
  pieces = std::move(left);
}

class Covers {
 public:
  Covers(const std::vector<Hull>& hulls, const std::vector<std::array<Point, 3>>& drawn) : drawn_(drawn) {
    std::vector<std::pair<TreeBox, std::size_t>> of_drawn, of_hulls;
    for (std::size_t i = 0; i < drawn.size(); ++i) of_drawn.emplace_back(box_of({drawn[i].begin(), drawn[i].end()}), i);
    for (std::size_t i = 0; i < hulls.size(); ++i) {
      Polygon all;
      for (const auto& face : hulls[i]) all.insert(all.end(), face.begin(), face.end());
      of_hulls.emplace_back(box_of(all), i);
      std::vector<Plane> region;
      const Point middle = middles_.emplace_back(middle_of(all));
      for (const auto& face : hulls[i]) {
        region.push_back(plane_at(area_vector(face), face[0], middle));
        region.back().offset += covered_gap;
      }
      solids_.push_back(std::move(region));
    }
    drawn_tree_ = Tree(of_drawn.begin(), of_drawn.end());
    hull_tree_ = Tree(of_hulls.begin(), of_hulls.end());
  }

  bool cover(std::size_t hull, const Polygon& face) const {
    const double all = area_of(face);
    const Plane plane = plane_at(area_vector(face), face[0], middles_[hull]);
    // Where somebody would stand who looks at the side.
    std::vector<Polygon> pieces{face};
    for (auto& p : pieces[0]) {
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += 2 * covered_gap * plane.normal[axis];
    }
    const TreeBox box = grown(box_of(pieces[0]));
    if (!is_worth_keeping(face)) return true;
    each_in(drawn_tree_, box, pieces, [&](std::size_t i) {
      const auto& t = drawn_[i];
      if (std::all_of(t.begin(), t.end(), [&](const Point& p) { return std::abs(plane.height(p)) <= covered_gap; }))
        cut_away(pieces, prism_over(t, plane.normal));
    });
    each_in(hull_tree_, box, pieces, [&](std::size_t i) {
      if (i != hull) cut_away(pieces, solids_[i]);
    });
    double open = 0;
    for (const auto& piece : pieces) open += area_of(piece);
    return open <= std::min(open_area, open_share * all);
  }

 private:
  template <class Cut>
  static void each_in(const Tree& tree, const TreeBox& box, const std::vector<Polygon>& pieces, const Cut& cut) {
    for (auto it = tree.qbegin(bg::index::intersects(box)); it != tree.qend() && !pieces.empty(); ++it) cut(it->second);
  }
  static std::vector<Plane> prism_over(const std::array<Point, 3>& t, const Point& normal) {
    std::vector<Plane> prism;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point across = cross(minus(t[(i + 1) % 3], t[i]), normal);
      if (length(across) > 0) prism.push_back(plane_at(across, t[i], t[(i + 2) % 3]));
    }
    return prism;
  }

  const std::vector<std::array<Point, 3>>& drawn_;
  std::vector<Point> middles_;
  std::vector<std::vector<Plane>> solids_;
  Tree drawn_tree_, hull_tree_;
};

}  // namespace

std::vector<std::vector<bool>> covered_faces(const std::vector<Hull>& hulls,
                                             const std::vector<std::array<Point, 3>>& drawn) {
  const Covers covers(hulls, drawn);
  std::vector<std::vector<bool>> covered(hulls.size());
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    for (const auto& face : hulls[i]) covered[i].push_back(covers.cover(i, face));
  }
  return covered;
}

}  // namespace clues::scene
