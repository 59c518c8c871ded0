// Bounds as a map: its visible regions are the upper bound.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <set>

#include "reference/visibility/bounds.h"

namespace clues::reference {

using exact::Point2;
using exact::Point3;

namespace {

struct Side {
  std::vector<Region> regions;
  std::vector<DmSegment> segments;
};

void add_faces(const FlatSet& set, bool visible, const TriangleFrame& frame, std::uint32_t t, bool front, Side& out) {
  const auto twice_triangle = twice_area({frame.flat()[0], frame.flat()[1], frame.flat()[2]});
  for (const Face2& face : set.faces()) {
    Region r{t, front, visible, {}, exact::FT(0), frame.lift(inner_point(face, 0))};
    for (const Ring2& ring : face) {
      r.area_fraction += twice_area(ring) / twice_triangle;
      r.rings.emplace_back();
      for (const Point2& q : ring) r.rings.back().push_back(frame.lift(q));
    }
    r.area_fraction = exact::collapsed(r.area_fraction);
    out.regions.push_back(std::move(r));
  }
}

// The borders of the set inside the triangle.
void add_borders(const FlatSet& set, const TriangleFrame& frame, std::uint32_t t, bool front, Side& out) {
  const auto& f = frame.flat();
  for (const Face2& face : set.faces()) {
    for (const Ring2& ring : face) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
        bool outline = false;
        for (int k = 0; k < 3; ++k) outline |= CGAL::collinear(f[k], f[k + 1], p) && CGAL::collinear(f[k], f[k + 1], q);
        if (outline) continue;
        Point3 a = frame.lift(p), b = frame.lift(q);
        if (CGAL::lexicographically_xyz_smaller(b, a)) std::swap(a, b);
        out.segments.push_back({t, front, true, a, b});
      }
    }
  }
}

}  // namespace

VisibilityMap Bounds::refined_map(const std::string& method) const {
  VisibilityMap map{map_.complex, map_.cell, map_.mode, map_.formulation, {}, {}, {}, {}, map_.statistics, method};
  std::set<std::size_t> present;
  for (const Region& r : map_.regions) present.insert(side_index(r.piece, r.front));
  const std::vector<std::size_t> order(present.begin(), present.end());
  std::vector<Side> sides(order.size());
  tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
  const auto describe = [&](std::size_t k) {
    const auto t = static_cast<std::uint32_t>(order[k] / 2);
    const bool front = order[k] % 2 == 0;
    const TriangleFrame frame(map.complex, t);
    const auto& f = frame.flat();
    const FlatSet whole(twice_area({f[0], f[1], f[2]}), {Face2{Ring2{f[0], f[1], f[2]}}});
    const FlatSet& visible = upper_[order[k]];
    add_faces(visible, true, frame, t, front, sides[k]);
    add_faces(subtract(whole, visible), false, frame, t, front, sides[k]);
    add_borders(visible, frame, t, front, sides[k]);
    std::sort(sides[k].regions.begin(), sides[k].regions.end(),
              [](const Region& x, const Region& y) { return CGAL::lexicographically_xyz_smaller(x.sample, y.sample); });
    std::sort(sides[k].segments.begin(), sides[k].segments.end(), [](const DmSegment& x, const DmSegment& y) {
      return x.a != y.a ? CGAL::lexicographically_xyz_smaller(x.a, y.a) : CGAL::lexicographically_xyz_smaller(x.b, y.b);
    });
  };
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, order.size(), describe); });
  map.statistics.regions_visible = map.statistics.regions_hidden = 0;
  for (Side& side : sides) {
    for (Region& r : side.regions) {
      ++(r.visible ? map.statistics.regions_visible : map.statistics.regions_hidden);
      map.regions.push_back(std::move(r));
    }
    std::move(side.segments.begin(), side.segments.end(), std::back_inserter(map.segments));
  }
  map.statistics.conservative_fallbacks += fallbacks_;
  find_visible(exact::SceneQuery(map.complex, map.cell), map);
  return map;
}

std::vector<TriangleBounds> Bounds::by_triangle() const {
  const exact::Complex& complex = map_.complex;
  std::vector<exact::FT> first_order(upper_.size(), exact::FT(0));
  for (const Region& r : map_.regions) {
    if (r.visible) first_order[side_index(r.piece, r.front)] += r.area_fraction;
  }
  std::vector<exact::FT> whole(complex.input_triangles, exact::FT(0));
  std::vector<TriangleBounds> sides(2 * complex.input_triangles, {0, true, exact::FT(0), exact::FT(0), exact::FT(0)});
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    const TriangleFrame frame(complex, t);
    const auto& f = frame.flat();
    const exact::FT area = twice_area({f[0], f[1], f[2]});  // pieces of one triangle are laid flat in one way
    for (const exact::Origin& o : complex.pieces[t].origins) {
      whole[o.triangle] += area;
      for (const bool front : {true, false}) {
        TriangleBounds& side = sides[2 * std::size_t{o.triangle} + (front ? 0 : 1)];
        const std::size_t i = side_index(t, front == o.same_side);
        side.lower += area * lower_[i].fraction();
        side.upper += area * upper_[i].fraction();
        side.first_order += area * first_order[i];
      }
    }
  }
  std::vector<TriangleBounds> out;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    TriangleBounds& side = sides[i];
    side.triangle = static_cast<std::uint32_t>(i / 2);
    side.front = i % 2 == 0;
    if ((map_.mode == Mode::solid && !side.front) || side.first_order == exact::FT(0)) continue;
    for (exact::FT* x : {&side.lower, &side.upper, &side.first_order}) *x = exact::collapsed(*x / whole[side.triangle]);
    out.push_back(std::move(side));
  }
  return out;
}

}  // namespace clues::reference
