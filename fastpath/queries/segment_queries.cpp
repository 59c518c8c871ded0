// The three stages, from a block in floats to a triangle in whole numbers.
#include "fastpath/queries/segment_queries.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "exact/dials.h"
#include "fastpath/predicates/exact_segment.h"
#include "fastpath/queries/traverse.h"
#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

constexpr std::size_t kSegmentsATask = 256;
constexpr std::size_t kTogether = 6;  // segments that one thread walks with at once

bool apart(const Range& x, const Range& y) { return x.high < y.low || y.high < x.low; }
bool contains(const Range& x, const Range& y) { return x.low < y.low && y.high < x.high; }

}  // namespace

struct SegmentQueries::Query {
  const Segment* segment;
  std::span<const std::uint32_t> ignored;
  const Cell* cell = nullptr;  // null unless the segment may meet int V
  Cell::Span inside{};

  Query(const Segment& s, const Except& except) : segment(&s), ignored(except.triangles) {
    if (except.cell == nullptr) return;
    inside = except.cell->span_of(s);
    if (inside.outer.low <= inside.outer.high) cell = except.cell;
  }
  bool ignores(std::uint32_t triangle) const {
    return std::find(ignored.begin(), ignored.end(), triangle) != ignored.end();
  }
};

SegmentCounts& SegmentCounts::operator+=(const SegmentCounts& other) {
  queries += other.queries;
  blocks += other.blocks;
  doubles += other.doubles;
  exact += other.exact;
  return *this;
}

SegmentQueries::SegmentQueries(const Bvh& bvh) : bvh_(&bvh) { require_float_rules(); }

// Stages 2 and 3 for one triangle that is not ignored.
bool SegmentQueries::blocks(const Query& query, std::uint32_t triangle, bool known_to_meet) {
  const Segment& s = *query.segment;
  const Corners t = bvh_->corners(triangle);
  if (!known_to_meet) {
    ++counts_.doubles;
    const Meets meets = meets_filtered(s, t);
    if (meets == Meets::no) return false;
    if (meets == Meets::unsure) {
      ++counts_.exact;
      return query.cell != nullptr && !misses_inside_of(t, *query.cell) ? blocks_exact(s, t, *query.cell)
                                                                        : meets_exact(s, t);
    }
  }
  if (query.cell == nullptr) return true;
  // It meets the triangle in one point: is that in int V?
  const Range where = crossing_parameter(s, t);
  if (apart(where, query.inside.outer)) return true;
  if (contains(query.inside.inner, where)) return false;
  ++counts_.exact;
  return misses_inside_of(t, *query.cell) || blocks_exact(s, t, *query.cell);
}

template <class Found>
bool SegmentQueries::hits_of_block(const Query& query, const BlockTest& test, const TriangleBlock& block,
                                   const Found& found) {
  ++counts_.blocks;
  BlockAnswer answer = test(block);
  if (exact::process_dials::is_on(exact::process_dials::unsure_doubles)) [[unlikely]]
    answer = {0, 0xF};
  for (unsigned lanes = answer.hit | answer.unsure; lanes != 0; lanes &= lanes - 1) {
    const int lane = __builtin_ctz(lanes);
    if (query.ignores(block.id[lane])) continue;
    const bool hit = ((answer.hit >> lane) & 1U) != 0;
    if (((hit && query.cell == nullptr) || blocks(query, block.id[lane], hit)) && found(block.id[lane])) return true;
  }
  return false;
}

bool SegmentQueries::any_of_block(const Query& query, const BlockTest& test, const TriangleBlock& block) {
  return hits_of_block(query, test, block, [](std::uint32_t) { return true; });
}

bool SegmentQueries::any_hit(const Segment& s, const Except& except) {
  ++counts_.queries;
  LocalSegment local;
  if (make_local(bvh_->frame(), s, local) == Reach::misses) return false;
  const Query query(s, except);
  const BlockTest test(local);
  bool found = false;
  traverse(*bvh_, local, [&](const TriangleBlock& block) { return found = any_of_block(query, test, block); });
  return found;
}

