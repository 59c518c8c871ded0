// D26: the surfaces on which a flood runs. What is known to be visible, a set on each side of each triangle, is cut along
// segments into parts; two parts of neighbouring triangles are joined where they meet along an edge of the scene, by the
// sides that continue each other there. Where three or more triangles meet in an edge, or one ends, nothing is joined: a
// component more, and nothing else.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/delta/input_sides.h"
#include "reference/visibility/planar/flat_set.h"
#include "scene/mesh/mesh.h"

namespace clues::reference {

// On a side, flat. Along an edge of the triangle it lies between the side and its neighbour.
struct SideSegment {
  std::size_t side = 0;
  FlatSegment at;
};

class SurfaceParts {
 public:
  struct Part {
    std::size_t side = 0;
    Face2 face;  // with segments that end inside of it (FlatSet::faces_cut_by)
  };
  // Of a stretch of an edge of the scene on which two parts meet.
  struct Join {
    std::size_t one = 0, other = 0;  // parts
    SideSegment along;               // on the side of `one`
  };

  // `sets`: one for each side. O(n log n) for n segments and corners.
  SurfaceParts(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh, const std::vector<FlatSet>& sets,
               const std::vector<SideSegment>& cuts);

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<Join>& joins() const { return joins_; }

  // Of each part the number of its component; components count from 0, by their first part.
  std::vector<std::size_t> components() const;

 private:
  std::vector<Part> parts_;
  std::vector<Join> joins_;
};

}  // namespace clues::reference
