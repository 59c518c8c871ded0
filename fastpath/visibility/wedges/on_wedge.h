// D13: what is valid on a wedge. Seen from the wedge's centre every piece that reaches strictly into H- leaves a trace in the plane; the nearest
// trace beyond the near bound ends the wedge there. Pieces in H+ or in the plane block nothing, traces seen edge-on block one ray only.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/visibility/scene/local_scene.h"

namespace clues::fastpath {

// A point of a wedge's plane that a mesh vertex or a mesh edge leaves there; equal names are equal points.
struct SpotName {
  enum class Kind : std::uint8_t { none, vertex, edge };
  Kind kind = Kind::none;
  std::uint32_t id = 0;
  bool operator==(const SpotName&) const = default;
};

// A planar radial sector of less than a half turn: behind a mesh edge as seen from a cell vertex, or with its apex on a contour vertex.
struct Sector {
  const Plane* plane = nullptr;  // V in the closed negative side H+
  const ExactPoint* center = nullptr;
  const ExactPoint *ray0 = nullptr,
                   *ray1 = nullptr;  // points of the bounding rays, counter-clockwise; of an edge wedge: the edge
  SpotName name0, name1;
  bool from_apex = false;
  SpotName apex;  // where the centre is, of a sector from an apex
};

struct Blocker {
  std::uint32_t piece = 0;
  const ExactPoint *u = nullptr, *w = nullptr;  // counter-clockwise
};

struct Strip {
  const ExactPoint *ray0 = nullptr, *ray1 = nullptr;
  int blocker = -1;  // index into OnWedge::blockers
};

// Where a mesh edge crosses the plane, or a mesh vertex lies in it, within the sector and not behind what ends it there.
struct Meeting {
  bool at_vertex = false;
  std::uint32_t id = 0;
  const ExactPoint* at = nullptr;
};

// The trace of a piece seen edge-on; u is nearer to the centre.
struct Radial {
  std::uint32_t piece = 0;
  const ExactPoint *u = nullptr, *w = nullptr;
};

struct OnWedge {
  const Plane* plane = nullptr;
  const ExactPoint* center = nullptr;
  SpotName apex;              // where the centre is, if it is a contour vertex
  std::vector<Strip> strips;  // counter-clockwise, covering the sector
  std::vector<Blocker> blockers;
  std::vector<Radial> radials;
  std::vector<Meeting> meetings;
  std::vector<std::uint32_t> coplanar_edges;

  // The turn of w against u seen from the centre; and of the path a, b, c. Counter-clockwise about the plane's normal: positive.
  int turn(const ExactPoint* u, const ExactPoint* w) const;
  int turn(const ExactPoint* a, const ExactPoint* b, const ExactPoint* c) const;
  // Whether q, at an angle of a strip, is not beyond the strip's blocker, if it has one.
  bool reaches(int blocker, const ExactPoint* q) const;
};

// Makes the envelopes of one scene; keeps its memory from one to the next. The result's points are kept in the pool.
class OnWedgeMaker {
 public:
  OnWedgeMaker(const LocalScene& scene, Pool& pool);
  ~OnWedgeMaker();
  OnWedge make(const Sector& sector);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace clues::fastpath
