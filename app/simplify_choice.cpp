#include "app/simplify_choice.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/error.h"

namespace clues::app {

using scene::Error;
using scene::ErrorCode;

void SimplifyChoice::add_to(CLI::App& command) {
  command
      .add_option(
          "--min-occlusion", min_occlusion,
          "Drop the boundaries of occlusion regions that cut off less than AREA, in units of the scene, squared,\n"
          "for each segment; triangles that are hidden wholly stay so. After --simplify-boundaries")
      ->type_name("AREA");
  command
      .add_option(
          "--simplify-boundaries", simplify_boundaries,
          "Give boundaries fewer segments, at the cost of at most this part, 0 to 1, of the area of each hidden\n"
          "region of a triangle")
      ->type_name("LOSS");
}

void SimplifyChoice::check() const {
  if (min_occlusion && !(*min_occlusion >= 0 && std::isfinite(*min_occlusion))) {
    throw Error(ErrorCode::bad_argument, fmt::format("--min-occlusion {}: use an area, 0 or more", *min_occlusion));
  }
  if (simplify_boundaries && !(*simplify_boundaries >= 0 && *simplify_boundaries <= 1)) {
    throw Error(ErrorCode::bad_argument,
                fmt::format("--simplify-boundaries {}: use a part, 0 to 1", *simplify_boundaries));
  }
}

reference::OcclusionControls SimplifyChoice::to_reference(int threads) const {
  check();
  return {min_occlusion.value_or(0), simplify_boundaries.value_or(0), threads, reference::PlantedStep::none};
}

scene::Simplification record_of(const reference::SimplifiedMap& simplified, const SimplifyChoice& choice) {
  const auto figures = [](const reference::OcclusionFigures& f) {
    return scene::Simplification::Figures{f.regions, f.segments, f.hidden_area, f.visible_triangles};
  };
  return {choice.min_occlusion.value_or(0), choice.simplify_boundaries.value_or(0), figures(simplified.before),
          figures(simplified.after)};
}

std::string summary_of(const scene::Simplification& s) {
  const double kept = s.before.hidden_area > 0 ? 100 * s.after.hidden_area / s.before.hidden_area : 100;
  return fmt::format(
      "simplified: boundary segments {} -> {}, hidden area {:.6g} -> {:.6g} ({:.2f} %), occlusion regions {} -> {}, "
      "visible triangles {} -> {}\n",
      s.before.boundary_segments, s.after.boundary_segments, s.before.hidden_area, s.after.hidden_area, kept,
      s.before.occlusion_regions, s.after.occlusion_regions, s.before.visible_triangles, s.after.visible_triangles);
}

}  // namespace clues::app
