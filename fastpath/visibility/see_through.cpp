#include "fastpath/visibility/see_through.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "exact/cell/standard_range.h"
#include "exact/sight/scene_query.h"
#include "exact/threads.h"
#include "fastpath/visibility/engine_part.h"

namespace clues::fastpath {
namespace {

// T: what counts and does not block.
std::vector<std::uint32_t> passing_ids(const scene::FlaggedMesh& scene) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    if (!scene.blocking(t) && scene.counting(t)) ids.push_back(t);
  }
  return ids;
}

// Those of T that meet the cell, which no proof has to be asked about (D3).
std::vector<std::uint32_t> meeting_the_cell(const Bvh& passing, const std::vector<Point>& points) {
  std::vector<std::uint32_t> met;
  const auto cell = exact::ConvexCell::from_doubles(points);
  const scene::Bounds about = scene::bounds_of(points);
  for (std::uint32_t t = 0; t < passing.mesh().triangles.size(); ++t) {
    const Corners c = passing.corners(t);
    const auto exactly = [](const Point& p) { return exact::Point3(p[0], p[1], p[2]); };
    if (scene::touch(scene::bounds_of(c), about) &&
        exact::meets_cell({exactly(c[0]), exactly(c[1]), exactly(c[2])}, cell))
      met.push_back(t);
  }
  return met;
}

SeeThroughList list_in_range(const SeeThroughScene& scene, const std::vector<Point>& cell,
                             const LocalMapOptions& options, std::span<const std::uint32_t> guess,
                             const std::vector<std::uint32_t>* bound) {
  const auto in_bound = [bound](std::uint32_t id) {
    return bound == nullptr || std::binary_search(bound->begin(), bound->end(), id);
  };
  const auto all_that_count = scene.blocking_that_count();
  std::vector<std::uint8_t> counting(all_that_count.begin(), all_that_count.end());
  for (std::uint32_t t = 0; t < counting.size(); ++t) {
    if (!in_bound(scene.blocking_id(t))) counting[t] = 0;
  }
  std::vector<std::uint32_t> guessed;
  for (const auto t : guess) {
    if (const auto at = scene.find_blocking(t)) guessed.push_back(*at);
  }
  exact::CutMemories::Loan cuts(scene.cuts_of_blocking());
  const ClosedScene closed = close_by_engine(scene.blocking(), cell, options,
                                             scene::hull_of(outside_of(scene.blocking()), outside_of(scene.passing())),
                                             cuts.memory(), guessed, counting);
  SeeThroughList list;
  const LocalMap* map = closed.map();
  std::vector<std::uint32_t> listed = closed.closure.unproved;
  if (map) {
    for (const auto t : map->visible()) listed.push_back(closed.closure.part[t]);
  }
  std::sort(listed.begin(), listed.end());
  for (const auto t : listed) {
    if (counting[t] != 0 || all_that_count[t] == 0) list.blocking.push_back(scene.blocking_id(t));
  }
  auto passing = not_proved_dark(scene.passing(), closed.closure, scene.blocking(), Cell(cell));
  const auto met = meeting_the_cell(scene.passing(), cell);
  std::vector<std::uint32_t> all;
  std::set_union(passing.begin(), passing.end(), met.begin(), met.end(), std::back_inserter(all));
  for (const auto t : all) {
    if (in_bound(scene.passing_id(t))) list.passing.push_back(scene.passing_id(t));
  }
  list.mapped = closed.closure.counts.mapped;
  list.passes = closed.closure.counts.passes;
  list.walks = map ? map->counts().walks : 0;
  list.conservative_fallbacks = closed.fallbacks();
  return list;
}

}  // namespace

SeeThroughScene::SeeThroughScene(scene::FlaggedMesh scene)
    : scene_(std::move(scene)),
      blocking_ids_(scene::blocking_ids(scene_)),
      passing_ids_(passing_ids(scene_)),
      blocking_(scene::part_of(scene_.mesh, blocking_ids_)),
      passing_(scene::part_of(scene_.mesh, passing_ids_)),
      blocking_tree_(blocking_),
      passing_tree_(passing_) {
  for (const std::uint32_t t : blocking_ids_) counting_.push_back(scene_.counting(t) ? 1 : 0);
}

std::optional<std::uint32_t> SeeThroughScene::find_blocking(std::uint32_t id) const {
  const auto at = std::lower_bound(blocking_ids_.begin(), blocking_ids_.end(), id);
  if (at == blocking_ids_.end() || *at != id) return std::nullopt;
  return static_cast<std::uint32_t>(at - blocking_ids_.begin());
}

std::vector<std::uint32_t> SeeThroughList::all() const {
  std::vector<std::uint32_t> ids;
  std::merge(blocking.begin(), blocking.end(), passing.begin(), passing.end(), std::back_inserter(ids));
  return ids;
}

std::vector<std::uint32_t> SeeThroughList::counting(const scene::FlaggedMesh& scene) const {
  auto ids = all();
  std::erase_if(ids, [&](std::uint32_t t) { return !scene.counting(t); });
  return ids;
}

SeeThroughList visible_through(const SeeThroughScene& scene, const std::vector<Point>& cell,
                               const LocalMapOptions& options, std::span<const std::uint32_t> guess,
                               const std::vector<std::uint32_t>* bound) {
  return exact::by_dialed_threads(options.dials.threads, [&] {
    const exact::StandardRange range(scene.scene().mesh, cell);
    if (!range.moves()) return list_in_range(scene, cell, options, guess, bound);
    scene::FlaggedMesh moved = scene.scene();
    moved.mesh = range.moved_in(moved.mesh);
    return list_in_range(SeeThroughScene(std::move(moved)), range.moved_in(cell), options, guess, bound);
  });
}

}  // namespace clues::fastpath
