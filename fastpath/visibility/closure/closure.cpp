#include "fastpath/visibility/closure/closure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "fastpath/visibility/closure/darkness.h"
#include "fastpath/visibility/closure/neighbours.h"
#include "fastpath/visibility/closure/open_part.h"
#include "fastpath/visibility/closure/sight_rays.h"

namespace clues::fastpath {
namespace {

// How many triangles whose proof failed are looked at before the map is made anew: as many as this, or as the map has, times two. (Of a scene behind a hole in K all proofs
// may fail.)
constexpr std::size_t kFailures = 512, kFailuresPerMapped = 2;
// So many come into any part at once, small as it may be: another map takes longer than theirs.
constexpr std::size_t kFewFailures = 128;
// How many triangles may come to a first part that already has as many: the map of a large level takes much longer than that of its half.
constexpr std::size_t kMostMissing = 2048;
// What is open is mapped alone where that takes no more of K than this, in hundredths: its light, which less of K stops, goes astray.
constexpr std::int64_t kOpenPercent = 60;
constexpr int kOpenTries = 32;  // sight lines to each triangle of K, which may tell that it is visible

std::vector<std::uint32_t> mapped_of(const Closure& closure) { return fastpath::mapped_of(closure.part, closure.dark); }

class Closer {
 public:
  Closer(const Bvh& bvh, const Cell& cell, std::size_t whole, const exact::Dials& dials,
         std::span<const std::uint8_t> counting, Wanted wanted)
      : bvh_(bvh),
        cell_(cell),
        takes_halves_(whole > 0),
        failures_(dials.batch),
        open_percent_(dials.open_percent == exact::Dials::kOwn ? kOpenPercent : dials.open_percent),
        open_tries_(dials.sight_tries(kOpenTries)),
        keeps_rays_(wanted == Wanted::list),
        counting_(counting),
        rays_(bvh, cell, dials.sight_rays),
        proved_(bvh),
        in_part_(bvh.mesh().triangles.size(), 0),
        is_dark_(in_part_.size(), 0),
        seen_(in_part_.size(), 0),
        looked_into_(in_part_.size(), 0) {}

  // Whether the part may grow by it. What has left it is dark and never comes back, though a ray that begins beside the cell by a rounding meets it: so each pass has what none had before, but for the first one of a stage.
  bool is_new(std::uint32_t triangle) const {
    return in_part_[triangle] == 0 && proved_.triangles[triangle] == 0 && (all_may_come() || counts_in_list(triangle));
  }
  // False if it is not.
  bool add(std::uint32_t triangle) {
    if (!is_new(triangle)) return false;
    in_part_[triangle] = 1;
    part_.push_back(triangle);
    return true;
  }
  // Whether K is what it was in this closure.
  bool is_part_of(const Closure& closure) const { return part_ == mapped_of(closure); }
  PartStage stage() const { return stage_; }
  std::uint64_t rays() const { return rays_.count(); }
  void add_all();
  void add_triangles_by_the_cell();
  void add_seen_by_rays();
  void add_neighbours_in_sight();
  // A part that holds half of what counts becomes all of that, and its map is made in the stage that follows the first.
  void begin_with_all_if_half();

  // The part, with what is known to be dark and divides what is around its vertices.
  ScenePart scene_part();
  // After add_what_may_be_lit: what of K is open, where all that is not known to be dark is in the part now, and little of K is on the way there.
  std::optional<OpenPart> open_part(const Closure& closure) const;
  // Tries to prove every triangle outside the part dark; adds what is in the way of that, and drops what is dark. False: nothing is in the way, and another map would tell nothing new.
  bool add_what_may_be_lit(const PartialMap& map, const std::vector<std::uint32_t>& visible);
  // After a map is given up: on to the next stage (closure.h). False: there is none.
  bool begin_again(const Closure& closure);
  // All triangles outside the part of this closure for which its map gives no proof, ascending; all, if it has none.
  std::vector<std::uint32_t> unproved_by(const Closure& closure);

  ClosureCounts counts;

