// T6: a node's list is the scene of what is below it; a node without a box only brings neighbours together. Cells of a node are asked one after the other, each with the list of the one before as a guess; nodes side by side.
#include "app/bake/baker.h"

#include <tbb/task_group.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "exact/cell/convex_cell.h"
#include "exact/threads.h"
#include "fastpath/visibility/see_through.h"
#include "reference/visibility/first_order.h"
#include "validate/see_through/layers.h"

namespace clues::app {
namespace {

using Ids = std::vector<std::uint32_t>;
using scene::PlaceKind;

class FastLister : public CellLister {
 public:
  explicit FastLister(scene::FlaggedMesh scene) : scene_(std::move(scene)) {}
  CellList list(const std::vector<scene::Point>& cell, std::span<const std::uint32_t> guess) const override {
    const auto found = exact::by_threads(1, [&] { return fastpath::visible_through(scene_, cell, {}, guess); });
    CellList out;
    out.visible = found.all();
    out.fallbacks = static_cast<std::int64_t>(found.conservative_fallbacks);
    out.mapped = static_cast<std::int64_t>(found.mapped);
    out.passes = static_cast<std::int64_t>(found.passes);
    return out;
  }

 private:
  fastpath::SeeThroughScene scene_;
};

// Layer by layer (D22); what only blocks is asked about, too, since others may be mapped in the list.
class ExactLister : public CellLister {
 public:
  explicit ExactLister(scene::FlaggedMesh scene) : scene_(std::move(scene)) {
    for (std::uint32_t t = 0; t < scene_.counts.size(); ++t) scene_.counts[t] |= scene_.blocking(t) ? 1 : 0;
  }
  CellList list(const std::vector<scene::Point>& points, std::span<const std::uint32_t>) const override {
    CellList out;
    const auto cell = exact::ConvexCell::from_doubles(points);
    out.visible = validate::visible_in_layers(scene_, [&](const scene::TriangleMesh& mesh) {
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

// A scene to map in, with the ids that its triangles have in the whole.
struct Part {
  std::unique_ptr<CellLister> lister;  // none: nothing is seen here
  Ids ids;                             // empty: the whole scene

  CellList list(const std::vector<scene::Point>& cell, const Ids& guess) const {
    if (!lister) return {};
    Ids local;
    for (const auto t : guess) {
      if (const auto at = std::lower_bound(ids.begin(), ids.end(), t); ids.empty()) {
        local.push_back(t);
      } else if (at != ids.end() && *at == t) {
        local.push_back(static_cast<std::uint32_t>(at - ids.begin()));
      }
    }
    CellList found = lister->list(cell, local);
    if (!ids.empty()) {
      for (auto& t : found.visible) t = ids[t];
    }
    return found;
  }
};

class Baker {
 public:
  Baker(const scene::FlaggedMesh& scene, const scene::BakePlan& plan, scene::BakeStore& store,
        const ListerMaker& make_lister, BakeShard shard, const std::atomic<bool>& stop, const BakeProgress& progress)
      : scene_(scene),
        plan_(plan),
        store_(store),
        make_lister_(make_lister),
        shard_(shard),
        stop_(stop),
        progress_(progress),
        below_(plan.nodes.size()) {
    for (std::uint32_t i = 1; i < plan.nodes.size(); ++i) below_[plan.nodes[i].node].nodes.push_back(i);
    for (std::uint32_t i = 0; i < plan.cells.size(); ++i) below_[plan.cells[i].node].cells.push_back(i);
    for (std::uint32_t i = 0; i < plan.cells.size(); ++i) done_ += store.has(PlaceKind::cell, i) ? 1 : 0;
  }

  void run() {
    if (done_ == plan_.cells.size()) return;
    tbb::task_group tasks;
    const auto whole = std::make_shared<const Part>(Part{make_lister_(scene_), {}});
    map_below(0, whole, tasks);
    tasks.wait();
  }

 private:
  struct Below {
    Ids nodes, cells;
  };

  bool is_ours(std::uint32_t top) const { return top % shard_.count == shard_.index; }
  std::optional<scene::BakedPlace> stored(PlaceKind kind, std::uint32_t index) const {
    const std::lock_guard lock(mutex_);
    return store_.find(kind, index);
  }
  bool has_cell(std::uint32_t cell) const {
    const std::lock_guard lock(mutex_);
    return store_.has(PlaceKind::cell, cell);
  }
  bool is_done(std::uint32_t node) const {
    return std::all_of(below_[node].cells.begin(), below_[node].cells.end(),
                       [&](std::uint32_t c) { return has_cell(c); }) &&
           std::all_of(below_[node].nodes.begin(), below_[node].nodes.end(),
                       [&](std::uint32_t n) { return is_done(n); });
  }

  void keep(PlaceKind kind, std::uint32_t index, const CellList& found, Ids list) {
    const std::lock_guard lock(mutex_);
    store_.commit({{kind, index, {std::move(list), found.fallbacks, found.mapped, found.passes}}});
    if (kind != PlaceKind::cell) return;
    progress_(++done_);
  }

  void map_below(std::uint32_t node, const std::shared_ptr<const Part>& part, tbb::task_group& tasks) {
    for (const auto child : below_[node].nodes) {
      if ((node == 0 && !is_ours(child)) || is_done(child)) continue;
      tasks.run([this, child, part, &tasks] { map_node(child, part, tasks); });
    }
    // At the root cells have nothing in common: each is a task.
    if (node == 0) {
      for (const auto cell : below_[0].cells) {
        if (is_ours(cell)) tasks.run([this, cell, part] { map_cell(cell, *part, {}); });
      }
      return;
    }
    Ids guess;
    for (const auto cell : below_[node].cells) guess = map_cell(cell, *part, guess);
  }

  void map_node(std::uint32_t node, const std::shared_ptr<const Part>& part, tbb::task_group& tasks) {
    if (stop_) return;
    if (plan_.nodes[node].points.empty()) return map_below(node, part, tasks);
    Ids ids;
    if (auto there = stored(PlaceKind::node, node)) {
      ids = std::move(there->list);
    } else {
      const CellList found = part->list(plan_.nodes[node].points, {});
      ids = found.visible;
      keep(PlaceKind::node, node, found, ids);
    }
    auto lister = ids.empty() ? nullptr : make_lister_(scene::part_of(scene_, ids));
    map_below(node, std::make_shared<const Part>(Part{std::move(lister), std::move(ids)}), tasks);
  }

  // All that is visible, of which the store gets what counts.
  Ids map_cell(std::uint32_t cell, const Part& part, const Ids& guess) {
    if (auto there = stored(PlaceKind::cell, cell)) return std::move(there->list);
    if (stop_) return {};
    const CellList found = part.list(plan_.cells[cell].points, guess);
    Ids counting;
    std::copy_if(found.visible.begin(), found.visible.end(), std::back_inserter(counting),
                 [&](std::uint32_t t) { return scene_.counting(t); });
    keep(PlaceKind::cell, cell, found, counting);
    return counting;
  }

  const scene::FlaggedMesh& scene_;
  const scene::BakePlan& plan_;
  scene::BakeStore& store_;
  const ListerMaker& make_lister_;
  const BakeShard shard_;
  const std::atomic<bool>& stop_;
  const BakeProgress& progress_;
  std::vector<Below> below_;
  mutable std::mutex mutex_;
  std::uint64_t done_ = 0;
};

}  // namespace

ListerMaker fast_lister() {
  return [](scene::FlaggedMesh scene) { return std::make_unique<FastLister>(std::move(scene)); };
}
ListerMaker exact_lister() {
  return [](scene::FlaggedMesh scene) { return std::make_unique<ExactLister>(std::move(scene)); };
}

void bake(const scene::FlaggedMesh& scene, const scene::BakePlan& plan, scene::BakeStore& store,
          const ListerMaker& make_lister, BakeShard shard, const std::atomic<bool>& stop,
          const BakeProgress& progress) {
  Baker(scene, plan, store, make_lister, shard, stop, progress).run();
}

}  // namespace clues::app
