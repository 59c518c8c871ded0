#include "fastpath/visibility/refinement/area_bounds.h"

#include <algorithm>
#include <cmath>

#include "fastpath/visibility/points/points.h"

#include "fastpath/predicates/estimated_vectors.h"

namespace clues::fastpath {
namespace {

using Polygon = std::vector<Point>;

// Areas below this part of a side's are roundings.
constexpr double kRounding = 0x1p-30;

// Twice the area, as a vector along the normal.
Point area_vector(const Polygon& p) {
  Point sum{0, 0, 0};
  for (std::size_t i = 2; i < p.size(); ++i) {
    const Point c = cross_of(minus(p[i - 1], p[0]), minus(p[i], p[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k];
  }
  return sum;
}

double polygon_area(const Polygon& p) { return length_estimate(area_vector(p)) / 2; }

bool boxes_overlap(const Polygon& p, const Polygon& q) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto less = [k](const Point& a, const Point& b) { return a[k] < b[k]; };
    const auto [p0, p1] = std::minmax_element(p.begin(), p.end(), less);
    const auto [q0, q1] = std::minmax_element(q.begin(), q.end(), less);
    if ((*p1)[k] < (*q0)[k] || (*q1)[k] < (*p0)[k]) return false;
  }
  return true;
}

// What p has in common with q, both convex and of one plane; empty if nothing. The rest of p, in convex parts, goes to `outside`.
Polygon common_part(Polygon p, const Polygon& q, std::vector<Polygon>& outside) {
  const Point n = area_vector(q);
  const double size = std::sqrt(length_estimate(area_vector(p)));
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Point &a = q[i], &b = q[(i + 1) % q.size()];
    const Point along = minus(b, a), inward = cross_of(n, along);
    // Between corners that are one but for roundings: the direction says nothing.
    if (length_estimate(along) <= 0x1p-30 * std::sqrt(length_estimate(n))) continue;
    const double tolerance = length_estimate(inward) * size * 0x1p-40;
    std::vector<double> height;
    for (const Point& x : p) height.push_back(dot_of(inward, minus(x, a)));
    const auto [least, most] = std::minmax_element(height.begin(), height.end());
    if (*least >= -tolerance) continue;
    if (*most <= tolerance) {
      outside.push_back(std::move(p));
      return {};
    }
    Polygon in, out;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const std::size_t l = (k + 1) % p.size();
      if (height[k] >= 0) in.push_back(p[k]);
      if (height[k] <= 0) out.push_back(p[k]);
      if (height[k] * height[l] >= 0) continue;
      Point x;
      for (std::size_t c = 0; c < 3; ++c) x[c] = p[k][c] + height[k] / (height[k] - height[l]) * (p[l][c] - p[k][c]);
      in.push_back(x);
      out.push_back(x);
    }
    outside.push_back(std::move(out));
    p = std::move(in);
  }
  return p;
}

// Moves what the cover has in common with `from` to `to`.
void move_covered(std::vector<Polygon>& from, const Polygon& cover, std::vector<Polygon>& to) {
  std::vector<Polygon> rest;
  for (Polygon& p : from) {
    if (!boxes_overlap(p, cover)) {
      rest.push_back(std::move(p));
      continue;
    }
    std::vector<Polygon> outside;
    Polygon inside = common_part(p, cover, outside);
    if (inside.empty()) {
      rest.push_back(std::move(p));
      continue;
    }
    to.push_back(std::move(inside));
    std::move(outside.begin(), outside.end(), std::back_inserter(rest));
  }
  from = std::move(rest);
}

}  // namespace

AreaBounds::AreaBounds(std::vector<LocalRegion> first_order) {
  for (LocalRegion& r : first_order) {
    Side& side = sides_[key_of(r)];
    side.area += r.area_estimate;
    if (r.visible) first_order_ += r.area_estimate;
    (r.visible ? side.doubt : side.hidden).push_back(std::move(r.outline_estimate));
  }
}

double AreaBounds::area_of(const Polygons& polygons) {
  double sum = 0;
  for (const Polygon& p : polygons) sum += polygon_area(p);
  return sum;
}

bool AreaBounds::matters(double area, const Side& side) { return area > kRounding * side.area; }

void AreaBounds::witness(const std::vector<LocalRegion>& seen) {
  for (const LocalRegion& r : seen) {
    const auto side = sides_.find(key_of(r));
    if (r.visible && side != sides_.end()) move_covered(side->second.doubt, r.outline_estimate, side->second.seen);
  }
}

void AreaBounds::restrict_to(const std::vector<const std::vector<LocalRegion>*>& parts,
                             const std::vector<bool>& wanted) {
  std::map<Key, Polygons> kept;
  for (const auto* regions : parts) {
    for (const LocalRegion& r : *regions) {
      const auto side = sides_.find(key_of(r));
      if (r.visible && wanted[r.triangle] && side != sides_.end())
        move_covered(side->second.doubt, r.outline_estimate, kept[side->first]);
    }
  }
  for (auto& [key, side] : sides_) {
    if (!wanted[key.first]) continue;
    std::move(side.doubt.begin(), side.doubt.end(), std::back_inserter(side.hidden));
    side.doubt = std::move(kept[key]);
  }
}

double AreaBounds::witnessed() const {
  double sum = 0;
  for (const auto& [key, side] : sides_) sum += area_of(side.seen);
  return sum;
}

double AreaBounds::in_doubt() const {
  double sum = 0;
  for (const auto& [key, side] : sides_) sum += area_of(side.doubt);
  return sum;
}

bool AreaBounds::in_doubt(std::uint32_t triangle) const {
  for (const bool back : {false, true}) {
    const auto side = sides_.find({triangle, back});
    if (side != sides_.end() && matters(area_of(side->second.doubt), side->second)) return true;
  }
  return false;
}

std::vector<LocalRegion> AreaBounds::doubtful(const std::vector<bool>& wanted) const {
  std::vector<LocalRegion> out;
  for (const auto& [key, side] : sides_) {
    if (!wanted[key.first]) continue;
    for (const Polygon& p : side.doubt) out.push_back({key.first, !key.second, true, p, polygon_area(p)});
  }
  return out;
}

bool AreaBounds::reach_doubt(const std::vector<LocalRegion>& regions) const {
  for (const LocalRegion& r : regions) {
    const auto side = sides_.find(key_of(r));
    if (!r.visible || side == sides_.end()) continue;
    Polygons doubt = side->second.doubt, covered;
    move_covered(doubt, r.outline_estimate, covered);
    if (matters(area_of(covered), side->second)) return true;
  }
  return false;
}

std::vector<LocalRegion> AreaBounds::regions() const {
  std::vector<LocalRegion> out;
  for (const auto& [key, side] : sides_) {
    for (const auto* polygons : {&side.seen, &side.doubt, &side.hidden}) {
      for (const Polygon& p : *polygons)
        out.push_back({key.first, !key.second, polygons != &side.hidden, p, polygon_area(p)});
    }
  }
  return out;
}

}  // namespace clues::fastpath
