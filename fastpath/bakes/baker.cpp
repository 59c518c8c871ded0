// T6: a node's list is the scene of what is below it; a node without a box only brings neighbours together. Cells of a node are asked one after the other, each with the list of the one before as a guess; nodes side by side.
#include "fastpath/bakes/baker.h"

#include <tbb/task_group.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "exact/threads.h"
#include "fastpath/solids/shafts.h"
#include "fastpath/visibility/see_through.h"

namespace clues::fastpath::bakes {
namespace {

using Ids = std::vector<std::uint32_t>;
using scene::PlaceKind;

class FastLister : public CellLister {
 public:
  FastLister(scene::FlaggedMesh scene, std::uint64_t effort, std::shared_ptr<const solids::Solids> solids)
      : scene_(std::move(scene)), solids_(std::move(solids)) {
    options_.effort = effort;
    if (solids_) targets_.emplace(scene_.scene(), *solids_);
  }
  CellList list(const std::vector<scene::Point>& cell, std::span<const std::uint32_t> guess) const override {
    Ids bound;
    if (solids_) bound = solids::not_hidden(*solids_, *targets_, cell);
    const auto found = exact::by_threads(
        1, [&] { return fastpath::visible_through(scene_, cell, options_, guess, solids_ ? &bound : nullptr); });
    CellList out;
    out.visible = found.all();
    out.fallbacks = static_cast<std::int64_t>(found.conservative_fallbacks);
    out.mapped = static_cast<std::int64_t>(found.mapped);
    out.passes = static_cast<std::int64_t>(found.passes);
    return out;
  }

 private:
  fastpath::SeeThroughScene scene_;
  std::shared_ptr<const solids::Solids> solids_;  // none: nothing is proved beforehand
  std::optional<solids::Targets> targets_;
  LocalMapOptions options_;
};

class SolidLister : public CellLister {
 public:
  SolidLister(std::shared_ptr<const solids::Solids> solids, scene::FlaggedMesh scene)
      : scene_(std::move(scene)), solids_(std::move(solids)), targets_(scene_, *solids_) {}
  CellList list(const std::vector<scene::Point>& cell, std::span<const std::uint32_t> /*guess*/) const override {
    CellList out;
    out.visible = solids::not_hidden(*solids_, targets_, cell);
    out.fallbacks = static_cast<std::int64_t>(out.visible.size());
    return out;
  }

 private:
  scene::FlaggedMesh scene_;
  std::shared_ptr<const solids::Solids> solids_;
  solids::Targets targets_;
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

// What is known of places, and where goes what is found. Called by several threads.
class Places {
 public:
  virtual ~Places() = default;
  virtual bool has(PlaceKind kind, std::uint32_t index) const = 0;
  virtual std::optional<scene::BakedPlace> find(PlaceKind kind, std::uint32_t index) const = 0;
  virtual void keep(scene::BakeStore::Done done) = 0;
};

class PlacesOfAStore : public Places {
 public:
  PlacesOfAStore(scene::BakeStore& store, std::size_t cells, const BakeProgress& progress)
      : store_(store), progress_(progress) {
    for (std::uint32_t i = 0; i < cells; ++i) done_ += store.has(PlaceKind::cell, i) ? 1 : 0;
  }
  bool has(PlaceKind kind, std::uint32_t index) const override {
    const std::lock_guard lock(mutex_);
    return store_.has(kind, index);
  }
  std::optional<scene::BakedPlace> find(PlaceKind kind, std::uint32_t index) const override {
    const std::lock_guard lock(mutex_);
    return store_.find(kind, index);
  }
  void keep(scene::BakeStore::Done done) override {
    const std::lock_guard lock(mutex_);
    const bool is_cell = done.kind == PlaceKind::cell;
    store_.commit({std::move(done)});
    if (is_cell) progress_(++done_);
  }
  std::uint64_t done() const { return done_; }

