// ESO, EDO and EDV of a transition, as a figure: how much area its packets keep away from a client for each byte that
// they take. The published measures take the area in an image from some viewpoint, and the triangles that cutting along
// borders makes; here nothing is cut when whole triangles are sent, and no viewpoint is needed (hazard A-36): what is
// paid for a packet is its bytes, and what is had for it is the area of what is not drawn from the cell in which it is
// hidden.
//
//   EDV of DR_E(AB), the newly visible: the area that A need not hold, by the bytes of the packet `+`.
//   EDO of DR_O(AB), the newly hidden: the area that B need not hold, by the bytes of the packet `-`.
//
// Where the regions of the two maps are known these are their areas; where there are lists only, or whole triangles are
// sent, those of whole triangles. A triangle of a packet is in the one list and not in the other, so that all of it is
// kept away.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "reference/delta/delta.h"
#include "scene/mesh/mesh.h"

namespace clues::reference {

// The least double whose square is not below the number, which is not negative; none: there is no finite one. 64 exact
// comparisons.
std::optional<double> root_above(const exact::FT& square);

// Areas of a mesh's triangles, each rounded up to a double; sums of them are exact. Keeps a reference.
class AreaWorth {
 public:
  explicit AreaWorth(const scene::TriangleMesh& mesh) : mesh_(&mesh), areas_(mesh.triangles.size()) {}

  // None: no double is as large.
  std::optional<exact::FT> area_of(const std::vector<std::uint32_t>& triangles) const;
  std::optional<exact::FT> area_of(const Delta& delta, SeenFrom seen) const;  // of the regions with this label
  // Of the packets, as packets.h has them, for a client that has none of the vertices, or none of the triangles'
  // neighbours.
  std::uint64_t bytes_of_plus(const std::vector<std::uint32_t>& triangles) const;
  std::uint64_t bytes_of_minus(const std::vector<std::uint32_t>& triangles) const;

  // The packet `+` keeps less area than that away for each of its bytes.
  bool is_poor(const std::vector<std::uint32_t>& plus, const exact::FT& area_of_a_byte) const;

 private:
  struct Known {
    bool known = false;
    std::optional<exact::FT> area;
  };
  const std::optional<exact::FT>& area_of_one(std::uint32_t triangle) const;

  const scene::TriangleMesh* mesh_;
  mutable std::vector<Known> areas_;  // those that were asked for
};

// Over all transitions between neighbours, what the packets `+` take.
struct PlusTotals {
  std::uint64_t packets = 0, triangles = 0, bytes = 0;
};
PlusTotals plus_totals(const AreaWorth& worth, const std::vector<std::vector<std::uint32_t>>& lists,
                       const std::vector<std::vector<std::uint32_t>>& neighbours);

}  // namespace clues::reference
