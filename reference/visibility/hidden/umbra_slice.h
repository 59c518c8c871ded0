// D27, virtual occluders: the part of a plane that lies in the umbra. Whatever every sight line reaches only through it
// is hidden: a sight line that passes it has points of the umbra right beside it.
//
// On a plane that holds facets of the umbra "in" has two answers, one for each side of the plane: a slice is what the
// slices of parallel planes tend to as they come near from that side. Both are inside the closed umbra.
#pragma once

#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "reference/visibility/hidden/umbra.h"
#include "reference/visibility/planar/flat_faces.h"

namespace clues::reference {

// From where the plane is approached: from where its normal points to, or from the other side.
enum class Approach : std::uint8_t { before, behind };

struct UmbraSlice {
  // Maximal connected faces, flat: in the two coordinates of PlaneFrame of the plane. Outer rings run counter-clockwise about
  // the plane's normal, holes clockwise.
  std::vector<std::vector<Ring2>> faces;
  exact::FT twice_area;  // of the flat faces
};

// O(n log n) for n facets that meet the plane.
UmbraSlice slice_of(const Umbra& umbra, const exact::Plane3& plane, Approach approach);

// The flat faces of a plane, in space.
std::vector<std::vector<exact::Point3>> in_space(const exact::Plane3& plane, const std::vector<Ring2>& face);

// A face whose corners are doubles in its frame's coordinates, and that lies in the given one, which is proved before it
// is returned. None where rounding the corners inwards finds none. O(n^2) for n corners.
std::optional<std::vector<Ring2>> rounded_inwards(const std::vector<Ring2>& face);

}  // namespace clues::reference
