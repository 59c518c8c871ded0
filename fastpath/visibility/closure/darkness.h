// Proofs that triangles lie outside Omega(K) (D9): what the closure (closure.h) asks of the map of a part K of a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "exact/box_tree.h"
#include "fastpath/visibility/closure/closure.h"

namespace clues::fastpath {

// What divides lit space from dark in K, but for wedge pieces: the triangles of K that are lit, and those edge-on to all of V (their planes
// hold V, which is flat). Of any other triangle a side that is lit faces V, so that the triangle is lit, or has V on its plane and
// a wedge piece upon it. Light is never on an edge-on one, as viewers in its plane see past it on both sides (T10): so it stops
// none, but one side of it may be in Omega and the other not, as where a wall stands on a floor that V is in.
class Dividers {
 public:
  Dividers(const Bvh& bvh, const std::vector<std::uint32_t>& ids);

  // Conservative: a box and the plane of a triangle beside it. Those in the plane of `aside` are not asked about.
  bool may_touch(const Box& box, const Corners* aside = nullptr) const;
  // Those that may have a point inside t, which is none of them: whether one lies in its plane, and all others.
  struct Meeting {
    bool in_plane = false;
    std::vector<std::uint32_t> across;
  };
  Meeting may_meet_inside(const Corners& t) const;
  const Corners& corners(std::uint32_t i) const { return corners_[i]; }

 private:
  std::vector<std::uint32_t> near(const Box& box) const;

  std::vector<Corners> corners_;
  exact::BoxTree tree_;
};

// What has been proved dark of a tree. A triangle outside of Omega(K) is outside of Omega(S), whatever part of S the map was made of: so this is kept from pass to pass.
struct ProvedDark {
  explicit ProvedDark(const Bvh& tree)
      : nodes(tree.nodes().size(), 0), blocks(tree.blocks().size(), 0), triangles(tree.mesh().triangles.size(), 0) {}
  // All that is below a node, in a block of triangles; one triangle.
  std::vector<std::uint8_t> nodes, blocks, triangles;
};

class Darkness {
 public:
  // Keeps references. `part`: K; `visible`: all triangles of the scene that light meets in the map; both ascending.
  Darkness(const PartialMap& map, const Bvh& scene, std::span<const std::uint32_t> part,
           std::span<const std::uint32_t> visible, std::span<const Point> cell);

  using Which = std::function<bool(std::uint32_t triangle)>;
  // The triangles of the tree for which there is no proof, but for those that are skipped or proved before. No more levels of the tree are opened once there are `enough`, of which at
  // least one counts. Marks what is proved; `one_by_one` gets what was proved now, but for what a box was enough for.
  std::vector<std::uint32_t> not_proved(const Bvh& tree, const Which& skip, const Which& counts, std::size_t enough,
                                        ProvedDark& proved, ClosureCounts& figures,
                                        std::vector<std::uint32_t>* one_by_one = nullptr) const;

  // Whether all of the cell is in the plane of the triangle.
  bool is_edge_on(const Corners& t) const;

 private:
  bool dark(const Box& box) const { return !dividers_.may_touch(box) && map_.label(box) == SetLabel::hidden; }
  bool dark(const Corners& t) const;
  bool dark_inside(const Corners& t, std::span<const std::uint32_t> across) const;
  bool dark_beside(const Corners& t, int side) const;
  int side_of_cell(const Corners& t) const;  // 0: on both; or all of it is in the plane

  const PartialMap& map_;
  Dividers dividers_;
  std::span<const Point> cell_;
};

}  // namespace clues::fastpath
