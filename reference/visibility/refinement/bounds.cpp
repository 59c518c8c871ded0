#include "reference/visibility/refinement/bounds.h"

#include <algorithm>

#include "exact/area.h"
#include "exact/complex/cell_cut.h"
#include "reference/in_parallel.h"
#include "reference/visibility/map/flat_sides.h"
#include "reference/visibility/map/omega.h"
#include "reference/visibility/map/sides.h"

namespace clues::reference {

using exact::FT;
using exact::Point3;

template <class Work>
void Bounds::for_each_side(const Work& work) const {
  in_parallel(2 * map_.complex.pieces.size(), options_.threads, work);
}

Bounds::Bounds(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Options& options)
    : map_(Omega(mesh, cell, options).take_map()), options_(options), viewpoints_to_ask_(map_.cell) {
  options_.progress = nullptr;
  const exact::Complex& complex = map_.complex;
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    const auto& c = complex.pieces[t].corners;
    piece_area_.push_back(exact::area_estimate(complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]));
  }
  lower_ = nothing();
  upper_ = sets_of(map_);
  for (std::size_t i = 0; i < upper_.size(); ++i) {
    const std::uint32_t t = piece_of(i);
    const bool faces = faces_cell(complex, cell, t, is_front(i)) || complex.in_cell[t];
    if (faces && counts(map_.mode, complex.pieces[t], is_front(i))) facing_ += piece_area_[t];
    if (complex.in_cell[t]) lower_[i] = upper_[i];  // D3
  }
  first_order_area_ = area_estimate(upper_);
  open_.assign(upper_.size(), 1);
  find_open();
}

SideSets Bounds::nothing() const {
  SideSets sets;
  for (std::uint32_t t = 0; t < map_.complex.pieces.size(); ++t) {
    const FT area = exact::collapsed(TriangleFrame(map_.complex, t).twice_area());
    sets.emplace_back(area);
    sets.emplace_back(area);
  }
  return sets;
}

SideSets Bounds::sets_of(const VisibilityMap& map) const {
  SideSets sets(2 * map_.complex.pieces.size(), FlatSet(FT(0)));
  std::vector<std::vector<const Region*>> visible(sets.size());
  for (const Region& r : map.regions) {
    if (r.visible) visible[side_index(r.piece, r.front)].push_back(&r);
  }
  for_each_side([&](std::size_t i) {
    const TriangleFrame frame(map_.complex, piece_of(i));
    std::vector<Face2> faces;
    for (const Region* r : visible[i]) faces.push_back(flat_face(*r, frame));
    sets[i] = FlatSet(frame.twice_area(), faces);
  });
  return sets;
}

// Closed sides stay closed: lower only grows, and upper only shrinks.
void Bounds::find_open() {
  for_each_side([&](std::size_t i) {
    if (open_[i]) open_[i] = subtract(upper_[i], lower_[i]).empty() ? 0 : 1;
  });
}

bool Bounds::closed() const {
  return std::none_of(open_.begin(), open_.end(), [](char o) { return o != 0; });
}

VisibilityMap Bounds::map_of(const exact::ConvexCell& part, const std::vector<bool>& wanted) {
  VisibilityMap found = first_order_visibility_in(map_.complex, part, options_, wanted);
  ++maps_;
  fallbacks_ += found.statistics.conservative_fallbacks;
  return found;
}

void Bounds::add_viewpoint(const Point3& v) {
  const exact::Complex& complex = map_.complex;
  if (closed() || exact::is_touched(complex, v)) return;
  const VisibilityMap seen =
      first_order_visibility_in(complex, exact::ConvexCell(std::vector<Point3>{v}), options_, open_sides());
  if (seen.statistics.conservative_fallbacks > 0) return;
  ++viewpoints_;
  lower_ = united(lower_, sets_of(seen));
  find_open();
}

void Bounds::look_around(int depth) {
  for (const auto& points : viewpoints_to_ask_.up_to(depth)) {
    for (const Point3& v : points) add_viewpoint(v);
  }
}

SideSets Bounds::united(const SideSets& a, const SideSets& b) const {
  SideSets out = a;
  for_each_side([&](std::size_t i) { out[i] = unite(a[i], b[i]); });
  return out;
}

bool Bounds::restrict_to(const SideSets& seen, const std::vector<bool>& wanted) {
  std::vector<char> less(upper_.size(), 0);
  for_each_side([&](std::size_t i) {
    if (!wanted[i]) return;
    const exact::FT before = upper_[i].fraction();
    upper_[i] = intersect(upper_[i], seen[i]);
    less[i] = upper_[i].fraction() < before;
  });
  find_open();
  return std::any_of(less.begin(), less.end(), [](char l) { return l != 0; });
}

double Bounds::area_estimate(const SideSets& sets) const {
  double sum = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) sum += piece_area_[piece_of(i)] * CGAL::to_double(sets[i].fraction());
  return sum;
}

AreaEstimate Bounds::area() const { return {facing_, area_estimate(lower_), first_order_area_, area_estimate(upper_)}; }

}  // namespace clues::reference