 private:
  bool all_may_come() const { return stage_ != PartStage::rest && stage_ != PartStage::least; }
  bool counts_in_list(std::uint32_t triangle) const { return counting_.empty() || counting_[triangle] != 0; }
  void set_part(std::vector<std::uint32_t> part);
  bool take_all_that_counts(const Closure& closure);
  std::size_t count_missing() const;  // of those that count
  void add_all_that_count();
  void add_those_that_count(const std::vector<std::uint32_t>& triangles);
  // Which a ray has met; as add().
  bool add_seen(std::uint32_t triangle);
  template <class RayOf>
  bool add_seen(std::uint32_t triangle, const RayOf& ray);
  void add_seen_beside(std::vector<std::uint32_t> triangles);
  // Adds what sight lines to the triangles meet first; else the triangles themselves.
  void add_front_of(const std::vector<std::uint32_t>& triangles);
  // Takes hidden triangles out of the part, which are dark for good.
  std::vector<std::uint32_t> taken_out(const Darkness& darkness, const std::vector<std::uint32_t>& visible);
  // Of triangles that are dark, keeps those that wedges touch beside the part. False: no others than before.
  bool keep_beside(const std::vector<std::uint32_t>& dark, const PartialMap& map);

  const Bvh& bvh_;
  const Cell& cell_;
  bool takes_halves_;
  std::size_t failures_;  // a dial; 0: our own number
  std::int64_t open_percent_;
  int open_tries_;
  bool keeps_rays_;
  std::span<const std::uint8_t> counting_;  // none: all do
  SightRays rays_;
  ProvedDark proved_;
  std::vector<std::uint8_t> in_part_;
  std::vector<std::uint8_t> is_dark_;             // and next to the part, or was
  std::vector<std::uint8_t> seen_, looked_into_;  // by a ray; as a listed triangle that none has seen
  FirstRays first_rays_;
  std::vector<std::uint32_t> part_;
  std::vector<std::uint32_t> given_up_;  // the first whose map was, or that became all that counts before it was made
  PartStage stage_ = PartStage::grown;
  bool all_came_in_ = false;  // what the last map gave no proof of, if it counts
};

void Closer::add_all() {
  for (std::uint32_t t = 0; t < in_part_.size(); ++t) add(t);
}

// D3: what meets the cell is visible. All whose boxes do: too many does no harm.
void Closer::add_triangles_by_the_cell() {
  const Box cell = scene::bounds_of(cell_.vertices());
  std::vector<std::uint32_t> nodes{0};
  while (!nodes.empty() && !bvh_.nodes().empty()) {
    const BoxLanes& node = bvh_.nodes()[nodes.back()];
    nodes.pop_back();
    for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane) {
      const std::uint32_t child = node.child[lane];
      if (child == BoxLanes::kEmpty || !touch(cell, bvh_.child_bounds(node, lane))) continue;
      if ((child & BoxLanes::kLeaf) == 0) {
        nodes.push_back(child);
        continue;
      }
      for (const std::uint32_t t : bvh_.blocks()[child & ~BoxLanes::kLeaf].id) {
        if (touch(cell, scene::bounds_of(bvh_.corners(t)))) add(t);
      }
    }
  }
  if (part_.empty()) rays_.cell_is_empty();
}

void Closer::add_seen_by_rays() {
  add_seen_beside(part_);
  rays_.look_around([this](std::uint32_t t, const auto& ray) { return add_seen(t, ray); });
}

void Closer::add_seen_beside(std::vector<std::uint32_t> triangles) {
  rays_.look_beside(std::move(triangles), [this](std::uint32_t t, const auto& ray) { return add_seen(t, ray); });
}

bool Closer::add_seen(std::uint32_t triangle) {
  seen_[triangle] = 1;
  return add(triangle);
}

template <class RayOf>
bool Closer::add_seen(std::uint32_t triangle, const RayOf& ray) {
  if (keeps_rays_ && !first_rays_.contains(triangle) && cell_.surely_holds_inside(ray().a))
    first_rays_.emplace(triangle, ray());
  return add_seen(triangle);
}

// They are seen as well, unless something is in front. Rays miss many of them where little can be seen of each.
void Closer::add_neighbours_in_sight() {
  add_those_that_count(neighbours_in_sight(bvh_.mesh(), part_, middle_of(scene::bounds_of(cell_.vertices()))));
}

void Closer::add_those_that_count(const std::vector<std::uint32_t>& triangles) {
  for (const std::uint32_t t : triangles) {
    if (counts_in_list(t)) add(t);
  }
}

void Closer::begin_with_all_if_half() {
  const std::size_t missing = count_missing();
  if (!takes_halves_ || missing == 0 || missing > std::min(part_.size(), kMostMissing)) return;
  given_up_ = part_;
  add_all_that_count();
  stage_ = PartStage::all;
}

ScenePart Closer::scene_part() {
  std::sort(part_.begin(), part_.end());
  return marked_part(bvh_, {in_part_, is_dark_});
}

std::optional<OpenPart> Closer::open_part(const Closure& closure) const {
  if (!all_came_in_ || open_percent_ == 0 || closure.map->has_fallbacks()) return std::nullopt;
  std::vector<std::uint32_t> asked = closure.visible;
  std::copy_if(part_.begin(), part_.end(), std::back_inserter(asked), [&](std::uint32_t t) {
    const auto before = std::lower_bound(closure.part.begin(), closure.part.end(), t);
    return before == closure.part.end() || *before != t;
  });
  std::sort(asked.begin(), asked.end());
  return fastpath::open_part(bvh_, cell_, {in_part_, is_dark_}, asked, first_rays_, open_tries_,
                             part_.size() * static_cast<std::size_t>(open_percent_) / 100);
}

void Closer::add_front_of(const std::vector<std::uint32_t>& triangles) {
  const std::vector<std::uint32_t> met = rays_.towards(triangles);
  std::vector<std::uint32_t> seen, added;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto first = met.begin() + static_cast<std::ptrdiff_t>(i * SightRays::kTowards);
    bool fresh = false;
    for (const std::uint32_t t : std::span(first, SightRays::kTowards)) {
      if (t == SightRays::kNothing) continue;
      seen.push_back(t);
      fresh = fresh || is_new(t);
    }
    if (!fresh) add(triangles[i]);
  }
  std::copy_if(seen.begin(), seen.end(), std::back_inserter(added), [&](std::uint32_t t) { return add_seen(t); });
  add_seen_beside(std::move(added));
}

