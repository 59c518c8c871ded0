#include "validate/stream/judge_delta.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "validate/stream/boundary_chain.h"

namespace clues::validate {
namespace {

using reference::SeenFrom;
using SideOf = std::pair<std::uint32_t, bool>;  // triangle, front
using Ids = std::vector<std::uint32_t>;

struct InputTriangle {
  std::array<RVector, 3> corners;
  RVector normal;  // of the front; as long as twice the area
};

InputTriangle input_triangle(const scene::TriangleMesh& mesh, std::uint32_t t) {
  InputTriangle out;
  for (std::size_t i = 0; i < 3; ++i) {
    const scene::Point& p = mesh.points[mesh.triangles[t][i]];
    out.corners[i] = {Rational(p[0]), Rational(p[1]), Rational(p[2])};
  }
  out.normal = cross(minus(out.corners[1], out.corners[0]), minus(out.corners[2], out.corners[0]));
  return out;
}

// A vector of twice the area of a ring.
template <class Ring>
RVector area_vector(const Ring& ring) {
  RVector total{};
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    total = sum(total, cross(minus(ring[i], ring[0]), minus(ring[i + 1], ring[0])));
  return total;
}

// In parts of the triangle's area; negative where it turns the other way. The ring lies in the triangle's plane.
Rational share(const RVector& area, const RVector& normal) { return Rational(dot(area, normal) / dot(normal, normal)); }

// Whether it is one of the two doubles that the number lies between, or the number itself.
bool is_rounding(double rounded, const Rational& exact) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!std::isfinite(rounded)) return false;
  const double below = std::nextafter(rounded, -infinite), above = std::nextafter(rounded, infinite);
  return (std::isinf(below) || Rational(below) < exact) && (std::isinf(above) || exact < Rational(above));
}

struct SideBorders {
  BoundaryChain tiling, from, to;
  bool seen = false;
};

std::string words_of(const SideOf& side) {
  return fmt::format("triangle {}, {}", side.first, side.second ? "front" : "back");
}

Ids difference(const Ids& a, const Ids& b) {
  Ids out;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

void compare_lists(const Ids& given, const Ids& expected, const std::string& what, std::vector<DeltaFinding>& out) {
  const Ids missing = difference(expected, given), extra = difference(given, expected);
  if (!missing.empty())
    out.push_back({fmt::format("{}: lacks triangle {} ({} in all)", what, missing[0], missing.size())});
  if (!extra.empty())
    out.push_back({fmt::format("{}: triangle {} is too much ({} in all)", what, extra[0], extra.size())});
}

// (e), of one of the two ends.
void require_listed(const DeltaRecord& delta, SeenFrom end, const MapFile& map, std::vector<DeltaFinding>& out) {
  const bool first = end == SeenFrom::from;
  std::set<std::uint32_t> seen;
  for (const MapFileRegion& r : map.regions) seen.insert(r.triangle);
  for (const DeltaFragment& f : delta.fragments) {
    if (f.seen == end || f.seen == SeenFrom::both) seen.insert(f.triangle);
  }
  const Ids& list = first ? delta.from.visible : delta.to.visible;
  for (const std::uint32_t t : seen) {
    if (std::binary_search(list.begin(), list.end(), t)) continue;
    out.push_back({fmt::format("the list of the {} cell: lacks triangle {}, of which a region or a fragment is seen",
                               first ? "first" : "second", t)});
  }
}

// The corners of a side, as it turns.
std::array<RVector, 3> outline_of(const InputTriangle& t, bool front) {
  return front ? t.corners : std::array{t.corners[0], t.corners[2], t.corners[1]};
}

class DeltaJudge {
 public:
  DeltaJudge(const scene::TriangleMesh& mesh, DeltaVerdict& verdict) : mesh_(mesh), verdict_(verdict) {}

  void add_fragments(const DeltaRecord& delta) {
    require_roundings(delta.vertices);
    for (std::size_t i = 0; i < delta.fragments.size(); ++i) {
      const DeltaFragment& f = delta.fragments[i];
      const InputTriangle t = input_triangle(mesh_, f.triangle);
      const RVector area = area_vector(f.corners);
      const bool flat = is_zero(cross(area, t.normal)) && sgn(dot(minus(f.corners[0], t.corners[0]), t.normal)) == 0;
      if (is_zero(t.normal) || !flat || sgn(dot(area, t.normal)) != (f.front ? 1 : -1)) {
        verdict_.findings.push_back({fmt::format("fragment {}: is no triangle in the plane of {} that turns as it does",
                                                 i, words_of({f.triangle, f.front}))});
        continue;
      }
      SideBorders& side = sides_[{f.triangle, f.front}];
      side.seen = true;
      const Rational part = abs(share(area, t.normal));
      side.tiling.add_ring(f.corners, 1);
      if (f.seen == SeenFrom::from || f.seen == SeenFrom::both) side.from.add_ring(f.corners, 1);
      if (f.seen == SeenFrom::to || f.seen == SeenFrom::both) side.to.add_ring(f.corners, 1);
      if (f.seen == SeenFrom::to) verdict_.exposed += part;
      if (f.seen == SeenFrom::from) verdict_.occluded += part;
    }
    for (auto& [key, side] : sides_) side.tiling.add_ring(outline_of(input_triangle(mesh_, key.first), key.second), -1);
  }

  void take_map(const MapFile& map, BoundaryChain SideBorders::*border, Rational& area) {
    for (const MapFileRegion& r : map.regions) {
      const InputTriangle t = input_triangle(mesh_, r.triangle);
      if (is_zero(t.normal)) {
        verdict_.findings.push_back({fmt::format("a map has a region on triangle {}, which has no area", r.triangle)});
        continue;
      }
      RVector total{};
      for (const auto& ring : r.rings) total = sum(total, area_vector(ring));
      const Rational part = share(total, t.normal);
      area += abs(part);
      // As the side turns, whichever way the file has it.
      const int times = (sgn(part) > 0) == r.front ? -1 : 1;
      for (const auto& ring : r.rings) (sides_[{r.triangle, r.front}].*border).add_ring(ring, times);
    }
  }

  void finish() {
    for (const auto& [key, side] : sides_) {
      ++verdict_.sides;
      const auto blame = [&, &at = key](const std::string& what) {
        verdict_.findings.push_back({words_of(at) + ": " + what});
      };
      if (!side.seen) {
        blame("is in a map, and has no fragment");
        continue;
      }
      if (!side.tiling.empty()) blame("the fragments do not cover it, each point once");
      if (!side.from.empty()) blame("\"from\" and \"both\" are not what the first map calls visible");
      if (!side.to.empty()) blame("\"to\" and \"both\" are not what the second map calls visible");
    }
  }

 private:
  void require_roundings(const std::vector<DeltaVertex>& vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const auto& [exact, rounded] = vertices[i];
      if (!is_rounding(rounded[0], exact[0]) || !is_rounding(rounded[1], exact[1]) ||
          !is_rounding(rounded[2], exact[2]))
        verdict_.findings.push_back({fmt::format("vertices[{}] is no rounding of vertices_exact[{}]", i, i)});
    }
  }

  const scene::TriangleMesh& mesh_;
  DeltaVerdict& verdict_;
  std::map<SideOf, SideBorders> sides_;
};

}  // namespace

