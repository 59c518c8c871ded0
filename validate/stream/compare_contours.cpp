#include "validate/stream/compare_contours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "validate/verdicts/area.h"

namespace clues::validate {
namespace {

using exact::FT;
using exact::Point2;
using reference::Face2;
using reference::FlatSegment;
using reference::FlatSet;

using Turns = std::vector<std::array<Point2, 2>>;

// How often the closed border goes around a point that is not on it.
int turns_around(const Turns& border, const Point2& p) {
  int turns = 0;
  for (const auto& [a, b] : border) {
    if ((a.y() <= p.y()) == (b.y() <= p.y())) continue;
    const auto side = CGAL::orientation(a, b, p);
    if (a.y() <= p.y() && side == CGAL::LEFT_TURN) ++turns;
    if (a.y() > p.y() && side == CGAL::RIGHT_TURN) --turns;
  }
  return turns;
}

// What the border goes around, in the triangle.
FlatSet set_around(const Turns& border, const reference::TriangleFrame& frame) {
  const FlatSet whole(frame.twice_area(), std::vector<Face2>{{frame.outline()}});
  std::vector<FlatSegment> cuts;
  for (const auto& [a, b] : border) {
    if (a != b) cuts.push_back({a, b});
  }
  std::vector<Face2> inside;
  for (Face2& face : whole.faces_cut_by(cuts)) {
    if (turns_around(border, reference::inner_point(face, 0)) != 0) inside.push_back(std::move(face));
  }
  return {frame.twice_area(), inside};
}

// Whether all of the face is so near to one edge of the border that LitRegion::may_hold says nothing else of it: with an
// end that stands for several, which cannot be told apart, a sliver between these is beside the border.
bool lies_at_the_border(const Face2& face, const fastpath::LitRegion& region, const reference::TriangleFrame& frame) {
  std::vector<Point2> corners;
  for (const Point2& q : face[0]) {
    const auto at = frame.lift(q);
    corners.emplace_back(at[region.axes[0]], at[region.axes[1]]);
  }
  return std::any_of(region.border.begin(), region.border.end(), [&](const auto& edge) {
    const exact::Kernel::Segment_2 line(Point2(edge.ends[0][0], edge.ends[0][1]),
                                        Point2(edge.ends[1][0], edge.ends[1][1]));
    const FT near = 2 * FT(edge.radius);
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Point2& p) { return CGAL::squared_distance(p, line) <= near * near; });
  });
}

}  // namespace

ContourComparison compare_contours(const scene::TriangleMesh& mesh, const scene::ContourFile& file, std::uint32_t cell,
                                   const std::vector<reference::InputSide>& sides, const std::vector<FlatSet>& exact,
                                   const fastpath::ContourDecoding& decoding) {
  ContourComparison out;
  const auto find = [&out](const reference::InputSide& side, const std::string& what) {
    out.findings.push_back(fmt::format("triangle {}, {} side: {}", side.triangle, side.front ? "front" : "back", what));
  };
  reference::Drawings drawings(mesh);
  for (const std::uint32_t c : scene::chain_of(file.cells, cell)) drawings.add(file.cells[c]);
  std::map<std::uint32_t, const fastpath::LitRegion*> regions;
  for (const auto& region : decoding.regions) regions[region.side] = &region;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const std::uint32_t side = 2 * sides[s].triangle + (sides[s].front ? 0U : 1U);
    const double area = area_estimate(mesh, sides[s].triangle);
    const auto at = regions.find(side);
    if (!exact[s].empty()) {
      ++out.sides;
      out.exact_area += area * CGAL::to_double(exact[s].fraction());
    }
    if (at == regions.end()) {
      if (!exact[s].empty()) find(sides[s], "doubles see nothing of it");
      continue;
    }
    if (at->second->whole) {
      out.area += area;
      continue;
    }
    const reference::DrawnSide& drawn = drawings.on(side);
    Turns border;
    for (const auto& edge : at->second->border) {
      out.radius = std::max(out.radius, edge.radius);
      for (std::size_t i = 0; i < 2; ++i) {
        ++out.ends_checked;
        for (std::size_t k = 0; k < 2; ++k) {
          const FT off = drawn.points()[edge.points[i]].at[at->second->axes[k]] - FT(edge.ends[i][k]);
          if (CGAL::abs(off) > FT(edge.radius)) find(sides[s], "an end of its border is farther off than its radius");
        }
      }
      border.push_back({drawn.points()[edge.points[0]].flat, drawn.points()[edge.points[1]].flat});
    }
    const FlatSet around = set_around(border, drawn.frame());
    out.area += area * CGAL::to_double(around.fraction());
    for (const Face2& face : subtract(exact[s], around).faces()) {
      if (!lies_at_the_border(face, *at->second, drawn.frame())) find(sides[s], "a part is missing in doubles");
    }
  }
  const auto list = reference::list_of(sides, exact, file.cells[cell].besides);
  out.exact_list = list.size();
  out.list = decoding.list.size();
  std::vector<std::uint32_t> missing;
  std::set_difference(list.begin(), list.end(), decoding.list.begin(), decoding.list.end(),
                      std::back_inserter(missing));
  for (const std::uint32_t t : missing)
    out.findings.push_back(fmt::format("triangle {} is not in the list of doubles", t));
  return out;
}

}  // namespace clues::validate
