// D12 at one contour vertex x, a mesh vertex or a point inside a mesh edge (CSV): which sectors of the border of the anti-cone A(x) carry
// an SE-MV wedge.
//
// On a small sphere around x every incident piece is an arc, and the arcs cut the free space into faces. What is known to be visible next to x is
// given as probes, directions with visible space. A sector exists if a probe lies in the face of the points just off the sector inside A(x):
// from a visible point beside x sight lines go on in all directions of A(x). Around a point of an edge this is decided exactly; around
// a vertex the face is taken, cut by circles that light passes in one direction (passes_circles), which may give a sector too many and never one too
// few. A sector is left out where visible space surely reaches its other side too: there it bounds nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "fastpath/visibility/wedges/on_wedge.h"
#include "fastpath/visibility/wedges/star.h"

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

struct ApexSector {
  const Plane* plane = nullptr;
  const ExactPoint *ray0 = nullptr, *ray1 = nullptr;
  SpotName name0, name1;
};

class Apex {
 public:
  // x: mesh vertex `id`, or a point inside mesh edge `id`. `contours`: planes of contour edges at the vertex.
  Apex(const LocalScene& scene, Pool& pool, bool on_edge, std::uint32_t id, const ExactPoint* x,
       const std::vector<const Plane*>& contours = {});

  const ExactPoint* x() const { return x_; }
  bool on_edge() const { return on_edge_; }
  std::uint32_t id() const { return id_; }
  const std::vector<ApexSector>& sectors() const { return sectors_; }

  // Whether A(x) is flat: x and V lie in one plane, and the sectors on either side of it only separate (T10).
  bool flat() const { return flat_; }
  // Whether x, where A(x) is flat, has a piece in that plane: then it is seen from just off the plane, past the piece.
  bool has_piece_in_plane() const;

  // The sectors that exist given these probes, ascending. Where A(x) is flat all of them do: one too many cuts, and shows nothing.
  std::vector<std::uint32_t> existing(const std::vector<Probe>& probes);

  // At a mesh vertex: whether the cell is seen from x without an incident piece between any two of the sight lines.
  bool sees_cell_in_one_part() const;
  // At a mesh vertex: one point x + t (q - x), t > 0, q inside V, in each part that incident pieces cut these points into; a part may have several. `inside_cell` is a point inside V. Throws
  // scene::Error internal if the vertex is too intricate.
  std::vector<ExactPoint> views_of_cell(const ExactPoint& inside_cell) const;
  // Whether the direction towards p is in the part of the directions into int V that the one towards q is in. Where A(x) is flat: whether pieces are between the two.
  bool in_one_part(const ExactPoint& p, const ExactPoint& q) const;

 private:
  template <class NT>
  struct Picture;
  class Pictures;
  template <class NT>
  bool exists(std::size_t sector, const Picture<NT>& around);
  // At a mesh vertex: the circle of a plane with V on one side, of a contour edge or a sector. What follows is made when it is first asked for.
  using Face = std::vector<int>;
  struct Circle {
    const Plane* plane;
    std::optional<Vec3<Integer>> normal;
    bool divides = false;               // faces
    std::optional<Star<Integer>> star;  // with the circle
    std::vector<std::pair<Face, Face>> across;
    std::vector<Face> inside;  // of sectors
  };
  bool passes_circles(std::size_t probe, std::size_t sector, const Vec3<Integer>& inner,
                      const Picture<Integer>& around);

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
  std::vector<Circle> circles_;
};

}  // namespace clues::fastpath
