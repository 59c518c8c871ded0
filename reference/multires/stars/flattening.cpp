#include "reference/multires/stars/flattening.h"

namespace clues::reference {
namespace {

using exact::DiskPoint;
constexpr DiskPoint middle{0, 0};

}  // namespace

bool is_certified(const StarShape& shape, const FlatStar& flat) {
  const std::size_t n = flat.ring.size(), sectors = shape.ring.triangles.size();
  int upward = 0;  // across the axis to the right
  for (std::size_t k = 0; k < sectors; ++k) {
    const DiskPoint &p = flat.ring[k], &q = flat.ring[(k + 1) % n];
    if (exact::orientation(middle, p, q) <= 0) return false;
    if (p[1] < 0 && q[1] >= 0) ++upward;
  }
  switch (shape.kind) {
    case scene::StarKind::interior:
      return upward == 1;
    case scene::StarKind::boundary:
      return upward == 0 && flat.ring[0][0] > 0 && flat.ring[0][1] == 0 && flat.ring[n - 1][0] < 0 &&
             flat.ring[n - 1][1] == 0;
    case scene::StarKind::feature:
      break;
  }
  return upward == 1 && flat.ring[0][0] > 0 && flat.ring[0][1] == 0 && flat.ring[shape.across][0] < 0 &&
         flat.ring[shape.across][1] == 0;
}

std::vector<FlatStar> flattenings(const StarShape& shape, std::uint32_t vertex,
                                  const std::vector<scene::Point>& points) {
  const exact::LayoutProposals proposals(shape.kind, shape.across, vertex, shape.ring.vertices, points);
  std::vector<FlatStar> found;
  if (!proposals.possible()) return found;
  for (int k = 0; k < exact::LayoutProposals::count; ++k) {
    FlatStar flat;
    flat.ring.resize(shape.ring.vertices.size());
    proposals.lay_out(k, flat.ring);
    if (is_certified(shape, flat)) found.push_back(std::move(flat));
  }
  return found;
}

}  // namespace clues::reference