std::vector<std::uint32_t> Closer::taken_out(const Darkness& darkness, const std::vector<std::uint32_t>& visible) {
  std::vector<std::uint32_t> out;
  std::erase_if(part_, [&](std::uint32_t t) {
    if (std::binary_search(visible.begin(), visible.end(), t) || darkness.is_edge_on(bvh_.corners(t))) return false;
    in_part_[t] = 0;
    proved_.triangles[t] = 1;
    out.push_back(t);
    return true;
  });
  return out;
}

bool Closer::keep_beside(const std::vector<std::uint32_t>& dark, const PartialMap& map) {
  std::vector<std::uint8_t> is_other(dark.size(), 0);
  tbb::parallel_for(std::size_t{0}, dark.size(), [&](std::size_t i) {
    is_other[i] = is_dark_[dark[i]] == 0 && map.piece_may_touch(bvh_.corners(dark[i])) ? 1 : 0;
  });
  for (std::size_t i = 0; i < dark.size(); ++i) {
    if (is_other[i] != 0) is_dark_[dark[i]] = 1;
  }
  return std::find(is_other.begin(), is_other.end(), 1) != is_other.end();
}

bool Closer::add_what_may_be_lit(const PartialMap& map, const std::vector<std::uint32_t>& visible) {
  const Darkness darkness(map, bvh_, part_, visible, cell_.vertices());
  const auto in_list = [this](std::uint32_t t) { return counts_in_list(t); };
  const std::size_t enough = failures_ > 0 ? failures_ : std::max(kFailures, kFailuresPerMapped * part_.size());
  std::vector<std::uint32_t> dark;
  const std::vector<std::uint32_t> failed = darkness.not_proved(
      bvh_, [&](std::uint32_t t) { return in_part_[t] != 0 || is_dark_[t] != 0; }, in_list, enough, proved_, counts,
      &dark);
  std::vector<std::uint32_t> open;
  std::copy_if(failed.begin(), failed.end(), std::back_inserter(open), in_list);
  const bool none_beside = std::find(is_dark_.begin(), is_dark_.end(), 1) == is_dark_.end();
  const bool others_beside = keep_beside(dark, map);
  keep_beside(taken_out(darkness, visible), map);
  all_came_in_ = failures_ == 0 && failed.size() < enough;
  // Without what divides its vertices a map may have too much; where rays have seen all of it, it does not.
  if (open.empty())
    return none_beside && others_beside &&
           std::any_of(visible.begin(), visible.end(), [this](std::uint32_t t) { return seen_[t] == 0; });
  if (open.size() < failed.size()) {
    std::vector<std::uint32_t> asked = open;
    for (const std::uint32_t t : visible) {
      if (!counts_in_list(t) || seen_[t] != 0 || looked_into_[t] != 0) continue;
      looked_into_[t] = 1;
      asked.push_back(t);
    }
    const std::vector<std::uint8_t> in_the_way = rays_.met_towards(asked);
    for (const std::uint32_t t : failed) {
      if (in_the_way[t] != 0) add(t);
    }
  }
  if (failures_ > 0) open.resize(std::min(open.size(), failures_));
  // What is in front may hide the others; where few failed another map to tell costs more than they do.
  const bool few = failures_ == 0 && open.size() <= std::max(kFewFailures, kFailuresPerMapped * part_.size());
  all_came_in_ = all_came_in_ && few;
  add_front_of(open);
  if (failures_ > 0) return true;
  if (few) {
    for (const std::uint32_t t : open) add(t);
  }
  // Where all were asked about, all others are dark: those next to the part will be touched.
  if (failed.size() < enough) {
    const std::set<std::uint32_t> not_dark(failed.begin(), failed.end());
    for (const std::uint32_t t : neighbours_of(bvh_.mesh(), part_)) {
      if (!not_dark.contains(t) && !darkness.is_edge_on(bvh_.corners(t))) is_dark_[t] = 1;
    }
  }
  return true;
}

