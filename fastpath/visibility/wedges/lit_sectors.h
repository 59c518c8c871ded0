// Which sectors of the border of an anti-cone carry an SE-MV wedge (D12).
//
// What is known to be visible next to x is given as probes, directions with visible space. A sector exists if a probe lies in the face of the points just
// off the sector inside A(x): from a visible point beside x sight lines go on in all directions of A(x). Around a point of an edge this is decided
// exactly; around a vertex the face is taken, cut by circles that light passes in one direction (T13), which may give a sector too many and never one
// too few. A sector is left out where visible space surely reaches its other side too: there it bounds nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fastpath/visibility/wedges/apex.h"

namespace clues::fastpath {

// A direction from x, towards `to`, moved a little to `aside` and by much less to `off`, with visible space beside x.
struct Probe {
  enum class Kind : std::uint8_t {
    sight,    // to a point near x that is visible
    contour,  // along a visible contour edge to its other end, off its supporting plane into H-
    csv,      // back to the centre of a valid piece that passes x, beside its ray, off into H-
  };
  Kind kind = Kind::sight;
  const ExactPoint* to = nullptr;
  SpotName at;                          // what of the mesh `to` is
  const Plane* plane = nullptr;         // contour, csv
  int aside = 0;                        // csv: +1 counter-clockwise about the plane's normal, -1 clockwise
  const ExactPoint* lit_end = nullptr;  // csv on an edge: the edge's end in H-
  // Visible only if what nothing is known about is: walks from elsewhere may call the same space hidden. So it makes sectors, and leaves none out (search.h).
  bool doubtful = false;
  bool operator==(const Probe&) const = default;
};

// Remembers what it has found for a probe and a sector.
class LitSectors {
 public:
  // Keeps references to scene and apex. `contours`: planes of contour edges at a mesh vertex.
  LitSectors(const LocalScene& scene, const Apex& apex, const std::vector<const Plane*>& contours);
  LitSectors(const LitSectors&) = delete;
  LitSectors& operator=(const LitSectors&) = delete;
  ~LitSectors();

  // The sectors that exist given these probes, ascending. Where A(x) is flat all of them do: one too many cuts, and shows nothing.
  // Throws scene::Error internal if the vertex is too intricate.
  std::vector<std::uint32_t> existing(const std::vector<Probe>& probes);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace clues::fastpath
