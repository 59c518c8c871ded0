// First-order visibility of a large scene from the map of a small part of it (D9), with hidden depth costing next to nothing.
//
// Theorem. If K contains every triangle of S that has a point in Omega(S), then Omega(K) = Omega(S).
// Proof. A continuation C(x,v) with x in Omega(S) ends, in S, at a point of Omega(S), so at a triangle of K, and K has no nearer one: C(x,v) is the same in K and in S.
// So Omega(S) is closed under continuation in K, which makes Omega(K) a subset of Omega(S); then x in Omega(K) is in Omega(S), and Omega(K) is closed under continuation
// in S, which makes it a superset. (What S has of measure zero in Omega(S) changes K's map by measure zero. So triangles that are edge-on to a flat V, in a
// plane with all of it, need not be in K: sight lines off the plane do not meet them, and no side of them faces V.)
//
// For any part K, Omega(S) lies in Omega(K): along a chain of D9 C(x,v) in S is a beginning of that in K. So a triangle that is proved to lie outside Omega(K) is dark for good, whatever
// K is mapped next.
//
// So: guess K by sampled rays, map K, and then prove of every other triangle that it lies outside Omega(K). A box that no lit triangle of K, no edge-on one and no wedge of K touches is of one
// label, so one point proves a whole subtree of the BVH dark. Where a proof fails K grows by the triangle, and by what is in front. What light does not meet in K is dark and leaves it. Then the loop
// runs again with what is left. When nothing is, K is as the theorem wants it, as only what is dark is not in it; K may hold too much.
//
// What is proved dark and next to K comes into the map all the same, marked (ScenePart::dark): not into K, as it stops no light, but the engine takes the wedges at a vertex by the faces that
// all incident triangles make there, and without these its map may have too much (never too little).
//
// Where a map is given up, light came past what K lacks, which is what makes maps long: so K becomes all that counts, with what else it had in the map before, or has in this one if there was none.
// If that is too much, too, or far more than K, K goes back to what it was, or, if there was no map, to what counts of the first one; and if some triangles do not count it grows again without any more of
// those: through cracks between hulls light leaks as well. And where such a map is given up the one before stands, whatever K became since: what is not proved to lie outside Omega of its part is listed, whether light meets it or not (`unproved`). If there is
// none, all is.
//
// Where some triangles do not count (D22: the hulls of a level) nobody needs a proof about them: the loop ends when those that count are mapped or proved, and what light meets in
// Omega(K) is listed, of which Omega(S) is a part. It may be more: light may come past what was left out. So that little does, K grows, too, by those without a proof that sight lines meet on
// their way to what is asked about, or is listed and has been seen by no ray (once each).
//
// Where only a list is wanted, and little came into K after a map, not all of K is mapped again, but what is on the way from V to what is still open (open_part.h).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "exact/dials.h"
#include "fastpath/predicates/cell.h"
#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/labels/set_label.h"
#include "fastpath/visibility/points/box.h"
#include "fastpath/visibility/points/points.h"

namespace clues::fastpath {

// The map of a small scene for a cell, as the closure asks for it. The questions may come from several threads at once.
class PartialMap {
 public:
  PartialMap() = default;
  PartialMap(const PartialMap&) = delete;
  PartialMap& operator=(const PartialMap&) = delete;
  virtual ~PartialMap() = default;