void Closer::set_part(std::vector<std::uint32_t> part) {
  part_ = std::move(part);
  std::fill(in_part_.begin(), in_part_.end(), std::uint8_t{0});
  for (const std::uint32_t t : part_) in_part_[t] = 1;
}

bool Closer::begin_again(const Closure& closure) {
  if (stage_ == PartStage::grown) {
    given_up_ = part_;
    stage_ = take_all_that_counts(closure) ? PartStage::all : PartStage::again;
    return true;
  }
  const bool all_count = std::find(counting_.begin(), counting_.end(), 0) == counting_.end();
  if (!all_may_come() || (stage_ == PartStage::again && closure.map && all_count)) return false;
  std::vector<std::uint32_t> part = closure.map && !all_count ? mapped_of(closure) : given_up_;
  if (!closure.map) std::erase_if(part, [this](std::uint32_t t) { return !counts_in_list(t); });
  set_part(std::move(part));
  stage_ = closure.map ? PartStage::rest : PartStage::least;
  return true;
}

// The part of the map before, or, if there is none, this one, and all that counts. False: that is too much, or it is this part.
bool Closer::take_all_that_counts(const Closure& closure) {
  const std::size_t missing = count_missing();
  if (missing == 0 || missing > kAllForPart * std::max(part_.size(), kLeastAll)) return false;
  if (closure.map) set_part(mapped_of(closure));
  add_all_that_count();
  return true;
}

std::size_t Closer::count_missing() const {
  std::size_t missing = 0;
  for (std::uint32_t t = 0; t < in_part_.size(); ++t) missing += counts_in_list(t) && is_new(t) ? 1 : 0;
  return missing;
}

void Closer::add_all_that_count() {
  for (std::uint32_t t = 0; t < in_part_.size(); ++t) {
    if (counts_in_list(t)) add(t);
  }
}

// Triangles of the tree for which the closure's map gives no proof, but for those that are skipped or proved before; all, if it has no map. Ascending.
std::vector<std::uint32_t> not_proved_by(const Closure& closure, const Bvh& scene, const Cell& cell, const Bvh& tree,
                                         const Darkness::Which& skip, ProvedDark& proved, ClosureCounts& figures) {
  const std::size_t all = tree.mesh().triangles.size();
  std::vector<std::uint32_t> left;
  if (!closure.map) {
    left.resize(all);
    std::iota(left.begin(), left.end(), 0U);
    return left;
  }
  const Darkness darkness(*closure.map, scene, closure.part, closure.visible, cell.vertices());
  left = darkness.not_proved(
      tree, skip, [](std::uint32_t) { return true; }, all, proved, figures);
  std::sort(left.begin(), left.end());
  return left;
}