 private:
  scene::BakeStore& store_;
  const BakeProgress& progress_;
  mutable std::mutex mutex_;
  std::uint64_t done_ = 0;
};

// Those of one piece, which one thread maps.
class PlacesInMemory : public Places {
 public:
  explicit PlacesInMemory(std::vector<scene::BakeStore::Done> known) : all_(std::move(known)), known_(all_.size()) {}
  bool has(PlaceKind kind, std::uint32_t index) const override { return at(kind, index) != all_.end(); }
  std::optional<scene::BakedPlace> find(PlaceKind kind, std::uint32_t index) const override {
    const auto found = at(kind, index);
    return found == all_.end() ? std::nullopt : std::optional(found->place);
  }
  void keep(scene::BakeStore::Done done) override { all_.push_back(std::move(done)); }
  std::vector<scene::BakeStore::Done> kept() && {
    all_.erase(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(known_));
    return std::move(all_);
  }

 private:
  std::vector<scene::BakeStore::Done>::const_iterator at(PlaceKind kind, std::uint32_t index) const {
    return std::find_if(all_.begin(), all_.end(), [&](const auto& d) { return d.kind == kind && d.index == index; });
  }

  std::vector<scene::BakeStore::Done> all_;
  std::size_t known_;
};

struct Below {
  Ids nodes, cells;
};

std::vector<Below> below_in(const scene::BakePlan& plan) {
  std::vector<Below> below(plan.nodes.size());
  for (std::uint32_t i = 1; i < plan.nodes.size(); ++i) below[plan.nodes[i].node].nodes.push_back(i);
  for (std::uint32_t i = 0; i < plan.cells.size(); ++i) below[plan.cells[i].node].cells.push_back(i);
  return below;
}

class Baker {
 public:
  Baker(const scene::FlaggedMesh& scene, const scene::BakePlan& plan, const std::vector<Below>& below, Places& places,
        const ListerMaker& make_lister, const std::atomic<bool>& stop)
      : scene_(scene), plan_(plan), below_(below), places_(places), make_lister_(make_lister), stop_(stop) {}

  // A piece that is not done.
  void map_piece(PlaceKind kind, std::uint32_t index, const std::shared_ptr<const Part>& whole,
                 tbb::task_group& tasks) {
    if (kind == PlaceKind::node) return map_node(index, whole, tasks);
    map_cell(index, *whole, {});
  }

 private:
  bool is_done(std::uint32_t node) const {
    return std::all_of(below_[node].cells.begin(), below_[node].cells.end(),
                       [&](std::uint32_t c) { return places_.has(PlaceKind::cell, c); }) &&
           std::all_of(below_[node].nodes.begin(), below_[node].nodes.end(),
                       [&](std::uint32_t n) { return is_done(n); });
  }

  void keep(PlaceKind kind, std::uint32_t index, const CellList& found, Ids list) {
    places_.keep({kind, index, {std::move(list), found.fallbacks, found.mapped, found.passes}});
  }

  void map_below(std::uint32_t node, const std::shared_ptr<const Part>& part, tbb::task_group& tasks) {
    for (const auto child : below_[node].nodes) {
      if (!is_done(child)) tasks.run([this, child, part, &tasks] { map_node(child, part, tasks); });
    }
    Ids guess;
    for (const auto cell : below_[node].cells) guess = map_cell(cell, *part, guess);
  }

  void map_node(std::uint32_t node, const std::shared_ptr<const Part>& part, tbb::task_group& tasks) {
    if (stop_ || is_done(node)) return;
    if (plan_.nodes[node].points.empty()) return map_below(node, part, tasks);
    Ids ids;
    if (auto there = places_.find(PlaceKind::node, node)) {
      ids = std::move(there->list);
    } else {
      const CellList found = part->list(plan_.nodes[node].points, {});
      ids = found.visible;
      keep(PlaceKind::node, node, found, ids);
    }
    auto lister = ids.empty() ? nullptr : make_lister_(scene::part_of(scene_, ids));
    map_below(node, std::make_shared<const Part>(Part{std::move(lister), std::move(ids)}), tasks);
  }

