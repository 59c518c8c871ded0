// D19: looks for a confirmed witness wherever the first-order map says "visible", and weighs the PVS with what it found.
#include "validate/verdicts/judge.h"

#include <algorithm>
#include <optional>

#include "exact/sight/point_occlusion.h"
#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "validate/certificates/region_points.h"
#include "validate/verdicts/light_search.h"

namespace clues::validate {
namespace {

using exact::Point3;
using reference::Region;

// A region as a side of one input triangle.
struct Seat {
  const Region* region = nullptr;
  bool front = true;  // of the input triangle
};

class Judge {
 public:
  Judge(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map)
      : mesh_(mesh), map_(map), seats_(mesh.triangles.size()) {
    for (const auto& piece : map.complex.pieces) {
      soup_.push_back({corner(piece, 0), corner(piece, 1), corner(piece, 2)});
    }
    for (const auto& region : map.regions) {
      for (const auto& origin : map.complex.pieces[region.piece].origins) {
        const bool front = region.front == origin.same_side;
        if (front || map.mode == reference::Mode::sheet) seats_[origin.triangle].push_back({&region, front});
      }
    }
  }

  bool touches_cell(std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return exact::meets_cell(
        {exact::to_exact(mesh_.points[a]), exact::to_exact(mesh_.points[b]), exact::to_exact(mesh_.points[c])},
        map_.cell);
  }

  // A confirmed witness for the triangle on one of its regions with the given label; `count` places a region.
  std::optional<Witness> find_witness(std::uint32_t triangle, bool label, std::size_t count) const {
    for (const auto& seat : seats_[triangle]) {
      if (seat.region->visible != label) continue;
      if (auto found = try_point(triangle, seat, seat.region->sample)) return found;
    }
    for (const auto& seat : seats_[triangle]) {
      if (seat.region->visible != label || count <= 1) continue;
      for (const auto& p : interior_points(seat.region->rings, count - 1)) {
        if (auto found = try_point(triangle, seat, p)) return found;
      }
    }
    return std::nullopt;
  }

 private:
  const Point3& corner(const exact::Piece& piece, int i) const { return map_.complex.points[piece.corners[i]]; }

  std::optional<Witness> try_point(std::uint32_t triangle, const Seat& seat, const Point3& p) const {
    // The cheap try first; the oracle knows all of the cell.
    const auto& cell = map_.cell;
    if (auto found = confirmed(triangle, seat.front, cell.center(), p)) return found;
    const exact::Plane3& plane = map_.complex.planes[seat.region->piece];
    const exact::Plane3 side = seat.region->front ? plane : plane.opposite();
    const auto answer = exact::point_occlusion(p, side, cell, soup_);
    if (answer.occluded || !answer.witness) return std::nullopt;
    return confirmed(triangle, seat.front, *answer.witness, p);
  }

  std::optional<Witness> confirmed(std::uint32_t triangle, bool front, const Point3& v, const Point3& p) const {
    if (!exact::check_witness(mesh_, map_.cell, triangle, front, v, p).valid) return std::nullopt;
    return Witness{triangle, front, v, p};
  }

  const scene::TriangleMesh& mesh_;
  const reference::VisibilityMap& map_;
  std::vector<exact::TriangleCorners> soup_;
  std::vector<std::vector<Seat>> seats_;  // per input triangle, the sides that count in the mode
};

}  // namespace

Judgement judge_pvs(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map,
                    const std::vector<std::uint32_t>& pvs, const JudgeOptions& options) {
  const Judge judge(mesh, map);
  const auto& degenerate = map.complex.degenerate;
  const auto total = static_cast<std::uint32_t>(mesh.triangles.size());
  std::optional<LightSearch> light;
  Judgement result;
  result.triangles.resize(total, TriangleVerdict::hidden);
  for (std::uint32_t t = 0; t < total; ++t) {
    if (!options.only.empty() && !std::binary_search(options.only.begin(), options.only.end(), t)) continue;
    const bool listed = std::binary_search(pvs.begin(), pvs.end(), t);
    const bool in_omega = std::binary_search(map.visible.begin(), map.visible.end(), t);
    const bool surface = !std::binary_search(degenerate.begin(), degenerate.end(), t);
    bool seen = false;
    if (surface && judge.touches_cell(t)) {
      seen = true;
      result.meet_cell.push_back(t);
    } else if (in_omega) {
      if (auto witness = judge.find_witness(t, true, options.points_per_region)) {
        seen = true;
        result.witnesses.push_back(*witness);
      }
    } else if (options.cross_check && surface) {
      auto witness = judge.find_witness(t, false, 1);
      if (!witness) {
        if (!light) light.emplace(mesh, map.cell, map.mode == reference::Mode::sheet);
        witness = light->find(t);
      }
      if (witness) {
        seen = true;
        result.witnesses.push_back(*witness);
        result.contradictions.push_back(*witness);
      }
    }
    auto& verdict = result.triangles[t];
    if (listed) {
      verdict = seen ? TriangleVerdict::exact : in_omega ? TriangleVerdict::first_order : TriangleVerdict::loose;
    } else {
      verdict = seen       ? TriangleVerdict::missing_visible
                : in_omega ? TriangleVerdict::missing_undecided
                           : TriangleVerdict::hidden;
    }
    switch (verdict) {
      case TriangleVerdict::hidden:
        break;
      case TriangleVerdict::missing_undecided:
        ++result.missing_undecided;
        break;
      case TriangleVerdict::missing_visible:
        ++result.missing_visible;
        break;
      case TriangleVerdict::exact:
        ++result.exact;
        break;
      case TriangleVerdict::first_order:
        ++result.first_order;
        break;
      case TriangleVerdict::loose:
        ++result.loose;
        break;
    }
    if (options.progress) options.progress(t + 1, total);
  }
  result.verdict = verdict_of(result);
  return result;
}

Verdict verdict_of(const Judgement& judgement) {
  if (judgement.missing_visible > 0) return Verdict::unsound;
  return judgement.missing_undecided > 0 ? Verdict::undecided : Verdict::sound;
}

std::vector<std::uint32_t> undecided(const Judgement& judgement) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < judgement.triangles.size(); ++t) {
    const TriangleVerdict v = judgement.triangles[t];
    if (v == TriangleVerdict::first_order || v == TriangleVerdict::missing_undecided) found.push_back(t);
  }
  return found;
}

}  // namespace clues::validate
