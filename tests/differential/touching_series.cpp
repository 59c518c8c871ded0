#include "tests/differential/touching_series.h"

#include <array>
#include <utility>

#include "fuzz/findings/dials.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/touching_scenes.h"

namespace clues::tests {
namespace {

// Of the scenes of each generator and of each cell some.
bool is_tip(std::uint64_t n) { return n % 9 == 8; }

// The first three triangles of limit-hides-a-tip.obj, the tip not always at the same place, but where the middle is outside of what was left out.
fuzz::Case tip_scene(std::uint64_t seed, std::uint64_t n) {
  fuzz::Random random(fuzz::Random(seed).next() ^ n);
  const auto about = [&](double x) { return x + random.between(-1024, 1024) * 0x3p-16; };
  fuzz::Case scene{"a tip", seed, n, {}, {}, false};
  // So far along the needle of that scene that the tip is in what was left out, and the needle's edges do not come out of it again.
  constexpr double f = 0.86;
  scene.mesh.points = {
      {-18, 60, 4},       {18, -60, 4},       {-120, -36, 4},
      {-60, -18, 12},     {60, 18, 12},       {36, -120, 12},
      {-12.84, -3.06, 5}, {-12.84, -3.01, 5}, {about(-12.84 + f * 9.80875), about(-3.035 + f * 0.81625), 5 + f * 25}};
  scene.mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  scene.mesh.face_of = {0, 1, 2};
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) {
      for (const double z : {-1, 0}) scene.cell.push_back({x, y, z});
    }
  }
  scene.dials["generation_limit"] = 0;
  return scene;
}

fuzz::Case limited_scene(std::uint64_t seed, std::uint64_t n) {
  if (is_tip(n)) return tip_scene(seed, n);
  constexpr std::array<std::int64_t, 5> csv_limits{0, 1, 2, 5, 20};
  fuzz::Case scene = touching_scene(seed, n);
  scene.dials = fuzz::with_dials(scene, true).dials;
  // Moved scenes have tests of their own (CoordinatesOfAnySize); areas far from the origin are as coarse as coordinates are there.
  scene.dials.erase("scale");
  scene.dials.erase("offset");
  // A turn that the round of generators and cells (7 x 8) does not divide.
  const std::uint64_t turn = n / 56 + n;
  if (turn % 3 != 0) scene.dials["generation_limit"] = static_cast<std::int64_t>(turn / 3 % 3);
  if (turn % 3 != 1) scene.dials["csv_limit"] = csv_limits[turn / 9 % csv_limits.size()];
  return scene;
}

JudgeSettings limited_settings(std::uint64_t n) {
  JudgeSettings settings;
  settings.refined = (n / 56 + n) % 4 == 0;
  settings.points_per_region = 2;
  settings.visible_set = is_tip(n);
  return settings;
}

}  // namespace

fuzz::Case touching_scene(std::uint64_t seed, std::uint64_t n) {
  const auto& generators = fuzz::touching_generators();
  const fuzz::DegenerateGenerator& g = generators[n % generators.size()];
  const std::uint64_t index = n / generators.size();
  fuzz::GeneratedScene scene = g.make(seed, index);
  return {g.name, seed, index, std::move(scene.mesh), std::move(scene.cell), false};
}

Series limited_series() { return {number_from("CLUES_SEED", kTouchingSeed + 1), limited_scene, limited_settings}; }

}  // namespace clues::tests