DeltaVerdict judge_delta(const scene::TriangleMesh& mesh, const DeltaRecord& delta, const MapFile& from,
                         const MapFile& to) {
  DeltaVerdict verdict;
  compare_lists(delta.from.visible, from.visible, "the list of the first cell", verdict.findings);
  compare_lists(delta.to.visible, to.visible, "the list of the second cell", verdict.findings);
  compare_lists(delta.plus, difference(to.visible, from.visible), "the packet +", verdict.findings);
  compare_lists(delta.minus, difference(from.visible, to.visible), "the packet -", verdict.findings);
  require_listed(delta, SeenFrom::from, from, verdict.findings);
  require_listed(delta, SeenFrom::to, to, verdict.findings);
  if (!delta.has_fragments) return verdict;
  DeltaJudge judge(mesh, verdict);
  judge.add_fragments(delta);
  judge.take_map(from, &SideBorders::from, verdict.from);
  judge.take_map(to, &SideBorders::to, verdict.to);
  judge.finish();
  if (verdict.to - verdict.from != verdict.exposed - verdict.occluded)
    verdict.findings.push_back({"the areas do not add up: |VM(to)| - |VM(from)| is not |DR_E| - |DR_O|"});
  return verdict;
}

std::vector<DeltaFinding> judge_reverse(const DeltaRecord& there, const DeltaRecord& back) {
  std::vector<DeltaFinding> findings;
  compare_lists(back.plus, there.minus, "the packet + of the way back", findings);
  compare_lists(back.minus, there.plus, "the packet - of the way back", findings);
  std::map<SideOf, std::array<BoundaryChain, 2>> borders;  // DR_E(AB) - DR_O(BA), DR_O(AB) - DR_E(BA)
  const auto add = [&](const DeltaRecord& delta, SeenFrom seen, std::size_t which, int times) {
    for (const DeltaFragment& f : delta.fragments) {
      if (f.seen == seen) borders[{f.triangle, f.front}][which].add_ring(f.corners, times);
    }
  };
  add(there, SeenFrom::to, 0, 1);
  add(back, SeenFrom::from, 0, -1);
  add(there, SeenFrom::from, 1, 1);
  add(back, SeenFrom::to, 1, -1);
  for (const auto& [side, both] : borders) {
    if (!both[0].empty()) findings.push_back({words_of(side) + ": DR_E there is not DR_O back"});
    if (!both[1].empty()) findings.push_back({words_of(side) + ": DR_O there is not DR_E back"});
  }
  return findings;
}

}  // namespace clues::validate
