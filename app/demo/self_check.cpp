// The point-occlusion oracle, random sight lines through the witness checker, and the judge on the map's own PVS.
#include "app/demo/self_check.h"

#include <algorithm>
#include <vector>

#include "exact/sight/point_occlusion.h"
#include "exact/sight/witness.h"
#include "fuzz/generators/random.h"
#include "validate/certificates/region_points.h"

namespace clues::app {

bool SelfCheck::passed() const {
  return hidden_points_seen == 0 && sight_lines_free == 0 && own.contradictions.empty() &&
         own.verdict == validate::Verdict::sound && loss_is_caught;
}

SelfCheck check_map(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map, std::uint64_t effort,
                    std::uint64_t seed, const CheckProgress& progress) {
  SelfCheck check;
  fuzz::Random random(seed);
  std::vector<exact::TriangleCorners> soup;
  for (const auto& piece : map.complex.pieces) {
    soup.push_back({map.complex.points[piece.corners[0]], map.complex.points[piece.corners[1]],
                    map.complex.points[piece.corners[2]]});
  }
  std::vector<const reference::Region*> hidden;
  for (const auto& region : map.regions) {
    if (!region.visible) hidden.push_back(&region);
  }
  const std::uint64_t chosen = std::min<std::uint64_t>(effort, hidden.size());
  constexpr std::size_t points_each = 3, lines_each = 4;
  for (std::uint64_t i = 0; i < chosen; ++i) {
    const auto& region = *hidden[i * hidden.size() / chosen];
    const auto& plane = map.complex.planes[region.piece];
    const auto& origin = map.complex.pieces[region.piece].origins.front();
    for (const auto& p : validate::interior_points(region.rings, points_each)) {
      ++check.hidden_points;
      const auto side = region.front ? plane : plane.opposite();
      if (!exact::point_occlusion(p, side, map.cell, soup).occluded) ++check.hidden_points_seen;
      for (std::size_t line = 0; line < lines_each; ++line) {
        std::vector<int> weights;
        for (std::size_t k = 0; k < map.cell.vertices().size(); ++k) weights.push_back(random.between(1, 1000));
        ++check.sight_lines;
        const auto verdict = exact::check_witness(mesh, map.cell, origin.triangle, region.front == origin.same_side,
                                                  map.cell.interior_point(weights), p);
        if (verdict.valid) ++check.sight_lines_free;
      }
    }
    progress("hidden regions", i + 1, chosen);
  }

  validate::JudgeOptions options;
  options.progress = [&](std::uint64_t done, std::uint64_t total) { progress("witnesses", done, total); };
  check.own = validate::judge_pvs(mesh, map, map.visible, options);
  // A judge that never says "unsound" is none. Only the triangle left out is looked at again, so this costs little.
  if (!check.own.witnesses.empty()) {
    const auto lost = check.own.witnesses[random.next() % check.own.witnesses.size()].triangle;
    auto without = map.visible;
    std::erase(without, lost);
    options.progress = nullptr;
    options.only = {lost};
    check.loss_is_caught = validate::judge_pvs(mesh, map, without, options).verdict == validate::Verdict::unsound;
  }
  return check;
}

}  // namespace clues::app