std::vector<std::uint32_t> Closer::unproved_by(const Closure& closure) {
  const auto in_its_part = [&](std::uint32_t t) {
    return std::binary_search(closure.part.begin(), closure.part.end(), t);
  };
  return not_proved_by(closure, bvh_, cell_, bvh_, in_its_part, proved_, counts);
}

// Ends the loop by a map of what is open, if there is little of that. False: nothing has changed.
bool settle_by_open_part(Closer& closer, const PartialMapMaker& make_map, Closure& result) {
  auto open = closer.open_part(result);
  if (!open) return false;
  ++closer.counts.passes;
  auto map = make_map(open->part, closer.stage());
  if (!map || map->has_fallbacks()) return false;
  closer.counts.settled = open->visible.size();
  result.map = std::move(map);
  result.visible = std::move(open->visible);
  for (const std::uint32_t i : result.map->visible()) {
    const std::uint32_t t = open->part.ids[i];
    if (std::binary_search(open->open.begin(), open->open.end(), t)) result.visible.push_back(t);
  }
  std::sort(result.visible.begin(), result.visible.end());
  ScenePart part = closer.scene_part();
  result.part = std::move(part.ids);
  result.dark = std::move(part.dark);
  return true;
}

}  // namespace

std::vector<std::uint32_t> not_proved_dark(const Bvh& others, const Closure& closure, const Bvh& scene,
                                           const Cell& cell) {
  ClosureCounts uncounted;
  ProvedDark proved(others);
  return not_proved_by(
      closure, scene, cell, others, [](std::uint32_t) { return false; }, proved, uncounted);
}

std::vector<std::uint32_t> mapped_of(std::span<const std::uint32_t> ids, std::span<const std::uint8_t> dark) {
  std::vector<std::uint32_t> mapped;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (dark[i] == 0) mapped.push_back(ids[i]);
  }
  return mapped;
}

Closure close_over_visible(const Bvh& bvh, const Cell& cell, const PartialMapMaker& make_map, std::size_t whole,
                           const exact::Dials& dials, std::span<const std::uint32_t> guess,
                           std::span<const std::uint8_t> counting, Wanted wanted) {
  using FirstGuess = exact::Dials::FirstGuess;
  Closer closer(bvh, cell, whole, dials, counting, wanted);
  const bool small = dials.first_guess == FirstGuess::seen && bvh.mesh().triangles.size() <= whole;
  if (small || dials.first_guess == FirstGuess::everything) {
    closer.add_all();
  } else if (!bvh.nodes().empty()) {
    closer.add_triangles_by_the_cell();
    for (const auto t : guess) closer.add(t);
    if (dials.first_guess == FirstGuess::seen) {
      closer.add_seen_by_rays();
      closer.add_neighbours_in_sight();
      closer.begin_with_all_if_half();
    }
  }
  Closure result;
  for (bool grown = true; grown;) {
    ++closer.counts.passes;
    ScenePart part = closer.scene_part();
    if (auto map = make_map(part, closer.stage())) {
      result.map = std::move(map);
      result.part = std::move(part.ids);
      result.dark = std::move(part.dark);
      result.visible.clear();
      for (const std::uint32_t i : result.map->visible()) result.visible.push_back(result.part[i]);
    } else if (!closer.begin_again(result)) {
      result.unproved = closer.unproved_by(result);
      break;
    } else if (!result.map || !closer.is_part_of(result)) {
      continue;
    }
    grown = result.part.size() < bvh.mesh().triangles.size() && !bvh.nodes().empty() &&
            closer.add_what_may_be_lit(*result.map, result.visible);
    if (grown && wanted == Wanted::list) grown = !settle_by_open_part(closer, make_map, result);
  }
  result.counts = closer.counts;
  result.counts.mapped = mapped_of(result).size();
  result.counts.rays = closer.rays();
  return result;
}

}  // namespace clues::fastpath
