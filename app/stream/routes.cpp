#include "app/stream/routes.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/common.h"
#include "reference/streams/camera_route.h"
#include "scene/messages/error.h"
#include "scene/messages/shell_word.h"
#include "scene/motion/view_path.h"
#include "scene/stream/route.h"

namespace clues::app {
namespace {

std::vector<std::uint32_t> along_camera(const ServedCells& served, const std::string& camera) {
  std::vector<exact::ConvexCell> hulls;
  for (const auto& cell : served.cells) {
    hulls.push_back(exact::ConvexCell::from_doubles(cell.points));
    if (hulls.back().dimension() < 3)
      throw scene::Error(scene::ErrorCode::bad_cell,
                         "cell " + cell.name + ": has no inside, and a camera path goes through insides");
  }
  std::vector<exact::Point3> path;
  for (const auto& at : scene::read_view_path(camera, {})) path.emplace_back(at[0], at[1], at[2]);
  return reference::camera_route(hulls, served.neighbours, path);
}

}  // namespace

void RouteChoice::add_to(CLI::App& command, const char* of_steps) {
  auto* file = command.add_option("--route", route, "Numbers of cells, one after the other; of a grid x fastest")
                   ->type_name("FILE");
  command
      .add_option("--camera", camera,
                  "A recorded camera path, x y z a line, or walk:x,y,z:x,y,z...: the cells that it goes through")
      ->type_name("FILE")
      ->excludes(file);
  command.add_option("--steps", steps, of_steps)->type_name("N")->check(CLI::Range(1, 1000000));
  command.add_option("--seed", seed, "Of the random steps (default: 1)")->type_name("N")->check(problem_of_count);
}

std::string RouteChoice::as_options() const {
  if (!route.empty()) return "--route " + scene::shell_word(route);
  if (!camera.empty()) return "--camera " + scene::shell_word(camera);
  return fmt::format("--steps {} --seed {}", steps, seed);
}

std::vector<std::uint32_t> RouteChoice::take(const ServedCells& served) const {
  if (at_random()) return scene::random_route(served.neighbours, steps, seed, first);
  if (!camera.empty()) return along_camera(served, camera);
  const auto taken = scene::read_route(route, served.cells.size());
  for (std::size_t i = 1; i < taken.size(); ++i) {
    const auto& next = served.neighbours[taken[i - 1]];
    if (taken[i] != taken[i - 1] && !std::binary_search(next.begin(), next.end(), taken[i]))
      throw scene::Error(scene::ErrorCode::bad_argument, fmt::format("{}: step {}: cell {} is no neighbour of cell {}",
                                                                     route, i, taken[i], taken[i - 1]));
  }
  return taken;
}

}  // namespace clues::app
