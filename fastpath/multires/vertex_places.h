// Pi of the vertices of the input alone (D32), without the overlay: for whoever wants levels and places, and no proof. They are carried as the points of
// an overlay are, to the bit. What only the overlay would forbid is not forbidden.
#pragma once

#include <vector>

#include "fastpath/multires/common_pieces.h"
#include "fastpath/multires/surface_star.h"

namespace clues::fastpath::multires {

class VertexPlaces {
 public:
  explicit VertexPlaces(const scene::TriangleMesh& input);

  // `out`: who is moved where. By any thread, as Carrier::carry.
  void carry(const SurfaceStar& star, const DiskLayout& layout, const HoleCover& cover, Carried& out) const;
  // The triangles of the cover are numbered on.
  void put(const SurfaceStar& star, const HoleCover& cover, const Carried& carried);
  void write_to(scene::Hierarchy& hierarchy) const;

 private:
  std::vector<scene::CarrierPoint> images_;
  // Who lies in a triangle, in lists: the first of each triangle, and who follows on a vertex.
  std::vector<std::uint32_t> first_, next_;
};

}  // namespace clues::fastpath::multires