  // What is visible and counts: what the store gets, and the next one's guess, whether it was mapped now or found.
  Ids map_cell(std::uint32_t cell, const Part& part, const Ids& guess) {
    if (auto there = places_.find(PlaceKind::cell, cell)) return std::move(there->list);
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
  const std::vector<Below>& below_;
  Places& places_;
  const ListerMaker& make_lister_;
  const std::atomic<bool>& stop_;
};

void add_below(const std::vector<Below>& below, std::uint32_t node, BakePiece& piece) {
  piece.nodes.push_back(node);
  piece.cells.insert(piece.cells.end(), below[node].cells.begin(), below[node].cells.end());
  for (const auto child : below[node].nodes) add_below(below, child, piece);
}

}  // namespace

struct PieceBaker::Whole {
  const scene::FlaggedMesh& scene;
  const scene::BakePlan& plan;
  const ListerMaker& make_lister;
  std::vector<Below> below;
  std::shared_ptr<const Part> part;
};

PieceBaker::PieceBaker(const scene::FlaggedMesh& scene, const scene::BakePlan& plan, const ListerMaker& make_lister)
    : whole_(new Whole{scene, plan, make_lister, below_in(plan),
                       std::make_shared<const Part>(Part{make_lister(scene), {}})}) {}
PieceBaker::~PieceBaker() = default;

std::vector<scene::BakeStore::Done> PieceBaker::map(const BakePiece& piece,
                                                    std::vector<scene::BakeStore::Done> known) const {
  const std::atomic<bool> never{false};
  PlacesInMemory places(std::move(known));
  exact::by_threads(1, [&] {
    tbb::task_group tasks;
    Baker(whole_->scene, whole_->plan, whole_->below, places, whole_->make_lister, never)
        .map_piece(piece.kind, piece.index, whole_->part, tasks);
    tasks.wait();
  });
  return std::move(places).kept();
}

std::vector<BakePiece> pieces_of(const scene::BakePlan& plan) {
  std::vector<BakePiece> pieces;
  const auto below = below_in(plan);
  for (const auto node : below[0].nodes) {
    BakePiece piece{PlaceKind::node, node, {}, {}};
    add_below(below, node, piece);
    pieces.push_back(std::move(piece));
  }
  for (const auto cell : below[0].cells) pieces.push_back({PlaceKind::cell, cell, {}, {cell}});
  return pieces;
}

ListerMaker solid_lister(std::shared_ptr<const solids::Solids> solids) {
  return [solids = std::move(solids)](scene::FlaggedMesh scene) {
    return std::make_unique<SolidLister>(solids, std::move(scene));
  };
}

ListerMaker fast_lister(std::uint64_t effort, std::shared_ptr<const solids::Solids> solids) {
  return [effort, solids = std::move(solids)](scene::FlaggedMesh scene) {
    return std::make_unique<FastLister>(std::move(scene), effort, solids);
  };
}

void bake(const scene::FlaggedMesh& scene, const scene::BakePlan& plan, scene::BakeStore& store,
          const ListerMaker& make_lister, std::uint32_t shard, std::uint32_t shards, const std::atomic<bool>& stop,
          const BakeProgress& progress) {
  PlacesOfAStore places(store, plan.cells.size(), progress);
  if (places.done() == plan.cells.size()) return;
  const auto below = below_in(plan);
  Baker baker(scene, plan, below, places, make_lister, stop);
  const auto whole = std::make_shared<const Part>(Part{make_lister(scene), {}});
  tbb::task_group tasks;
  for (const auto& piece : pieces_of(plan)) {
    if (piece.index % shards != shard) continue;
    tasks.run([&baker, kind = piece.kind, index = piece.index, &whole, &tasks] {
      baker.map_piece(kind, index, whole, tasks);
    });
  }
  tasks.wait();
}

}  // namespace clues::fastpath::bakes
