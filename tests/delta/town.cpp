#include "tests/delta/town.h"

#include "scene/stream/route.h"
#include "tests/reference/support.h"

namespace clues::test {

Town::Town(scene::TriangleMesh mesh, const std::string& grid)
    : mesh_(std::move(mesh)), cells_(scene::parse_cells(grid)), neighbours_(scene::neighbours_of(cells_)) {
  for (const auto& spec : cells_) {
    const auto map = map_of(mesh_, exact::ConvexCell::from_doubles(spec.points));
    lists_.push_back(map.visible);
    truth_.push_back(validate::judge_pvs(mesh_, map, {}));
  }
}

const reference::StreamStore& Town::store(int horizon) const {
  return stores_.try_emplace(horizon, mesh_, lists_, neighbours_, horizon).first->second;
}

validate::StreamVerdict Town::judge(const std::vector<scene::StreamMessage>& messages) const {
  return validate::judge_stream(mesh_, neighbours_, messages,
                                [this](std::uint32_t c) -> const validate::Judgement& { return truth_[c]; });
}

std::vector<scene::StreamMessage> Town::stream(const std::vector<std::uint32_t>& route, int horizon) const {
  std::vector<scene::StreamMessage> all;
  auto made = server(horizon);
  for (const std::uint32_t cell : route) {
    for (auto& message : made.enter(cell)) all.push_back(std::move(message));
  }
  return all;
}

const Town& town() {
  static const scene::TriangleMesh mesh = [] {
    SceneBuilder scene;
    scene.box({-4, -4, -1}, {-3, 4, 3});
    scene.box({3, -1, -1}, {3.5, 1, 3});
    scene.triangle({-6, -1, 0}, {-6, 1, 0}, {-6, 0, 1});
    scene.triangle({6, -0.25, 0}, {6, 0.25, 0}, {6, 0, 1});
    scene.triangle({-5, -6, 0}, {-4.5, -6, 0}, {-5, -6, 1});
    scene.triangle({6, 3, 0}, {6, 3.5, 0}, {6, 3.25, 1});
    return scene.mesh();
  }();
  static const Town made(mesh, "grid:3x3x2:box:-2.5,-2.5,0,2.5,2.5,2");
  return made;
}

}  // namespace clues::test
