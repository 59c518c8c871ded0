// D12 at one contour vertex x, a mesh vertex or a point inside a mesh edge (CSV): the sectors of the border of the anti-cone A(x), which may carry
// SE-MV wedges, and what x sees of the cell.
//
// On a small sphere around x every incident piece is an arc, and the arcs cut the free space into faces (star.h). Which sectors exist is lit_sectors.h.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "fastpath/visibility/wedges/on_wedge.h"
#include "fastpath/visibility/wedges/star.h"

namespace clues::fastpath {

struct ApexSector {
  const Plane* plane = nullptr;
  const ExactPoint *ray0 = nullptr, *ray1 = nullptr;
  SpotName name0, name1;
};

class Apex {
 public:
  // x: mesh vertex `id`, or a point inside mesh edge `id`. Keeps references to scene and x.
  Apex(const LocalScene& scene, Pool& pool, bool on_edge, std::uint32_t id, const ExactPoint* x);

  const ExactPoint* x() const { return x_; }
  bool on_edge() const { return on_edge_; }
  std::uint32_t id() const { return id_; }
  const std::vector<ApexSector>& sectors() const { return sectors_; }

  // Whether A(x) is flat: x and V lie in one plane, and the sectors on either side of it only separate (T10).
  bool flat() const { return flat_; }
  // Whether x, where A(x) is flat, has a piece in that plane: then it is seen from just off the plane, past the piece.
  bool has_piece_in_plane() const;

  template <class NT>
  Star<NT> star() const {
    return Star<NT>(*scene_, on_edge_, id_, x_, arcs_);
  }

  // At a mesh vertex: whether the cell is seen from x without an incident piece between any two of the sight lines.
  bool sees_cell_in_one_part() const;
  // At a mesh vertex: one point x + t (q - x), t > 0, q inside V, in each part that incident pieces cut these points into; a part may have several. `inside_cell` is a point inside V. Throws
  // scene::Error internal if the vertex is too intricate.
  std::vector<ExactPoint> views_of_cell(const ExactPoint& inside_cell) const;
  // Whether the direction towards p is in the part of the directions into int V that the one towards q is in. Where A(x) is flat: whether pieces are between the two.
  bool in_one_part(const ExactPoint& p, const ExactPoint& q) const;

 private:
  bool may_meet_cone(const LocalArc& arc) const;  // the directions from x to V; filtered
  void find_sectors(Pool& pool);
  void split(Pool& pool, const Plane* plane, const ExactPoint* ray0, const ExactPoint* ray1);

  const LocalScene* scene_;
  bool on_edge_;
  std::uint32_t id_;
  const ExactPoint* x_;
  std::vector<LocalArc> arcs_;
  std::vector<ApexSector> sectors_;
  bool flat_ = false;
};

}  // namespace clues::fastpath
