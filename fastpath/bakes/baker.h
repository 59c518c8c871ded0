// Maps all cells of a bake, whatever of it is not in its store yet.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "fastpath/solids/solids.h"
#include "scene/bakes/bake_store.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::fastpath::bakes {

// What one cell sees in a scene: ids of the scene, ascending, of triangles that count and of those that only block.
struct CellList {
  std::vector<std::uint32_t> visible;
  std::int64_t fallbacks = 0, mapped = 0, passes = 0;
};

// A scene that was made ready for many cells.
class CellLister {
 public:
  CellLister() = default;
  CellLister(const CellLister&) = delete;
  CellLister& operator=(const CellLister&) = delete;
  virtual ~CellLister() = default;
  // By one thread. `guess`: ids that are likely among the answer, for speed. Several threads may ask at once.
  virtual CellList list(const std::vector<scene::Point>& cell, std::span<const std::uint32_t> guess) const = 0;
};
using ListerMaker = std::function<std::unique_ptr<CellLister>(scene::FlaggedMesh scene)>;

// `effort`: LocalMapOptions. `solids`: if there are any, cells are mapped for what these do not hide (T15).
ListerMaker fast_lister(std::uint64_t effort, std::shared_ptr<const solids::Solids> solids = nullptr);

// What these do not hide (T15); only triangles that count are listed, and each as a fallback.
ListerMaker solid_lister(std::shared_ptr<const solids::Solids> solids);

// Called after each commit with how many cells are done.
using BakeProgress = std::function<void(std::uint64_t cells)>;

// A part of a bake that needs nothing of the others: a node of the root with all that is below it, or a cell of the root.
struct BakePiece {
  scene::PlaceKind kind = scene::PlaceKind::cell;
  std::uint32_t index = 0;
  std::vector<std::uint32_t> nodes, cells;  // all of it
};
std::vector<BakePiece> pieces_of(const scene::BakePlan& plan);

// `plan` is what the store was made with. Once `stop` is set, what is begun is finished and nothing else is begun. Of the pieces those are done whose
// number leaves `shard` when divided by `shards`. Lists do not depend on the number of threads, nor on what was there already. Throws what kernels and the store throw; what was
// committed stays.
void bake(const scene::FlaggedMesh& scene, const scene::BakePlan& plan, scene::BakeStore& store,
          const ListerMaker& make_lister, std::uint32_t shard, std::uint32_t shards, const std::atomic<bool>& stop,
          const BakeProgress& progress);

// The same, a piece at a time, away from the store.
class PieceBaker {
 public:
  PieceBaker(const scene::FlaggedMesh& scene, const scene::BakePlan& plan, const ListerMaker& make_lister);
  ~PieceBaker();
  PieceBaker(const PieceBaker&) = delete;
  PieceBaker& operator=(const PieceBaker&) = delete;
  // What is not among `known`, by one thread. Several may ask at once.
  std::vector<scene::BakeStore::Done> map(const BakePiece& piece, std::vector<scene::BakeStore::Done> known) const;

 private:
  struct Whole;
  std::unique_ptr<const Whole> whole_;
};

}  // namespace clues::fastpath::bakes
