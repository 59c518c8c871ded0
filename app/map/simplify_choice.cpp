#include "app/map/simplify_choice.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/messages/error.h"
#include "scene/messages/percent.h"

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
  command
      .add_option(
          "--intersect-planes", intersect_planes,
          "At inside corners of silhouettes let the planes of the two wedges meet, in place of the swept wedges\n"
          "between, where none of these is more than DEGREES, 0 to 90, from the line in which they meet, and\n"
          "that saves a segment. Before the others; not with --refine")
      ->type_name("DEGREES");
}

void SimplifyChoice::check() const {
  if (intersect_planes && !(*intersect_planes >= 0 && *intersect_planes <= 90)) {
    throw Error(ErrorCode::bad_argument,
                fmt::format("--intersect-planes {}: use an angle, 0 to 90 degrees", *intersect_planes));
  }
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
  return {min_occlusion.value_or(0), simplify_boundaries.value_or(0), threads, intersect_planes};
}

scene::Simplification record_of(const reference::SimplifiedMap& simplified, const SimplifyChoice& choice) {
  const auto figures = [&](const reference::OcclusionFigures& f) {
    return scene::Simplification::Figures{f.regions, f.segments, simplified.map.range.area_moved_back(f.hidden_area),
                                          f.visible_triangles};
  };
  return {choice.min_occlusion.value_or(0),
          choice.simplify_boundaries.value_or(0),
          figures(simplified.before),
          figures(simplified.after),
          choice.intersect_planes,
          simplified.inside_corners,
          simplified.by_planes};
}

std::string summary_of(const reference::SimplifiedMap& simplified, const scene::Simplification& s) {
  const std::string kept = simplified.before.hidden_area > 0
                               ? scene::percent(simplified.after.hidden_area, simplified.before.hidden_area, 2)
                               : "100.00";
  const std::string corners =
      s.intersect_planes ? fmt::format("inside corners by planes {} of {}, ", s.by_planes, s.inside_corners) : "";
  return fmt::format(
      "simplified: {}boundary segments {} -> {}, hidden area {:.6g} -> {:.6g} ({} %), occlusion regions {} -> {}, "
      "visible triangles {} -> {}\n",
      corners, s.before.boundary_segments, s.after.boundary_segments, s.before.hidden_area, s.after.hidden_area, kept,
      s.before.occlusion_regions, s.after.occlusion_regions, s.before.visible_triangles, s.after.visible_triangles);
}

}  // namespace clues::app
