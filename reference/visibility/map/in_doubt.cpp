#include "reference/visibility/map/in_doubt.h"

#include <tbb/parallel_for.h>

#include <optional>

#include "reference/visibility/labels/walk.h"
#include "reference/visibility/map/sides.h"
#include "scene/messages/error.h"

namespace clues::reference {
namespace {

constexpr int kLooks = 16;  // walks to points of a side
constexpr std::uint64_t kSeed = 0x2b9, kSeeds = 2;

// The visible regions on sides that count, by input triangle; in the order of the map.
std::vector<std::vector<const Region*>> visible_regions(const VisibilityMap& map) {
  std::vector<std::vector<const Region*>> regions(map.complex.input_triangles);
  for (const Region& r : map.regions) {
    if (!r.visible) continue;
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      if (counts(map.mode, o, r.front)) regions[o.triangle].push_back(&r);
    }
  }
  return regions;
}

}  // namespace

std::vector<std::uint32_t> find_in_doubt(const exact::SceneQuery& scene, const Fixpoint& fixpoint,
                                         const Options& options, const VisibilityMap& map) {
  if (map.statistics.conservative_fallbacks == 0) return {};
  const std::optional<WedgeSet> known = fixpoint.find_known ? std::optional(fixpoint.find_known()) : std::nullopt;
  const WedgeSet& wedges = known ? *known : fixpoint.wedges;
  const Walker walker(scene, options.dials.longest_walk);
  const auto is_seen = [&](const Region& r, std::uint64_t seed) {
    const Start start{r.sample, SurfaceSide{r.piece, r.front}, nullptr};
    try {
      const Walk walk = walker.walk(start, seed);
      return !walk.unresolved && walker.visible(start, walk, wedges, 0) == Meets::yes;
    } catch (const scene::Error&) {  // the sample lies in special position
      return false;
    }
  };
  const auto is_known = [&](const std::vector<const Region*>& regions) {
    int looks = 0;
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const Region& r = *regions[i];
      if (i > 0 && (r.piece != regions[i - 1]->piece || r.front != regions[i - 1]->front)) looks = 0;
      for (std::uint64_t k = 0; k < kSeeds && looks < kLooks; ++k, ++looks) {
        if (is_seen(r, kSeed + k)) return true;
      }
    }
    return false;
  };
  const std::vector<bool> meets_cell = that_meet_cell(scene, map.complex);
  const std::vector<std::vector<const Region*>> regions = visible_regions(map);
  std::vector<char> shown(map.visible.size(), 0);
  tbb::parallel_for(std::size_t{0}, map.visible.size(), [&](std::size_t i) {
    const std::uint32_t t = map.visible[i];
    shown[i] = meets_cell[t] || is_known(regions[t]) ? 1 : 0;
  });
  std::vector<std::uint32_t> in_doubt;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (shown[i] == 0) in_doubt.push_back(map.visible[i]);
  }
  return in_doubt;
}

}  // namespace clues::reference
