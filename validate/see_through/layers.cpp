// D22: the loop that the header proves.
#include "validate/see_through/layers.h"

#include <algorithm>
#include <iterator>

namespace clues::validate {
namespace {

Layer layer_of(const scene::FlaggedMesh& scene, const std::vector<bool>& in_layer, bool see_through) {
  Layer layer;
  layer.see_through = see_through;
  for (std::uint32_t t = 0; t < in_layer.size(); ++t) {
    if (!in_layer[t]) continue;
    const bool asked = see_through ? !scene.blocking(t) : scene.counting(t);
    if (asked) layer.asked.push_back(static_cast<std::uint32_t>(layer.ids.size()));
    layer.ids.push_back(t);
  }
  layer.mesh = scene::part_of(scene.mesh, layer.ids);
  return layer;
}

}  // namespace

AskedAlone asked_alone(const scene::FlaggedMesh& scene, std::uint32_t t) {
  AskedAlone alone;
  alone.ids = scene::blocking_ids(scene);
  const auto at = std::lower_bound(alone.ids.begin(), alone.ids.end(), t);
  alone.triangle = static_cast<std::uint32_t>(at - alone.ids.begin());
  if (at == alone.ids.end() || *at != t) alone.ids.insert(at, t);
  alone.mesh = scene::part_of(scene.mesh, alone.ids);
  return alone;
}

void each_layer(const scene::FlaggedMesh& scene, const DecideLayer& decide) {
  const auto total = static_cast<std::uint32_t>(scene.mesh.triangles.size());
  std::vector<bool> in_layer(total);
  for (std::uint32_t t = 0; t < total; ++t) in_layer[t] = scene.blocking(t);
  const Layer opaque = layer_of(scene, in_layer, false);
  if (!opaque.asked.empty()) decide(opaque);
  in_layer.assign(total, true);
  while (true) {
    const Layer layer = layer_of(scene, in_layer, true);
    if (layer.asked.empty()) return;
    const auto seen = decide(layer);
    if (seen.empty()) return;
    for (const auto t : seen) in_layer[layer.ids[t]] = false;
  }
}

std::vector<std::uint32_t> visible_in_layers(const scene::FlaggedMesh& scene, const ListVisible& list) {
  std::vector<std::uint32_t> visible;
  each_layer(scene, [&](const Layer& layer) {
    const auto listed = list(layer.mesh);
    std::vector<std::uint32_t> seen;
    std::set_intersection(listed.begin(), listed.end(), layer.asked.begin(), layer.asked.end(),
                          std::back_inserter(seen));
    for (const auto t : seen) visible.push_back(layer.ids[t]);
    return seen;
  });
  std::sort(visible.begin(), visible.end());
  return visible;
}

}  // namespace clues::validate
