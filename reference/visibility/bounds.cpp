#include "reference/visibility/bounds.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "exact/area.h"
#include "exact/cell_cut.h"

namespace clues::reference {

using exact::FT;
using exact::Point3;

namespace {

bool faced(const exact::Complex& complex, const exact::ConvexCell& cell, std::size_t side) {
  const auto wanted = side % 2 == 0 ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
  return std::any_of(cell.vertices().begin(), cell.vertices().end(),
                     [&](const Point3& v) { return complex.planes[side / 2].oriented_side(v) == wanted; });
}

bool side_counts(const VisibilityMap& map, std::size_t side) {
  const auto& origins = map.complex.pieces[side / 2].origins;
  return map.mode == Mode::sheet ||
         std::any_of(origins.begin(), origins.end(), [&](const auto& o) { return o.same_side == (side % 2 == 0); });
}

}  // namespace

template <class Work>
void Bounds::for_each_side(const Work& work) const {
  tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, 2 * map_.complex.pieces.size(), work); });
}

Bounds::Bounds(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Options& options)
    : map_(first_order_visibility(mesh, cell, options)), options_(options), viewpoints_to_ask_(cell) {
  options_.progress = nullptr;
  const exact::Complex& complex = map_.complex;
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    const auto& c = complex.pieces[t].corners;
    piece_area_.push_back(exact::area_estimate(complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]));
  }
  lower_ = nothing();
  upper_ = sets_of(map_);
  for (std::size_t i = 0; i < upper_.size(); ++i) {
    if (side_counts(map_, i) && (faced(complex, cell, i) || complex.in_cell[i / 2])) facing_ += piece_area_[i / 2];
    if (complex.in_cell[i / 2]) lower_[i] = upper_[i];  // D3
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
    const TriangleFrame frame(map_.complex, static_cast<std::uint32_t>(i / 2));
    std::vector<Face2> faces;
    for (const Region* r : visible[i]) {
      faces.emplace_back();
      for (const auto& ring : r->rings) {
        faces.back().emplace_back();
        for (const Point3& p : ring) faces.back().back().push_back(frame.frame()(p));
      }
    }
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
  if (closed() || std::find(asked_.begin(), asked_.end(), v) != asked_.end()) return;
  asked_.push_back(v);
  const exact::Complex& complex = map_.complex;
  if (exact::is_touched(complex, v)) return;
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
  for (std::size_t i = 0; i < sets.size(); ++i) sum += piece_area_[i / 2] * CGAL::to_double(sets[i].fraction());
  return sum;
}

AreaEstimate Bounds::area() const { return {facing_, area_estimate(lower_), first_order_area_, area_estimate(upper_)}; }

}  // namespace clues::reference
