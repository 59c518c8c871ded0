// D10-D13: from a source to its valid wedge pieces. A job is a sector that waits: a visible part of a contour edge seen from a touching cell vertex (D10, D11), or a sector
// of an apex (D12). What blocks along its wedge is found once (on_wedge.h) and kept for as long as the search lasts; each strip of it is a valid piece, since the source is visible.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "exact/sight/scene_query.h"
#include "reference/visibility/wedges/apex.h"
#include "reference/visibility/wedges/contour.h"
#include "reference/visibility/wedges/wedge.h"
#include "reference/visibility/wedges/wedge_set.h"

namespace clues::reference {

class PieceMaker {
 public:
  // Keeps references to both.
  PieceMaker(const exact::SceneQuery& scene, const std::vector<ContourEdge>& contours);

  struct Job {
    std::size_t contour = 0;
    int touching = -1;     // index into ContourEdge::touching; -1: an apex sector
    exact::Point3 lo, hi;  // the part of the contour edge
    Apex* apex = nullptr;
    std::size_t sector = 0;
    std::shared_ptr<const OnWedge>* slot = nullptr;  // where the wedge is kept
  };

  // Adds a job for each cell vertex that the plane of the contour edge touches.
  void add_jobs(std::size_t contour, const exact::Point3& lo, const exact::Point3& hi, std::vector<Job>& jobs);
  static void add_job(Apex& apex, std::size_t sector, std::vector<Job>& jobs);

  // The valid pieces of all jobs, in their order. O(m log m) for each new wedge whose plane m pieces meet.
  std::vector<ValidPiece> build(const std::vector<Job>& jobs);

  std::uint64_t wedges_on_edges() const;  // built so far

 private:
  Sector sector_of(const Job& job) const;
  std::vector<ValidPiece> pieces_of(const Job& job) const;

  const exact::SceneQuery& scene_;
  const std::vector<ContourEdge>& contours_;
  std::vector<std::vector<std::shared_ptr<const OnWedge>>> edge_wedges_;  // per contour edge and touching vertex
};

}  // namespace clues::reference
