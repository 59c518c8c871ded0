#include "validate/see_through/exact_lister.h"

#include <memory>
#include <utility>

#include "exact/cell/convex_cell.h"
#include "reference/visibility/first_order.h"
#include "validate/see_through/layers.h"

namespace clues::validate {
namespace {

using fastpath::bakes::CellList;

class ExactLister : public fastpath::bakes::CellLister {
 public:
  explicit ExactLister(scene::FlaggedMesh scene) : scene_(std::move(scene)) {
    for (std::uint32_t t = 0; t < scene_.counts.size(); ++t) scene_.counts[t] |= scene_.blocking(t) ? 1 : 0;
  }
  CellList list(const std::vector<scene::Point>& points, std::span<const std::uint32_t>) const override {
    CellList out;
    const auto cell = exact::ConvexCell::from_doubles(points);
    out.visible = visible_in_layers(scene_, [&](const scene::TriangleMesh& mesh) {
      reference::Options options;
      options.threads = 1;
      const auto map = reference::first_order_visibility(mesh, cell, options);
      out.fallbacks += static_cast<std::int64_t>(map.statistics.conservative_fallbacks);
      out.mapped += static_cast<std::int64_t>(mesh.triangles.size());
      ++out.passes;
      return map.visible;
    });
    return out;
  }

 private:
  scene::FlaggedMesh scene_;
};

}  // namespace

fastpath::bakes::ListerMaker exact_lister() {
  return [](scene::FlaggedMesh scene) { return std::make_unique<ExactLister>(std::move(scene)); };
}

}  // namespace clues::validate