  // Triangles of the small scene with a visible region, or meeting the cell; ascending.
  virtual std::vector<std::uint32_t> visible() const = 0;
  // hidden only if all of the closed box is outside Omega, where no visible triangle touches it, nor one that is edge-on to the cell (darkness.h, Dividers); so below.
  virtual SetLabel label(const Box& box) const = 0;
  // The same for the inside of a convex polygon that no visible triangle meets. It is asked at middle_of(about); `about` holds a point of the inside, and no visible triangle touches it.
  virtual SetLabel label_of_inside(std::span<const ExactPoint> polygon, const Box& about) const = 0;
  // The same for what is right beside the inside of a triangle, on the side of middle_of(about), which is not in its plane. Visible ones may meet the inside, or touch `about`, only if they
  // lie in that plane.
  virtual SetLabel label_beside(const Corners& triangle, const Box& about) const = 0;
  // False only if no wedge piece touches the closed triangle.
  virtual bool piece_may_touch(const Corners& triangle) const = 0;
  // Whether any of it counts as visible for want of a proof.
  virtual bool has_fallbacks() const = 0;
};

// How a part came about. A map that is given up is made again, of another part, as long as there is a stage left:
enum class PartStage : std::uint8_t {
  grown,  // from what rays saw, and what came to that
  all,    // from all that counts
  again,  // in place of that, the same part as before, where that is much more or nothing more
  rest,  // from the part of the map before; nothing comes in any more that does not count. Or, where all count, from the part of the map that was given up first
  least,  // the same where there is no map yet: from what counts of that part
};

// A part of the scene, as it is mapped.
struct ScenePart {
  scene::TriangleMesh mesh;
  std::vector<std::uint32_t> ids;  // of its triangles in the scene, ascending
  // Of each: whether it is known to be outside of Omega(S), and is there only for what it divides around vertices.
  std::vector<std::uint8_t> dark;
};

// K of a part: the ids of those that are not dark.
std::vector<std::uint32_t> mapped_of(std::span<const std::uint32_t> ids, std::span<const std::uint8_t> dark);

// Makes the map of a part of the scene, for the same cell. None: it is given up, as it takes too much effort.
using PartialMapMaker = std::function<std::shared_ptr<const PartialMap>(const ScenePart& part, PartStage stage)>;

// Cheap figures about how the answer came about, over all passes.
struct ClosureCounts {
  std::uint64_t passes = 0;      // maps made
  std::uint64_t rays = 0;        // first hits asked for
  std::uint64_t boxes_dark = 0;  // subtrees proved dark as a whole
  std::uint64_t boxes_opened = 0;
  std::uint64_t triangles_dark = 0;  // proved dark one by one
  std::uint64_t mapped = 0;          // triangles of K
  std::uint64_t settled = 0;  // of these, visible by a free sight line where the last map was made of what was open
};

struct Closure {
  // K, and what is known to be dark beside it: ids of the scene, ascending. Triangle i of the map is part[i], but where a list was wanted: then the last map may be one of
  // a part of K.
  std::vector<std::uint32_t> part;
  std::vector<std::uint8_t> dark;  // of each: whether it is none of K
  std::vector<std::uint32_t>
      visible;  // of K, what light meets: ids of the scene, ascending. With what follows it is the PVS.
  std::vector<std::uint32_t>
      unproved;  // where a map was given up: what is not in the part and not proved to be dark; ascending
  std::shared_ptr<const PartialMap> map;  // none: all maps were given up, and all of the scene is unproved
  ClosureCounts counts;
};

// A box that contains the point with these weights, which sum to 1, and that point rounded. With u =
// 2^-53 and M the largest corner coordinate each product is off by u M or, where it underflows, by 2^-1075;
// the sums by 2 u M (no sum of doubles underflows): at most 5 u M + 3 2^-1075 in all. The box is wider than
// 2^-50 M + 2^-1071 in every direction, less its own rounding, which is below 2 u M.
Box about_inside(const Corners& t, const std::array<double, 3>& weight);

inline constexpr std::size_t kMappedWhole = 64;
// After a map is given up K becomes all that counts, if that is no more than so many times the part of that map, or of kLeastAll triangles.
inline constexpr std::size_t kAllForPart = 16, kLeastAll = 512;

// Triangles that stop no light (D22), as a tree of their own: those that are not proved to lie outside Omega of the scene that was closed, ids of the
// tree's mesh, ascending. All that the closure's proofs use of a triangle outside K is that it is one; whether it would stop light, were it lit, does not matter to them.
// `scene` is the tree that was closed, for `cell`; the map has to answer for places all over `others` (make_map, `outside`).
std::vector<std::uint32_t> not_proved_dark(const Bvh& others, const Closure& closure, const Bvh& scene,
                                           const Cell& cell);

enum class Wanted : std::uint8_t { map, list };

// Deterministic for any number of threads of the current arena. Scenes of up to `whole` triangles are mapped as they are, unless the first guess is on a dial; and so is, unless it is 0, all that counts
// if rays see half of that, and what is missing is not much: another map costs more than what may be left out.
// `guess`: triangles that are mapped from the start, for instance what a neighbour sees; whatever it is, the answer is a closed one.
// `counting`: for each triangle whether it is asked about; none: all are. Of the others the list holds some that are dark, and not all that are lit.
// `wanted`: see Closure::part.
// O(passes * (map of K + boxes next to lit space)).
Closure close_over_visible(const Bvh& bvh, const Cell& cell, const PartialMapMaker& make_map,
                           std::size_t whole = kMappedWhole, const exact::Dials& dials = {},
                           std::span<const std::uint32_t> guess = {}, std::span<const std::uint8_t> counting = {},
                           Wanted wanted = Wanted::map);

}  // namespace clues::fastpath
