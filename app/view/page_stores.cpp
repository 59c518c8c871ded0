#include "app/view/page_stores.h"

#include <array>
#include <cmath>
#include <map>

#include "app/view/base64.h"
#include "fastpath/motion/bounds/bounds.h"
#include "scene/messages/error.h"
#include "scene/motion/walk_file.h"

namespace clues::app {
namespace {

using nlohmann::json;

constexpr std::uint8_t due = 64;
constexpr int most_bin = 7;

// The least b with left < step * 4^(b - 1).
std::uint8_t bin_of(double left, double step) {
  double limit = step / 4;
  int bin = 0;
  while (bin < most_bin && !(left < limit)) {
    ++bin;
    limit *= 4;
  }
  return static_cast<std::uint8_t>(bin);
}

}  // namespace

std::string run_lengths(const std::vector<std::uint32_t>& list, std::uint32_t triangles) {
  Base64 out;
  const auto put = [&](std::uint32_t length) {
    for (; length >= 128; length >>= 7) out.put(static_cast<std::uint8_t>(128 | (length & 127)));
    out.put(static_cast<std::uint8_t>(length));
  };
  std::uint32_t at = 0;
  for (std::size_t i = 0; i < list.size();) {
    std::size_t end = i + 1;
    while (end < list.size() && list[end] == list[end - 1] + 1) ++end;
    put(list[i] - at);
    put(static_cast<std::uint32_t>(end - i));
    at = list[end - 1] + 1;
    i = end;
  }
  put(triangles - at);
  return out.take();
}

json bake_for_page(const scene::FinishedBake& bake) {
  const scene::BakePlan& plan = bake.plan();
  json cells = json::array(), nodes = json::array();
  for (std::uint32_t i = 0; i < plan.cells.size(); ++i) {
    const scene::BakePlace& place = plan.cells[i];
    const scene::BakedPlace baked = bake.cell(i);
    cells.push_back({{"name", place.name},
                     {"node", place.node},
                     {"points", place.points},
                     {"fallbacks", baked.fallbacks},
                     {"runs", run_lengths(baked.list, plan.triangles)}});
  }
  for (const scene::BakePlace& node : plan.nodes) nodes.push_back(node.node);
  return {{"format", "clues-bake-page/1"},
          {"scene", {{"file", plan.scene_file}, {"sha256", plan.scene_sha256}, {"triangles", plan.triangles}}},
          {"note", plan.note},
          {"nodes", std::move(nodes)},
          {"cells", std::move(cells)}};
}

json walk_for_page(const std::filesystem::path& file) {
  namespace motion = fastpath::motion;
  std::vector<scene::MotionPoint> path;
  scene::WalkFrame frame;
  for (scene::WalkReader reader(file); reader.next(frame);) path.push_back(frame.viewpoint);
  if (path.empty())
    throw scene::Error(scene::ErrorCode::malformed, file.string() + ": has no frames; make it anew with --walk-out");
  double way = 0;
  for (std::size_t k = 1; k < path.size(); ++k) way += motion::distance_up(path[k - 1], path[k]);
  const double step = way > 0 ? way / static_cast<double>(path.size() - 1) : 1;

  json frames = json::array();
  std::map<std::array<std::uint32_t, 3>, double> keys;  // the odometer at which the bound of a triangle is used up
  double odometer = 0;
  scene::MotionPoint last = path.front();
  for (scene::WalkReader reader(file); reader.next(frame);) {
    odometer += motion::distance_up(last, frame.viewpoint);
    last = frame.viewpoint;
    const motion::BoundThresholds limits(frame.thresholds);
    std::vector<motion::Row> rows;
    rows.reserve(frame.mesh.samples.size());
    for (const auto& sample : frame.mesh.samples) rows.push_back(motion::row_of(sample, frame.viewpoint));
    std::map<std::array<std::uint32_t, 3>, double> now;
    Base64 bytes;
    for (const auto& t : frame.mesh.triangles) {
      const auto known = keys.find(t);
      const bool used_up = known != keys.end() && known->second < odometer;
      const double key = known != keys.end() && !used_up
                             ? known->second
                             : odometer + motion::triangle_bound(rows[t[0]], rows[t[1]], rows[t[2]], limits);
      now.emplace(t, key);
      bytes.put(static_cast<std::uint8_t>(bin_of(key - odometer, step) | (used_up ? due : 0)));
    }
    keys = std::move(now);
    frames.push_back(bytes.take());
  }
  return {{"step", step}, {"frames", std::move(frames)}};
}

}  // namespace clues::app
