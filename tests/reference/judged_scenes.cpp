#include "judged_scenes.h"

#include <iostream>

#include "fuzz/generators/random_scenes.h"
#include "judges.h"

namespace clues::test {

std::uint64_t contradictions_in_random_scenes(std::uint64_t per_kind) {
  constexpr std::uint64_t seed = 7;
  for (std::uint64_t i = 0; i < per_kind; ++i) {
    for (const fuzz::Kind kind : fuzz::all_kinds) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, seed, i);
      const auto map = map_of(scene.mesh, exact::ConvexCell::from_doubles(scene.cell));
      const std::uint64_t n = contradictions(map, 6, seed).total() + map.statistics.walk_disagreements;
      if (n > 0) {
        std::cout << "caught in " << scene.name << ": " << n << "\n";
        return n;
      }
    }
  }
  return 0;
}

}  // namespace clues::test
