// D14: walks look for sight lines in general position. With a flat cell or a segment some points have few of them, or none: V and the point are in one plane, and
// in it, or on it, something stands before most of V, or all of it.
#pragma once

#include <optional>
#include <vector>

#include "exact/sight/scene_query.h"

namespace clues::reference {

// What in a plane with V makes sight lines that run in it special: convex sets, of one input triangle or piece each.
class SpecialPosition {
 public:
  // `plane` holds V, which is flat or a segment. O(pieces that touch the plane).
  SpecialPosition(const exact::SceneQuery& scene, const exact::Plane3& plane);

  // Whether there are so few sets that an answer costs less than hundreds of trials.
  bool is_quick() const { return sets_.size() <= 64; }

  // On the border of a convex polygon or segment `viewpoints`, a part of V that p, a point of the plane, is not inside of: a point from which the sight line
  // to p, and so those from next to it, are not special for any of these reasons. None: then crossings(v, p, off_planes) is degenerate for each v of the
  // polygon. O(sets^2 corners).
  std::optional<exact::Point3> free_viewpoint(const std::vector<exact::Point3>& viewpoints, const exact::Point3& p,
                                              bool off_planes) const;

 private:
  struct Set {
    std::vector<exact::Point3> corners;  // one, two or three
    exact::Plane3 of_piece;
    bool in_plane = false;  // the input triangle, else what it has in common with the plane that it stands on
    bool holds_cell = false;
  };
  static bool meets(const Set& set, const exact::Point3& v, const exact::Point3& p);

  exact::Vector3 normal_;
  std::vector<Set> sets_;
};

}  // namespace clues::reference
