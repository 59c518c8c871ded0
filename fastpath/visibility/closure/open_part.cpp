#include "fastpath/visibility/closure/open_part.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>

#include "exact/cell/convex_cell.h"
#include "fastpath/queries/shaft.h"
#include "fastpath/visibility/closure/marks.h"
#include "fastpath/visibility/closure/sight_lines.h"
#include "fastpath/visibility/scene/mesh_part.h"

namespace clues::fastpath {
namespace {

// What the hulls are made of: the corners of the cell, or, where it has more than a box, those of its box. (Shafts take the cube of their number.)
std::vector<Point> corners_about(const Cell& cell) {
  constexpr std::size_t kCornersOfBox = 8;
  if (cell.vertices().size() <= kCornersOfBox) return cell.vertices();
  const Box box = scene::bounds_of(cell.vertices());
  std::vector<Point> corners;
  for (unsigned i = 0; i < kCornersOfBox; ++i)
    corners.push_back(
        {(i & 1U ? box.high : box.low)[0], (i & 2U ? box.high : box.low)[1], (i & 4U ? box.high : box.low)[2]});
  return corners;
}

// Those which the hull of the cell and of one of these may meet, and these.
std::vector<std::uint8_t> on_the_way(const Bvh& bvh, const Cell& cell, const std::vector<std::uint32_t>& to) {
  const std::vector<Point> corners = corners_about(cell);
  return marks(bvh.mesh().triangles.size(), to.size(), [&](std::size_t i, std::vector<std::uint8_t>& met) {
    met[to[i]] = 1;
    const Shaft shaft(bvh.frame(), bvh.corners(to[i]), corners);
    for (const std::uint32_t t : shaft_candidates_conservative(bvh, shaft)) met[t] = 1;
  });
}

// Those that a free sight line reaches, and those that are open. By the rays first: each of these says it all but for roundings and ties.
OpenPart told_apart(const Bvh& bvh, const Cell& cell, const std::vector<std::uint32_t>& asked, const FirstRays& rays,
                    int tries) {
  const auto exact_cell = exact::ConvexCell::from_doubles(cell.vertices());
  const SightLines lines(bvh, cell.vertices(), exact_cell, SideMode::sheet);
  std::vector<std::uint8_t> reached(asked.size(), 0);
  tbb::enumerable_thread_specific<SegmentQueries> queries(std::cref(bvh));
  tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t i) {
    const auto ray = rays.find(asked[i]);
    if (ray != rays.end() && lines.reaches(queries.local(), asked[i], ray->second)) reached[i] = 1;
  });
  OpenPart found;
  std::vector<std::uint32_t> others;
  for (std::size_t i = 0; i < asked.size(); ++i) (reached[i] != 0 ? found.visible : others).push_back(asked[i]);
  const std::vector<std::uint8_t> others_reached = lines.reach(others, lines.viewpoints(exact_cell), tries);
  for (std::size_t i = 0; i < others.size(); ++i)
    (others_reached[i] != 0 ? found.visible : found.open).push_back(others[i]);
  std::sort(found.visible.begin(), found.visible.end());
  return found;
}

}  // namespace

ScenePart marked_part(const Bvh& bvh, const Marked& marked) {
  ScenePart part;
  for (std::uint32_t t = 0; t < marked.in_part.size(); ++t) {
    if (marked.in_part[t] == 0 && marked.is_dark[t] == 0) continue;
    part.ids.push_back(t);
    part.dark.push_back(marked.in_part[t] == 0 ? 1 : 0);
  }
  part.mesh = mesh_of(bvh.mesh(), part.ids);
  return part;
}

std::optional<OpenPart> open_part(const Bvh& bvh, const Cell& cell, const Marked& marked,
                                  const std::vector<std::uint32_t>& asked, const FirstRays& rays, int tries,
                                  std::size_t most) {
  OpenPart found = told_apart(bvh, cell, asked, rays, tries);
  if (found.open.size() > most) return std::nullopt;
  const std::vector<std::uint8_t> met = on_the_way(bvh, cell, found.open);
  std::vector<std::uint8_t> in_part(met.size()), is_dark(met.size());
  for (std::size_t t = 0; t < met.size(); ++t) {
    in_part[t] = met[t] & marked.in_part[t];
    is_dark[t] = met[t] & marked.is_dark[t];
  }
  if (static_cast<std::size_t>(std::count(in_part.begin(), in_part.end(), 1)) > most) return std::nullopt;
  found.part = marked_part(bvh, {in_part, is_dark});
  return found;
}

}  // namespace clues::fastpath
