// D5, D3: which triangles does an open segment with double end points meet? Every answer is exactly right: three stages - four triangles at
// once in floats, one in doubles, one in whole numbers - each of which answers only what its error bound allows and leaves the rest
// to the next. Closed triangles, open segment: grazing an edge or a vertex blocks, touching at an end point does not. Triangles without area are
// no surface; a segment without length meets nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fastpath/predicates/cell.h"
#include "fastpath/predicates/filter.h"
#include "fastpath/queries/bvh.h"

namespace clues::fastpath {

// What a query leaves out. `triangles`: these ids (a few; they are looked through one by one). `cell`: what triangles have in its
// interior does not occlude (D3).
struct Except {
  std::span<const std::uint32_t> triangles{};
  const Cell* cell = nullptr;
};

// How the triangles that queries looked at were decided.
struct SegmentCounts {
  std::uint64_t queries = 0;
  std::uint64_t blocks = 0;   // of four triangles, in floats
  std::uint64_t doubles = 0;  // triangles that floats left open
  std::uint64_t exact = 0;    // questions that doubles left open

  SegmentCounts& operator+=(const SegmentCounts& other);
  bool operator==(const SegmentCounts&) const = default;
};

// Queries on one tree by one thread. O(log n + triangles near the segment), as trees go. Every query throws scene::Error for an end
// point that is not finite.
class SegmentQueries {
 public:
  // Keeps a reference: the tree must outlive it. Throws scene::Error unless the thread has the default floating-point environment, which must
  // stay so.
  explicit SegmentQueries(const Bvh& bvh);

  // Whether any triangle blocks the segment.
  bool any_hit(const Segment& s, const Except& except = {});
  // The same for many segments, several at a time: faster, as their waits for memory overlap. answers[i] becomes 1 where segments[i] is blocked, else
  // 0; as many answers as segments.
  void any_hits(std::span<const Segment> segments, std::span<std::uint8_t> answers, const Except& except = {});
  // All that do, ascending.
  std::vector<std::uint32_t> all_hits(const Segment& s, const Except& except = {});
  // The one that does so nearest to s.a, the least id among several at the same point. A triangle along the segment counts from where it begins.
  std::optional<std::uint32_t> first_hit(const Segment& s, const Except& except = {});

  const SegmentCounts& counts() const { return counts_; }

 private:
  struct Query;
  bool blocks(const Query& query, std::uint32_t triangle, bool known_to_meet);
  // Tells `found` the triangles of the block that block the segment, until it answers true.
  template <class Found>
  bool hits_of_block(const Query& query, const BlockTest& test, const TriangleBlock& block, const Found& found);
  bool any_of_block(const Query& query, const BlockTest& test, const TriangleBlock& block);

  const Bvh* bvh_;
  SegmentCounts counts_;
};

// any_hit for many segments, by all threads of the current arena; answers[i] is 1 where segments[i] is blocked. The same `except` for all.
std::vector<std::uint8_t> any_hits(const Bvh& bvh, std::span<const Segment> segments, const Except& except = {},
                                   SegmentCounts* counts = nullptr);

}  // namespace clues::fastpath
