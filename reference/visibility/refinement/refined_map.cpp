// Bounds as a map: its visible regions are the upper bound.
#include <set>
#include <utility>

#include "reference/in_parallel.h"
#include "reference/visibility/map/flat_sides.h"
#include "reference/visibility/map/sides.h"
#include "reference/visibility/refinement/bounds.h"

namespace clues::reference {

VisibilityMap Bounds::refined_map(const std::string& method) const {
  VisibilityMap map{map_.complex, map_.cell, map_.mode,       map_.formulation, {},        {},
                    {},           {},        map_.statistics, method,           map_.range};
  std::set<std::size_t> present;
  for (const Region& r : map_.regions) present.insert(side_index(r.piece, r.front));
  const std::vector<std::size_t> order(present.begin(), present.end());
  std::vector<SideFaces> sides(order.size());
  in_parallel(order.size(), options_.threads, [&](std::size_t k) {
    const std::uint32_t t = piece_of(order[k]);
    sides[k] = side_faces(upper_[order[k]], TriangleFrame(map.complex, t), t, is_front(order[k]));
  });
  map.statistics.regions_visible = map.statistics.regions_hidden = 0;
  for (SideFaces& side : sides) side.move_to(map);
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
    const exact::FT area = frame.twice_area();  // pieces of one triangle are laid flat in one way
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
