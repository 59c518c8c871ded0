#include "reference/streams/list_store.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "reference/delta/delta.h"
#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using scene::ListPlace;
using scene::ListRecord;
using Kind = ListRecord::Kind;
using Ids = std::vector<std::uint32_t>;

constexpr std::uint32_t siblings_tried = 64;
constexpr std::uint64_t most_triangles = std::uint64_t{1} << 28;  // that are gone over, those of all lists among them

bool holds(const Ids& large, const Ids& small) {
  return std::includes(large.begin(), large.end(), small.begin(), small.end());
}

Ids without(const Ids& a, const Ids& b) {
  Ids out;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

// What is in one of them.
Ids either(const Ids& a, const Ids& b) {
  Ids out;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

Ids both(const Ids& a, const Ids& b) {
  Ids out;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

// A way to say a list, what it takes, and what it is decoded to.
struct Said {
  ListRecord record;
  std::size_t bytes = 0;
  Ids list;
};

// One level, place by place.
class LevelMaker {
 public:
  // `around`: the lists of the level above, as they are decoded; none above the first.
  LevelMaker(const EdgeUsers& edges, const AreaWorth& worth, const exact::FT& area_of_a_byte,
             const std::vector<Ids>& around)
      : floods_(edges), worth_(worth), area_of_a_byte_(area_of_a_byte), around_(around) {}

  void add(std::uint32_t within, const Ids& wanted) {
    place_ = static_cast<std::uint32_t>(places_.size());
    wanted_ = &wanted;
    best_.reset();
    loose_.clear();
    consider({Kind::list, 0, wanted, {}}, wanted);
    if (!around_.empty()) consider_within(around_[within]);
    for (std::uint32_t j = place_ - std::min(place_, siblings_tried); j < place_; ++j) consider_sibling(j, within);
    take_loose();
    places_.push_back({within, best_->record});
    if (!around_.empty()) {
      const bool is_exact = best_->list.size() == wanted.size();
      contours_.push_back(is_exact ? contour_ : floods_.contour(around_[within], best_->list));
    }
    lists_.push_back(std::move(best_->list));
  }

  std::vector<ListPlace> places_;
  std::vector<Ids> lists_;

 private:
  void consider(ListRecord record, const Ids& list) {
    const std::size_t bytes = scene::record_bytes(record, place_).size();
    if (list.size() > wanted_->size()) {
      if (area_of_a_byte_ > 0) loose_.push_back({std::move(record), bytes, list});
    } else if (!best_ || bytes < best_->bytes) {
      best_ = Said{std::move(record), bytes, list};
    }
  }
  void consider_within(const Ids& known) {
    consider({Kind::all, 0, {}, {}}, known);
    consider({Kind::goes, 0, without(known, *wanted_), {}}, *wanted_);
    contour_ = floods_.contour(known, *wanted_);
    consider({Kind::contour, 0, contour_.seeds, contour_.boundary}, *wanted_);
  }
  void consider_sibling(std::uint32_t j, std::uint32_t within) {
    const DeltaPackets packets = packets_of(lists_[j], *wanted_);
    consider({Kind::delta, j, packets.plus, packets.minus}, *wanted_);
    if (places_[j].within != within) return;
    if (packets.plus.empty()) consider({Kind::same, j, {}, {}}, lists_[j]);
    if (around_.empty()) return;
    consider({Kind::changed, j, either(contours_[j].seeds, contour_.seeds),
              either(contours_[j].boundary, contour_.boundary)},
             *wanted_);
  }
  // Of those that list too much the one that saves most, if what it gives up is worth that; of equal ones the least.
  void take_loose() {
    const std::size_t exact_bytes = best_->bytes;
    std::optional<exact::FT> given_up;
    for (Said& said : loose_) {
      if (said.bytes > best_->bytes || (said.bytes == best_->bytes && !given_up)) continue;
      const auto area = worth_.area_of(without(said.list, *wanted_));
      if (!area || *area > area_of_a_byte_ * exact::FT(static_cast<double>(exact_bytes - said.bytes))) continue;
      if (said.bytes == best_->bytes && *area >= *given_up) continue;
      given_up = area;
      best_ = std::move(said);
    }
  }

  ListFloods floods_;
  const AreaWorth& worth_;
  const exact::FT& area_of_a_byte_;
  const std::vector<Ids>& around_;
  std::vector<ListContour> contours_;  // of each place within what is around it
  // Of the place that is added:
  std::uint32_t place_ = 0;
  const Ids* wanted_ = nullptr;
  ListContour contour_;
  std::optional<Said> best_;
  std::vector<Said> loose_;
};

class LevelReader {
 public:
  // `floods`, of these edges, and `gone_over` are those of all levels.
  LevelReader(const EdgeUsers& edges, ListFloods& floods, const std::vector<Ids>& around,
              const std::vector<ListPlace>& places, std::uint64_t& gone_over)
      : edges_(edges), floods_(floods), around_(around), places_(places), gone_over_(gone_over) {}

  std::vector<Ids> read() {
    for (const ListPlace& place : places_) {
      // Besides these, a record takes no longer than it has bytes: the list that it refers to lies in that around it
      // (changed), or is its own, but for triangles that it names (same, delta).
      if (!around_.empty()) go_over(around_[place.within]);
      lists_.push_back(list_of(place));
      go_over(lists_.back());
    }
    return std::move(lists_);
  }

 private:
  void go_over(const Ids& list) {
    gone_over_ += list.size();
    if (gone_over_ > most_triangles)
      throw scene::Error(scene::ErrorCode::unsupported, "the lists of a file go over more than 2^28 triangles in all");
  }
  void require(bool fits, const char* what) const {
    if (fits) return;
    throw scene::Error(scene::ErrorCode::malformed,
                       "list " + std::to_string(lists_.size()) + " of a level of the file: " + what);
  }

  Ids list_of(const ListPlace& place) {
    const ListRecord& r = place.record;
    if (r.kind == Kind::list) return inside(r.first, place);
    if (r.kind == Kind::delta) {
      require(holds(lists_[r.of], r.second), "takes away what is not there");
      require(without(r.first, lists_[r.of]).size() == r.first.size(), "brings what is there");
      return inside(both(without(lists_[r.of], r.second), r.first), place);
    }
    if (r.kind == Kind::same || r.kind == Kind::changed)
      require(places_[r.of].within == place.within, "is that of a place within another one");
    if (r.kind == Kind::same) return lists_[r.of];
    require(!around_.empty(), "is said to be within a list that there is not");
    const Ids& known = around_[place.within];
    if (r.kind == Kind::all) return known;
    if (r.kind == Kind::goes) {
      require(holds(known, r.first), "takes away what is not there");
      return without(known, r.first);
    }
    ListContour contour{r.first, r.second};
    require(r.second.empty() || r.second.back() < edges_.edge_count(), "names an edge that the scene does not have");
    if (r.kind == Kind::changed) {
      const ListContour other = floods_.contour(known, lists_[r.of]);
      contour = {either(other.seeds, r.first), either(other.boundary, r.second)};
    }
    require(holds(known, contour.seeds), "begins outside of what is known");
    Ids list = floods_.list(known, contour);
    require(floods_.contour(known, list) == contour, "has a contour that is not the one that its triangles have");
    return list;
  }
  // A list lies in that around it: what follows for cells below rests on it.
  Ids inside(Ids list, const ListPlace& place) const {
    require(list.empty() || list.back() < edges_.triangle_count(), "names a triangle that the scene does not have");
    require(around_.empty() || holds(around_[place.within], list), "has more than what it is within");
    return list;
  }

  const EdgeUsers& edges_;
  ListFloods& floods_;
  const std::vector<Ids>& around_;
  const std::vector<ListPlace>& places_;
  std::uint64_t& gone_over_;
  std::vector<Ids> lists_;
};

}  // namespace

std::vector<std::vector<ListPlace>> made_levels(const EdgeUsers& edges, const AreaWorth& worth,
                                                const std::vector<Ids>& lists, const CellTree& tree,
                                                const ListStoreOptions& options) {
  std::vector<std::vector<ListPlace>> out;
  std::vector<Ids> around;
  std::vector<std::uint32_t> above(lists.size(), 0);  // of each cell, its node on the level before
  Ids cells(lists.size());
  std::iota(cells.begin(), cells.end(), 0U);
  for (std::size_t i = 0; i <= options.levels.size(); ++i) {
    const bool is_last = i == options.levels.size();
    const auto& node_of = is_last ? cells : tree.node_of[options.levels[i]];
    const std::vector<Ids> wanted = lists_of_nodes(node_of, lists);
    Ids within(wanted.size(), 0);
    for (std::size_t c = 0; c < lists.size(); ++c) within[node_of[c]] = above[c];
    LevelMaker maker(edges, worth, options.area_of_a_byte, around);
    for (std::size_t n = 0; n < wanted.size(); ++n) maker.add(within[n], wanted[n]);
    out.push_back(std::move(maker.places_));
    around = std::move(maker.lists_);
    above = node_of;
  }
  return out;
}

std::vector<std::vector<Ids>> decoded_levels(const EdgeUsers& edges,
                                             const std::vector<std::vector<ListPlace>>& levels) {
  std::vector<std::vector<Ids>> out;
  ListFloods floods(edges);
  std::uint64_t gone_over = 0;
  for (const auto& places : levels) {
    const std::vector<Ids> none;
    LevelReader reader(edges, floods, out.empty() ? none : out.back(), places, gone_over);
    out.push_back(reader.read());
  }
  return out;
}

}  // namespace clues::reference
