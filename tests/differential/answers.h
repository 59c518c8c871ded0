// The answers of both kernels to one scene in one form, and what is asked of them: is anything visible missing, is anything that is seen in a hidden region, and are two answers the same.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/dials.h"
#include "exact/sight/point_occlusion.h"
#include "fastpath/visibility/map/local_map.h"
#include "fuzz/findings/finding.h"
#include "reference/visibility/first_order.h"

namespace clues::tests {

struct Answer {
  std::string by;                      // for messages
  std::vector<std::uint32_t> visible;  // ascending
  std::uint64_t fallbacks = 0;
  std::map<std::pair<std::uint32_t, bool>, double>
      areas;                                 // visible, by triangle and side; none in answers without regions
  std::vector<std::uint32_t> in_doubt = {};  // of the visible ones (D17b); none in refined answers
};

// In solid mode if the scene is meant for it.
Answer reference_answer(const fuzz::Case& scene, const exact::Dials& dials,
                        reference::Formulation formulation = reference::Formulation::plain);
// Through the closure, regions and all.
Answer fast_answer(const fuzz::Case& scene, const exact::Dials& dials);
// By cells, or by backprojection; lists only.
Answer refined_reference_answer(const fuzz::Case& scene, const exact::Dials& dials, bool backprojection, int depth);
Answer refined_fast_answer(const fuzz::Case& scene, const exact::Dials& dials, bool backprojection, int depth);

// Ids of all that is not in `some`.
std::vector<std::uint32_t> missing_from(const std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some);

// Visible triangles, by the exact visible set (validate/visible_set/visible_set.h).
std::vector<std::uint32_t> truly_visible(const fuzz::Case& scene);

// Asks exact point occlusion (D18) about points of triangles.
class PointJudge {
 public:
  explicit PointJudge(const fuzz::Case& scene);
  // Whether the point of this triangle with about these coordinates is seen on that side.
  bool is_seen(std::uint32_t triangle, bool front, const scene::Point& near) const;
  const exact::ConvexCell& cell() const { return cell_; }

 private:
  exact::TriangleCorners corners(std::uint32_t triangle) const;
  const scene::TriangleMesh& mesh_;
  exact::ConvexCell cell_;
  std::vector<exact::TriangleCorners> occluders_;
};

struct Judged {
  std::uint64_t points = 0, seen = 0;  // in hidden regions
};
// The middle of every hidden region, and places between it and the corners.
Judged judge_regions(const PointJudge& judge, const std::vector<fastpath::LocalRegion>& regions);

// A dial for tests, by name.
struct Setting {
  std::string name;
  exact::Dials dials;
};

// Small scenes of several generators.
std::vector<fuzz::Case> small_scenes(std::size_t per_generator, std::size_t most_pieces);

}  // namespace clues::tests