void SegmentQueries::any_hits(std::span<const Segment> segments, std::span<std::uint8_t> answers,
                              const Except& except) {
  if (answers.size() != segments.size()) {
    throw scene::Error(scene::ErrorCode::bad_argument, "any_hits needs room for one answer for each segment");
  }
  struct Lane {
    Query query;
    BlockTest test;
    Traversal traversal;
    std::uint8_t* answer;
    // In place: a traversal has room for a whole stack, which must not be copied.
    Lane(const Segment& segment, const Except& but, const LocalSegment& local, std::uint8_t* to)
        : query(segment, but), test(local), traversal(local), answer(to) {}
  };
  std::array<std::optional<Lane>, kTogether> lanes;
  std::size_t next = 0;
  // Puts the next segment that needs a traversal into the lane; false when there is none.
  const auto refill = [&](std::optional<Lane>& lane) {
    for (; next < segments.size(); ++next) {
      ++counts_.queries;
      answers[next] = 0;
      LocalSegment local;
      if (make_local(bvh_->frame(), segments[next], local) == Reach::misses || bvh_->nodes().empty()) continue;
      lane.emplace(segments[next], except, local, &answers[next]);
      ++next;
      return true;
    }
    lane.reset();
    return false;
  };
  std::size_t active = 0;
  for (auto& lane : lanes) active += refill(lane) ? 1 : 0;
  while (active > 0) {
    for (auto& lane : lanes) {
      if (!lane) continue;
      const bool goes_on = lane->traversal.step(*bvh_, [&](const TriangleBlock& block) {
        const bool found = any_of_block(lane->query, lane->test, block);
        *lane->answer = found ? 1 : 0;
        return found;
      });
      if (goes_on) {
        lane->traversal.prefetch(*bvh_);
      } else if (!refill(lane)) {
        --active;
      }
    }
  }
}

std::vector<std::uint32_t> SegmentQueries::all_hits(const Segment& s, const Except& except) {
  ++counts_.queries;
  std::vector<std::uint32_t> found;
  LocalSegment local;
  if (make_local(bvh_->frame(), s, local) == Reach::misses) return found;
  const Query query(s, except);
  const BlockTest test(local);
  traverse(*bvh_, local, [&](const TriangleBlock& block) {
    return hits_of_block(query, test, block, [&](std::uint32_t id) {
      found.push_back(id);
      return false;
    });
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());  // blocks of fewer than four repeat one
  return found;
}

std::optional<std::uint32_t> SegmentQueries::first_hit(const Segment& s, const Except& except) {
  ++counts_.queries;
  LocalSegment local;
  if (make_local(bvh_->frame(), s, local) == Reach::misses) return std::nullopt;
  const Query query(s, except);
  const BlockTest test(local);
  std::optional<std::uint32_t> best;
  Range best_range;
  float limit = 1;
  const auto offer = [&](std::uint32_t triangle) {
    if (best == triangle) return;
    const Corners t = bvh_->corners(triangle);
    const Range range = crossing_parameter(s, t);
    if (best && range.low > best_range.high) return;
    if (best && !(range.high < best_range.low)) {
      ++counts_.exact;
      const int order = compare_first_exact(s, t, bvh_->corners(*best), query.cell);
      if (order > 0 || (order == 0 && triangle > *best)) return;
    }
    best = triangle;
    best_range = range;
    // From the parameter of the segment to that of its part in the scene; a few roundings of a relative 2^-53, made up for by 2^-40.
    const double part =
        (range.high * (1 + 0x1p-40) - local.begin) / (local.end - local.begin) * (1 + 0x1p-40) + 0x1p-40;
    if (part < static_cast<double>(limit)) limit = std::max(0.0F, rounded_up(part));
  };
  traverse_ordered(
      *bvh_, local,
      [&](const TriangleBlock& block) {
        hits_of_block(query, test, block, [&](std::uint32_t id) {
          offer(id);
          return false;
        });
      },
      [&] { return limit; });
  return best;
}

std::vector<std::uint8_t> any_hits(const Bvh& bvh, std::span<const Segment> segments, const Except& except,
                                   SegmentCounts* counts) {
  std::vector<std::uint8_t> answers(segments.size());
  std::vector<SegmentCounts> parts((segments.size() + kSegmentsATask - 1) / kSegmentsATask);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    SegmentQueries queries(bvh);
    const std::size_t begin = part * kSegmentsATask, size = std::min(segments.size() - begin, kSegmentsATask);
    queries.any_hits(segments.subspan(begin, size), std::span(answers).subspan(begin, size), except);
    parts[part] = queries.counts();
  });
  if (counts != nullptr) {
    for (const SegmentCounts& part : parts) *counts += part;
  }
  return answers;
}

}  // namespace clues::fastpath
