// D12 at one point: which SE-MV wedges start at a contour vertex (a mesh vertex, or a CSV on an edge).
//
// On the small sphere around x (LocalStar) a wedge with apex x goes in directions w of the boundary of the anti-cone. It exists where
// visible space near x, known by a few probes, lies in the same local face as the points just off w in H-: a sight line that
// reaches x there goes on in every direction of A(x) that no piece is in the way of. It is left out where that same visible space surely reaches the other side (H+)
// of the wedge as well: such a piece bounds nothing. Building too many pieces would be correct too, only slower (D12).
//
// Where x and V lie in one plane A(x) is flat, and both sides of it are sectors. They only separate (T10): all of them are built as soon as x is known, or suspected, to be visible.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/wedges/local_star.h"
#include "reference/visibility/wedges/on_wedge.h"

namespace clues::reference {

// Visible space beside x: the direction it is known for, and a true direction so near to it that no piece lies between.
struct Probe {
  Beside beside;
  exact::Vector3 actual;
  exact::Vector3 lit_edge = CGAL::NULL_VECTOR;  // at a CSV: the direction of the visible part of the crossed edge
  // Visible only if what nothing is known about is: walks from elsewhere may call the same space hidden. So it makes sectors, and leaves none out (fixpoint.h).
  bool doubtful = false;
};

// A sector of the anti-cone's boundary between two neighbouring traces of incident pieces, its middle, and its local face.
struct ApexSector {
  exact::Plane3 plane;
  exact::Vector3 ray0, ray1, middle;
  exact::Vector3 inner;                     // beside middle, inside the anti-cone
  std::vector<int> face;                    // that inner is in
  std::shared_ptr<const OnWedge> on_wedge;  // made when first needed
  bool built = false;                       // in this round
};

class Apex {
 public:
  // `contours`: the planes of contour edges at this vertex.
  static Apex at_vertex(const exact::Complex& complex, const exact::ConvexCell& cell, std::uint32_t point,
                        const std::vector<exact::Plane3>& contours);
  static Apex at_edge(const exact::Complex& complex, const exact::ConvexCell& cell, std::uint32_t edge,
                      const exact::Point3& x);

  // A probe just off `limit` towards `aside` (may be zero: exactly along limit) and then towards `off`.
  Probe probe(const exact::Vector3& limit, const exact::Vector3& aside, const exact::Vector3& off) const;

  void add_probe(const Probe& p) {
    probes_.push_back(p);
    fresh_ = true;
  }
  // Whether A(x) is flat: its sectors lie in a plane that holds V.
  bool flat() const { return flat_; }
  // Directions into int V: at least one in each part that incident pieces cut the directions to V into, in whose local
  // face a sector starts and in which none of `known` is. Where A(x) is flat: one in each part that pieces which are not
  // in its plane cut the way to V into.
  std::vector<exact::Vector3> into_cell(const exact::ConvexCell& cell, const std::vector<exact::Vector3>& known) const;
  // Whether two directions into int V surely lie in one such part, which has one label: no wedge with apex x or through
  // x divides it, as V is on one side of its plane. A face may have several parts, joined far from V (definition, 6).
  bool in_one_part(const exact::Vector3& d, const exact::Vector3& e) const { return star_.free_between(d, e); }
  // Whether a sector starts in the local face that contains d.
  bool has_sector_facing(const exact::Vector3& d) const;
  // The sectors that exist by the probes so far and were not given before in this round.
  std::vector<std::size_t> new_sectors();
  void start_round();
  bool probed() const { return !probes_.empty(); }  // in this round

  int generation = 0;  // of its wedges; at a CSV: -1 until one is found in this round

  const exact::Point3& x() const { return x_; }
  bool on_edge() const { return on_edge_; }
  std::uint32_t id() const { return id_; }
  std::vector<ApexSector>& sectors() { return sectors_; }

 private:
  Apex(const exact::ConvexCell& cell, const exact::Point3& x, LocalStar star);

  bool has_sector_in(const std::vector<int>& face) const;
  // At a mesh vertex: the circle of a plane with V on one side, of a contour edge or a sector, that divides faces. What follows is made when it is first asked for.
  using Face = std::vector<int>;
  struct Circle {
    exact::Vector3 normal;
    std::optional<LocalStar> star;  // with the circle
    std::vector<std::pair<Face, Face>> across;
    std::vector<Face> inside;  // of sectors
  };
  void add_circles(const std::vector<exact::Plane3>& contours, const exact::ConvexCell& cell);
  // Whether the visible space of probe p, in the local face of sector s, may reach the sector's inside. `faces`: those of the probe in stars with circles, once
  // they were asked for.
  bool spreads(const Probe& p, std::size_t s, std::vector<Face>& faces);
  bool passes_circles(const Probe& p, std::size_t s, std::vector<Face>& faces);

  exact::Point3 x_;
  LocalStar star_;
  std::vector<exact::Vector3> anticone_;  // its rays: away from the cell's vertices
  std::vector<Circle> circles_;
  bool flat_ = false;
  bool on_edge_ = false;
  std::uint32_t id_ = 0;
  std::vector<ApexSector> sectors_;
  std::vector<Probe> probes_;
  bool fresh_ = false;
};

}  // namespace clues::reference
